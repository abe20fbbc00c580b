/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Exact modal propagation against CVODE on random scenes with fixed numbers of modes: the same
 * model, two independent integrations in time. */
#include "physics/support.h"

enum { SCENES = 28 };

static struct material random_material(uint64_t *seed)
{
    return (struct material){"random",
                             random_between(seed, 30e9, 220e9),
                             random_between(seed, 0.1, 0.4),
                             random_between(seed, 2000.0, 8000.0),
                             INFINITY,
                             0.0};
}

static double maybe(uint64_t *seed, double low, double high)
{
    double value = random_between(seed, low, high);
    return random_between(seed, 0.0, 1.0) < 0.5 ? 0.0 : value;
}

/* Something round to strike with: a ball, a round-tipped rod, a beam laid across. */
static struct spot random_striker(struct lab *lab, uint64_t *seed, int kind)
{
    struct body body = make_sphere(random_material(seed), random_between(seed, 0.006, 0.02));
    struct spot spot = sphere_spot("striker", body.radius);
    if (kind == 1) {
        double length = random_between(seed, 0.1, 0.6);
        body = make_bar(&rod_kind, body.material, 0.5 * body.radius, length);
        body.tip_radius = random_between(seed, 1.1, 3.0) * body.radius;
        body.lateral_inertia = random_between(seed, 0.0, 1.0) < 0.5;
        spot = end_spot("striker", length);
    } else if (kind == 2) {
        double length = random_between(seed, 0.2, 0.6);
        body = make_bar(&beam_kind, body.material, body.radius, length);
        spot = side_spot("striker", random_between(seed, -0.45, 0.45) * length, body.radius,
                         random_between(seed, -3.0, 3.0));
    }
    body.damping = body_is_flexible(&body) ? maybe(seed, 0.0, 0.05) : 0.0;
    body.modes = body_is_flexible(&body) ? (unsigned)random_between(seed, 3.0, 9.0) : 0;
    lab_add(lab, "striker", body);
    return spot;
}

/* Something long or flat to be struck: a round or rectangular beam, a rod's face, a wall. */
static struct spot random_target(struct lab *lab, uint64_t *seed, int kind)
{
    struct material material = random_material(seed);
    double length = random_between(seed, 0.3, 1.2);
    double radius = random_between(seed, 0.006, 0.015);
    double x = random_between(seed, -0.48, 0.48) * length;
    struct body body = make_bar(kind == 2 ? &rod_kind : &beam_kind, material, radius, length);
    struct spot spot = side_spot("target", x, radius, random_between(seed, -3.0, 3.0));
    if (kind == 1) {
        body.radius = 0.0;
        body.width = random_between(seed, 0.01, 0.04);
        body.height = random_between(seed, 0.006, 0.02);
        spot =
            (struct spot){"target", {x, 0.2 * body.width, 0.5 * body.height}, {0.0, 0.0, 1.0}, 0.0};
    } else if (kind == 2) {
        spot = end_spot("target", length);
    } else if (kind == 3) {
        body = make_body(&half_space_kind, material);
        spot = wall_spot("target");
    }
    if (body.kind == &beam_kind) {
        body.theory =
            random_between(seed, 0.0, 1.0) < 0.5 ? THEORY_TIMOSHENKO : THEORY_EULER_BERNOULLI;
        for (int end = 0; end < 2; end++)
            body.supports[end] = (enum support)random_between(seed, 0.0, 2.999);
    }
    body.damping = body_is_flexible(&body) ? maybe(seed, 0.0, 0.05) : 0.0;
    body.modes = body_is_flexible(&body) ? (unsigned)random_between(seed, 4.0, 12.0) : 0;
    lab_add(lab, "target", body);
    spot.roll = 0.5 * M_PI; /* bars cross */
    return spot;
}

static struct solve_request random_scene(struct lab *lab, uint64_t *seed, int index)
{
    int kind = index % 3;
    int target = index % 4;
    struct spot a = random_striker(lab, seed, kind);
    struct spot b = random_target(lab, seed, kind == 2 && target ? 0 : target);
    struct solve_request request = strike(a, b, random_between(seed, 0.05, 0.6));
    double q[4];
    random_rotation(seed, q);
    move_scene(&request, q, (double[]){0.0, 0.0, 0.0}, (double[]){0.0, 0.0, 0.0});
    request.contacts[0].gap = maybe(seed, -2e-4, 2e-4);
    request.contacts[0].gap_acceleration = maybe(seed, -20.0, 20.0);
    request.options.tolerance = 1e-7;
    return request;
}

/* Largest relative difference of the peak forces of all scenes. */
static double worst_peak;

static void compare(const struct solve_result *modal, const struct solve_result *cvode)
{
    const struct solve_contact_result *a = &modal->contacts[0];
    const struct solve_contact_result *b = &cvode->contacts[0];
    /* time tolerance 1e-7 on either side; a sequence of sub-impacts amplifies by 10 to 100 */
    if (a->sub_impact_count > 12) {
        /* a long rattle is chaotic: errors grow a hundredfold every few sub-impacts. The reply must
         * say so, and the beginning still agrees. */
        assert_false(modal->tolerance_met);
        measured("rattle, first start", a->sub_impacts[0].start, b->sub_impacts[0].start, 1e-7);
        measured_relative("rattle, first impulse", a->sub_impacts[0].impulse,
                          b->sub_impacts[0].impulse, 1e-6);
        return;
    }
    measured("e", a->restitution, b->restitution, 1e-5);
    assert_int_equal(modal->end_reason, cvode->end_reason);
    assert_int_equal(a->sub_impact_count, b->sub_impact_count);
    measured("time shift", modal->time_shift, cvode->time_shift, 1e-9);
    for (size_t i = 0; i < a->sub_impacts_listed; i++) {
        const struct sub_impact *x = &a->sub_impacts[i];
        const struct sub_impact *y = &b->sub_impacts[i];
        /* relative to the whole impulse; a graze's instants move with the root of its depth */
        double graze = x->negligible ? 1e-5 : 0.0;
        measured("impulse", x->impulse, y->impulse, 1e-5 * a->impulse);
        measured("start", x->start, y->start, 1e-7 + graze);
        measured("end", x->end, y->end, 1e-7 + graze);
        measured("gap rate before", x->gap_rate_before, y->gap_rate_before, 1e-5);
        measured("gap rate after", x->gap_rate_after, y->gap_rate_after, 1e-5);
        if (!x->negligible)
            worst_peak = fmax(worst_peak, fabs(x->peak_force / y->peak_force - 1.0));
    }
    double scale = modal->energy.available;
    /* CVODE notices the end at its next step: what has left the vibration by then is damping */
    measured("vibration and damping", (modal->energy.vibration + modal->energy.damping) / scale,
             (cvode->energy.vibration + cvode->energy.damping) / scale, 1e-5);
    /* ten times the tolerance (notes, section 4) */
    measured("closure, modal", modal->energy.closure / scale, 0.0, 1e-6);
    measured("closure, cvode", cvode->energy.closure / scale, 0.0, 1e-6);
}

static void random_scenes_agree(void **state)
{
    (void)state;
    static struct solve_result modal, cvode;
    struct lab *lab = lab_create();
    uint64_t seed = 1234;
    for (int i = 0; i < SCENES; i++) {
        struct solve_request request = random_scene(lab, &seed, i);
        enum percuss_status status = solve(lab->workspace, &lab->means, &request, &modal);
        if (getenv("PERCUSS_MEASURE"))
            print_message("scene %d: %s on %s, %s, %zu sub-impacts, end %u %s\n", i,
                          lab->bodies[0].kind->name, lab->bodies[1].kind->name, status_name(status),
                          modal.contacts[0].sub_impact_count, modal.end_reason, modal.fault.text);
        assert_true(status == PERCUSS_OK || status == PERCUSS_TRUNCATED);
        /* the sub-impacts listed belong to the workspace */
        struct solve_workspace *other = solve_workspace_create();
        assert_non_null(other);
        request.options.method = PERCUSS_METHOD_CVODE;
        assert_int_equal(solve(other, &lab->means, &request, &cvode), status);
        compare(&modal, &cvode);
        solve_workspace_free(other);
    }
    lab_free(lab);
}

/* The peak of a polynomial on a step in the one, a root of the approach rate in the other. */
static void peak_forces_agree(void **state)
{
    (void)state;
    /* at a tolerance of 1e-7 on e nobody expects four digits only of a force */
    measured("worst peak force", worst_peak, 0.0, 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes_agree),
        cmocka_unit_test(peak_forces_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
