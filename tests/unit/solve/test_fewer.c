/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/solve/fewer.c: a scene with fewer modes is as flexible, and what it lacks does
 * what was allowed. */
#include "unit/solve/search_lab.h"

#include "solve/fewer.h"

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
    assert_true(fewer_modes(context.problem, scene, &full->outcome, allowed, fewer));
    assert_int_equal(attempt_run(&context, &attempt, fewer), PERCUSS_OK);
    return attempt;
}

/* Sums in another order: some hundred roundings of terms of one sign. */
static void as_flexible(const struct scene *scene, const struct scene *fewer)
{
    near_relative(flexibility(fewer), flexibility(scene), 1e-13);
}

/* 98 of 100 errors are below 2.5 times the effect (mode_search.c). Fewer modes the more is allowed.
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
    assert_true(fewer_modes(search->context.problem, scene, &full.outcome, 0.0, &fewer));
    assert_int_equal(count_modes(&fewer), 30);
    scene->group[0].v = arena_take(&search->arena, scene->group[0].stride, sizeof(double));
    assert_true(fewer_modes(search->context.problem, scene, &full.outcome, 1.0, &fewer));
    assert_int_equal(count_modes(&fewer), 30);
    near_relative(fewer.residual[0], scene->residual[0], 0.0);
    search_free(search);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rod),
        cmocka_unit_test(a_beam),
        cmocka_unit_test(those_that_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
