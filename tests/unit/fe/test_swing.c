/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/swing.c: known swings. */
#include "check.h"
#include "fe/swing.h"

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

static void a_swing_has_a_mean(void **unused)
{
    (void)unused;
    struct swing three = known_swing(3);
    struct swing six = known_swing(6);
    measured("three", three.mean, 0.5, 1e-15);
    measured("six", six.mean, 0.5, 1e-15);
    assert_true(six.jitter < three.jitter && six.jitter > 0.0);
}

static void a_swing_says_where_it_passes(void **unused)
{
    (void)unused;
    struct swing swing = known_swing(6);
    struct swing_bracket bracket;
    const double wanted[] = {0.49, 0.5, 0.505, 0.515};
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        double phase = swing_phase(&swing, wanted[i], &bracket);
        assert_true(phase > bracket.phase[0] && phase < bracket.phase[1]);
        assert_true(bracket.off[0] * bracket.off[1] < 0.0);
        measured("end", wanted[i] + bracket.off[0], swing_at(bracket.phase[0]), 1e-15);
        measured("passes", swing_at(phase), wanted[i], 1e-9);
    }
    assert_true(isnan(swing_phase(&swing, 0.6, &bracket)));
    assert_true(isnan(swing_phase(&swing, 0.4, &bracket)));
}

static double weighed(const struct swing *swing, double wanted)
{
    double weights[SWING_PHASES];
    double sum = 0.0;
    double mean = 0.0;
    swing_weigh(swing, wanted, weights);
    for (unsigned k = 0; k < swing->phases; k++) {
        assert_true(weights[k] >= 0.0);
        sum += weights[k];
        mean += weights[k] * swing->restitution[k];
    }
    measured("sum", sum, 1.0, 1e-15);
    return mean;
}

static void weights_have_the_wanted_mean(void **unused)
{
    (void)unused;
    struct swing swing = known_swing(6);
    measured("mean", weighed(&swing, 0.5), 0.5, 1e-15);
    measured("above", weighed(&swing, 0.504), 0.504, 1e-15);
    measured("below", weighed(&swing, 0.497), 0.497, 1e-15);
    /* too far: on that side, no farther than the phases */
    double far = weighed(&swing, 0.6);
    assert_true(far > 0.505 && far < 0.5 + 0.5 * 1.1 * swing.width);
    /* no swing: even ones */
    struct swing still = {.phases = 3, .restitution = {0.5, 0.5, 0.5}};
    swing_judge(&still);
    measured("still", weighed(&still, 0.6), 0.5, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_swing_has_a_mean),
        cmocka_unit_test(a_swing_says_where_it_passes),
        cmocka_unit_test(weights_have_the_wanted_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
