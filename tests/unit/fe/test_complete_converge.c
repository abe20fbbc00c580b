/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/complete_converge.c: known limits, and scenes against finer meshes
 * and another program's. */
#include "check.h"
#include "fe/complete_converge.h"

/* A swing with harmonics 1 and 2, which six phases hold exactly. */
static double swing_at(double phase)
{
    return 0.5 + 0.02 * cos(2.0 * M_PI * (phase - 0.2)) + 0.004 * sin(4.0 * M_PI * phase);
}

static struct swing known_swing(unsigned phases)
{
    struct swing swing = {.cells = 8, .phases = phases};
    for (unsigned k = 0; k < phases; k++)
        swing.restitution[k] = swing_at((double)k / phases);
    swing_judge(&swing);
    return swing;
}

/* Means 0.5 + ratio^n without any swing. */
static struct complete_convergence known_means(double ratio, unsigned meshes)
{
    struct complete_convergence found = {.meshes = meshes};
    for (unsigned m = 0; m < meshes; m++) {
        struct swing *swing = &found.swing[m];
        swing->phases = 6;
        for (unsigned k = 0; k < swing->phases; k++)
            swing->restitution[k] = 0.5 + pow(ratio, m);
        swing_judge(swing);
    }
    complete_converge_judge(&found);
    return found;
}

static void known_limits_are_found(void **unused)
{
    (void)unused;
    struct complete_convergence found = known_means(0.25, 3);
    measured("second order", found.restitution, 0.5, 1e-15);
    measured("order", found.order, 2.0, 1e-12);
    measured("error", found.error, 0.75 / 4.0, 1e-15);
    found = known_means(0.5, 3);
    measured("first order", found.restitution, 0.5, 1e-15);
    measured("error", found.error, 0.25, 1e-15);
    /* two meshes: all that the finer one changed; one knows nothing */
    found = known_means(0.5, 2);
    measured("two", found.error, 0.5, 1e-15);
    assert_true(isinf(known_means(0.5, 1).error));
    /* one that turns round is not extrapolated */
    found = known_means(-0.5, 3);
    measured("turns", found.restitution, 0.75, 1e-15);
    measured("its error", found.error, 0.75, 1e-15);
}

/* Means that agree do not hide a swing: a twelfth of its width, and what six phases leave. */
static void a_swing_is_never_less_than_its_share(void **unused)
{
    (void)unused;
    struct complete_convergence found = {.meshes = 2};
    found.swing[0] = known_swing(6);
    found.swing[1] = known_swing(6);
    complete_converge_judge(&found);
    measured("error", found.error, (1.0 / 12.0 + 0.03) * found.swing[1].width, 1e-15);
}

static struct complete_problem sphere_on_rod(double sphere, double rod, double yield,
                                             double tangent, double speed)
{
    return (struct complete_problem){
        .a = {.shape = COMPLETE_SPHERE,
              .radius = sphere,
              .material = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0}},
        .b = {.shape = COMPLETE_CYLINDER,
              .radius = rod,
              .length = 1.0,
              .material = {"aluminium", 73e9, 0.33, 2700.0, yield, tangent}},
        .speed = speed,
        .cells = 16,
        .horizon = 20e-3,
    };
}

static struct complete_convergence found_for(const struct complete_problem *problem,
                                             double tolerance)
{
    struct complete_convergence found;
    struct fault fault = {""};
    if (complete_converge(problem, tolerance, &found, &fault) != PERCUSS_OK)
        fail_msg("%s", fault.text);
    measured("one whole solution", found.result.restitution, found.restitution,
             found.result_error - found.error + 1e-15);
    return found;
}

static bool count(void *context, double fraction)
{
    double *last = context;
    assert_true(fraction >= *last && fraction <= 1.0);
    *last = fraction;
    return fraction < 0.02;
}

static void progress_rises_and_may_end_it(void **unused)
{
    (void)unused;
    double last = 0.0;
    struct complete_convergence found;
    struct fault fault = {""};
    struct complete_problem problem = sphere_on_rod(0.015, 0.01, 205e6, 0.0, 0.3);
    struct watch watch = {count, &last};
    struct pace pace = {.watch = &watch};
    problem.pace = &pace;
    assert_int_equal(complete_converge(&problem, 0.01, &found, &fault), PERCUSS_TIMEOUT);
    problem.cells = 18;
    assert_int_equal(complete_converge(&problem, 0.01, &found, &fault), PERCUSS_BAD_REQUEST);
}

/* Means of three phases on meshes of 32 and 24 elements (docs/lab/complete-fe.md); what is open of
 * them is a tenth of their swing's width, 0.0003. */
static void finer_meshes_lie_within_the_error(void **unused)
{
    (void)unused;
    const struct {
        double sphere, rod, length, yield, tangent, speed, fine;
    } cases[] = {
        {0.008, 0.025, 0.3, 200e6, 0.73e9, 3.0, 0.4876},
        {0.012, 0.015, 0.6, 400e6, 14.6e9, 2.0, 0.6499},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct complete_problem problem = sphere_on_rod(
            cases[i].sphere, cases[i].rod, cases[i].yield, cases[i].tangent, cases[i].speed);
        problem.b.length = cases[i].length;
        struct complete_convergence found = found_for(&problem, 5e-3);
        measured("e", found.result.restitution, cases[i].fine, found.result_error + 0.0003);
        assert_true(found.result_error <= 5e-3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_limits_are_found),
        cmocka_unit_test(a_swing_is_never_less_than_its_share),
        cmocka_unit_test(finer_meshes_lie_within_the_error),
        cmocka_unit_test(progress_rises_and_may_end_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
