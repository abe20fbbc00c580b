/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/error/deviation.c: shifted models are the same ones with other
 * numbers. */
#include "model/half_space.h"
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

/* A ball that never slips on a half-space, u'' = -W (k u + lag k^2 u'), k = kappa K(t): the waves
 * along the surface change the tangential impulse, integrated here, by less than their part of the
 * error, of a coefficient that is just enough, but not by much less. */
static void waves_along_a_half_space(void **state)
{
    (void)state;
    static const double speeds[] = {0.1, 1.0, 5.0};
    struct search *search = search_create();
    lab_add(search->lab, "floor", make_body(&half_space_kind, ALUMINIUM));
    for (size_t i = 0; i < COUNT(speeds); i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), wall_spot("floor"), speeds[i]);
        request.contacts[0].friction = 0.3;
        struct attempt_context *context = search_begin(search, &request);
        const struct problem *problem = context->problem;
        const struct contact_friction *friction = problem->friction;
        double lag = half_space_waves_of(&problem_body(problem, 0, 1)->material).lag_along;
        double mass = problem->bodies[0]->mass, w = problem->row_w[4];
        double hertz = problem->hertz[0].stiffness, kappa = friction->ratio[0];
        double slip[2]; /* of 1 m/s, without waves and with them */
        for (int waves = 0; waves < 2; waves++) {
            double d = 0.0, rate = speeds[i], u = 0.0, v = 1.0;
            double h = 1e-4 * pow(mass * mass / (hertz * hertz * speeds[i]), 0.2);
            for (; d >= 0.0; d += h * rate) {
                double k = 1.5 * kappa * hertz * sqrt(d);
                rate -= h * hertz * d * sqrt(d) / mass;
                v -= h * w * (k * u + waves * lag * k * k * v);
                u += h * v;
            }
            slip[waves] = v;
        }
        double rest = fabs(slip[1] - slip[0]) / w; /* N s of 1 m/s */
        /* the least coefficient that holds it: kappa u'/d' */
        double limit = kappa / speeds[i] * 2.0 * mass * speeds[i];
        double share = deviation_along(problem, friction).waves;
        assert_true(rest < share * limit && rest > 0.7 * share * limit);
    }
    search_free(search);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(force_is_speed),
        cmocka_unit_test(waves_along_a_half_space),
        cmocka_unit_test(compliance_softens),
        cmocka_unit_test(later_yield_gives_more_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
