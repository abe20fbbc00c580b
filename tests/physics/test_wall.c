/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Waves that leave through a half-space: the loss of a sphere against Hunter's formula and an
 * integration of its own, its energy, both methods, dents, neighbours. */
#include "model/half_space.h"
#include "physics/support.h"
#include "solve/repeat.h"

static const double SPEEDS[] = {0.1, 0.5, 2.0, 5.0, 20.0};

static struct solve_request on_wall(double speed)
{
    return strike(sphere_spot("ball", 0.015), wall_spot("wall"), speed);
}

static struct lab *wall_lab(struct material ball, struct material wall)
{
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(ball, 0.015));
    lab_add(lab, "wall", make_body(&half_space_kind, wall));
    return lab;
}

static struct material soft_metal(double yield)
{
    return (struct material){"soft", 70e9, 0.33, 2700.0, yield, 0.0};
}

/* Half-space: u = c F - lag F' by u' = (c F - u)/t, lag = c t: another closure than the solver's,
 * of first order in t; c goes off Hertz's compliance. */
struct closure {
    double mass, stiffness, compliance, time;
};

/* y: approach, its rate, u. */
static void rates(const struct closure *closure, const double y[3], double rate[3])
{
    double left = fmax(0.0, y[0] - y[2]);
    double d = left;
    for (int i = 0; i < 30 && left > 0.0; i++) {
        double bent = closure->compliance * closure->stiffness * sqrt(d);
        d -= (d - bent * d - left) / (1.0 - 1.5 * bent);
    }
    double force = closure->stiffness * d * sqrt(d);
    rate[0] = y[1];
    rate[1] = -force / closure->mass;
    rate[2] = (closure->compliance * force - y[2]) / closure->time;
}

/* Speed after a blow at `speed`, by Runge and Kutta. */
static double rebound(const struct closure *closure, double speed, double step)
{
    double y[3] = {0.0, speed, 0.0};
    while (y[0] - y[2] > 0.0 || y[1] > 0.0) {
        double k[4][3];
        double at[3];
        rates(closure, y, k[0]);
        for (int stage = 1; stage < 4; stage++) {
            for (int i = 0; i < 3; i++)
                at[i] = y[i] + (stage < 3 ? 0.5 : 1.0) * step * k[stage - 1][i];
            rates(closure, at, k[stage]);
        }
        for (int i = 0; i < 3; i++)
            y[i] += step / 6.0 * (k[0][i] + 2.0 * k[1][i] + 2.0 * k[2][i] + k[3][i]);
    }
    return -y[1];
}

/* The restitution without the closure's error, which goes with the square of its time. */
static double expected(double mass, double k, double lag, double speed)
{
    double d = pow(1.25 * mass * speed * speed / k, 0.4);
    double e[2];
    for (int i = 0; i < 2; i++) {
        struct closure closure = {mass, k, (i ? 0.4 : 0.2) / (1.5 * k * sqrt(d)), 0.0};
        closure.time = lag / closure.compliance;
        e[i] = rebound(&closure, speed, fmin(0.05 * closure.time, 1e-3 * d / speed)) / speed;
    }
    return e[1] + (e[1] - e[0]) / 3.0;
}

static void a_sphere_loses_what_the_waves_take(void **state)
{
    (void)state;
    static struct solve_result result;
    const struct material pairs[][2] = {{STEEL, STEEL}, {STEEL, ALUMINIUM}, {GLASS, STEEL}};
    for (size_t p = 0; p < COUNT(pairs); p++) {
        struct lab *lab = wall_lab(pairs[p][0], pairs[p][1]);
        double mass = lab->bodies[0].mass;
        double k = sphere_plane_stiffness(pairs[p][0], pairs[p][1], 0.015);
        double lag = half_space_waves_of(&pairs[p][1]).lag;
        for (size_t v = 0; v < COUNT(SPEEDS); v++) {
            struct solve_request request = on_wall(SPEEDS[v]);
            request.options.tolerance = 1e-6;
            lab_solve(lab, &request, &result);
            double e = result.contacts[0].restitution;
            assert_true(result.tolerance_met && e < 0.9999 && e > 0.9);
            assert_int_equal(result.contacts[0].sub_impact_count, 1);
            /* what the reply says is left out; the expected number's own error is a fifth of it */
            double allowed = 1e-6 + result.omitted_error;
            assert_true(allowed < 0.01 * (1.0 - e));
            measured("e", e, expected(mass, k, lag, SPEEDS[v]), allowed);
        }
        lab_free(lab);
    }
}

/* 1 - e^2 = 1.04 (v/c)^(3/5), bodies alike, with a force like half a sine for Hertz's and to first
 * order (Hunter 1957; Johnson, Contact Mechanics, section 11.4): 8 % less than it is. */
static void hunter_was_not_far_off(void **state)
{
    (void)state;
    static struct solve_result result;
    struct material metal = {"metal", 210e9, 0.25, 7800.0, INFINITY, 0.0};
    struct lab *lab = wall_lab(metal, metal);
    for (size_t v = 0; v < COUNT(SPEEDS); v++) {
        struct solve_request request = on_wall(SPEEDS[v]);
        request.options.tolerance = 1e-6;
        lab_solve(lab, &request, &result);
        double e = result.contacts[0].restitution;
        double hunter = 1.04 * pow(SPEEDS[v] * sqrt(metal.density / metal.young), 0.6);
        measured_relative("share", 1.0 - e * e, hunter, 0.08);
    }
    lab_free(lab);
}

/* Elastic and with a dent, pressed or not: the books close, waves are booked as damping, and CVODE
 * says the same. */
static void both_methods_keep_the_books(void **state)
{
    (void)state;
    static struct solve_result result, again;
    struct lab *lab = wall_lab(STEEL, soft_metal(205e6));
    for (int i = 0; i < 12; i++) {
        struct solve_request request = on_wall(SPEEDS[i % 3]);
        request.options.contact_model = i % 2 ? PERCUSS_CONTACT_CLOSED_FORM : PERCUSS_CONTACT_HERTZ;
        request.contacts[0].gap_acceleration = i >= 6 ? -9.81 : 0.0;
        request.options.tolerance = 1e-8;
        lab_solve(lab, &request, &result);
        const struct impact_energy *energy = &result.energy;
        measured("closure", energy->closure / energy->available, 0.0, 1e-9);
        double e = result.contacts[0].restitution;
        assert_true(energy->damping > 1e-3 * energy->available);
        /* what has not left yet when the bodies part */
        assert_true(energy->vibration < 0.02 * energy->damping);
        assert_int_equal(energy->plastic > 0.0, i % 2);
        assert_null(i % 2 ? NULL : result.bodies[1].state_after);
        request.options.method = PERCUSS_METHOD_CVODE;
        lab_solve(lab, &request, &again);
        /* CVODE sees releases a step late */
        measured("e by CVODE", again.contacts[0].restitution, e, 1e-6);
        measured_relative("waves by CVODE", again.energy.damping, energy->damping, 1e-3);
    }
    lab_free(lab);
}

/* Two equal spheres at once, `apart` from each other; what one of them loses, over `alone`. */
static double loss_of_two(struct lab *lab, double apart, double alone)
{
    static struct solve_result result;
    struct solve_request request = {.body_count = 3, .contact_count = 2};
    struct solve_request one = on_wall(2.0);
    for (int i = 0; i < 2; i++) {
        request.bodies[2 * i] = one.bodies[0];
        request.bodies[2 * i].position[0] = i * apart;
        request.contacts[i] = one.contacts[0];
        request.contacts[i].point[0] = i * apart;
    }
    request.bodies[1] = one.bodies[1];
    request.contacts[1].a = 2;
    request.options.tolerance = 1e-6;
    lab_solve(lab, &request, &result);
    measured("mirrored", result.contacts[0].restitution, result.contacts[1].restitution, 1e-9);
    measured("closure", result.energy.closure / result.energy.available, 0.0, 1e-6);
    return (1.0 - result.contacts[0].restitution) / alone;
}

/* Their waves add up: side by side each loses twice as much, since a wave of twice the height has
 * four times the power; beyond the length of a wave each loses its own. */
static void neighbours_share_their_waves(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = wall_lab(STEEL, STEEL);
    struct solve_request one = on_wall(2.0);
    one.options.tolerance = 1e-6;
    lab_solve(lab, &one, &result);
    double alone = 1.0 - result.contacts[0].restitution;
    /* 1 mm is 0.02 of the wave's length over 2 pi; second order in the loss of 0.5 % */
    measured("side by side", loss_of_two(lab, 1e-3, alone), 2.0, 0.02);
    measured("far away", loss_of_two(lab, 2.0, alone), 1.0, 1e-3);
    double between = loss_of_two(lab, 0.15, alone);
    assert_true(between > 1.2 && between < 1.8);
    lab_free(lab);
}

/* `count` spheres in rows of six, 50 mm from each other, at different speeds. */
static void solve_crowd(struct lab *lab, size_t count, struct solve_result *result)
{
    struct solve_request request = {.body_count = count + 1, .contact_count = count};
    struct solve_request one = on_wall(1.0);
    request.bodies[count] = one.bodies[1];
    for (size_t i = 0; i < count; i++) {
        struct solve_body *body = &request.bodies[i];
        struct solve_contact *contact = &request.contacts[i];
        *body = one.bodies[0];
        *contact = one.contacts[0];
        contact->a = i;
        contact->b = count;
        body->position[0] = contact->point[0] = 0.05 * (double)(i % 6);
        body->position[1] = contact->point[1] = 0.05 * (double)(i / 6);
        body->velocity[2] = -(0.5 + (double)(i * 7 % 11) / 10.0);
    }
    lab_solve(lab, &request, result);
}

/* So many neighbours cannot be solved together with the effort allowed: they are answered without
 * waves, with an error that has all of the waves in it, and a warning that says why. */
static void a_crowd_is_answered_without_waves(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = wall_lab(STEEL, STEEL);
    double lost = 0.0;
    solve_crowd(lab, 20, &result);
    assert_true(result.tolerance_met && result.status == PERCUSS_OK);
    for (size_t c = 0; c < 20; c++)
        lost = fmax(lost, 1.0 - result.contacts[c].restitution);
    assert_true(lost > 0.03);
    solve_crowd(lab, 60, &result);
    assert_int_equal(result.status, PERCUSS_OK);
    assert_false(result.tolerance_met);
    assert_true(strstr(result.warnings[0], "left out") != NULL);
    /* more neighbours take more */
    assert_true(result.restitution_modes > lost && result.restitution_modes < 1.0);
    for (size_t c = 0; c < 60; c++)
        measured("e", result.contacts[c].restitution, 1.0, 1e-4);
    lab_free(lab);
}

/* A heavy ball on a light one that rests on the wall presses it far more than its own weight and
 * speed tell: the waves stay in the model, and CVODE agrees. */
static void a_ball_between_a_heavy_one_and_the_wall(void **state)
{
    (void)state;
    static struct solve_result result, again;
    struct lab *lab = wall_lab(STEEL, STEEL);
    for (double radius = 0.03; radius < 0.3; radius *= 2.0) {
        struct solve_request request = {.body_count = 3, .contact_count = 2};
        struct solve_request below = on_wall(0.0);
        lab_add(lab, "heavy", make_sphere(STEEL, radius));
        request.bodies[0] = below.bodies[0];
        request.bodies[1] = below.bodies[1];
        request.bodies[2] = below.bodies[0];
        snprintf(request.bodies[2].id, sizeof request.bodies[2].id, "heavy");
        request.bodies[2].position[2] = 0.030 + radius;
        request.bodies[2].velocity[2] = -0.5;
        request.contacts[0] = below.contacts[0];
        request.contacts[1] = below.contacts[0];
        request.contacts[1].point[2] = 0.030;
        request.contacts[1].a = 2;
        request.contacts[1].b = 0;
        request.options.tolerance = 1e-6;
        lab_solve(lab, &request, &result);
        assert_non_null(strstr(result.reason, "waves leave"));
        assert_true(result.energy.damping > 1e-4 * result.energy.available);
        request.options.method = PERCUSS_METHOD_CVODE;
        lab_solve(lab, &request, &again);
        /* the tolerance of either */
        measured("e", result.contacts[1].restitution, again.contacts[1].restitution, 2e-6);
        measured_relative("waves", result.energy.damping, again.energy.damping, 1e-3);
    }
    lab_free(lab);
}

/* Many speeds by one model, as an ensemble solves them: each as if it were alone. */
static void every_sample_has_its_own_waves(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = wall_lab(STEEL, ALUMINIUM);
    struct repeat *repeat = repeat_create();
    struct solution_model model;
    struct repeat_outcome outcome;
    struct fault fault;
    struct solve_request request = on_wall(SPEEDS[COUNT(SPEEDS) - 1]);
    request.options.tolerance = 1e-4;
    assert_int_equal(repeat_search(repeat, &lab->means, &request, 0, &model, &outcome, &fault),
                     PERCUSS_OK);
    for (size_t v = 0; v < COUNT(SPEEDS); v++) {
        request = on_wall(SPEEDS[v]);
        request.options.tolerance = 1e-4;
        lab_solve(lab, &request, &result);
        assert_int_equal(
            repeat_solve(repeat, &lab->means, &request, 0, &model, v > 0, &outcome, &fault),
            PERCUSS_OK);
        /* the search may have taken other steps: two tenths of the tolerance */
        measured("sample", outcome.restitution, result.contacts[0].restitution, 2e-5);
        assert_true(outcome.restitution < 1.0 - 5e-4);
    }
    repeat_free(repeat);
    lab_free(lab);
}

/* A dent as large as it is deep in a soft wall makes the contact far stiffer on the way back, and
 * whatever the speed the waves stay in the model. */
static void soft_walls_take_waves_too(void **state)
{
    (void)state;
    static struct solve_result result;
    for (double yield = 1e6; yield < 2e9; yield *= 5.0) {
        struct lab *lab = wall_lab(STEEL, soft_metal(yield));
        double before = 1.0;
        for (size_t v = 0; v < COUNT(SPEEDS); v++) {
            struct solve_request request = on_wall(SPEEDS[v]);
            request.options.contact_model = PERCUSS_CONTACT_CLOSED_FORM;
            request.options.tolerance = 1e-5;
            lab_solve(lab, &request, &result);
            assert_true(result.tolerance_met);
            assert_non_null(strstr(result.reason, "waves leave"));
            measured("closure", result.energy.closure / result.energy.available, 0.0, 1e-4);
            assert_true(result.contacts[0].restitution < before);
            before = result.contacts[0].restitution;
        }
        lab_free(lab);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_loses_what_the_waves_take),
        cmocka_unit_test(hunter_was_not_far_off),
        cmocka_unit_test(both_methods_keep_the_books),
        cmocka_unit_test(neighbours_share_their_waves),
        cmocka_unit_test(a_crowd_is_answered_without_waves),
        cmocka_unit_test(a_ball_between_a_heavy_one_and_the_wall),
        cmocka_unit_test(every_sample_has_its_own_waves),
        cmocka_unit_test(soft_walls_take_waves_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
