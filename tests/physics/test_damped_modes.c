/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A mesh whose modes have damping ratios of their own: free vibration against its closed form, the
 * energy audit, CVODE, and the same ratios stated in other ways. */
#include "bodies/made_mesh.h"
#include "model/damping.h"
#include "model/mesh_surface.h"
#include "model/modal_basis.h"
#include "physics/ensemble_lab.h"

enum { MODES = 30, RATIOS = 5 };
static const double RATIO[RATIOS] = {0.02, 0.001, 0.0, 0.3, 0.005};

/* A ball, and a beam's mesh: all of its modes that a tolerance asks for. */
struct damped {
    struct lab *lab;
    struct mesh_body *surface;
    double shares[3 * MODES];
};

/* The mesh under another id with `count` ratios, of the modes from the lowest up. */
static const struct body *add(struct damped *damped, const char *id, const double *ratios,
                              size_t count)
{
    struct body body = make_body(&mesh_kind, ALUMINIUM);
    body.mesh = damped->surface;
    body.scale = 1.0;
    body.damping_shares = damped->shares;
    body.damping_count = count;
    for (size_t k = 0; k < count; k++)
        body.damping = fmax(body.damping, ratios[k]);
    for (size_t k = 0; k < count; k++)
        damped->shares[k] = ratios[k] / body.damping;
    return lab_add(damped->lab, id, body);
}

static struct damped *damped_create(void)
{
    struct damped *damped = calloc(1, sizeof *damped);
    assert_non_null(damped);
    damped->lab = lab_create();
    lab_add(damped->lab, "ball", make_sphere(STEEL, 0.015));
    struct made_mesh wanted = {
        .bar = lab_add(damped->lab, "bar", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0)),
        .modes = MODES,
        .removed = 12,
        .around = 16,
        .along = 40};
    damped->surface = made_mesh_bar(&wanted);
    assert_non_null(damped->surface);
    assert_true(mesh_surface_prepare(damped->surface));
    add(damped, "mesh", RATIO, RATIOS);
    return damped;
}

static void damped_free(struct damped *damped)
{
    lab_free(damped->lab);
    mesh_body_free(damped->surface);
    free(damped);
}

static struct solve_request blow(const char *id, double speed, double tolerance)
{
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot(id, 0.12, 0.010, 0.6), speed);
    request.options.tolerance = tolerance;
    request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
    return request;
}

/* q'' + 2 zeta omega q' + omega^2 q = 0 from q(0) and rest. */
static void swing(double omega, double zeta, double t, double start, double *q, double *v)
{
    double decay = zeta * omega, w = omega * sqrt(1.0 - zeta * zeta);
    double fall = start * exp(-decay * t);
    *q = fall * (cos(w * t) + decay / w * sin(w * t));
    *v = -fall * omega * omega / w * sin(w * t);
}

/* A token of a few modes while a distant ball misses, some time after it was taken: each has
 * decayed by its own ratio, and what they lost meanwhile is the damping's. */
static void kept_vibration_decays_mode_by_mode(void **state)
{
    (void)state;
    static struct solve_result result;
    struct damped *damped = damped_create();
    const double elapsed = 0.004, window = 0.006, start = 1e-5;
    const size_t count = 8;
    struct body_state *ringing =
        calloc(1, sizeof *ringing + 2 * count * sizeof *ringing->coordinates);
    assert_non_null(ringing);
    ringing->count[0] = count;
    for (size_t k = 0; k < count; k++)
        ringing->coordinates[2 * k] = start;
    struct solve_request request = blow("mesh", 1e-3, 1e-6);
    request.contacts[0].gap = 0.5;
    request.options.horizon = window;
    request.bodies[1].state = ringing;
    request.bodies[1].elapsed = elapsed;
    assert_int_equal(solve(damped->lab->workspace, &damped->lab->means, &request, &result),
                     PERCUSS_TRUNCATED);
    const double *after = body_state_family(result.bodies[1].state_after, 0);
    double lost = 0.0;
    for (size_t k = 0; k < count; k++) {
        double omega = damped->surface->omega[k], zeta = RATIO[k < RATIOS ? k : RATIOS - 1];
        double q[2], v[2];
        swing(omega, zeta, elapsed, start, &q[0], &v[0]);
        swing(omega, zeta, elapsed + window, start, &q[1], &v[1]);
        lost += 0.5 * (v[0] * v[0] - v[1] * v[1]);
        lost += 0.5 * omega * omega * (q[0] * q[0] - q[1] * q[1]);
        /* angles of some tens of radians in a few steps: roundings of them */
        measured("q", after[2 * k], q[1], 1e-12 * start);
        measured("v", after[2 * k + 1], v[1], 1e-12 * start * omega);
    }
    measured_relative("lost", result.energy.damping, lost, 1e-10);
    free(ringing);
    damped_free(damped);
}

/* Blow after blow on what rings, by both methods, each cut off at one instant before its end: until
 * then they damp. */
static void the_books_close_by_both_methods(void **state)
{
    (void)state;
    static struct solve_result results[2];
    struct damped *damped = damped_create();
    struct body_state *kept = NULL;
    for (int i = 0; i < 2; i++) {
        struct solve_request request = blow("mesh", 0.1, 1e-8);
        request.bodies[1].state = kept;
        request.bodies[1].elapsed = kept ? 0.002 : 0.0;
        request.options.horizon = 0.001;
        struct body_state *next =
            calloc(1, sizeof *next + 2 * 3 * MODES * sizeof *next->coordinates);
        assert_non_null(next);
        for (int method = 0; method < 2; method++) {
            request.options.method = method ? PERCUSS_METHOD_CVODE : PERCUSS_METHOD_MODAL;
            assert_int_equal(
                solve(damped->lab->workspace, &damped->lab->means, &request, &results[method]),
                PERCUSS_TRUNCATED);
            assert_true(results[method].window == 0.001);
            /* as long as the next solve leaves it */
            const struct body_state *after = results[method].bodies[1].state_after;
            if (method == 0)
                memcpy(next, after, body_state_size(after));
        }
        /* physics notes, section 4 */
        const struct impact_energy *energy = &results[0].energy;
        measured("closure", energy->closure, 0.0, 1e-9 * energy->available);
        assert_true(energy->damping > 1e-3 * energy->available);
        /* CVODE comes within 1e-5 of e, as for the other shapes, and of the energy */
        measured("CVODE", results[1].contacts[0].restitution, results[0].contacts[0].restitution,
                 1e-5);
        measured("loss by CVODE", results[1].energy.damping, energy->damping,
                 1e-5 * energy->available);
        free(kept);
        kept = next;
    }
    free(kept);
    damped_free(damped);
}

static double answer(struct damped *damped, const char *id, struct solve_result *result)
{
    struct solve_request request = blow(id, 0.2, 1e-4);
    lab_solve(damped->lab, &request, result);
    return result->contacts[0].restitution;
}

/* One for all, a list of one, and lists that go on as they end: the same bits. */
static void the_same_ratios_are_the_same_body(void **state)
{
    (void)state;
    static struct solve_result result;
    struct damped *damped = damped_create();
    double e = answer(damped, "mesh", &result), many[3 * MODES], alike[3] = {0.01, 0.01, 0.01};
    for (size_t k = 0; k < 3 * MODES; k++)
        many[k] = RATIO[k < RATIOS ? k : RATIOS - 1];
    add(damped, "mesh", many, 3 * MODES);
    assert_true(answer(damped, "mesh", &result) == e);
    add(damped, "mesh", alike, 3);
    e = answer(damped, "mesh", &result);
    add(damped, "mesh", alike, 1);
    assert_true(answer(damped, "mesh", &result) == e);
    struct body one = *add(damped, "mesh", alike, 1);
    one.damping_count = 0;
    lab_add(damped->lab, "mesh", one);
    assert_true(answer(damped, "mesh", &result) == e);
    damped_free(damped);
}

/* An override and a sample state the largest; the others keep their share of it. */
static void variations_scale_all(void **state)
{
    (void)state;
    static struct solve_result result;
    struct damped *damped = damped_create();
    struct solve_request request = blow("mesh", 0.2, 1e-4);
    request.bodies[1].variations[0] = (struct body_variation){PERCUSS_PARAMETER_DAMPING, 0.6};
    request.bodies[1].variation_count = 1;
    lab_solve(damped->lab, &request, &result);
    double e = result.contacts[0].restitution;
    double twice[RATIOS];
    for (size_t k = 0; k < RATIOS; k++)
        twice[k] = 2.0 * RATIO[k];
    add(damped, "mesh", twice, RATIOS);
    assert_true(answer(damped, "mesh", &result) == e);
    damped_free(damped);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kept_vibration_decays_mode_by_mode),
        cmocka_unit_test(the_books_close_by_both_methods),
        cmocka_unit_test(the_same_ratios_are_the_same_body),
        cmocka_unit_test(variations_scale_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
