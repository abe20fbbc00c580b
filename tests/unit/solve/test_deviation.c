/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/error/deviation.c: shifted models are the same ones with other
 * numbers. */
#include "solve/error/deviation.h"
#include "unit/solve/search_lab.h"

static struct solve_result result;

static double restitution(struct lab *lab, const struct solve_request *request)
{
    lab_solve(lab, request, &result);
    return result.contacts[0].restitution;
}

/* Hertz's law with f times the force is that of f^2 times the speed: k d^1.5 at s times the speed
 * is k sqrt(s) d^1.5. */
static void force_is_speed(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = strike(sphere_spot("ball", 0.015), end_spot("rod", 1.0), 2.0);
    struct attempt_context *context = search_begin(search, &request);
    struct model_impact blow = model_impact_expected(context->problem, 0);
    struct deviation deviation = deviation_of(context->problem, 0, &blow);
    double factor = exp(2.0 * deviation.force / DEVIATION_SIGMAS);
    assert_true(factor > 1.001);
    request.options.tolerance = 1e-6;
    request.model_shift[SOLVE_SHIFT_FORCE] = 2.0;
    double shifted = restitution(search->lab, &request);
    request = strike(sphere_spot("ball", 0.015), end_spot("rod", 1.0), 2.0 * factor * factor);
    request.options.tolerance = 1e-6;
    near(shifted, restitution(search->lab, &request), 4e-6); /* two tolerances, either way */
    search_free(search);
}

/* More compliance is a softer contact: less is lost to waves. And it is what is in series. */
static void compliance_softens(void **state)
{
    (void)state;
    struct search *search = search_create();
    struct solve_request request = strike(sphere_spot("ball", 0.015), end_spot("rod", 1.0), 0.3);
    double stated = restitution(search->lab, &request);
    double width = result.restitution_model;
    request.model_shift[SOLVE_SHIFT_COMPLIANCE] = 1.0;
    double softer = restitution(search->lab, &request);
    request.model_shift[SOLVE_SHIFT_COMPLIANCE] = -1.0;
    double stiffer = restitution(search->lab, &request);
    assert_true(stiffer < stated && stated < softer);
    assert_true(softer - stated < width && stated - stiffer < width);
    struct attempt_context *context = search_begin(search, &request);
    struct model_impact blow = model_impact_expected(context->problem, 0);
    struct deviation deviation = deviation_of(context->problem, 0, &blow);
    near_relative(context->problem->shift[0], -deviation.compliance / DEVIATION_SIGMAS, 1e-15);
    search_free(search);
}

/* What yields later gives more back, by what its deviation says. */
static void later_yield_gives_more_back(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    const struct material soft = {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0};
    struct body block = make_body(&block_kind, soft);
    block.size[0] = block.size[1] = block.size[2] = 0.1;
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "block", block);
    struct spot top = {"block", {0.0, 0.0, 0.05}, {0.0, 0.0, 1.0}, 0.0};
    struct solve_request request = strike(sphere_spot("ball", 0.015), top, 0.3);
    double stated = restitution(lab, &request);
    double width = result.restitution_model;
    request.model_shift[SOLVE_SHIFT_YIELD] = 1.0;
    double later = restitution(lab, &request);
    request.model_shift[SOLVE_SHIFT_YIELD] = -1.0;
    double earlier = restitution(lab, &request);
    assert_true(earlier < stated && stated < later);
    /* one standard deviation of two; the slope between yields is not constant */
    near(later - stated, 0.5 * width, 0.2 * width);
    near(stated - earlier, 0.5 * width, 0.2 * width);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(force_is_speed),
        cmocka_unit_test(compliance_softens),
        cmocka_unit_test(later_yield_gives_more_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
