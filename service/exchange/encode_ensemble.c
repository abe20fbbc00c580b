/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/encode_ensemble.h"

#include <math.h>
#include <string.h>

#include "exchange/encode.h"
#include "percuss/fields.h"

/* Copies `count` elements into the answer and makes them the sequence. */
#define COPY_LIST(answer, sequence, from, count)                                                   \
    do {                                                                                           \
        (sequence)._length = (sequence)._maximum = (uint32_t)(count);                              \
        (sequence)._buffer = answer_take(answer, count, sizeof *(sequence)._buffer);               \
        if ((count) > 0)                                                                           \
            memcpy((sequence)._buffer, from, (count) * sizeof *(sequence)._buffer);                \
    } while (0)

/* Room of an empty list's elements, to be filled one by one. */
#define TAKE_LIST(answer, sequence, count)                                                         \
    do {                                                                                           \
        (sequence)._length = (sequence)._maximum = (uint32_t)(count);                              \
        (sequence)._buffer = answer_take(answer, count, sizeof *(sequence)._buffer);               \
    } while (0)

static size_t statistic_room(const struct report_quantity *quantity)
{
    return 4 * answer_room(quantity->quantile_count, sizeof(double)) +
           answer_room(quantity->bins + 1, sizeof(double)) +
           answer_room(quantity->bins, sizeof(uint64_t)) +
           2 * answer_room(quantity->curve_count, sizeof(double));
}

static size_t all_room(const struct ensemble_report *report)
{
    size_t room = answer_room(1, sizeof(percuss_v1_EnsembleReply)) +
                  answer_room(report->quantity_count, sizeof(percuss_v1_Statistic)) +
                  2 * answer_room(report->count_length, sizeof(uint64_t)) +
                  answer_room(report->input_count, sizeof(percuss_v1_Sensitivity)) +
                  answer_room(report->tangential_count, sizeof(percuss_v1_Sensitivity)) +
                  answer_room(REPORT_INTERVALS, sizeof(percuss_v1_SigmaInterval)) +
                  answer_room(1, sizeof(percuss_v1_BetaFit)) +
                  answer_room(1, sizeof(percuss_v1_EnsembleCheck)) +
                  answer_room(report->warning_count, sizeof(char *)) +
                  report->warning_count * answer_room(1, sizeof report->warnings[0]);
    for (size_t q = 0; q < report->quantity_count; q++)
        room += statistic_room(&report->quantities[q]);
    for (size_t i = 0; i < report->input_count; i++)
        room += answer_room(report->inputs[i].part_count, sizeof(percuss_v1_InputPart));
    for (size_t i = 0; i < report->tangential_count; i++)
        room += answer_room(report->tangential[i].part_count, sizeof(percuss_v1_InputPart));
    return room;
}

static void fill_statistic(struct answer *answer, const struct report_quantity *from,
                           percuss_v1_Statistic *to)
{
    size_t n = from->quantile_count;
    COPY_TEXT(to->quantity, from->name);
    /* moments and extremes */
    to->mean = from->moments.mean;
    to->mean_low = from->mean.low;
    to->mean_high = from->mean.high;
    to->standard_deviation = from->moments.deviation;
    to->standard_deviation_low = from->deviation.low;
    to->standard_deviation_high = from->deviation.high;
    to->skewness = from->moments.skewness;
    to->count = from->moments.count;
    to->lowest = from->moments.lowest;
    to->highest = from->moments.highest;
    /* quantiles, histogram, distribution function */
    COPY_LIST(answer, to->probabilities, from->probabilities, n);
    COPY_LIST(answer, to->quantiles, from->quantiles, n);
    COPY_LIST(answer, to->quantiles_low, from->quantiles_low, n);
    COPY_LIST(answer, to->quantiles_high, from->quantiles_high, n);
    COPY_LIST(answer, to->bin_edges, from->edges, from->bins + 1);
    COPY_LIST(answer, to->bin_counts, from->counts, from->bins);
    COPY_LIST(answer, to->curve_values, from->curve_values, from->curve_count);
    COPY_LIST(answer, to->curve_shares, from->curve_shares, from->curve_count);
}

static void fill_sensitivity(struct answer *answer, const struct ensemble_spec *spec,
                             const struct report_input *from, percuss_v1_Sensitivity *to)
{
    const struct ensemble_input *input = &spec->inputs[from->input];
    /* which input, of which body */
    COPY_TEXT(to->input, input_quantity_name(input->quantity));
    COPY_TEXT(to->quantity, from->quantity);
    if (input_is_of_body(input->quantity))
        COPY_TEXT(to->body, spec->request->bodies[input->body].id);
    /* Sobol indices with their intervals */
    to->first_order = from->indices.first_order;
    to->first_order_low = from->indices.first_bounds.low;
    to->first_order_high = from->indices.first_bounds.high;
    to->noise = from->indices.noise;
    to->total = from->indices.total;
    to->total_low = from->indices.total_bounds.low;
    to->total_high = from->indices.total_bounds.high;
    /* the values that were drawn of it */
    to->mean = from->values.mean;
    to->standard_deviation = from->values.deviation;
    to->lowest = from->values.lowest;
    to->highest = from->values.highest;
    to->resolution = from->resolution;
    /* part by part of its range: how much the result still varies there */
    TAKE_LIST(answer, to->parts, from->part_count);
    for (size_t k = 0; k < from->part_count; k++) {
        const struct influence_part *part = &from->parts[k];
        to->parts._buffer[k] = (percuss_v1_InputPart){
            .low = part->low,
            .high = part->high,
            .count = part->count,
            .mean = part->mean,
            .standard_deviation = part->deviation,
            .local = part->local,
            .chaotic = part->chaotic,
        };
    }
}

static void fill_interval(const struct sigma_interval *from, percuss_v1_SigmaInterval *to)
{
    PERCUSS_SIGMA_INTERVAL_FIELDS(PERCUSS_COPY)
}

static void fill_beta(const struct beta_fit *from, percuss_v1_BetaFit *to)
{
    PERCUSS_BETA_FIT_FIELDS(PERCUSS_COPY)
}

static void fill_shape(struct answer *answer, const struct ensemble_report *report)
{
    percuss_v1_EnsembleReply *reply = answer->report;
    reply->possible_low = report->range.low;
    reply->possible_high = report->range.high;
    TAKE_LIST(answer, reply->intervals, REPORT_INTERVALS);
    for (int i = 0; i < REPORT_INTERVALS; i++)
        fill_interval(&report->intervals[i], &reply->intervals._buffer[i]);
    TAKE_LIST(answer, reply->beta, 1);
    fill_beta(&report->beta, reply->beta._buffer);
}

static void fill_model(struct answer *answer, const struct ensemble *ensemble,
                       const struct report_verification *check)
{
    percuss_v1_EnsembleReply *reply = answer->report;
    /* how far the samples agree with the full accuracy search */
    TAKE_LIST(answer, reply->check, 1);
    reply->check._buffer[0] = (percuss_v1_EnsembleCheck){
        .count = check->count,
        .within = check->within,
        .largest = check->largest,
        .mean_shift = check->mean_shift,
        .mean_shift_half_width = check->mean_shift_half_width,
        .standard_deviation_shift = check->deviation_shift,
        .quantile_shift = check->quantile_shift,
        .within_low = check->within_bounds.low,
        .within_high = check->within_bounds.high,
        .unmet = check->unmet,
    };
    /* the model that the pilots chose for all samples */
    reply->cut = ensemble->model.model.cut / (2.0 * M_PI);
    reply->step_accuracy = ensemble->model.model.accuracy;
    reply->pilots = ensemble->model.pilots;
    reply->agreeing = ensemble->model.agreeing;
}

static void fill_lists(struct answer *answer, const struct ensemble *ensemble,
                       const struct ensemble_report *report)
{
    percuss_v1_EnsembleReply *reply = answer->report;
    TAKE_LIST(answer, reply->statistics, report->quantity_count);
    for (size_t q = 0; q < report->quantity_count; q++)
        fill_statistic(answer, &report->quantities[q], &reply->statistics._buffer[q]);
    COPY_LIST(answer, reply->sub_impact_counts, report->sub_impact_counts, report->count_length);
    COPY_LIST(answer, reply->significant_counts, report->significant_counts, report->count_length);
    TAKE_LIST(answer, reply->sensitivities, report->input_count);
    for (size_t i = 0; i < report->input_count; i++)
        fill_sensitivity(answer, &ensemble->spec, &report->inputs[i],
                         &reply->sensitivities._buffer[i]);
    TAKE_LIST(answer, reply->tangential_sensitivities, report->tangential_count);
    for (size_t i = 0; i < report->tangential_count; i++)
        fill_sensitivity(answer, &ensemble->spec, &report->tangential[i],
                         &reply->tangential_sensitivities._buffer[i]);
    TAKE_LIST(answer, reply->warnings, report->warning_count);
    for (size_t i = 0; i < report->warning_count; i++) {
        reply->warnings._buffer[i] = answer_take(answer, 1, sizeof report->warnings[0]);
        strcpy(reply->warnings._buffer[i], report->warnings[i]);
    }
}

struct answer *encode_ensemble(const struct envelope *envelope, const struct ensemble *ensemble,
                               const struct ensemble_report *report,
                               const struct ensemble_ending *ending)
{
    struct answer *answer = answer_create(EXCHANGE_ENSEMBLE, all_room(report));
    if (!answer)
        return NULL;
    answer->report = answer_take(answer, 1, sizeof *answer->report);
    percuss_v1_EnsembleReply *reply = answer->report;
    ENCODE_HEAD(reply, envelope, ending->status, ending->message);
    /* how far it came */
    reply->complete = ending->status == PERCUSS_OK;
    reply->samples = report->done;
    reply->requested = ensemble->count;
    reply->refused = report->refused;
    reply->truncated = report->truncated;
    /* the results of the samples, and their check */
    fill_lists(answer, ensemble, report);
    fill_shape(answer, report);
    fill_model(answer, ensemble, &report->verification);
    return answer;
}

enum { RESULT_COLUMNS = 7, TANGENTIAL_COLUMNS = 4 };

/* Results of a sample; clients that do not know of friction get what they expect. */
static size_t result_columns(const struct ensemble *ensemble)
{
    bool tangential = ensemble->has_friction && ensemble->spec.list_tangential;
    return RESULT_COLUMNS + (tangential ? TANGENTIAL_COLUMNS : 0);
}

size_t encode_sample_columns(const struct ensemble *ensemble)
{
    return ensemble->spec.input_count + result_columns(ensemble);
}

void encode_sample(const struct ensemble *ensemble, uint64_t index,
                   const struct ensemble_sample *sample, double *row)
{
    size_t inputs = ensemble->spec.input_count;
    ensemble_inputs(ensemble, index, row);
    const double results[RESULT_COLUMNS + TANGENTIAL_COLUMNS] = {
        sample->restitution,
        sample->impulse,
        sample->end_time,
        sample->peak_force,
        sample->sub_impacts,
        sample->significant,
        sample->status,
        sample->tangential[0],
        sample->tangential[1],
        sample->tangential_restitution,
        sample->restitution_kinematic,
    };
    memcpy(row + inputs, results, result_columns(ensemble) * sizeof *row);
}
