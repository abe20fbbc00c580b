/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A sphere across a beam: Timoshenko's example of 1913, the paper's beam at four speeds, and every
 * support, theory and site against a converged solution of the same model and against CVODE. */
#include "physics/support.h"

static void timoshenko_1913(void **state)
{
    (void)state;
    static struct solve_result result;
    struct material steel = {"steel-1913", 215.75e9, 0.30, 7960.0, INFINITY, 0.0};
    struct lab *lab = lab_create();
    struct body beam = make_supported(make_body(&beam_kind, steel), SUPPORT_PINNED, SUPPORT_PINNED);
    beam.width = beam.height = 0.01;
    beam.length = 0.1535;
    beam.theory = THEORY_EULER_BERNOULLI;
    lab_add(lab, "beam", beam);
    lab_add(lab, "ball", make_sphere(steel, 0.010));
    struct solve_request request =
        strike(sphere_spot("ball", 0.010), side_spot("beam", 0.0, 0.005, 0.0), 0.01);
    request.options.tolerance = 1e-8;
    lab_solve(lab, &request, &result);
    const struct sub_impact *sub = result.contacts[0].sub_impacts;
    assert_int_equal(result.contacts[0].sub_impact_count, 1);
    /* the notes' digits */
    measured("e", result.contacts[0].restitution, 0.302325, 5e-7);
    measured("duration, us", 1e6 * (sub->end - sub->start), 156.401, 5e-4);
    /* the notes' 4.97716 lies 3 ppm low: a plain Runge-Kutta integration of 40 modes with residual
     * flexibility, done for this test, and CVODE give 4.977175 */
    measured("force, N", sub->peak_force, 4.977175, 1e-6);
    /* the beam cannot move rigidly: W is the sphere's */
    double mass = 4.0 / 3.0 * M_PI * 1e-6 * 7960.0;
    measured_relative("W", result.contacts[0].inverse_effective_mass, 1.0 / mass, 1e-14);
    lab_free(lab);
}

static struct lab *paper_beam(void)
{
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    return lab;
}

/* Against the beam as a mesh (docs/lab/mesh.md, `mesh_values.sh ... beam`, 4 mm, 220 modes): what the
 * answer states covers the difference, which the later blows amplify; the first impulse by itself
 * is within the 2e-6 N s that meshes leave. The digits are our own, for a change to be seen. */
static void the_paper_s_beam_at_four_speeds(void **state)
{
    (void)state;
    static const struct {
        double speed, mesh, e;
    } rows[] = {{0.200, 0.7397, 0.73940},
                {0.276, 0.7036, 0.71004},
                {0.287, 0.3204, 0.32753},
                {0.303, 0.2430, 0.24534}};
    static struct solve_result result;
    struct lab *lab = paper_beam();
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), rows[i].speed);
        request.options.tolerance = 1e-6;
        request.options.compliance = PERCUSS_COMPLIANCE_MATCHED;
        lab_solve(lab, &request, &result);
        const struct solve_contact_result *contact = &result.contacts[0];
        measured("e, of the mesh", contact->restitution, rows[i].mesh, result.restitution_total);
        assert_true(result.restitution_total < 0.1);
        measured("e", contact->restitution, rows[i].e, 5e-5);
        assert_int_equal(result.end_reason, PERCUSS_END_SEPARATED);
        if (rows[i].speed == 0.2) {
            measured("first impulse", contact->sub_impacts[0].impulse, 0.019513, 2e-6);
            measured("second start, ms", 1e3 * contact->sub_impacts[1].start, 5.247, 2e-3);
        }
    }
    lab_free(lab);
}

/* Cowper's shear factor moves e by less than what is stated for it; a graze beside the second blow
 * is a sub-impact of its own. */
static void the_same_with_cowper_s_shear_factor(void **state)
{
    (void)state;
    static const double rows[][2] = {
        {0.200, 0.7397}, {0.276, 0.7036}, {0.287, 0.3204}, {0.303, 0.2430}};
    static struct solve_result result;
    struct lab *lab = paper_beam();
    lab_add(lab, "beam", make_cowper(lab->bodies[1]));
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), rows[i][0]);
        request.options.tolerance = 1e-6;
        request.options.compliance = PERCUSS_COMPLIANCE_MATCHED;
        lab_solve(lab, &request, &result);
        measured("e", result.contacts[0].restitution, rows[i][1], result.restitution_total);
    }
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 0.31);
    request.options.tolerance = 1e-6;
    lab_solve(lab, &request, &result);
    const struct sub_impact *sub = result.contacts[0].sub_impacts;
    assert_int_equal(result.contacts[0].sub_impact_count, 3);
    measured("graze, ms", 1e3 * sub[1].start, 1.415, 2e-3);
    measured("graze, impulse", sub[1].impulse, 5e-6, 3e-6);
    assert_true(sub[1].negligible && !sub[0].negligible && !sub[2].negligible);
    lab_free(lab);
}

/* Impulse of the first and start of the second sub-impact that is not negligible; INFINITY: none.
 */
struct outline {
    double first_impulse, second_start, restitution;
    size_t count;
};

static struct outline outline_of(struct lab *lab, struct solve_request *request, double tolerance,
                                 enum percuss_method method)
{
    static struct solve_result result;
    request->options.tolerance = tolerance;
    request->options.method = method;
    lab_solve(lab, request, &result);
    const struct solve_contact_result *contact = &result.contacts[0];
    struct outline outline = {contact->sub_impacts[0].impulse, INFINITY, contact->restitution,
                              contact->sub_impact_count};
    for (size_t i = contact->sub_impacts_listed; i-- > 1;)
        if (!contact->sub_impacts[i].negligible)
            outline.second_start = contact->sub_impacts[i].start;
    return outline;
}

static void compare(const char *what, struct outline value, struct outline expected)
{
    char text[96];
    snprintf(text, sizeof text, "%s: first impulse", what);
    measured_relative(text, value.first_impulse, expected.first_impulse, 1e-6);
    snprintf(text, sizeof text, "%s: second start", what);
    if (isinf(expected.second_start))
        assert_true(isinf(value.second_start));
    else
        measured(text, value.second_start, expected.second_start, 1e-6);
}

static const enum support ends[][2] = {
    {SUPPORT_FREE, SUPPORT_FREE},       {SUPPORT_PINNED, SUPPORT_PINNED},
    {SUPPORT_CLAMPED, SUPPORT_CLAMPED}, {SUPPORT_CLAMPED, SUPPORT_FREE},
    {SUPPORT_FREE, SUPPORT_PINNED},     {SUPPORT_PINNED, SUPPORT_CLAMPED}};

/* Every theory, support and two sites: a tolerance of 1e-6 against one of 1e-8. */
static void every_beam_against_its_converged_solution(void **state)
{
    (void)state;
    struct lab *lab = paper_beam();
    for (size_t i = 0; i < 2 * COUNT(ends); i++) {
        struct body beam = make_supported(make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0),
                                          ends[i / 2][0], ends[i / 2][1]);
        beam.theory = i % 2 ? THEORY_EULER_BERNOULLI : THEORY_TIMOSHENKO;
        lab_add(lab, "beam", beam);
        for (int site = 0; site < 2; site++) {
            struct solve_request request = strike(
                sphere_spot("ball", 0.015), side_spot("beam", 0.137 * site, 0.010, 0.0), 0.25);
            char what[64];
            snprintf(what, sizeof what, "ends %u-%u, theory %u, x %.3f", beam.supports[0],
                     beam.supports[1], beam.theory, 0.137 * site);
            compare(what, outline_of(lab, &request, 1e-6, PERCUSS_METHOD_MODAL),
                    outline_of(lab, &request, 1e-8, PERCUSS_METHOD_MODAL));
        }
    }
    lab_free(lab);
}

/* The same by CVODE, with a fixed number of modes: one model, two time integrations. */
static void every_beam_against_cvode(void **state)
{
    (void)state;
    struct lab *lab = paper_beam();
    for (size_t i = 0; i < 2 * COUNT(ends); i++) {
        struct body beam = make_supported(make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0),
                                          ends[i / 2][0], ends[i / 2][1]);
        beam.theory = i % 2 ? THEORY_EULER_BERNOULLI : THEORY_TIMOSHENKO;
        beam.modes = 12;
        lab_add(lab, "beam", beam);
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), side_spot("beam", -0.21, 0.010, 0.0), 0.25);
        char what[64];
        snprintf(what, sizeof what, "ends %u-%u, theory %u, cvode", beam.supports[0],
                 beam.supports[1], beam.theory);
        struct outline modal = outline_of(lab, &request, 1e-7, PERCUSS_METHOD_MODAL);
        struct outline cvode = outline_of(lab, &request, 1e-7, PERCUSS_METHOD_CVODE);
        compare(what, modal, cvode);
        /* time tolerance 1e-7 each, amplified by the sequence */
        measured(what, modal.restitution, cvode.restitution, 1e-5);
        assert_int_equal(modal.count, cvode.count);
    }
    lab_free(lab);
}

/* Hit on its end face a beam is the elementary rod (no lateral inertia in either). */
static void a_beam_hit_on_its_end_is_the_rod(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_beam();
    double e[2];
    lab_add(lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0));
    for (int i = 0; i < 2; i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), end_spot(i ? "rod" : "beam", 1.0), 0.3);
        request.options.tolerance = 1e-8;
        lab_solve(lab, &request, &result);
        e[i] = result.contacts[0].restitution;
    }
    /* the same numbers on the same path */
    measured("beam's end face", e[0], e[1], 1e-12);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(timoshenko_1913),
        cmocka_unit_test(the_paper_s_beam_at_four_speeds),
        cmocka_unit_test(the_same_with_cowper_s_shear_factor),
        cmocka_unit_test(every_beam_against_its_converged_solution),
        cmocka_unit_test(every_beam_against_cvode),
        cmocka_unit_test(a_beam_hit_on_its_end_is_the_rod),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
