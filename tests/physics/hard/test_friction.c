/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Friction where it is hard: Painleve's configurations, coefficients up to 10, no slip and far too
 * much, grazes, many contacts, contacts that are pressed: an answer or a clear refusal, in time. */
#include <time.h>

#include "physics/hard/hard.h"

/* Processor time of an answer, s: with sanitizers ten times as much is enough. */
static const double IN_TIME = 10.0;

/* Solves; the friction takes no energy back, and no impulse along the surface is above the
 * coefficient's share of the normal one. */
static enum percuss_status rub(struct lab *lab, const struct solve_request *request,
                               const char *what, struct solve_result *result)
{
    clock_t before = clock();
    enum percuss_status status = hard_solve(lab, request, result);
    double seconds = (double)(clock() - before) / CLOCKS_PER_SEC;
    const struct solve_contact_result *first = &result->contacts[0];
    if (getenv("PERCUSS_MEASURE"))
        print_message("    %-28s %-10s %-12s %6.0f ms, e %8.4f, %zu blows, closure %.1e, met %d, "
                      "%zu warnings %s\n",
                      what, status_name(status), end_reason_name(result->end_reason), 1e3 * seconds,
                      first->restitution, first->sub_impact_count,
                      result->energy.closure / result->energy.available, result->tolerance_met,
                      result->warning_count, status ? result->fault.text : "");
    assert_true(seconds < IN_TIME);
    if (status && status != PERCUSS_TRUNCATED)
        return status;
    assert_true(result->energy.friction >= 0.0);
    for (size_t c = 0; c < result->contact_count; c++) {
        const struct solve_contact_result *contact = &result->contacts[c];
        const double *t = contact->impulse_tangential;
        assert_true(isfinite(t[0]) && isfinite(t[1]));
        assert_true(hypot(t[0], t[1]) <= contact->friction * contact->impulse * (1.0 + 1e-9));
    }
    return status;
}

/* An answer whose energy closes. */
static void rub_well(struct lab *lab, const struct solve_request *request, const char *what,
                     struct solve_result *result)
{
    assert_int_equal(rub(lab, request, what, result), PERCUSS_OK);
    assert_true(result->tolerance_met);
    near(closure_share(result, 0.0), 0.0, 1e-3);
}

/* A slender bar slides on its end: beyond a coefficient of 4/3 rigid bodies have no or two
 * solutions while it slides towards its lean. */
static void painleve(void **state)
{
    (void)state;
    static struct solve_result result;
    static const double mu[] = {1.4, 2.0, 4.0, 10.0}, lean[] = {50.0, 63.4, 75.0};
    static const double slip[] = {-3.0, -0.3, 0.0, 0.3, 3.0};
    static const double r = 0.003, length = 0.3;
    struct lab *lab = lab_create();
    struct body bar = make_bar(&beam_kind, STEEL, r, length);
    bar.tip_radius = r;
    lab_add(lab, "bar", bar);
    lab_add(lab, "wall", make_body(&half_space_kind, STEEL));
    for (size_t i = 0; i < COUNT(mu) * COUNT(lean) * COUNT(slip); i++) {
        double angle = lean[i / COUNT(mu) % COUNT(lean)] * M_PI / 180.0;
        double along = slip[i / (COUNT(mu) * COUNT(lean))];
        struct spot spot = {
            "bar", {0.5 * length - r, 0.0, 0.0}, {sin(angle), 0.0, cos(angle)}, 0.0};
        add_scaled3(r, spot.outward, spot.point);
        struct solve_request request = strike(spot, wall_spot("wall"), 0.5);
        char what[64];
        double axis[3] = {0.0, 0.0, 0.0}, rotation[9];
        rotation_matrix(request.bodies[0].orientation, rotation);
        rotate3(rotation, (double[3]){1.0, 0.0, 0.0}, axis);
        axis[2] = 0.0;
        scale3(along / norm3(axis), axis, axis);
        add_scaled3(1.0, axis, request.bodies[0].velocity);
        request.contacts[0].friction = mu[i % COUNT(mu)];
        snprintf(what, sizeof what, "mu %g, lean %g, slip %g", request.contacts[0].friction,
                 lean[i / COUNT(mu) % COUNT(lean)], along);
        enum percuss_status status = rub(lab, &request, what, &result);
        assert_int_equal(status, PERCUSS_OK);
        assert_true(result.tolerance_met || result.warning_count);
        near(closure_share(&result, 0.0), 0.0, 2e-4);
    }
    lab_free(lab);
}

static void no_slip_and_too_much(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    static const double mu[] = {1e-6, 0.3, 10.0};
    for (size_t i = 0; i < COUNT(mu); i++)
        for (int wall = 0; wall < 2; wall++) {
            struct solve_request request = wall ? on_wall(0.3) : on_beam(0.19, 0.3);
            double *spin = request.bodies[0].angular_velocity;
            request.contacts[0].friction = mu[i];
            rub_well(lab, &request, "no slip", &result);
            spin[1] = 1e5;
            rub_well(lab, &request, "spin of 1e5 rad/s", &result);
            spin[1] = 0.0;
            spin[2] = 1e5; /* about the normal: nothing slips */
            rub_well(lab, &request, "drilling", &result);
            spin[2] = 0.0;
            request.bodies[0].velocity[0] = 1e-9;
            rub_well(lab, &request, "a slip of 1e-9 m/s", &result);
            request.bodies[0].velocity[0] = 100.0;
            rub_well(lab, &request, "a slip of 100 m/s", &result);
        }
    lab_free(lab);
}

static void grazes(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    for (double speed = 1e-6; speed < 0.1; speed *= 10.0)
        for (int wall = 0; wall < 2; wall++) {
            struct solve_request request = wall ? on_wall(speed) : on_beam(0.19, speed);
            request.bodies[0].velocity[0] = 1.0;
            request.bodies[0].velocity[1] = 0.3;
            request.contacts[0].friction = 0.4;
            rub_well(lab, &request, "a graze", &result);
        }
    lab_free(lab);
}

/* Balls side by side on a beam, and ten in a row whose first comes from the side. */
static void many_contacts(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.01);
    for (int kind = 0; kind < 6; kind++) {
        struct solve_request request = {.body_count = 4, .contact_count = 3};
        request.bodies[3] = (struct solve_body){.id = "beam", .orientation = {1.0}};
        for (unsigned i = 0; i < 3; i++) {
            double x = 0.3 * i - 0.31;
            request.bodies[i] = (struct solve_body){.id = "ball",
                                                    .position = {x, 0.0, 0.025},
                                                    .orientation = {1.0},
                                                    .velocity = {0.4 - 0.5 * i, 0.1 * i, -0.3}};
            request.contacts[i] = (struct solve_contact){.a = i,
                                                         .b = 3,
                                                         .point = {x, 0.0, 0.010},
                                                         .normal = {0.0, 0.0, 1.0},
                                                         .gap = kind % 2 * 1e-6 * i,
                                                         .friction = kind < 2   ? 0.1
                                                                     : kind < 4 ? 0.6
                                                                                : 3.0};
        }
        rub_well(lab, &request, "three on a beam", &result);
    }
    for (int kind = 0; kind < 4; kind++) {
        struct solve_request request = {.body_count = 10, .contact_count = 9};
        for (unsigned i = 0; i < 10; i++) {
            request.bodies[i] = (struct solve_body){
                .id = "ball", .position = {0.0, 0.0, -0.03 * i}, .orientation = {1.0}};
            if (i)
                request.contacts[i - 1] =
                    (struct solve_contact){.a = i - 1,
                                           .b = i,
                                           .point = {0.0, 0.0, 0.015 - 0.03 * i},
                                           .normal = {0.0, 0.0, 1.0},
                                           .friction = kind % 2 ? 0.8 : 0.2};
        }
        request.bodies[0].velocity[2] = -0.5;
        request.bodies[0].velocity[0] = kind < 2 ? 0.3 : 0.0;
        request.bodies[9].angular_velocity[1] = kind < 2 ? 0.0 : 50.0;
        rub_well(lab, &request, "ten in a row", &result);
    }
    lab_free(lab);
}

/* A column that falls on a wall as a whole and turns: its lowest contact bears all of it. */
static void a_column_falls(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.01);
    struct solve_request request = {.body_count = 7, .contact_count = 6};
    request.bodies[6] = (struct solve_body){.id = "wall", .orientation = {1.0}};
    for (unsigned i = 0; i < 6; i++) {
        request.bodies[i] = (struct solve_body){.id = "ball",
                                                .position = {0.0, 0.0, 0.165 - 0.03 * i},
                                                .orientation = {1.0},
                                                .velocity = {0.2, 0.1, -0.3}};
        request.contacts[i] = (struct solve_contact){.a = i,
                                                     .b = i + 1,
                                                     .point = {0.0, 0.0, 0.15 - 0.03 * i},
                                                     .normal = {0.0, 0.0, 1.0},
                                                     .friction = 0.3};
    }
    rub_well(lab, &request, "a column", &result);
    near(closure_share(&result, 0.0), 0.0, 2e-5);
    lab_free(lab);
}

/* Bodies that press on each other, until the horizon. */
static void pressed(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.01);
    static const double acceleration[] = {-9.81, -1e3, -1e5, 1e3};
    for (size_t i = 0; i < COUNT(acceleration); i++)
        for (int wall = 0; wall < 2; wall++)
            for (int rest = 0; rest < 2; rest++) {
                double speed = rest ? 1e-3 : 0.3;
                struct solve_request request = wall ? on_wall(speed) : on_beam(0.19, speed);
                request.contacts[0].gap_acceleration = acceleration[i];
                request.contacts[0].friction = 0.3;
                request.bodies[0].velocity[0] = 0.5;
                request.options.horizon = 2e-3;
                enum percuss_status status = rub(lab, &request, "pressed", &result);
                assert_true(status == PERCUSS_OK || status == PERCUSS_TRUNCATED);
                if (result.end_reason != PERCUSS_END_LIMIT)
                    near(closure_share(&result, 0.0), 0.0, 2e-3);
            }
    lab_free(lab);
}

/* Slip along both tangents of a beam, where it turns: tolerances that are finer than its cells end
 * as well. They once ended without a solution, as their forces had to settle below their rounding.
 */
static void fine_tolerances(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = paper_lab(0.0);
    double coarse[2] = {0.0, 0.0};
    for (double tolerance = 1e-4; tolerance > 3e-8; tolerance *= 0.1) {
        struct solve_request request = on_beam(0.1, 0.26);
        request.bodies[0].velocity[0] = 0.12;
        request.bodies[0].velocity[1] = 0.09;
        request.contacts[0].friction = 0.3;
        request.options.tolerance = tolerance;
        assert_int_equal(rub(lab, &request, "a fine tolerance", &result), PERCUSS_OK);
        assert_true(result.tolerance_met || tolerance < 3e-6);
        for (int t = 0; t < 2; t++) {
            double impulse = result.contacts[0].impulse_tangential[t];
            if (coarse[t] != 0.0)
                near_relative(impulse, coarse[t], 2e-4);
            coarse[t] = impulse;
        }
    }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fine_tolerances),      cmocka_unit_test(painleve),
        cmocka_unit_test(no_slip_and_too_much), cmocka_unit_test(grazes),
        cmocka_unit_test(many_contacts),        cmocka_unit_test(pressed),
        cmocka_unit_test(a_column_falls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
