/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/oblique.c and the rows of service/core/solve/assemble.c: a ball thrown
 * on the paper's beam at an angle, against a program of its own (282 modes up to 200 kHz, steps of
 * 50 ns, 2000 cells). */
#include "solve/oblique.h"
#include "solve/outcome.h"
#include "unit/solve/assembly_bench.h"

/* The ball comes down on the beam at `place` of its length with 0.3 m/s at an angle from the
 * normal, its motion along the surface turned by `about` from the beam's axis. */
static struct solve_request throw(double place, double degrees, double about, double mu)
{
    double angle = degrees * M_PI / 180.0;
    struct solve_request request = strike(
        sphere_spot("ball", 0.015), side_spot("beam", place - 0.5, 0.010, 0.0), 0.3 * cos(angle));
    double r[9], axis[3] = {1.0, 0.0, 0.0}, along[3], across[3];
    rotation_matrix(request.bodies[1].orientation, r);
    rotate3(r, axis, along);
    cross3(request.contacts[0].normal, along, across);
    for (int i = 0; i < 3; i++) {
        double t = cos(about) * along[i] + sin(about) * across[i];
        request.bodies[0].velocity[i] += 0.3 * sin(angle) * t;
        request.contacts[0].tangent[i] = t;
    }
    request.contacts[0].friction = mu;
    return request;
}

/* That program has Timoshenko's beam whose section does not deform. */
static void stiffen_sections(struct problem *problem)
{
    for (size_t r = 0; r < problem_rows(problem); r++)
        for (size_t f = 0; f < BODY_MOST_FAMILIES; f++) {
            const struct family_load *load = problem_load(problem, r, 1, f);
            if (load)
                ((struct family_load *)load)->bar.curvature = 0.0;
        }
}

/* And one tangent where it slides across the axis: the second one moves with nothing. */
static void leave_out_second(struct problem *problem)
{
    struct contact_tangent *second = problem->friction[0].sides[1];
    for (size_t r = 0; r < 3; r++)
        problem->row_w[3 * r + 2] = problem->row_w[6 + r] = r == 2 ? 1.0 : 0.0;
    for (int which = 0; which < 2; which++)
        for (size_t f = 0; f < BODY_MOST_FAMILIES; f++)
            second[which].load.family[f].acts = false;
}

/* Plain friction's values of that program (25 and 50 ns alike), to its digits: the contact sticks,
 * slides on and back as the beam rings under it. The modal method's steps leave 1e-5. */
struct plain_row {
    double place, degrees, mu;
    double tangential, e, spin, first, second;
};

/* The outcome with all modes up to 200 kHz, half-spaces in the contact and short steps. */
static struct impact_outcome run(struct bench *bench, const struct solve_request *request,
                                 bool alone, bool cvode)
{
    struct impact_settings settings = {
        .accuracy = cvode ? 1e-7 : 1e-9, .horizon = 0.02, .max_work = 1e10};
    struct impact_outcome outcome;
    bench_place(bench, request);
    stiffen_sections(bench->problem);
    if (alone)
        leave_out_second(bench->problem);
    bench_assemble(bench, 2.0 * M_PI * 200e3);
    const struct scene *scene = &bench->assembly.scene;
    assert_true(impact_create(&outcome, scene, &bench->arena));
    assert_int_equal(
        (cvode ? impact_cvode : impact_modal)(scene, &settings, &bench->arena, &outcome),
        PERCUSS_OK);
    return outcome;
}

/* mN s, rad/s, m/s; shares of the available energy; the first blow. */
struct row {
    double place, degrees, mu;
    double normal, tangential, e, spin, slip, friction, vibration;
    double first[2];
};

static void compare(struct bench *bench, const struct row *row, double about, bool cvode)
{
    struct solve_request request = throw(row->place, row->degrees, about, row->mu);
    struct impact_outcome outcome = run(bench, &request, about != 0.0, cvode);
    const struct track *track = &outcome.tracks[0];
    const struct impact_energy *energy = &outcome.energy;
    double inertia = bench->problem->bodies[0]->inertia[0];
    /* the program's digits, and of what depends on the tangential force 1e-4 by its steps */
    measured("normal impulse", 1e3 * track->impulse, row->normal, 1e-3);
    measured_relative("tangential impulse", -1e3 * track->tangential[0], row->tangential, 1e-4);
    measured("e", outcome_restitution(bench->problem, &outcome, 0), row->e, 2e-5);
    measured_relative("spin", -track->tangential[0] * 0.015 / inertia, row->spin, 1e-4);
    measured("slip", outcome.motion.gap_rate[1], row->slip, 2e-5);
    measured("lost to friction", energy->friction / energy->available, row->friction, 1e-4);
    measured("vibration", energy->vibration / energy->available, row->vibration, 1e-4);
    measured("first blow", 1e3 * track->list[0].impulse, row->first[0], 1e-3);
    measured("along the surface", -1e3 * track->list[0].impulse_tangential[0], row->first[1], 1e-3);
    measured("closure", energy->closure / energy->available, 0.0, 2e-5);
}

/* CVODE takes two seconds for a row. */
static bool is_by_both(const struct row *row)
{
    return row->place == 0.5 && row->mu == 0.3;
}

static void along_the_axis(void **state)
{
    (void)state;
    static const struct row rows[] = {
        {0.5, 30, 0.1, 32.821, 3.2821, 0.29456, 4.9607, 0.04195, 0.0857, 0.8283, {24.951, 2.495}},
        {0.5, 30, 0.3, 32.821, 4.6861, 0.29456, 7.0828, -0.00427, 0.0812, 0.8401, {24.951, 7.047}},
        {0.5, 60, 0.1, 20.369, 2.0369, 0.39153, 3.0786, 0.19275, 0.2168, 0.4382, {14.884, 1.488}},
        {0.5, 60, 0.3, 20.369, 6.1106, 0.39153, 9.2358, 0.05864, 0.4555, 0.4406, {14.884, 4.465}},
        {0.31, 30, 0.1, 28.766, 2.8766, 0.19116, 4.3479, 0.05607, 0.0845, 0.8690, {24.951, 2.495}},
        {0.31, 30, 0.3, 28.899, 5.8490, 0.19666, 8.8404, -0.04178, 0.0780, 0.8797, {24.951, 7.033}},
        {0.31, 60, 0.3, 14.884, 4.4651, 0.06746, 6.7487, 0.11322, 0.3963, 0.5077, {14.884, 4.465}},
    };
    struct bench *bench = bench_create();
    for (size_t i = 0; i < COUNT(rows); i++)
        for (int cvode = 0; cvode <= is_by_both(&rows[i]); cvode++)
            compare(bench, &rows[i], 0.0, cvode);
    bench_free(bench);
}

/* It twists the beam and bends it in the other plane. */
static void across_the_axis(void **state)
{
    (void)state;
    static const struct row rows[] = {
        {0.5, 30, 0.3, 32.821, 4.4719, 0.29456, 6.7591, -0.00776, 0.0161, 0.9045, {24.951, 5.034}},
        {0.31, 30, 0.3, 28.702, 4.5127, 0.18850, 6.8207, -0.01150, 0.0186, 0.9486, {24.951, 5.034}},
    };
    struct bench *bench = bench_create();
    for (size_t i = 0; i < COUNT(rows); i++)
        for (int cvode = 0; cvode <= is_by_both(&rows[i]); cvode++)
            compare(bench, &rows[i], 0.5 * M_PI, cvode);
    bench_free(bench);
}

static void without_compliance(void **state)
{
    (void)state;
    static const struct plain_row rows[] = {
        {0.5, 30, 0.3, 4.0465, 0.29456, 6.1160, 4.737, -0.691},
        {0.31, 30, 0.3, 4.2955, 0.19487, NAN, 4.522, -0.226},
        /* it slides throughout: as with micro-slip */
        {0.5, 60, 0.3, 6.1106, 0.39153, 9.2358, 4.465, 1.646},
        {0.31, 60, 0.3, 4.4651, 0.06746, 6.7487, 4.465, NAN},
    };
    struct bench *bench = bench_create();
    for (size_t i = 0; i < COUNT(rows); i++) {
        const struct plain_row *row = &rows[i];
        struct solve_request request = throw(row->place, row->degrees, 0.0, row->mu);
        request.options.friction = PERCUSS_FRICTION_PLAIN;
        struct impact_outcome outcome = run(bench, &request, false, false);
        const struct track *track = &outcome.tracks[0];
        const struct impact_energy *energy = &outcome.energy;
        double inertia = bench->problem->bodies[0]->inertia[0];
        measured("tangential impulse", -1e3 * track->tangential[0], row->tangential, 1e-4);
        measured("e", outcome_restitution(bench->problem, &outcome, 0), row->e, 1e-5);
        if (!isnan(row->spin))
            measured("spin", -track->tangential[0] * 0.015 / inertia, row->spin, 1e-4);
        if (i == 0)
            measured("lost to friction", energy->friction / energy->available, 0.0839, 1e-4);
        measured("first blow", -1e3 * track->list[0].impulse_tangential[0], row->first, 6e-4);
        if (!isnan(row->second))
            measured("second", -1e3 * track->list[1].impulse_tangential[0], row->second, 6e-4);
        measured("closure", energy->closure / energy->available, 0.0, 1e-7);
    }
    bench_free(bench);
}

static struct solve_result result;

static void refused(struct lab *lab, const struct solve_request *request, const char *why)
{
    solve(lab->workspace, &lab->means, request, &result);
    assert_true(result.status == PERCUSS_BAD_REQUEST ||
                result.status == PERCUSS_UNSUPPORTED_GEOMETRY);
    if (!strstr(result.fault.text, why))
        fail_msg("%s", result.fault.text);
}

static bool warned(const char *text)
{
    for (size_t i = 0; i < result.warning_count; i++)
        if (strstr(result.warnings[i], text))
            return true;
    return false;
}

/* By a name, and with the way on; without friction all of them are answered. */
static void what_has_no_friction(void **state)
{
    (void)state;
    static const double w = 10.0;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    for (int friction = 1; friction >= 0; friction--) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 1.0);
        request.bodies[0].velocity[0] = 1.0;
        request.contacts[0].friction = 0.3;
        request.options.friction = friction ? PERCUSS_FRICTION_PLAIN : PERCUSS_FRICTION_NONE;
        struct solve_request matrix = request, elements = request, cvode = request;
        cvode.options.method = PERCUSS_METHOD_CVODE;
        matrix.delassus = &w;
        elements.options.contact_model = PERCUSS_CONTACT_CONCURRENT_FE;
        if (friction) {
            refused(lab, &matrix, "delassus: 1 x 1 numbers: where");
            refused(lab, &elements, "contacts[0].friction: finite elements");
            refused(lab, &cvode, "options.friction: plain: method cvode");
        } else {
            lab_solve(lab, &request, &result);
            lab_solve(lab, &matrix, &result);
            near(result.contacts[0].friction, 0.0, 0.0);
        }
    }
    lab_free(lab);
}

/* The ball on a rigid wall at an angle. */
static struct solve_result ball_on_wall(struct lab *lab, const char *ball, double degrees,
                                        double mu, enum percuss_contact_model model)
{
    double slope = tan(degrees * M_PI / 180.0);
    struct solve_request request = strike(sphere_spot(ball, 0.015), wall_spot("wall"), 1.0);
    request.bodies[0].velocity[0] = slope;
    request.contacts[0].friction = mu;
    request.contacts[0].tangent[0] = 1.0;
    request.options.contact_model = model;
    request.options.tolerance = 1e-4;
    lab_solve(lab, &request, &result);
    /* CVODE's cells are twice as many, its steps its own */
    if (degrees < 60.0) {
        static struct solve_result other;
        request.options.method = PERCUSS_METHOD_CVODE;
        lab_solve(lab, &request, &other);
        near(other.contacts[0].impulse_tangential[0] / other.contacts[0].impulse,
             result.contacts[0].impulse_tangential[0] / result.contacts[0].impulse, 1e-4);
        near(other.contacts[0].restitution, result.contacts[0].restitution, 1e-4);
    }
    return result;
}

/* A ball that yields: friction leaves its normal motion alone; where it slides throughout the
 * tangential impulse is the coefficient's; short of yield it is Hertz's ball, though its cells
 * divide the slope of the unloading branch, not the indentation. */
static void where_it_yields(void **state)
{
    (void)state;
    static const enum percuss_contact_model model = PERCUSS_CONTACT_CLOSED_FORM;
    struct lab *lab = lab_create();
    struct body soft = make_sphere(STEEL, 0.015), hard = soft;
    soft.material.yield = 400e6;
    hard.material.yield = 8e9;
    lab_add(lab, "soft", soft);
    lab_add(lab, "hard", hard);
    lab_add(lab, "wall", rigid_wall());
    double smooth = ball_on_wall(lab, "soft", 30.0, 0.0, model).contacts[0].restitution;
    assert_true(smooth < 0.7);
    struct solve_contact_result rough = ball_on_wall(lab, "soft", 30.0, 0.3, model).contacts[0];
    near(rough.restitution, smooth, 1e-4);
    near(rough.restitution_kinematic, smooth, 1e-4);
    assert_true(rough.friction_state == PERCUSS_FRICTION_STATE_PARTLY ||
                rough.friction_state == PERCUSS_FRICTION_STATE_REVERSED);
    struct solve_contact_result slides = ball_on_wall(lab, "soft", 70.0, 0.1, model).contacts[0];
    assert_int_equal(slides.friction_state, PERCUSS_FRICTION_STATE_SLID);
    near_relative(fabs(slides.impulse_tangential[0]), 0.1 * slides.impulse, 1e-9);
    near(result.energy.closure / result.energy.available, 0.0, 1e-4);
    assert_true(result.energy.plastic > 0.0 && result.energy.friction > 0.0);
    for (double degrees = 15.0; degrees < 50.0; degrees += 15.0) {
        double elastic = ball_on_wall(lab, "hard", degrees, 0.2, PERCUSS_CONTACT_HERTZ)
                             .contacts[0]
                             .impulse_tangential[0];
        double below =
            ball_on_wall(lab, "hard", degrees, 0.2, model).contacts[0].impulse_tangential[0];
        /* as exact as the tolerance asks */
        near_relative(below, elastic, 1e-4);
    }
    lab_free(lab);
}

/* A spin that turns the surfaces within a contact, and friction that jams a slender bar. */
static void where_it_ends(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    struct body bar = make_bar(&beam_kind, STEEL, 0.00635, 0.2);
    bar.tip_radius = 0.00635;
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "bar", bar);
    lab_add(lab, "wall", rigid_wall());
    struct solve_request spins = strike(sphere_spot("ball", 0.015), wall_spot("wall"), 1.0);
    spins.contacts[0].friction = 0.1;
    lab_solve(lab, &spins, &result);
    assert_false(warned("turn by up to"));
    spins.bodies[0].angular_velocity[1] = 2000.0;
    lab_solve(lab, &spins, &result);
    assert_true(warned("turn by up to"));
    /* the cap of a bar 26.6 degrees from upright: coefficients above some 4/3 jam */
    double lean = 26.6 * M_PI / 180.0;
    struct spot cap = {"bar",
                       {-0.1 + 0.00635 * (1.0 - cos(lean)), 0.0, -0.00635 * sin(lean)},
                       {-cos(lean), 0.0, -sin(lean)},
                       0.0};
    struct solve_request leans = strike(cap, wall_spot("wall"), 1.0);
    leans.contacts[0].friction = 0.5;
    lab_solve(lab, &leans, &result);
    assert_false(warned("may press the bodies together"));
    leans.contacts[0].friction = 1.6;
    solve(lab->workspace, &lab->means, &leans, &result);
    assert_true(warned("may press the bodies together"));
    lab_free(lab);
}

/* In the middle of the beam friction does not act on the normal force: its errors are those without
 * friction. A second order of the models' part is asked for where the omitted modes tell so, those
 * of the tangents, too: here it adds 5 %. */
static void errors_of_the_normal_force(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    struct solve_result smooth;
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    for (int i = 0; i < 2; i++) {
        struct solve_request request = throw(0.5, 30.0, i ? 0.6 : 0.0, 0.0);
        request.options.tolerance = 1e-3;
        lab_solve(lab, &request, &smooth);
        request.contacts[0].friction = 0.3;
        lab_solve(lab, &request, &result);
        near(result.contacts[0].restitution, smooth.contacts[0].restitution, 1e-4);
        double model = smooth.restitution_model - smooth.restitution_yield;
        near_relative(result.restitution_model - result.restitution_yield, model, 0.1);
        assert_true(result.tolerance_met && smooth.tolerance_met);
        assert_true(result.restitution_modes < 2.0 * smooth.restitution_modes);
    }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(along_the_axis),
        cmocka_unit_test(across_the_axis),
        cmocka_unit_test(without_compliance),
        cmocka_unit_test(what_has_no_friction),
        cmocka_unit_test(where_it_yields),
        cmocka_unit_test(where_it_ends),
        cmocka_unit_test(errors_of_the_normal_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
