/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "error.h"

#define COPY_TEXT(target, source)                                                                  \
    do {                                                                                           \
        _Static_assert(sizeof(target) >= sizeof(source), "room for the wire's text");              \
        memcpy(target, source, sizeof(source));                                                    \
    } while (0)

/* All arrays of a reply, one after the other. */
struct kept {
    struct kept *next;
    max_align_t memory[];
};

/* Zeroed memory that goes with the reply; never NULL unless memory runs out, which is noted. */
static void *keep(struct percuss_ensemble_reply *reply, size_t count, size_t size, bool *good)
{
    struct kept *kept = calloc(1, sizeof *kept + count * size);
    if (!kept) {
        *good = false;
        return NULL;
    }
    kept->next = reply->storage;
    reply->storage = kept;
    return kept->memory;
}

void percuss_ensemble_reply_free(struct percuss_ensemble_reply *reply)
{
    for (struct kept *kept = reply->storage; kept;) {
        struct kept *next = kept->next;
        free(kept);
        kept = next;
    }
    free(reply->rows);
    *reply = (struct percuss_ensemble_reply){0};
}

static double *keep_numbers(struct percuss_ensemble_reply *reply, const dds_sequence_double *from,
                            bool *good)
{
    double *numbers = keep(reply, from->_length, sizeof *numbers, good);
    if (numbers && from->_length)
        memcpy(numbers, from->_buffer, from->_length * sizeof *numbers);
    return numbers;
}

static uint64_t *keep_counts(struct percuss_ensemble_reply *reply,
                             const dds_sequence_unsigned_long_long *from, bool *good)
{
    uint64_t *counts = keep(reply, from->_length, sizeof *counts, good);
    if (counts && from->_length)
        memcpy(counts, from->_buffer, from->_length * sizeof *counts);
    return counts;
}

static size_t least(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static void convert_statistic(struct percuss_ensemble_reply *reply,
                              const percuss_v1_Statistic *wire, struct percuss_statistic *to,
                              bool *good)
{
    COPY_TEXT(to->quantity, wire->quantity);
    to->count = wire->count;
    to->mean = wire->mean;
    to->mean_low = wire->mean_low;
    to->mean_high = wire->mean_high;
    to->standard_deviation = wire->standard_deviation;
    to->standard_deviation_low = wire->standard_deviation_low;
    to->standard_deviation_high = wire->standard_deviation_high;
    to->skewness = wire->skewness;
    to->lowest = wire->lowest;
    to->highest = wire->highest;
    /* lists that belong together are as long as the shortest, whatever a server sends */
    to->quantile_count = least(least(wire->probabilities._length, wire->quantiles._length),
                               least(wire->quantiles_low._length, wire->quantiles_high._length));
    to->probabilities = keep_numbers(reply, &wire->probabilities, good);
    to->quantiles = keep_numbers(reply, &wire->quantiles, good);
    to->quantiles_low = keep_numbers(reply, &wire->quantiles_low, good);
    to->quantiles_high = keep_numbers(reply, &wire->quantiles_high, good);
    to->bin_count =
        wire->bin_edges._length ? least(wire->bin_counts._length, wire->bin_edges._length - 1) : 0;
    to->bin_edges = keep_numbers(reply, &wire->bin_edges, good);
    to->bin_counts = keep_counts(reply, &wire->bin_counts, good);
    to->curve_count = least(wire->curve_values._length, wire->curve_shares._length);
    to->curve_values = keep_numbers(reply, &wire->curve_values, good);
    to->curve_shares = keep_numbers(reply, &wire->curve_shares, good);
}

static void convert_sensitivity(struct percuss_ensemble_reply *reply,
                                const percuss_v1_Sensitivity *wire, struct percuss_sensitivity *to,
                                bool *good)
{
    COPY_TEXT(to->input, wire->input);
    COPY_TEXT(to->body, wire->body);
    to->first_order = wire->first_order;
    to->noise = wire->noise;
    to->total = wire->total;
    /* a server that does not know them leaves them 0, which no upper bound is */
    bool bounded = wire->first_order_high != 0.0;
    to->first_order_low = bounded ? wire->first_order_low : NAN;
    to->first_order_high = bounded ? wire->first_order_high : NAN;
    to->total_low = bounded ? wire->total_low : NAN;
    to->total_high = bounded ? wire->total_high : NAN;
    to->mean = wire->mean;
    to->standard_deviation = wire->standard_deviation;
    to->lowest = wire->lowest;
    to->highest = wire->highest;
    to->resolution = wire->resolution;
    to->parts = keep(reply, wire->parts._length, sizeof *to->parts, good);
    to->part_count = to->parts ? wire->parts._length : 0;
    for (size_t k = 0; k < to->part_count; ++k) {
        const percuss_v1_InputPart *part = &wire->parts._buffer[k];
        to->parts[k] = (struct percuss_input_part){
            .low = part->low,
            .high = part->high,
            .count = part->count,
            .mean = part->mean,
            .standard_deviation = part->standard_deviation,
            .local = part->local,
            .chaotic = part->chaotic,
        };
    }
}

static void convert_intervals(struct percuss_ensemble_reply *reply,
                              const percuss_v1_EnsembleReply *wire, bool *good)
{
    reply->intervals = keep(reply, wire->intervals._length, sizeof *reply->intervals, good);
    reply->interval_count = reply->intervals ? wire->intervals._length : 0;
    for (size_t i = 0; i < reply->interval_count; ++i) {
        const percuss_v1_SigmaInterval *from = &wire->intervals._buffer[i];
        reply->intervals[i] = (struct percuss_sigma_interval){
            .sigmas = from->sigmas,
            .low = from->low,
            .high = from->high,
            .covered = from->covered,
            .unphysical = from->unphysical,
            .quantile_low = from->quantile_low,
            .quantile_high = from->quantile_high,
        };
    }
}

static void convert_warnings(struct percuss_ensemble_reply *reply,
                             const percuss_v1_EnsembleReply *wire, bool *good)
{
    reply->warnings = keep(reply, wire->warnings._length, sizeof *reply->warnings, good);
    for (uint32_t i = 0; *good && i < wire->warnings._length; ++i) {
        const char *text = wire->warnings._buffer[i];
        reply->warnings[i] = keep(reply, strlen(text) + 1, 1, good);
        if (*good)
            strcpy(reply->warnings[i], text);
    }
    reply->warning_count = *good ? wire->warnings._length : 0;
}

static void convert_fit_and_check(const percuss_v1_EnsembleReply *wire,
                                  struct percuss_ensemble_reply *reply)
{
    reply->beta.low = reply->beta.high = reply->beta.alpha = reply->beta.beta = NAN;
    reply->beta.distance = reply->beta.p_value = NAN;
    reply->check.within = reply->check.largest = reply->check.mean_shift = NAN;
    reply->check.mean_shift_half_width = reply->check.standard_deviation_shift = NAN;
    reply->check.quantile_shift = reply->check.within_low = reply->check.within_high = NAN;
    if (wire->beta._length > 0) {
        const percuss_v1_BetaFit *beta = &wire->beta._buffer[0];
        reply->beta.low = beta->low;
        reply->beta.high = beta->high;
        reply->beta.alpha = beta->alpha;
        reply->beta.beta = beta->beta;
        reply->beta.distance = beta->distance;
        reply->beta.p_value = beta->p_value;
    }
    if (wire->check._length > 0) {
        const percuss_v1_EnsembleCheck *check = &wire->check._buffer[0];
        reply->check.count = check->count;
        reply->check.within = check->within;
        reply->check.largest = check->largest;
        reply->check.mean_shift = check->mean_shift;
        reply->check.mean_shift_half_width = check->mean_shift_half_width;
        reply->check.standard_deviation_shift = check->standard_deviation_shift;
        reply->check.quantile_shift = check->quantile_shift;
        /* a server that does not know them leaves them 0, which no upper bound is */
        bool bounded = check->within_high != 0.0;
        reply->check.within_low = bounded ? check->within_low : NAN;
        reply->check.within_high = bounded ? check->within_high : NAN;
        reply->check.unmet = check->unmet;
    }
}

static void convert_numbers(const percuss_v1_EnsembleReply *wire,
                            struct percuss_ensemble_reply *reply)
{
    memcpy(reply->client, wire->client, sizeof reply->client);
    memcpy(reply->server, wire->server, sizeof reply->server);
    reply->sequence = wire->sequence;
    COPY_TEXT(reply->catalogue_revision, wire->catalogue_revision);
    COPY_TEXT(reply->version, wire->version);
    reply->status = wire->status;
    COPY_TEXT(reply->message, wire->message);
    reply->complete = wire->complete;
    reply->samples = wire->samples;
    reply->requested = wire->requested;
    reply->refused = wire->refused;
    reply->truncated = wire->truncated;
    reply->possible_low = wire->possible_low;
    reply->possible_high = wire->possible_high;
    reply->cut = wire->cut;
    reply->step_accuracy = wire->step_accuracy;
    reply->pilots = wire->pilots;
    reply->agreeing = wire->agreeing;
    reply->timing.queue = wire->timing.queue;
    reply->timing.solve = wire->timing.solve;
}

enum percuss_result convert_ensemble_reply(const percuss_v1_EnsembleReply *wire,
                                           struct percuss_ensemble_reply *reply)
{
    bool good = true;
    *reply = (struct percuss_ensemble_reply){0};
    convert_numbers(wire, reply);
    convert_fit_and_check(wire, reply);
    reply->statistics = keep(reply, wire->statistics._length, sizeof *reply->statistics, &good);
    for (uint32_t i = 0; good && i < wire->statistics._length; ++i)
        convert_statistic(reply, &wire->statistics._buffer[i], &reply->statistics[i], &good);
    reply->statistic_count = good ? wire->statistics._length : 0;
    reply->sensitivities =
        keep(reply, wire->sensitivities._length, sizeof *reply->sensitivities, &good);
    for (uint32_t i = 0; good && i < wire->sensitivities._length; ++i)
        convert_sensitivity(reply, &wire->sensitivities._buffer[i], &reply->sensitivities[i],
                            &good);
    reply->sensitivity_count = good ? wire->sensitivities._length : 0;
    reply->count_length = least(wire->sub_impact_counts._length, wire->significant_counts._length);
    reply->sub_impact_counts = keep_counts(reply, &wire->sub_impact_counts, &good);
    reply->significant_counts = keep_counts(reply, &wire->significant_counts, &good);
    convert_intervals(reply, wire, &good);
    convert_warnings(reply, wire, &good);
    if (good)
        return PERCUSS_RESULT_OK;
    percuss_ensemble_reply_free(reply);
    return PERCUSS_RESULT_NO_MEMORY;
}
