/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "ensemble_output.h"
#include "plot_ensemble.h"

/* Columns of the listed samples behind the inputs. */
enum { RESTITUTION, SIGNIFICANT = 5, RESULTS = 7 };

/* The memory that a picture's arrays lie in. */
struct columns {
    double *speeds; /* and restitutions, and numbers of sub-impacts */
    struct input_share shares[PERCUSS_MAX_INPUTS];
    char texts[PERCUSS_MAX_INPUTS][2 * PERCUSS_ID_SIZE];
    double *lows; /* and highs of the intervals */
};

/* A fixed speed has no panel. */
static bool speed_column(const struct percuss_ensemble_request *request, size_t *column)
{
    for (size_t i = 0; i < request->input_count; i++) {
        *column = i;
        if (!strcmp(request->inputs[i].name, "speed"))
            return request->inputs[i].distribution != PERCUSS_DISTRIBUTION_CONSTANT;
    }
    return false;
}

/* One sample has no deviation. False: they did not arrive, or out of memory; complains. */
static bool take_samples(const struct percuss_ensemble_request *request,
                         const struct percuss_ensemble_reply *reply, struct columns *columns,
                         struct ensemble_picture *picture)
{
    size_t count = reply->samples, speed;
    if (count < 2 || !speed_column(request, &speed))
        return true;
    if (!reply->rows || reply->column_count != request->input_count + RESULTS) {
        complain("--plot: the samples did not arrive");
        return false;
    }
    double *speeds = malloc(3 * count * sizeof *speeds);
    if (!speeds) {
        complain("--plot: out of memory");
        return false;
    }
    /* from rows to columns */
    for (size_t i = 0; i < count; i++) {
        const double *row = reply->rows + i * reply->column_count;
        const double *results = row + request->input_count;
        speeds[i] = row[speed];
        speeds[count + i] = results[RESTITUTION];
        speeds[2 * count + i] = results[SIGNIFICANT];
    }
    columns->speeds = speeds;
    picture->sample_count = count;
    picture->speeds = speeds;
    picture->restitutions = speeds + count;
    picture->sub_impacts = speeds + 2 * count;
    return true;
}

/* A single input causes everything: no panel. */
static void take_sensitivities(const struct percuss_ensemble_reply *reply, struct columns *columns,
                               struct ensemble_picture *picture)
{
    size_t count = reply->sensitivity_count;
    if (count < 2 || count > PERCUSS_MAX_INPUTS)
        return;
    for (size_t i = 0; i < count; i++) {
        const struct percuss_sensitivity *s = &reply->sensitivities[i];
        snprintf(columns->texts[i], sizeof columns->texts[i], "%s%s%s", s->input,
                 s->body[0] ? "@" : "", s->body);
        columns->shares[i] = (struct input_share){
            .name = columns->texts[i],
            .first_order = {s->first_order, s->first_order_low, s->first_order_high},
            .total = {s->total, s->total_low, s->total_high},
        };
    }
    picture->input_count = count;
    picture->inputs = columns->shares;
}

static bool take_intervals(const struct percuss_ensemble_reply *reply, struct columns *columns,
                           struct ensemble_picture *picture)
{
    size_t count = reply->interval_count;
    columns->lows = malloc((2 * count + 1) * sizeof *columns->lows);
    if (!columns->lows) {
        complain("--plot: out of memory");
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        columns->lows[i] = reply->intervals[i].low;
        columns->lows[count + i] = reply->intervals[i].high;
    }
    picture->interval_count = isnan(picture->deviation) ? 0 : count;
    picture->intervals_low = columns->lows;
    picture->intervals_high = columns->lows + count;
    return true;
}

int ensemble_plot(const struct plot_output *output, const char *scene,
                  const struct percuss_ensemble_request *request,
                  const struct percuss_ensemble_reply *reply)
{
    const struct percuss_statistic *e = &reply->statistics[0];
    char title[600];
    struct columns columns = {0};
    struct ensemble_picture picture = {.title = title,
                                       .mean = e->mean,
                                       .deviation = e->standard_deviation,
                                       .bins = e->highest > e->lowest ? e->bin_count : 0,
                                       .edges = e->bin_edges,
                                       .counts = e->bin_counts,
                                       .quantile_count = e->quantile_count,
                                       .probabilities = e->probabilities,
                                       .quantiles = e->quantiles,
                                       .quantiles_low = e->quantiles_low,
                                       .quantiles_high = e->quantiles_high,
                                       .curve_count = e->curve_count,
                                       .curve_values = e->curve_values,
                                       .curve_shares = e->curve_shares};
    snprintf(title, sizeof title, "%s\n%llu samples", scene, (unsigned long long)reply->samples);
    /* a picture without the samples is better than none, but a failure */
    bool complete = take_samples(request, reply, &columns, &picture) &&
                    take_intervals(reply, &columns, &picture);
    take_sensitivities(reply, &columns, &picture);
    int code = plot_ensemble(output, &picture);
    free(columns.speeds);
    free(columns.lows);
    return complete ? code : EXIT_FAILURE;
}
