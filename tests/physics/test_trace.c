/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Time histories (solve/report.c, impact/trace.c, force_log.c): what they show is the impact that
 * the reply describes, and kinematics and momentum hold between their columns. */
#include <unistd.h>

#include "impact/trace.h"
#include "physics/support.h"

static const double SPHERE_MASS = 7800.0 * 4.0 / 3.0 * M_PI * 0.015 * 0.015 * 0.015;

static struct lab *lab_of_three(void)
{
    struct lab *lab = lab_create();
    lab_add(lab, "sphere", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0));
    return lab;
}

static struct solve_request on_beam(double speed, double tolerance)
{
    struct solve_request request =
        strike(sphere_spot("sphere", 0.015), side_spot("beam", 0.1, 0.010, 0.0), speed);
    request.options.tolerance = tolerance;
    request.options.trace = true;
    return request;
}

/* Impulse of the force shown, by the trapezoidal rule. */
static double shown_impulse(const struct trace *trace, size_t contact)
{
    double sum = 0.0;
    for (size_t i = 1; i < trace->count; i++)
        sum += 0.5 * (trace->time[i] - trace->time[i - 1]) *
               (trace->contact[contact].force[i] + trace->contact[contact].force[i - 1]);
    return sum;
}

static void shows_the_reply(const struct solve_result *result)
{
    const struct trace *trace = result->trace;
    assert_non_null(trace);
    assert_int_equal(trace->contacts, result->contact_count);
    assert_in_range(trace->count, 64, 4096);
    for (size_t i = 1; i < trace->count; i++)
        assert_true(trace->time[i] > trace->time[i - 1]);
    /* a closed form's window ends with its contact, whose last step goes on: at most 1e-2 of it */
    double beyond = trace->time[trace->count - 1] / result->window - 1.0;
    assert_true(beyond > -1e-9 && beyond < 1e-2);
    for (size_t c = 0; c < trace->contacts; c++) {
        const struct solve_contact_result *contact = &result->contacts[c];
        double peak = 0.0, deepest = 0.0, listed_peak = 0.0, listed_deepest = 0.0;
        for (size_t i = 0; i < trace->count; i++) {
            peak = fmax(peak, trace->contact[c].force[i]);
            deepest = fmax(deepest, trace->contact[c].indentation[i]);
            /* nothing presses where nothing touches */
            assert_true(trace->contact[c].indentation[i] > 0.0 ||
                        trace->contact[c].force[i] == 0.0);
        }
        for (size_t i = 0; i < contact->sub_impacts_listed; i++) {
            listed_peak = fmax(listed_peak, contact->sub_impacts[i].peak_force);
            listed_deepest = fmax(listed_deepest, contact->sub_impacts[i].max_indentation);
        }
        /* the trapezoidal rule on some 100 parts of a bell */
        measured_relative("impulse shown", shown_impulse(trace, c), contact->impulse, 2e-3);
        measured_relative("peak shown", peak, listed_peak, 5e-3);
        measured_relative("indentation shown", deepest, listed_deepest, 5e-3);
    }
}

/* Both bodies' points are an indentation apart in the wrong direction while they touch. */
static void bodies_meet_while_they_touch(const struct solve_result *result, size_t c, double gap)
{
    const struct trace_contact *contact = &result->trace->contact[c];
    double deepest = 0.0, worst = 0.0;
    for (size_t i = 0; i < result->trace->count; i++)
        deepest = fmax(deepest, contact->indentation[i]);
    for (size_t i = 0; i < result->trace->count; i++) {
        double apart = gap + contact->displacement[0][i] - contact->displacement[1][i];
        if (contact->force[i] > 0.0)
            worst = fmax(worst, fabs(apart + contact->indentation[i]));
        else /* a thousandth of the indentation bears 3e-5 of the force */
            assert_true(apart >= -1e-3 * deepest);
    }
    measured("worst overlap mismatch", worst / deepest, 0.0, 1e-3);
}

static void a_beam_shows_all_sub_impacts(void **state)
{
    (void)state;
    static struct solve_result result, plain;
    struct lab *lab = lab_of_three();
    struct solve_request request = on_beam(0.25, 1e-6);
    lab_solve(lab, &request, &result);
    assert_true(result.contacts[0].sub_impact_count >= 2);
    shows_the_reply(&result);
    bodies_meet_while_they_touch(&result, 0, 0.0);
    /* the sphere is rigid: its velocity is momentum */
    const struct trace_contact *contact = &result.trace->contact[0];
    size_t last = result.trace->count - 1;
    measured("sphere before", contact->velocity[0][0], -0.25, 1e-15);
    measured_relative("sphere after", contact->velocity[0][last],
                      -0.25 + result.contacts[0].impulse / SPHERE_MASS, 1e-9);
    measured_relative(
        "gap rate after", contact->gap_rate[last],
        -0.25 + result.contacts[0].impulse * result.contacts[0].inverse_effective_mass, 1e-9);
    /* the derivative of what the beam's point does is its velocity, away from contacts */
    double worst = 0.0;
    for (size_t i = last - 40; i + 1 < last; i++) {
        double h = result.trace->time[i + 1] - result.trace->time[i - 1];
        double slope = (contact->displacement[1][i + 1] - contact->displacement[1][i - 1]) / h;
        worst = fmax(worst, fabs(slope - contact->velocity[1][i]));
    }
    measured("slope of the beam's point, m/s", worst, 0.0, 0.05);
    /* asking for it changes nothing */
    struct solve_request without = request;
    without.options.trace = false;
    double impulse = result.contacts[0].impulse;
    lab_solve(lab, &without, &plain);
    assert_null(plain.trace);
    assert_true(plain.contacts[0].impulse == impulse);
    assert_int_equal(plain.warning_count, result.warning_count);
    lab_free(lab);
}

static void a_rod_a_wall_and_a_ringing_beam(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_three();
    struct solve_request request = strike(sphere_spot("sphere", 0.015), end_spot("rod", 1.0), 0.3);
    request.options.trace = true;
    request.options.tolerance = 1e-5;
    lab_solve(lab, &request, &result);
    shows_the_reply(&result);
    bodies_meet_while_they_touch(&result, 0, 0.0);
    /* two rigid bodies are solved in closed form, and shown all the same */
    lab_add(lab, "other", make_sphere(ALUMINIUM, 0.02));
    request = strike(sphere_spot("sphere", 0.015), sphere_spot("other", 0.02), 1.0);
    request.options.trace = true;
    request.contacts[0].gap = 2e-5;
    lab_solve(lab, &request, &result);
    assert_int_equal(result.warning_count, 0);
    shows_the_reply(&result);
    bodies_meet_while_they_touch(&result, 0, 2e-5);
    /* a wall's point moves with the waves that leave: into it first, and out of it at the end */
    lab_add(lab, "wall", make_body(&half_space_kind, STEEL));
    request = strike(sphere_spot("sphere", 0.015), wall_spot("wall"), 2.0);
    request.options.trace = true;
    lab_solve(lab, &request, &result);
    shows_the_reply(&result);
    bodies_meet_while_they_touch(&result, 0, 0.0);
    const struct trace_contact *wall = &result.trace->contact[0];
    assert_true(wall->velocity[1][result.trace->count / 8] < 0.0);
    assert_true(wall->velocity[1][result.trace->count - 1] > 0.0);
    lab_free(lab);
}

/* Work of the force shown, by the trapezoidal rule. */
static double shown_work(const struct trace_contact *contact, size_t count)
{
    double sum = 0.0;
    for (size_t i = 1; i < count; i++)
        sum += 0.5 * (contact->force[i] + contact->force[i - 1]) *
               (contact->indentation[i] - contact->indentation[i - 1]);
    return sum;
}

/* Where metal yields, the work of the force on the indentation is what the dent has taken. */
static void dents_take_the_work(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_three();
    struct material soft = ALUMINIUM;
    soft.yield = 200e6;
    lab_add(lab, "beam", make_bar(&beam_kind, soft, 0.010, 1.0));
    struct solve_request request = on_beam(0.25, 1e-6);
    lab_solve(lab, &request, &result);
    assert_true(result.energy.plastic > 0.02 * result.energy.available);
    shows_the_reply(&result);
    /* the rule's error, of an exchange ten times as large as what stays */
    measured_relative("work shown", shown_work(&result.trace->contact[0], result.trace->count),
                      result.energy.plastic, 1e-2);
    lab_free(lab);
}

static void other_methods_and_masses_are_told(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_three();
    /* by CVODE the answer differs in some digits, which is said */
    struct solve_request request = on_beam(0.1, 1e-4);
    request.options.method = PERCUSS_METHOD_CVODE;
    lab_solve(lab, &request, &result);
    assert_non_null(result.trace);
    bool told = false;
    for (size_t i = 0; i < result.warning_count; i++)
        told = told || strstr(result.warnings[i], "options.trace");
    assert_true(told);
    /* with the caller's W the share of each body is unknown; the contact is shown */
    double w = 1.1 * result.contacts[0].inverse_effective_mass;
    request = on_beam(0.1, 1e-4);
    request.delassus = &w;
    lab_solve(lab, &request, &result);
    assert_non_null(result.trace);
    assert_true(isnan(result.trace->contact[0].displacement[0][5]));
    assert_true(isnan(result.trace->contact[0].velocity[1][5]));
    measured_relative("impulse shown", shown_impulse(result.trace, 0), result.contacts[0].impulse,
                      2e-3);
    lab_free(lab);
}

/* Two spheres at once on one beam, and a horizon inside: each contact is shown to the end. */
static void several_contacts_share_the_instants(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_three();
    struct solve_request request = on_beam(0.25, 1e-5);
    struct solve_request other =
        strike(sphere_spot("sphere", 0.015), side_spot("beam", -0.3, 0.010, 0.0), 0.2);
    request.bodies[2] = other.bodies[0];
    request.contacts[1] = other.contacts[0];
    /* the beam stands where the first strike puts it: the second point is 0.4 m along it */
    for (int i = 0; i < 3; i++) {
        double along = other.bodies[1].position[i] - request.bodies[1].position[i];
        request.bodies[2].position[i] -= along;
        request.contacts[1].point[i] -= along;
    }
    request.contacts[1].a = 2;
    request.body_count = 3;
    request.contact_count = 2;
    lab_solve(lab, &request, &result);
    shows_the_reply(&result);
    bodies_meet_while_they_touch(&result, 0, 0.0);
    bodies_meet_while_they_touch(&result, 1, 0.0);
    request.options.horizon = 1e-3;
    assert_int_equal(solve(lab->workspace, &lab->means, &request, &result), PERCUSS_TRUNCATED);
    shows_the_reply(&result);
    lab_free(lab);
}

/* A sphere that has come into a wall by some micrometres and is pressed on: the way back to the
 * touch may end within a rounding error of it, where a flight has no length any more. */
static struct solve_request overlapping(uint64_t *seed)
{
    struct solve_request request =
        strike(sphere_spot("sphere", 0.015), wall_spot("wall"), random_between(seed, 0.01, 1.0));
    request.contacts[0].gap = -pow(10.0, random_between(seed, -9.0, -4.0));
    request.contacts[0].gap_acceleration = random_between(seed, -50.0, 10.0);
    request.options.trace = true;
    return request;
}

static void an_overlap_is_shown_without_end(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_three();
    lab_add(lab, "wall", make_body(&half_space_kind, STEEL));
    uint64_t seed = 20;
    /* a solve takes a millisecond: only a hang lasts so long */
    alarm(120);
    struct solve_request request = overlapping(&seed);
    request.bodies[0].velocity[2] = -0.57836769580547198;
    request.contacts[0].gap = -4.8199513928408236e-06;
    request.contacts[0].gap_acceleration = -27.4639035134993;
    size_t shown = 0;
    for (int i = 0; i < 1000; i++) {
        enum percuss_status status = solve(lab->workspace, &lab->means, &request, &result);
        if (status != PERCUSS_BAD_REQUEST) {
            assert_int_equal(status, PERCUSS_OK);
            assert_non_null(result.trace);
            for (size_t k = 1; k < result.trace->count; k++)
                assert_true(result.trace->time[k] > result.trace->time[k - 1]);
            shown++;
        }
        request = overlapping(&seed);
    }
    alarm(0);
    assert_true(shown > 500);
    lab_free(lab);
}

static bool count_asking(void *context, double done)
{
    (void)done;
    ++*(unsigned *)context;
    return true;
}

/* A heavy ball on a light beam of many modes, which meet hundreds of times: the histories take no
 * more than twice what an answer may, and show the impact from its start as far as that goes. */
static void histories_have_their_bounds(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_three();
    struct body beam =
        make_supported(make_bar(&beam_kind, ALUMINIUM, 0.001, 0.5), SUPPORT_PINNED, SUPPORT_PINNED);
    double work[2];
    beam.modes = 100;
    lab_add(lab, "light", beam);
    struct solve_request request =
        strike(sphere_spot("sphere", 0.015), side_spot("light", 0.06, 0.001, 0.0), 0.05);
    request.options.horizon = 1.0;
    request.options.tolerance = 1e-2;
    for (int traced = 0; traced < 2; traced++) {
        unsigned asked = 0;
        request.options.trace = traced;
        lab->means.watch = (struct watch){count_asking, &asked};
        enum percuss_status status = solve(lab->workspace, &lab->means, &request, &result);
        assert_true(status == PERCUSS_OK || status == PERCUSS_TRUNCATED);
        work[traced] = asked * PACE_WORK;
    }
    if (getenv("PERCUSS_MEASURE"))
        print_message("    work %g, traced %g, %zu sub-impacts, until %g of %g s\n", work[0],
                      work[1], result.contacts[0].sub_impact_count,
                      result.trace->time[result.trace->count - 1], result.window);
    /* 3e7 each (docs/lab/accuracy.md), and what is counted after it is done */
    assert_true(work[1] - work[0] < 6.6e7);
    /* they are cut short here, and that is said */
    bool said = false;
    for (size_t i = 0; i < result.warning_count; i++)
        said = said || strstr(result.warnings[i], "options.trace: the histories end at");
    assert_true(said && result.trace->count > 1);
    lab_free(lab);
}

/* Tangential forces move the normals' points where the site is off the middle: the beam turns and
 * bends by their lever arm. */
static void with_friction(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_three();
    struct solve_request request = on_beam(0.25, 1e-5);
    double r[9], axis[3] = {1.0, 0.0, 0.0}, along[3];
    rotation_matrix(request.bodies[1].orientation, r);
    rotate3(r, axis, along);
    add_scaled3(0.6, along, request.bodies[0].velocity);
    request.contacts[0].friction = 0.4;
    lab_solve(lab, &request, &result);
    shows_the_reply(&result);
    bodies_meet_while_they_touch(&result, 0, 0.0);
    const struct trace_contact *contact = &result.trace->contact[0];
    size_t last = result.trace->count - 1;
    measured_relative("gap rate after", contact->gap_rate[last],
                      0.25 * result.contacts[0].restitution_kinematic, 1e-6);
    assert_true(result.contacts[0].restitution_kinematic != result.contacts[0].restitution);
    lab_free(lab);
}

/* The tangential force shown, integrated over the sub-impacts of the reply. */
static void shows_the_tangential_force(const struct solve_result *result)
{
    const struct trace *trace = result->trace;
    const struct trace_contact *shown = &trace->contact[0];
    const struct solve_contact_result *contact = &result->contacts[0];
    double impulse[2] = {0};
    double part[8][2] = {{0}};
    assert_in_range(contact->sub_impacts_listed, 1, 8);
    for (size_t i = 1; i < trace->count; i++)
        for (size_t t = 0; t < 2; t++) {
            double h = trace->time[i] - trace->time[i - 1];
            double added = 0.5 * h * (shown->tangential[t][i] + shown->tangential[t][i - 1]);
            impulse[t] += added;
            for (size_t s = 0; s < contact->sub_impacts_listed; s++)
                if (trace->time[i] > contact->sub_impacts[s].start - 0.5 * h &&
                    trace->time[i - 1] < contact->sub_impacts[s].end)
                    part[s][t] += added;
        }
    /* Coulomb's circle at every instant */
    double most = 0.0;
    for (size_t i = 0; i < trace->count; i++) {
        double size = hypot(shown->tangential[0][i], shown->tangential[1][i]);
        if (shown->force[i] > 0.0)
            most = fmax(most, size / (contact->friction * shown->force[i]));
        else
            assert_true(size == 0.0);
    }
    assert_true(most > 0.999 && most <= 1.0 + 1e-12);
    /* by the trapezoidal rule, of the largest tangential impulse that Coulomb's law allows */
    double scale = contact->friction * contact->impulse;
    for (size_t t = 0; t < 2; t++) {
        measured("tangential impulse shown", impulse[t] / scale,
                 contact->impulse_tangential[t] / scale, 2e-3);
        for (size_t s = 0; s < contact->sub_impacts_listed; s++)
            measured("of a sub-impact", part[s][t] / scale,
                     contact->sub_impacts[s].impulse_tangential[t] / scale, 2e-3);
    }
}

/* The paper's sphere on the middle of its beam at 30 degrees: the second blow slides backward. */
static void friction_that_reverses(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_three();
    struct solve_request request = strike(
        sphere_spot("sphere", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 0.3 * cos(M_PI / 6.0));
    double r[9], axis[3] = {1.0, 0.0, 0.0}, along[3];
    rotation_matrix(request.bodies[1].orientation, r);
    rotate3(r, axis, along);
    add_scaled3(0.15, along, request.bodies[0].velocity);
    request.contacts[0].friction = 0.3;
    memcpy(request.contacts[0].tangent, along, sizeof along);
    request.options.tolerance = 1e-5;
    request.options.trace = true;
    lab_solve(lab, &request, &result);
    shows_the_reply(&result);
    shows_the_tangential_force(&result);
    const struct solve_contact_result *contact = &result.contacts[0];
    /* a program of its own has 7.047 and -2.361 mN s (unit/solve/test_oblique) with sections that
     * do not deform */
    measured_relative("first blow", contact->sub_impacts[0].impulse_tangential[0], -7.047e-3, 1e-2);
    measured_relative("second blow", contact->sub_impacts[1].impulse_tangential[0], 2.361e-3, 6e-2);
    /* the force is against the slip of each blow's start, which vibration has turned */
    const struct trace_contact *shown = &result.trace->contact[0];
    double first = 0.0, second = 0.0;
    for (size_t i = 0; i < result.trace->count; i++)
        if (result.trace->time[i] < 1e-3)
            first = fmin(first, shown->tangential[0][i]);
        else
            second = fmax(second, shown->tangential[0][i]);
    assert_true(first < -50.0 && second > 15.0);
    measured("slip at first", shown->slip[0][0], 0.15, 1e-12);
    size_t touch = 0;
    while (result.trace->time[touch] < contact->sub_impacts[1].start)
        touch++;
    assert_true(shown->slip[0][touch] < -0.02);
    /* along a tangent that is turned both components are shown */
    request.options.tolerance = 1e-3;
    rotate3(r, (const double[3]){0.6, 0.8, 0.0}, request.contacts[0].tangent);
    lab_solve(lab, &request, &result);
    shows_the_tangential_force(&result);
    measured_relative("turned", result.trace->contact[0].slip[0][0], 0.09, 1e-9);
    assert_true(fabs(result.contacts[0].impulse_tangential[1]) > 3e-3);
    /* the histories of a contact without friction have none */
    request.contacts[0].friction = 0.0;
    lab_solve(lab, &request, &result);
    assert_null(result.trace->contact[0].tangential[0]);
    assert_null(result.trace->contact[0].slip[1]);
    lab_free(lab);
}

/* Two balls that stick at first and slide at last: no vibration, so that the slip shown at the end
 * is that of the reply. */
static void friction_of_rigid_bodies(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_of_three();
    lab_add(lab, "other", make_sphere(STEEL, 0.015));
    struct solve_request request =
        strike(sphere_spot("sphere", 0.015), sphere_spot("other", 0.015), 0.26);
    request.bodies[0].velocity[0] += 0.1;
    request.bodies[0].velocity[1] += 0.05;
    request.contacts[0].friction = 0.3;
    request.options.trace = true;
    lab_solve(lab, &request, &result);
    shows_the_reply(&result);
    shows_the_tangential_force(&result);
    const struct trace_contact *shown = &result.trace->contact[0];
    size_t last = result.trace->count - 1;
    for (size_t t = 0; t < 2; t++) {
        measured_relative("slip before", shown->slip[t][0], result.contacts[0].slip_before[t],
                          1e-9);
        measured("slip after", shown->slip[t][last], result.contacts[0].slip_after[t], 1e-6);
    }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_overlap_is_shown_without_end),
        cmocka_unit_test(histories_have_their_bounds),
        cmocka_unit_test(a_beam_shows_all_sub_impacts),
        cmocka_unit_test(a_rod_a_wall_and_a_ringing_beam),
        cmocka_unit_test(dents_take_the_work),
        cmocka_unit_test(other_methods_and_masses_are_told),
        cmocka_unit_test(several_contacts_share_the_instants),
        cmocka_unit_test(with_friction),
        cmocka_unit_test(friction_that_reverses),
        cmocka_unit_test(friction_of_rigid_bodies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
