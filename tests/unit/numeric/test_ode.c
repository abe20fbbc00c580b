/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/numeric/ode.c: CVODE behind four verbs, on problems with closed solutions. */
#include "check.h"
#include "numeric/ode.h"

static void oscillator(double t, const double *y, double *rate, void *context)
{
    (void)t;
    double omega = *(const double *)context;
    rate[0] = y[1];
    rate[1] = -omega * omega * y[0];
}

static void crossings(double t, const double *y, double *roots, void *context)
{
    (void)t;
    (void)context;
    roots[0] = y[0];
    roots[1] = y[1];
}

static const double absolute[2] = {1e-11, 1e-11};

static struct ode *make(double *omega, size_t roots, bool stiff)
{
    struct ode *ode = ode_create(&(struct ode_problem){
        .size = 2,
        .root_count = roots,
        .rhs = oscillator,
        .roots = crossings,
        .context = omega,
        .relative = 1e-11,
        .absolute = absolute,
        .stiff = stiff,
    });
    assert_non_null(ode);
    return ode;
}

static void follows_an_oscillator(void **state)
{
    (void)state;
    double omega = 3.0;
    for (int stiff = 0; stiff < 2; stiff++) {
        struct ode *ode = make(&omega, 0, stiff != 0);
        double y[2] = {1.0, 0.0};
        double t = 0.5;
        enum ode_event event;
        assert_true(ode_set(ode, t, y));
        do {
            event = ode_step(ode, 2.5, &t, y, NULL);
            assert_true(event == ODE_STEP || event == ODE_REACHED);
            assert_true(t <= 2.5);
        } while (event != ODE_REACHED);
        near(t, 2.5, 0.0);
        /* local tolerance 1e-11, some hundred steps (BDF: a few thousand) */
        near(y[0], cos(6.0), 1e-8);
        near(y[1], -3.0 * sin(6.0), 1e-8);
        unsigned long rhs;
        unsigned long steps;
        ode_effort(ode, &rhs, &steps);
        assert_true(steps > 20 && rhs >= steps);
        ode_free(ode);
    }
}

static void reports_roots_with_direction(void **state)
{
    (void)state;
    double omega = 1.0;
    struct ode *ode = make(&omega, 2, false);
    double y[2] = {0.5, 1.0};
    double t = 0.0;
    int found[2];
    int count = 0;
    double phase = atan2(0.5, 1.0); /* y = A sin(t + phase) */
    assert_true(ode_set(ode, t, y));
    for (enum ode_event event = ODE_STEP; event != ODE_REACHED;) {
        event = ode_step(ode, 9.0, &t, y, found);
        assert_true(event != ODE_FAILED);
        if (event != ODE_ROOT)
            continue;
        /* y' crosses at pi/2, y at pi, ... in turn, falling first */
        double expected = (count + 1) * 0.5 * M_PI - phase;
        near(t, expected, 1e-8);
        int which = count % 2 == 0 ? 1 : 0;
        assert_int_equal(found[which], count % 4 < 2 ? -1 : 1);
        assert_int_equal(found[1 - which], 0);
        count++;
    }
    assert_int_equal(count, (int)((9.0 + phase) / (0.5 * M_PI)));
    ode_free(ode);
}

static void restarts_and_limits_its_step(void **state)
{
    (void)state;
    double omega = 1.0;
    struct ode *ode = make(&omega, 0, false);
    double y[2] = {1.0, 0.0};
    double t = 0.0;
    unsigned long rhs;
    unsigned long before;
    unsigned long after;
    assert_true(ode_set(ode, 0.0, y) && ode_set_longest_step(ode, 1e-3));
    while (ode_step(ode, 1.0, &t, y, NULL) == ODE_STEP)
        continue;
    near(t, 1.0, 0.0);
    ode_effort(ode, &rhs, &before);
    assert_true(before >= 1000);
    /* from another state, backward in name only: a new start */
    y[0] = 0.0;
    y[1] = 1.0;
    assert_true(ode_set(ode, 5.0, y));
    while (ode_step(ode, 6.0, &t, y, NULL) == ODE_STEP)
        continue;
    near(y[0], sin(1.0), 1e-9);
    ode_effort(ode, &rhs, &after);
    assert_true(after >= before + 1000); /* counts since creation */
    ode_free(ode);
    ode_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(follows_an_oscillator),
        cmocka_unit_test(reports_roots_with_direction),
        cmocka_unit_test(restarts_and_limits_its_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
