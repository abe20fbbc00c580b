/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/report_make.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ensemble/remarks.h"
#include "ensemble/verification.h"

static double value_of(const struct ensemble_sample *sample, int quantity)
{
    const double all[] = {sample->restitution, sample->impulse, sample->end_time,
                          sample->peak_force};
    return all[quantity];
}

static bool take_quantity(struct report_quantity *quantity, struct arena *arena)
{
    size_t n = quantity->quantile_count;
    quantity->quantiles = arena_take(arena, n, sizeof(double));
    quantity->quantiles_low = arena_take(arena, n, sizeof(double));
    quantity->quantiles_high = arena_take(arena, n, sizeof(double));
    quantity->edges = arena_take(arena, quantity->bins + 1, sizeof(double));
    quantity->counts = arena_take(arena, quantity->bins, sizeof(uint64_t));
    quantity->curve_values = arena_take(arena, REPORT_CURVE + 1, sizeof(double));
    quantity->curve_shares = arena_take(arena, REPORT_CURVE + 1, sizeof(double));
    return quantity->quantiles && quantity->quantiles_low && quantity->quantiles_high &&
           quantity->edges && quantity->counts && quantity->curve_values && quantity->curve_shares;
}

static void fill_curve(struct report_quantity *quantity, const double *sorted, size_t count)
{
    bool few = count <= REPORT_CURVE;
    quantity->curve_count = few ? count : REPORT_CURVE + 1;
    for (size_t i = 0; i < quantity->curve_count; i++) {
        double share = few ? (double)(i + 1) / (double)count : (double)i / REPORT_CURVE;
        quantity->curve_shares[i] = share;
        quantity->curve_values[i] = few ? sorted[i] : summary_quantile(sorted, count, share);
    }
}

static bool fill_quantity(struct ensemble_report *report, const struct ensemble *ensemble,
                          struct report_quantity *quantity, struct interval_sample *sample)
{
    /* what is told of it */
    report_probabilities(&ensemble->spec, &quantity->probabilities, &quantity->quantile_count);
    quantity->moments = summary_moments(sample->values, sample->count);
    quantity->bins = ensemble->spec.bins ? ensemble->spec.bins : summary_bins(sample->kept);
    if (!summary_varies(&quantity->moments))
        quantity->bins = 0; /* they would have no width */
    if (!take_quantity(quantity, &report->memory))
        return false;
    /* mean, deviation and quantiles with their intervals */
    quantity->mean = interval_mean(sample, &quantity->moments);
    quantity->deviation = interval_deviation(sample, &quantity->moments);
    for (size_t i = 0; i < quantity->quantile_count; i++) {
        double p = quantity->probabilities[i];
        struct interval interval = interval_quantile(sample, p);
        quantity->quantiles[i] = summary_quantile(sample->sorted, sample->kept, p);
        quantity->quantiles_low[i] = interval.low;
        quantity->quantiles_high[i] = interval.high;
    }
    /* and the distribution */
    summary_histogram(sample->sorted, sample->kept, quantity->bins, quantity->edges,
                      quantity->counts);
    fill_curve(quantity, sample->sorted, sample->kept);
    return true;
}

/* At rest and left alone, one contact separates two bodies with at most the energy they met with:
 * 0 <= e <= 1. Vibration, acceleration and other contacts may add to it or take from it. */
static struct shape_range possible_range(const struct ensemble_spec *spec)
{
    const struct solve_request *request = spec->request;
    bool alone = request->contact_count == 1 && request->contacts[0].gap_acceleration == 0.0;
    for (size_t b = 0; b < request->body_count; b++)
        alone = alone && !request->bodies[b].state;
    return alone ? (struct shape_range){0.0, 1.0} : (struct shape_range){-1.0, INFINITY};
}

static void fill_shape(struct ensemble_report *report, const struct ensemble *ensemble,
                       const double *sorted)
{
    static const double sigmas[REPORT_INTERVALS] = {0.5, 1.0, 1.5, 2.0};
    const struct moments *moments = &report->quantities[0].moments;
    report->range = possible_range(&ensemble->spec);
    for (int i = 0; i < REPORT_INTERVALS; i++)
        report->intervals[i] = shape_sigma_interval(sorted, moments, sigmas[i], &report->range);
    report->beta = shape_fit_beta(sorted, moments, &report->range);
}

static bool fill_quantities(struct ensemble_report *report, const struct ensemble *ensemble,
                            const struct ensemble_sample *samples)
{
    static const char *const names[] = {"restitution", "impulse", "end_time", "peak_force"};
    double *values = malloc((report->done + 1) * sizeof *values);
    double *sorted = malloc((report->done + 1) * sizeof *sorted);
    bool good = values && sorted;
    for (int q = 0; good && q < REPORT_QUANTITIES; q++) {
        /* its values, and sorted */
        for (uint64_t i = 0; i < report->done; i++)
            values[i] = value_of(&samples[i], q);
        struct interval_sample sample = {
            .values = values,
            .count = report->done,
            .replicates = ensemble->sampling.replicates,
            .sorted = sorted,
            .kept = summary_sort(values, report->done, sorted),
            .level = REPORT_LEVEL,
        };
        /* what follows from them */
        report->quantities[q].name = names[q];
        good = fill_quantity(report, ensemble, &report->quantities[q], &sample);
        if (good && q == 0)
            fill_shape(report, ensemble, sorted);
    }
    free(values);
    free(sorted);
    return good;
}

static bool fill_counts(struct ensemble_report *report, const struct ensemble_sample *samples)
{
    /* as long as the longest sequence */
    size_t most = 0;
    for (uint64_t i = 0; i < report->done; i++)
        if (ensemble_sample_has_result(&samples[i]) && samples[i].sub_impacts > most)
            most = samples[i].sub_impacts;
    report->count_length = most + 1;
    report->sub_impact_counts = arena_take(&report->memory, most + 1, sizeof(uint64_t));
    report->significant_counts = arena_take(&report->memory, most + 1, sizeof(uint64_t));
    if (!report->sub_impact_counts || !report->significant_counts)
        return false;
    /* how many samples have so many */
    for (uint64_t i = 0; i < report->done; i++) {
        report->refused += !ensemble_sample_has_result(&samples[i]);
        report->truncated += samples[i].status == PERCUSS_TRUNCATED;
        if (!ensemble_sample_has_result(&samples[i]))
            continue;
        report->sub_impact_counts[samples[i].sub_impacts]++;
        report->significant_counts[samples[i].significant]++;
    }
    return true;
}

static bool fill_input(struct report_input *out, struct influence_pair *pairs, size_t kept,
                       struct arena *arena)
{
    out->parts = arena_take(arena, REPORT_PARTS, sizeof *out->parts);
    if (!out->parts)
        return false;
    double range = kept ? pairs[kept - 1].x - pairs[0].x : 0.0;
    out->resolution = 0.01 * range;
    if (range > 0.0) {
        out->part_count = REPORT_PARTS;
        influence_parts(pairs, kept, out->resolution, out->parts, REPORT_PARTS);
    }
    return true;
}

/* Uncertain: drawn, or a list that differs from sample to sample. */
static bool is_uncertain(const struct ensemble_spec *spec, size_t input)
{
    const struct ensemble_input *one = &spec->inputs[input];
    return spec_is_drawn(spec, input) ||
           (one->distribution == DISTRIBUTION_IS_LIST && one->value_count > 1);
}

/* The extras with the input drawn anew, if there are any. False: out of memory. */
static bool find_indices(const struct report_material *material, const struct ensemble *ensemble,
                         struct report_input *out, struct indices_data *data)
{
    /* rows: the extras in which this input alone is another */
    uint64_t count = material->extras ? ensemble_extras(ensemble, material->done) : 0;
    struct indices_row *rows = malloc((count + 1) * sizeof *rows);
    if (!rows)
        return false;
    for (uint64_t k = 0; k < count; k++) {
        struct ensemble_extra_place place = ensemble_extra_place(ensemble, material->done, k);
        double values[ENSEMBLE_MAX_INPUTS];
        if (place.dimension == SIZE_MAX || ensemble->drawn[place.dimension] != out->input)
            continue;
        ensemble_extra_inputs(ensemble, &place, values);
        rows[data->row_count++] =
            (struct indices_row){place.sample, values[out->input], material->extras[k].restitution};
    }
    /* the indices from them */
    data->rows = rows;
    bool good = indices_find(data, &out->indices);
    free(rows);
    return good;
}

/* What the inputs are of one sample after the other, and their answers. */
struct columns {
    double *x, *y;
    struct influence_pair *pairs;
};

static bool take_columns(struct columns *columns, size_t count)
{
    columns->x = malloc((count + 1) * sizeof *columns->x);
    columns->y = malloc((count + 1) * sizeof *columns->y);
    columns->pairs = malloc((count + 1) * sizeof *columns->pairs);
    return columns->x && columns->y && columns->pairs;
}

static void release_columns(struct columns *columns)
{
    free(columns->x);
    free(columns->y);
    free(columns->pairs);
}

static bool fill_inputs(struct ensemble_report *report, const struct ensemble *ensemble,
                        const struct report_material *material)
{
    /* room for all inputs, and for the columns of one */
    const struct ensemble_spec *spec = &ensemble->spec;
    size_t n = report->done;
    struct columns columns;
    report->inputs = arena_take(&report->memory, spec->input_count, sizeof *report->inputs);
    bool good = take_columns(&columns, n) && report->inputs;
    /* where nothing varies there is nothing to explain */
    bool varies = summary_varies(&report->quantities[0].moments);
    for (size_t i = 0; good && i < spec->input_count; i++) {
        if (!is_uncertain(spec, i))
            continue;
        struct report_input *out = &report->inputs[report->input_count++];
        /* its values beside the restitutions */
        for (size_t k = 0; k < n; k++) {
            double values[ENSEMBLE_MAX_INPUTS];
            ensemble_inputs(ensemble, k, values);
            columns.x[k] = values[i];
            columns.y[k] = varies ? material->samples[k].restitution : NAN;
            columns.pairs[k] = (struct influence_pair){columns.x[k], columns.y[k]};
        }
        /* how the restitution depends on them */
        out->input = i;
        out->values = summary_moments(columns.x, n);
        struct indices_data data = {.count = n,
                                    .x = columns.x,
                                    .y = columns.y,
                                    .replicates = ensemble->sampling.replicates,
                                    .level = REPORT_LEVEL};
        good = find_indices(material, ensemble, out, &data) &&
               fill_input(out, columns.pairs, influence_sort(columns.pairs, n), &report->memory);
    }
    release_columns(&columns);
    return good;
}

bool report_create(struct ensemble_report *report, const struct ensemble *ensemble,
                   const struct report_material *material, const struct watch *watch)
{
    const struct ensemble_sample *samples = material->samples;
    memset(report, 0, sizeof *report);
    report->done = material->done;
    bool good = fill_counts(report, samples) && fill_quantities(report, ensemble, samples) &&
                fill_inputs(report, ensemble, material) &&
                (!material->extras || verification_fill(report, ensemble, material));
    return good && remarks_fill(report, ensemble, samples, watch);
}
