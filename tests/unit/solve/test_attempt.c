/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/error/attempt.c: the profile of its steps, when it is solved again,
 * its first steps; a truncated scene is as flexible, and its missing modes have the allowed effect.
 */
#include "solve/error/attempt.h"
#include "unit/solve/search_lab.h"

static const double ACCURACY = 1e-4;

/* An attempt at a request, its forces taken down, with a profile; the work that it took. */
static double attempt_with(struct search *search, const struct solve_request *request,
                           enum step_profile profile, struct attempt *attempt)
{
    struct attempt_context *context = search_begin(search, request);
    double work = context->work;
    *attempt = (struct attempt){
        .choice = {.cut = INFINITY, .most = 20}, .accuracy = ACCURACY, .profile = profile};
    assert_int_equal(attempt_assemble(context, attempt), PERCUSS_OK);
    assert_int_equal(attempt_run_logged(context, attempt, &attempt->assembly->scene), PERCUSS_OK);
    return work - context->work;
}

/* The beam swings back: what began as a single blow is the sequence to the bit, forces and all, and
 * both solutions count. */
static void a_single_blow_that_is_none_is_begun_again(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_beam(1e-3);
    struct attempt sequence;
    struct attempt single;
    double once = attempt_with(search, &request, STEP_PROFILE_SEQUENCE, &sequence);
    assert_true(sequence.outcome.tracks[0].count > 1);
    double impulse = sequence.outcome.tracks[0].impulse;
    unsigned long steps = sequence.outcome.steps;
    size_t logged = sequence.log->count;
    double both = attempt_with(search, &request, STEP_PROFILE_SINGLE, &single);
    assert_int_equal(single.profile, STEP_PROFILE_SEQUENCE);
    assert_true(single.outcome.tracks[0].impulse == impulse);
    assert_int_equal(single.outcome.steps, steps);
    assert_int_equal(single.log->count, logged);
    assert_true(both > 1.3 * once);
    /* without a log too */
    struct attempt again = {.accuracy = ACCURACY, .profile = STEP_PROFILE_SINGLE};
    again.assembly = single.assembly;
    assert_int_equal(attempt_run(&search->context, &again, &single.assembly->scene), PERCUSS_OK);
    assert_int_equal(again.profile, STEP_PROFILE_SEQUENCE);
    assert_true(again.outcome.tracks[0].impulse == impulse);
    search_free(search);
}

/* One that is a single blow stays so: fewer steps, within what the accuracy leaves, and nobody asks
 * for its forces. */
static void a_single_blow_takes_fewer_steps(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_rod("rod", 1e-3);
    struct attempt sequence;
    struct attempt single;
    attempt_with(search, &request, STEP_PROFILE_SEQUENCE, &sequence);
    double impulse = sequence.outcome.tracks[0].impulse;
    unsigned long steps = sequence.outcome.steps;
    attempt_with(search, &request, STEP_PROFILE_SINGLE, &single);
    assert_int_equal(single.profile, STEP_PROFILE_SINGLE);
    assert_null(single.log);
    assert_true(single.outcome.steps < 0.8 * steps);
    near(single.outcome.tracks[0].impulse, impulse, attempt_steps_leave(ACCURACY) * impulse);
    search_free(search);
}

/* A contact that acceleration presses as much as its approach does is no short blow: at 2 mm/s, but
 * not at 2 m/s. */
static void a_pressed_contact_takes_care(void **state)
{
    (void)state;
    struct search *search = search_create();
    static const double speeds[] = {2e-3, 2.0};
    for (size_t i = 0; i < COUNT(speeds); i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), sphere_spot("ball", 0.015), speeds[i]);
        struct attempt attempt;
        request.contacts[0].gap_acceleration = -9.81;
        attempt_with(search, &request, STEP_PROFILE_SINGLE, &attempt);
        assert_int_equal(attempt.profile, i ? STEP_PROFILE_SINGLE : STEP_PROFILE_SEQUENCE);
        assert_true(!attempt.log == (i == 1));
    }
    search_free(search);
}

/* A contact's normal forces are recorded where friction hardly acts on them: on the middle of the
 * beam and along it, not at the end of a bar that falls askew. First order follows a scene without
 * tangents. */
static void friction_that_is_weak(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct body bar = make_bar(&beam_kind, STEEL, 0.00635, 0.2);
    double lean = M_PI / 4.0;
    struct spot cap = {"bar",
                       {-0.1 + 0.00635 * (1.0 - cos(lean)), 0.0, -0.00635 * sin(lean)},
                       {-cos(lean), 0.0, -sin(lean)},
                       0.0};
    bar.tip_radius = 0.00635;
    lab_add(search->lab, "bar", bar);
    lab_add(search->lab, "wall", rigid_wall());
    for (int i = 0; i < 3; i++) {
        struct solve_request request = i < 2 ? strike(sphere_spot("ball", 0.015),
                                                      side_spot("beam", -0.19 * i, 0.010, 0.0), 0.3)
                                             : strike(cap, wall_spot("wall"), 1.0);
        struct attempt attempt;
        struct scene followed;
        request.contacts[0].friction = 0.3;
        attempt_with(search, &request, STEP_PROFILE_SEQUENCE, &attempt);
        assert_true(!attempt.log == (i == 2));
        if (!attempt.log)
            continue;
        assert_int_equal(attempt.log->rows, 1);
        assert_true(attempt_followed_scene(search->context.problem, &attempt.assembly->scene,
                                           &attempt.outcome, &followed));
        assert_int_equal(followed.rows, 1);
        assert_true(followed.w[0] == attempt.assembly->scene.w[0]);
    }
    search_free(search);
}

/* A rough solution of the sequence has the same sub-impacts by half the steps. */
static void a_rough_solution_is_cheap(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_beam(1e-3);
    struct attempt sequence;
    struct attempt rough;
    attempt_with(search, &request, STEP_PROFILE_SEQUENCE, &sequence);
    double impulse = sequence.outcome.tracks[0].impulse;
    unsigned long steps = sequence.outcome.steps;
    size_t count = sequence.outcome.tracks[0].count;
    attempt_with(search, &request, STEP_PROFILE_ROUGH, &rough);
    assert_int_equal(rough.profile, STEP_PROFILE_ROUGH);
    assert_int_equal(rough.outcome.tracks[0].count, count);
    assert_true(rough.outcome.steps < steps);
    near(rough.outcome.tracks[0].impulse, impulse, 1e-3 * impulse);
    search_free(search);
}

/* A tenth of the tolerance; a hundredth of what a sequence amplifies tenfold, a thousandth in
 * groups and of the smallest tolerances; and never less than is tried. */
static void begins_below_the_tolerance(void **state)
{
    (void)state;
    near_relative(attempt_first_accuracy(1e-3, false, false), 1e-4, 1e-12);
    near_relative(attempt_first_accuracy(1e-3, true, false), 1e-5, 1e-12);
    near_relative(attempt_first_accuracy(1e-4, true, false), 1e-7, 1e-12);
    near_relative(attempt_first_accuracy(6e-5, true, false), 6e-7, 1e-12);
    near_relative(attempt_first_accuracy(1e-4, true, true), 1e-7, 1e-12);
    near_relative(attempt_first_accuracy(1e-8, false, false), 1e-11, 1e-12);
    near_relative(attempt_first_accuracy(0.5, true, false), 1e-5, 1e-12);
    near_relative(attempt_first_accuracy(0.5, true, true), 1e-6, 1e-12);
    near_relative(attempt_first_accuracy(1e-17, false, false), FINEST_STEPS, 0.0);
}

/* What a slow force meets: the residual flexibility and that of the modes. */
static double flexibility(const struct scene *scene)
{
    double sum = scene->residual[0];
    for (size_t g = 0; g < scene->groups; g++)
        for (size_t k = 0; scene->group[g].participation[0] && k < scene->group[g].count; k++) {
            double share = scene->group[g].participation[0][k] / scene->group[g].set->omega[k];
            sum += share * share;
        }
    return sum;
}

static size_t count_modes(const struct scene *scene)
{
    size_t count = 0;
    for (size_t g = 0; g < scene->groups; g++)
        count += scene->group[g].count;
    return count;
}

static struct attempt solve_fewer(const struct search *search, const struct attempt *full,
                                  double allowed, struct scene *fewer)
{
    struct attempt_context context = search->context;
    struct attempt attempt = *full;
    const struct scene *scene = &full->assembly->scene;
    assert_true(attempt_truncate(context.problem, scene, &full->outcome, allowed, fewer));
    assert_int_equal(attempt_run(&context, &attempt, fewer), PERCUSS_OK);
    return attempt;
}

/* Sums in another order: some hundred roundings of terms of one sign. */
static void as_flexible(const struct scene *scene, const struct scene *fewer)
{
    near_relative(flexibility(fewer), flexibility(scene), 1e-13);
}

/* 98 of 100 errors are below 2.5 times the effect (refinement.c). Fewer modes the more is
 * allowed.
 */
static void a_rod(void **state)
{
    (void)state;
    static const double allowed[] = {1e-5, 1e-4, 1e-3, 1e-2};
    struct search *search = search_create();
    struct solve_request request = search_on_rod("rod", 1e-6);
    search_begin(search, &request);
    struct attempt full = search_attempt(search, 200, 1e-8);
    size_t before = 200;
    for (size_t i = 0; i < COUNT(allowed); i++) {
        struct scene fewer;
        struct attempt attempt = solve_fewer(search, &full, allowed[i], &fewer);
        size_t modes = count_modes(&fewer);
        assert_true(modes < before && modes % LANES == 0);
        as_flexible(&full.assembly->scene, &fewer);
        assert_true(search_error(search, &attempt, &full) <= 2.5 * allowed[i]);
        before = modes;
    }
    search_free(search);
}

/* Of two parities, some of each; a sequence of two amplifies tenfold. */
static void a_beam(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 0.303);
    request.options.tolerance = 1e-6;
    search_begin(search, &request);
    struct attempt full = search_attempt(search, 100, 1e-8);
    struct scene fewer;
    struct attempt attempt = solve_fewer(search, &full, 1e-4, &fewer);
    as_flexible(&full.assembly->scene, &fewer);
    assert_true(count_modes(&fewer) < 50);
    assert_true(search_error(search, &attempt, &full) < 20.0 * 1e-4);
    search_free(search);
}

/* Nothing may be left out, and modes that are in motion stay. */
static void those_that_stay(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = search_on_rod("rod", 1e-6);
    search_begin(search, &request);
    struct attempt full = search_attempt(search, 30, 1e-8);
    struct scene *scene = &full.assembly->scene;
    struct scene fewer;
    assert_true(attempt_truncate(search->context.problem, scene, &full.outcome, 0.0, &fewer));
    assert_int_equal(count_modes(&fewer), 30);
    scene->group[0].v = arena_take(&search->arena, scene->group[0].stride, sizeof(double));
    assert_true(attempt_truncate(search->context.problem, scene, &full.outcome, 1.0, &fewer));
    assert_int_equal(count_modes(&fewer), 30);
    near_relative(fewer.residual[0], scene->residual[0], 0.0);
    search_free(search);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(begins_below_the_tolerance),
        cmocka_unit_test(a_single_blow_that_is_none_is_begun_again),
        cmocka_unit_test(a_single_blow_takes_fewer_steps),
        cmocka_unit_test(a_pressed_contact_takes_care),
        cmocka_unit_test(friction_that_is_weak),
        cmocka_unit_test(a_rough_solution_is_cheap),
        cmocka_unit_test(a_rod),
        cmocka_unit_test(a_beam),
        cmocka_unit_test(those_that_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
