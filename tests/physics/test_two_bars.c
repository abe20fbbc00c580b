/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Two elastic bars of one section meet end to end (St. Venant): as the contact stiffens the shorter
 * one stops dead, e tends to L1/L2 and the contact lasts 2 L1/c. */
#include "physics/support.h"
#include "unit/impact/toy_scene.h"

/* Bars with c = Z = 1; bar 0 of length 1 strikes bar 1 at unit speed. Bar b has `modes` times its
 * length modes, so that both end at one frequency. */
static void build(struct toy *toy, const double lengths[2], double stiffness, size_t modes)
{
    toy_init(toy, 1);
    toy->w[0] = 0.0;
    for (int b = 0; b < 2; b++) {
        size_t count = (size_t)((double)modes * lengths[b]);
        double *omega = calloc(count, sizeof *omega);
        double *shape = calloc(count, sizeof *shape);
        assert_true(omega && shape);
        toy->residual[0] += lengths[b] / 3.0;
        toy->w[0] += 1.0 / lengths[b];
        for (size_t k = count; k-- > 0;) {
            omega[k] = (double)(k + 1) * M_PI / lengths[b];
            shape[k] = sqrt(2.0 / lengths[b]);
            toy->residual[0] -= shape[k] * shape[k] / (omega[k] * omega[k]);
        }
        toy_add(toy, (size_t)b, count, omega, 0.0, shape);
        free(omega);
        free(shape);
    }
    toy->gap_rate[0] = -1.0;
    toy->laws[0] = contact_law_linear(stiffness);
}

/* By waves: the ends part at 1 - 2 F + (what comes back), so that with a contact spring k
 *   F = (1 - exp(-2 k t))/2 until the shorter bar's end answers at t = 2 (= 2 L1/c), then
 *   F = (F(2) + k (t - 2)) exp(-2 k (t - 2)) until t = 4.
 * Impulse until t. The edges last some 1/(2 k): in the limit the force is Z v/2 during 2 L1/c. */
static double wave_impulse(double k, double t)
{
    double first = fmin(t, 2.0);
    double sum = 0.5 * (first + expm1(-2.0 * k * first) / (2.0 * k));
    if (t > 2.0) {
        double start = -0.5 * expm1(-4.0 * k);
        double x = 2.0 * k * (t - 2.0);
        sum += -start * expm1(-x) / (2.0 * k) + (1.0 - (1.0 + x) * exp(-x)) / (4.0 * k);
    }
    return sum;
}

static struct impact_outcome meet(struct toy *toy, double k, size_t modes, double horizon)
{
    static const double lengths[2] = {1.0, 2.0};
    build(toy, lengths, k, modes);
    return toy_run(toy, 1e-8, horizon);
}

/* e = W P - 1 with W = 1/L1 + 1/L2 = 3/2 and P = 1 + 1/(4 k): 1/2 + 3/(8 k). */
static void the_shorter_bar_stops(void **state)
{
    (void)state;
    struct toy toy;
    for (double k = 10.0; k < 200.0; k *= 4.0) {
        struct impact_outcome outcome = meet(&toy, k, 400, 100.0);
        double e = outcome.tracks[0].impulse * toy.w[0] - 1.0;
        /* what 400 modes a length miss of edges of 1/(2 k) grows like k^2: 1.4e-9 k^2 measured, and
         * see truncation_converges */
        measured("e", e, 0.5 + 0.375 / k, 3e-9 * k * k);
        assert_int_equal(outcome.end_reason, PERCUSS_END_SEPARATED);
        /* accuracy 1e-8 in time */
        measured("closure", outcome.energy.closure / outcome.energy.available, 0.0, 1e-7);
        toy_free(&toy);
    }
}

/* The force has a tail that never ends by itself, so that a duration is one of the force: what has
 * passed by 2 L1/c, and 8/k later. */
static void the_force_lasts_for_a_round_trip(void **state)
{
    (void)state;
    struct toy toy;
    for (double k = 10.0; k < 200.0; k *= 4.0) {
        double horizons[2] = {2.0, 2.0 + 8.0 / k};
        for (int i = 0; i < 2; i++) {
            struct impact_outcome outcome = meet(&toy, k, 200, horizons[i]);
            /* truncation as above, with half the modes; the cut falls into a force of 1/2 that
             * Gibbs' waves disturb */
            measured("impulse", outcome.tracks[0].impulse, wave_impulse(k, outcome.window),
                     i ? 3e-8 * k * k : 1e-6 * k);
            assert_true(outcome.end_reason == PERCUSS_END_IN_CONTACT ||
                        outcome.end_reason == PERCUSS_END_HORIZON);
            /* the last step ends at most a shortest step before the horizon */
            measured("window", outcome.window, horizons[i], 1e-3);
            toy_free(&toy);
        }
        measured("share by 2 L1/c", wave_impulse(k, 2.0) / wave_impulse(k, 4.0), 1.0, 0.5 / k);
    }
}

static void truncation_converges(void **state)
{
    (void)state;
    double worse = INFINITY;
    for (size_t modes = 50; modes <= 400; modes *= 2) {
        struct toy toy;
        struct impact_outcome outcome = meet(&toy, 40.0, modes, 100.0);
        double e = outcome.tracks[0].impulse * toy.w[0] - 1.0;
        double error = fabs(e - 0.5 - 0.375 / 40.0);
        if (getenv("PERCUSS_MEASURE"))
            print_message("    %zu modes a length: error %.2e\n", modes, error);
        /* each doubling gains close to a factor of 8 */
        assert_true(error < 0.25 * worse);
        worse = error;
        toy_free(&toy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_shorter_bar_stops),
        cmocka_unit_test(the_force_lasts_for_a_round_trip),
        cmocka_unit_test(truncation_converges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
