/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/plot_ensemble.c and plot.c: gnuplot draws every panel, and each alone. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "plot_ensemble.h"

enum { SAMPLES = 12000, BINS = 10, QUANTILES = 5 };

static double edges[BINS + 1], speeds[SAMPLES], restitutions[SAMPLES], sub_impacts[SAMPLES];
static uint64_t counts[BINS];
static const double probabilities[QUANTILES] = {0.05, 0.25, 0.5, 0.75, 0.95};
static const double quantiles[QUANTILES] = {0.1, 0.25, 0.4, 0.6, 0.72};
static const double low[QUANTILES] = {NAN, 0.22, 0.37, 0.58, 0.7};
static const double high[QUANTILES] = {0.12, 0.28, 0.43, 0.62, 0.74};
static const double below[] = {0.34, 0.24}, above[] = {0.54, 0.64};
/* the second from a server that tells no intervals, and without a total index */
static const struct input_share inputs[] = {
    {"speed", {0.3, 0.25, 0.34}, {0.9, 0.8, 1.0}},
    {"young of 'al-beam'", {0.05, NAN, NAN}, {NAN, NAN, NAN}},
};

static struct ensemble_picture whole(void)
{
    for (int i = 0; i <= BINS; i++)
        edges[i] = 0.08 * i;
    for (int i = 0; i < BINS; i++)
        counts[i] = (uint64_t)(10 + i * (BINS - i));
    for (int i = 0; i < SAMPLES; i++) {
        speeds[i] = 0.1 + 0.3 * i / SAMPLES;
        restitutions[i] = 0.4 + 0.3 * sin(60.0 * speeds[i]);
        sub_impacts[i] = 1 + i % 5;
    }
    return (struct ensemble_picture){.title = "steel-sphere on al-beam",
                                     .mean = 0.44,
                                     .deviation = 0.21,
                                     .bins = BINS,
                                     .edges = edges,
                                     .counts = counts,
                                     .quantile_count = QUANTILES,
                                     .probabilities = probabilities,
                                     .quantiles = quantiles,
                                     .quantiles_low = low,
                                     .quantiles_high = high,
                                     .curve_count = QUANTILES,
                                     .curve_values = quantiles,
                                     .curve_shares = probabilities,
                                     .sample_count = SAMPLES,
                                     .speeds = speeds,
                                     .restitutions = restitutions,
                                     .sub_impacts = sub_impacts,
                                     .interval_count = 2,
                                     .intervals_low = below,
                                     .intervals_high = above,
                                     .input_count = 2,
                                     .inputs = inputs};
}

static long drawn(const struct ensemble_picture *picture)
{
    char file[] = "/tmp/percuss-plot-XXXXXX.png";
    int descriptor = mkstemps(file, 4);
    assert_true(descriptor >= 0);
    close(descriptor);
    assert_int_equal(plot_ensemble(&(struct plot_output){file, NULL}, picture), 0);
    unsigned char head[8] = {0};
    FILE *in = fopen(file, "rb");
    assert_non_null(in);
    assert_int_equal(fread(head, 1, 8, in), 8);
    assert_memory_equal(head, "\x89PNG\r\n\x1a\n", 8);
    fseek(in, 0, SEEK_END);
    long size = ftell(in);
    fclose(in);
    const char *keep = getenv("PERCUSS_KEEP_PLOT");
    if (keep)
        rename(file, keep);
    else
        unlink(file);
    return size;
}

static void draws_all_panels(void **state)
{
    (void)state;
    struct ensemble_picture picture = whole();
    assert_true(drawn(&picture) > 20000);
}

static void draws_each_panel_alone(void **state)
{
    (void)state;
    for (int panel = 0; panel < 4; panel++) {
        struct ensemble_picture picture = whole();
        picture.bins = panel == 0 ? picture.bins : 0;
        picture.quantile_count = panel == 1 ? picture.quantile_count : 0;
        picture.sample_count = panel == 2 ? picture.sample_count : 0;
        picture.input_count = panel == 3 ? picture.input_count : 0;
        assert_true(drawn(&picture) > 4000);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws_each_panel_alone),
        cmocka_unit_test(draws_all_panels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
