/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/report.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/sorting.h"

static const double REPORT_LEVEL = 0.95; /* of all intervals */

static const double default_quantiles[] = {0.025, 0.05, 0.25, 0.5, 0.75, 0.95, 0.975};

/* Probabilities of the quantiles: those asked for, or the default ones. */
static void report_probabilities(const struct ensemble_spec *spec, const double **probabilities,
                                 size_t *count)
{
    bool given = spec->quantile_count > 0;
    *probabilities = given ? spec->quantiles : default_quantiles;
    *count = given ? spec->quantile_count : sizeof default_quantiles / sizeof *default_quantiles;
}

void report_release(struct ensemble_report *report)
{
    arena_release(&report->memory);
}

/* Largest half-width of the quantiles' intervals; infinite where one is not known. */
static double widest_quantile(const struct ensemble *ensemble, const struct interval_sample *sample)
{
    const double *probabilities;
    size_t count;
    double widest = 0.0;
    report_probabilities(&ensemble->spec, &probabilities, &count);
    for (size_t i = 0; i < count; i++) {
        struct interval interval = interval_quantile(sample, probabilities[i]);
        double half = 0.5 * (interval.high - interval.low);
        widest = fmax(widest, isnan(half) ? INFINITY : half);
    }
    return widest;
}

struct report_progress report_progress(const struct ensemble *ensemble,
                                       const struct ensemble_sample *samples, uint64_t done,
                                       bool quantiles)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    struct report_progress progress = {NAN, NAN, NAN, NAN, false};
    double *values = malloc(2 * (done + 1) * sizeof *values);
    if (!values)
        return progress;
    /* the mean so far */
    for (uint64_t i = 0; i < done; i++)
        values[i] = samples[i].restitution;
    double *sorted = values + done;
    struct interval_sample sample = {values, done, ensemble->sampling.replicates,
                                     sorted, 0,    REPORT_LEVEL};
    struct moments moments = summary_moments(values, done);
    progress.mean = moments.mean;
    progress.deviation = moments.deviation;
    progress.half_width = interval_mean(&sample, &moments).high - moments.mean;
    /* and whether the bounds asked for are met */
    bool mean_enough = spec->half_width == 0.0 || progress.half_width <= spec->half_width;
    if (quantiles && mean_enough && spec->quantile_half_width > 0.0) {
        bool sorts = summary_sort(values, done, sorted, &sample.kept);
        progress.quantile_half_width = sorts ? widest_quantile(ensemble, &sample) : NAN;
    }
    progress.enough = mean_enough && (spec->quantile_half_width == 0.0 ||
                                      progress.quantile_half_width <= spec->quantile_half_width);
    free(values);
    return progress;
}

/* Accuracy of the one model for all samples. */

/* Largest difference of the quantiles of two samples of equal size, which are sorted here. False:
 * out of memory. */
static bool quantile_shift(const struct ensemble_spec *spec, double *a, double *b, size_t count,
                           double *shift)
{
    const double *probabilities;
    size_t quantiles;
    *shift = 0.0;
    report_probabilities(spec, &probabilities, &quantiles);
    if (!sorting_ascend(a, NULL, count) || !sorting_ascend(b, NULL, count))
        return false;
    for (size_t i = 0; i < quantiles; i++)
        *shift = fmax(*shift, fabs(summary_quantile(a, count, probabilities[i]) -
                                   summary_quantile(b, count, probabilities[i])));
    return true;
}

/* Restitutions of the same samples by both ways, and their differences. */
struct comparison {
    double *fast, *searched, *difference;
};

/* Of the tangential impulses, in the unit of the restitution. */
static double tangential_difference(const struct ensemble_sample *sample,
                                    const struct ensemble_extra *extra)
{
    double change = hypot(sample->tangential[0] - extra->tangential[0],
                          sample->tangential[1] - extra->tangential[1]);
    return sample->compression > 0.0 ? change / sample->compression : 0.0;
}

static void compare(struct report_verification *out, const struct ensemble *ensemble,
                    const struct report_material *material, struct comparison *comparison)
{
    double tolerance = ensemble->model.tolerance;
    uint64_t count = ensemble_extras(ensemble, material->done);
    size_t within = 0;
    /* both answers of every sample that was solved again */
    for (uint64_t k = 0; k < count; k++) {
        struct ensemble_extra_place place = ensemble_extra_place(ensemble, material->done, k);
        const struct ensemble_sample *sample = &material->samples[place.sample];
        double fast = sample->restitution;
        double shift = fast - material->extras[k].restitution;
        if (place.dimension != SIZE_MAX)
            break; /* the others are not of this kind */
        if (!isfinite(shift))
            continue;
        comparison->fast[out->count] = fast;
        comparison->searched[out->count] = material->extras[k].restitution;
        comparison->difference[out->count++] = shift;
        double apart = fmax(fabs(shift), tangential_difference(sample, &material->extras[k]));
        within += apart <= tolerance;
        out->unmet += !(material->extras[k].error <= tolerance);
        out->largest = fmax(out->largest, apart);
    }
    /* the share that agrees */
    out->within = (double)within / (double)out->count;
    out->within_bounds = interval_share(within, out->count, REPORT_LEVEL);
}

/* Fills report->verification from the samples that were solved again by the accuracy search.
 * False: out of memory. */
static bool verification_fill(struct ensemble_report *report, const struct ensemble *ensemble,
                              const struct report_material *material)
{
    /* both answers side by side */
    struct report_verification *out = &report->verification;
    uint64_t count = ensemble_extras(ensemble, report->done);
    double *memory = calloc(3 * count + 1, sizeof *memory);
    if (!memory)
        return false;
    struct comparison comparison = {memory, memory + count, memory + 2 * count};
    compare(out, ensemble, material, &comparison);
    /* shift of the mean and the deviation by the fast model */
    struct moments moments = summary_moments(comparison.difference, out->count);
    struct interval_sample sample = {comparison.difference, out->count, 1, NULL, out->count,
                                     REPORT_LEVEL};
    out->mean_shift = moments.mean;
    out->mean_shift_half_width = interval_mean(&sample, &moments).high - moments.mean;
    out->deviation_shift = summary_moments(comparison.fast, out->count).deviation -
                           summary_moments(comparison.searched, out->count).deviation;
    /* and to the quantiles, last as these sort the values */
    bool good = quantile_shift(&ensemble->spec, comparison.fast, comparison.searched, out->count,
                               &out->quantile_shift);
    free(memory);
    return good;
}

/* The warnings of an ensemble: the warnings of single impacts, counted, and its own. */

/* More of a distribution than this outside its truncation is warned of. */
static const double TRUNCATED_SHARE = 0.01;

/* A larger share of samples that differ from the accuracy search by more than the tolerance, or one
 * that differs by so many times of it, is warned of. */
static const double OUTSIDE_SHARE = 0.05, OUTSIDE_FACTOR = 10.0;

__attribute__((format(printf, 2, 3))) static void warn(struct ensemble_report *report,
                                                       const char *format, ...)
{
    if (report->warning_count == REPORT_WARNINGS)
        return;
    va_list args;
    va_start(args, format);
    vsnprintf(report->warnings[report->warning_count++], sizeof *report->warnings, format, args);
    va_end(args);
}

/* Samples with one kind of warning. */
struct occurrence {
    uint64_t count, first;
};

static void note(struct occurrence *occurrence, uint64_t index)
{
    if (occurrence->count++ == 0)
        occurrence->first = index;
}

/* A sample that is solved again for the text of its warnings. */
struct witness {
    const struct ensemble *ensemble;
    const struct watch *watch;      /* NULL: none */
    struct ensemble_worker *worker; /* NULL: none was called yet */
    uint64_t index;
    struct ensemble_sample sample;
    struct fault fault;
};

/* False: out of memory. */
static bool call(struct witness *witness, uint64_t index)
{
    if (witness->worker && witness->index == index)
        return true;
    if (!witness->worker &&
        ensemble_worker_create(&witness->worker, witness->ensemble, witness->watch, NULL))
        return false;
    witness->index = index;
    ensemble_solve(witness->worker, index, &witness->sample, &witness->fault);
    return true;
}

/* Text of a kind of warning, or with WARNING_KINDS of the refusal. */
static const char *words_of(const struct witness *witness, enum warning_kind kind)
{
    /* the worker then still holds another sample */
    if (witness->sample.status == PERCUSS_TIMEOUT)
        return "(no time was left to say why)";
    const char *text = kind == WARNING_KINDS
                           ? witness->fault.text
                           : warnings_text(ensemble_warnings(witness->worker), kind);
    return text ? text : "";
}

/* Quotes the warning of the first of them. */
static void quote(struct ensemble_report *report, const struct witness *witness,
                  const struct occurrence *occurrence, enum warning_kind kind)
{
    bool refusal = kind == WARNING_KINDS;
    warn(report, "samples: %llu of %llu%s, first %llu: %s", (unsigned long long)occurrence->count,
         (unsigned long long)report->done, refusal ? " were refused and are left out" : "",
         (unsigned long long)occurrence->first, words_of(witness, kind));
}

/* Every kind of warning once, and the refusals. False: out of memory. */
static bool warn_samples(struct ensemble_report *report, struct witness *witness,
                         const struct ensemble_sample *samples)
{
    /* count of each, and its first sample */
    struct occurrence found[WARNING_KINDS + 1] = {0};
    for (uint64_t i = 0; i < report->done; i++) {
        if (!ensemble_sample_has_result(&samples[i]))
            note(&found[WARNING_KINDS], i);
        for (unsigned kinds = samples[i].warnings; kinds; kinds &= kinds - 1)
            note(&found[__builtin_ctz(kinds)], i);
    }
    /* quoted from that sample, solved again */
    bool good = true;
    for (int kind = 0; good && kind <= WARNING_KINDS; kind++) {
        if (found[kind].count == 0)
            continue;
        good = call(witness, found[kind].first);
        if (good)
            quote(report, witness, &found[kind], (enum warning_kind)kind);
    }
    return good;
}

static bool is_of_table(unsigned model)
{
    return contact_law_asked(model)->tables == CONTACT_TABLES_ONLY;
}

/* A table and the closed form differ by some 0.01: not to be taken for a spread of the inputs. */
static void warn_models(struct ensemble_report *report, const struct ensemble *ensemble,
                        const struct ensemble_sample *samples)
{
    uint64_t closed = 0;
    bool tables = is_of_table(ensemble->stated_model);
    for (uint64_t i = 0; i < report->done; i++) {
        if (!ensemble_sample_has_result(&samples[i]))
            continue;
        bool tabulated = is_of_table(samples[i].contact_model);
        tables = tables || tabulated;
        closed += contact_law_asked(samples[i].contact_model)->curve && !tabulated;
    }
    if (tables && closed)
        warn(report,
             "samples: %llu of %llu follow the closed form, for want of a table for their "
             "materials or so deep, others (or the impact as it is stated) a table: the two differ "
             "by some 0.01 in the restitution (contact_model closed-form takes one for all)",
             (unsigned long long)closed, (unsigned long long)report->done);
}

static void warn_numbers(struct ensemble_report *report, const struct ensemble *ensemble)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    if (report->truncated)
        warn(report,
             "samples: %llu of %llu reached the horizon or the effort allowed before they "
             "were over",
             (unsigned long long)report->truncated, (unsigned long long)report->done);
    for (size_t i = 0; i < spec->input_count; i++) {
        double share = input_truncated(&spec->inputs[i]);
        if (share > TRUNCATED_SHARE)
            warn(report,
                 "inputs[%zu]: %s: %.2g of its distribution lies outside what is possible or "
                 "allowed and is cut off",
                 i, input_quantity_name(spec->inputs[i].quantity), share);
    }
}

/* Warns by the samples that were solved again. */
static void warn_verification(struct ensemble_report *report, const struct ensemble *ensemble)
{
    const struct report_verification *verification = &report->verification;
    double tolerance = ensemble->model.tolerance;
    if (verification->count == 0)
        return;
    /* samples that differ */
    double outside = 1.0 - verification->within;
    if (outside > OUTSIDE_SHARE || verification->largest > OUTSIDE_FACTOR * tolerance)
        warn(report,
             "verification: %.2g %% of %zu samples solved again by the accuracy search differ by "
             "more than the tolerance of %g, by up to %.2g: so do as many of all samples, %.2g to "
             "%.2g %% (the mean is off by %.1g, a quantile by up to %.1g)",
             100.0 * outside, verification->count, tolerance, verification->largest,
             100.0 * (1.0 - verification->within_bounds.high),
             100.0 * (1.0 - verification->within_bounds.low), fabs(verification->mean_shift),
             verification->quantile_shift);
    /* searches that miss the tolerance themselves */
    if ((double)verification->unmet > OUTSIDE_SHARE * (double)verification->count)
        warn(report,
             "verification: %zu of %zu samples: the accuracy search itself does not reach the "
             "tolerance of %g, by its own estimate",
             verification->unmet, verification->count, tolerance);
    /* a mean that is off */
    if (fabs(verification->mean_shift) > tolerance)
        warn(report,
             "verification: the mean is off by %.2g: more than the tolerance: ask for a "
             "finer one",
             verification->mean_shift);
}

/* Fills report->warnings, when all else is filled, from samples 0 .. report->done - 1 in their
 * order: the same for any number of workers. Quoted samples are solved again: where the watch
 * (NULL: none) stops that, the words are left out. False: out of memory. */
static bool remarks_fill(struct ensemble_report *report, const struct ensemble *ensemble,
                         const struct ensemble_sample *samples, const struct watch *watch)
{
    struct witness witness = {.ensemble = ensemble, .watch = watch};
    bool good = warn_samples(report, &witness, samples);
    ensemble_worker_free(witness.worker);
    if (!good)
        return false;
    warn_models(report, ensemble, samples);
    warn_numbers(report, ensemble);
    warn_verification(report, ensemble);
    return true;
}

static const char *const names[REPORT_QUANTITIES] = {"restitution",
                                                     "impulse",
                                                     "end_time",
                                                     "peak_force",
                                                     "impulse_tangential_1",
                                                     "impulse_tangential_2",
                                                     "tangential_restitution",
                                                     "restitution_kinematic"};

static double value_of(const struct ensemble_sample *sample, int quantity)
{
    const double all[REPORT_QUANTITIES] = {sample->restitution,
                                           sample->impulse,
                                           sample->end_time,
                                           sample->peak_force,
                                           sample->tangential[0],
                                           sample->tangential[1],
                                           sample->tangential_restitution,
                                           sample->restitution_kinematic};
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
    /* probabilities, moments and bins */
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
    double *values = malloc((report->done + 1) * sizeof *values);
    double *sorted = malloc((report->done + 1) * sizeof *sorted);
    bool good = values && sorted;
    report->quantity_count = ensemble->has_friction ? REPORT_QUANTITIES : REPORT_WITHOUT_FRICTION;
    for (size_t q = 0; good && q < report->quantity_count; q++) {
        /* its values, and sorted */
        for (uint64_t i = 0; i < report->done; i++)
            values[i] = value_of(&samples[i], (int)q);
        struct interval_sample sample = {
            .values = values,
            .count = report->done,
            .replicates = ensemble->sampling.replicates,
            .sorted = sorted,
            .level = REPORT_LEVEL,
        };
        /* its statistics */
        report->quantities[q].name = names[q];
        good = summary_sort(values, report->done, sorted, &sample.kept) &&
               fill_quantity(report, ensemble, &report->quantities[q], &sample);
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
    /* samples by number of sub-impacts */
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

static bool fill_input(struct report_input *out, const struct indices_point *sorted, size_t kept,
                       struct arena *arena)
{
    out->parts = arena_take(arena, REPORT_PARTS, sizeof *out->parts);
    if (!out->parts)
        return false;
    double range = kept ? sorted[kept - 1].x - sorted[0].x : 0.0;
    out->resolution = 0.01 * range;
    if (range > 0.0) {
        out->part_count = REPORT_PARTS;
        influence_parts(sorted, kept, out->resolution, out->parts, REPORT_PARTS);
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
                         enum report_of quantity, struct report_input *out,
                         struct indices_data *data)
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
        const struct ensemble_extra *extra = &material->extras[k];
        double y = quantity == REPORT_RESTITUTION ? extra->restitution
                                                  : extra->tangential[quantity - REPORT_TANGENTIAL];
        rows[data->row_count++] = (struct indices_row){place.sample, values[out->input], y};
    }
    /* the indices from them */
    data->rows = rows;
    bool good = indices_find(data, &out->indices);
    free(rows);
    return good;
}

/* Values of an input by sample, and the answers. */
struct columns {
    double *x, *y;
    struct indices_point *sorted;
};

static bool take_columns(struct columns *columns, size_t count)
{
    columns->x = malloc((count + 1) * sizeof *columns->x);
    columns->y = malloc((count + 1) * sizeof *columns->y);
    columns->sorted = malloc((count + 1) * sizeof *columns->sorted);
    return columns->x && columns->y && columns->sorted;
}

static void release_columns(struct columns *columns)
{
    free(columns->x);
    free(columns->y);
    free(columns->sorted);
}

/* One input's influence on a quantity. */
static bool fill_influence(struct ensemble_report *report, const struct ensemble *ensemble,
                           const struct report_material *material, enum report_of quantity,
                           struct columns *columns, struct report_input *out)
{
    /* its values beside those of the quantity; no indices of a constant */
    size_t n = report->done;
    bool varies = summary_varies(&report->quantities[quantity].moments);
    for (size_t k = 0; k < n; k++) {
        columns->x[k] = ensemble_input(ensemble, k, out->input);
        columns->y[k] = varies ? value_of(&material->samples[k], quantity) : NAN;
    }
    /* how the quantity depends on them */
    out->quantity = names[quantity];
    out->values = summary_moments(columns->x, n);
    struct indices_data data = {.count = n,
                                .sorted = columns->sorted,
                                .replicates = ensemble->sampling.replicates,
                                .level = REPORT_LEVEL};
    return indices_sort(columns->x, columns->y, n, columns->sorted, &data.kept) &&
           find_indices(material, ensemble, quantity, out, &data) &&
           fill_input(out, columns->sorted, data.kept, &report->memory);
}

static bool fill_inputs(struct ensemble_report *report, const struct ensemble *ensemble,
                        const struct report_material *material)
{
    /* room for all inputs, and for the columns of one */
    const struct ensemble_spec *spec = &ensemble->spec;
    struct columns columns;
    report->inputs = arena_take(&report->memory, spec->input_count, sizeof *report->inputs);
    report->tangential =
        arena_take(&report->memory, 2 * spec->input_count, sizeof *report->tangential);
    bool good = take_columns(&columns, report->done) && report->inputs && report->tangential;
    for (size_t i = 0; good && i < spec->input_count; i++) {
        if (!is_uncertain(spec, i))
            continue;
        struct report_input *out = &report->inputs[report->input_count++];
        out->input = i;
        good = fill_influence(report, ensemble, material, REPORT_RESTITUTION, &columns, out);
    }
    /* the same of the tangential impulses */
    for (int q = REPORT_TANGENTIAL; q <= REPORT_TANGENTIAL_SECOND; q++) {
        bool varies =
            (size_t)q < report->quantity_count && summary_varies(&report->quantities[q].moments);
        for (size_t i = 0; good && varies && i < spec->input_count; i++) {
            if (!is_uncertain(spec, i))
                continue;
            struct report_input *out = &report->tangential[report->tangential_count++];
            out->input = i;
            good = fill_influence(report, ensemble, material, (enum report_of)q, &columns, out);
        }
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
