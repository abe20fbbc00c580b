/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdlib.h>

#include "convert.h"
#include "convert_members.h"
#include "error.h"

/* A copy without its undefined values; an element that is absent. */
#define UNDEFINER(element, fields)                                                                 \
    static void undefine_##element(struct percuss_##element *to)                                   \
    {                                                                                              \
        fields(PERCUSS_UNDEFINED)                                                                  \
    }
UNDEFINER(beta_fit, PERCUSS_BETA_FIT_FIELDS)
UNDEFINER(ensemble_check, PERCUSS_ENSEMBLE_CHECK_FIELDS)

CONVERTER(input_part, InputPart, PERCUSS_INPUT_PART_FIELDS)
CONVERTER(sigma_interval, SigmaInterval, PERCUSS_SIGMA_INTERVAL_FIELDS)
CONVERTER(beta_fit, BetaFit, PERCUSS_BETA_FIT_FIELDS)
CONVERTER(timing, Timing, PERCUSS_TIMING_FIELDS)

static size_t least(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

/* Lists that belong together are as long as the shortest, for any server. */
static void convert_statistic(const percuss_v1_Statistic *from, struct storage *storage,
                              struct percuss_statistic *to)
{
    PERCUSS_STATISTIC_FIELDS(PERCUSS_COPY, CONVERT)
    to->quantile_count = least(least(from->probabilities._length, from->quantiles._length),
                               least(from->quantiles_low._length, from->quantiles_high._length));
    to->bin_count =
        from->bin_edges._length ? least(from->bin_counts._length, from->bin_edges._length - 1) : 0;
    to->curve_count = least(from->curve_values._length, from->curve_shares._length);
}

/* A server that does not know intervals leaves them 0, which no upper bound is. */
static void convert_sensitivity(const percuss_v1_Sensitivity *from, struct storage *storage,
                                struct percuss_sensitivity *to)
{
    PERCUSS_SENSITIVITY_FIELDS(PERCUSS_COPY, CONVERT)
    if (from->first_order_high == 0.0)
        to->first_order_low = to->first_order_high = to->total_low = to->total_high = NAN;
}

static void convert_ensemble_check(const percuss_v1_EnsembleCheck *from, struct storage *storage,
                                   struct percuss_ensemble_check *to)
{
    (void)storage;
    PERCUSS_ENSEMBLE_CHECK_FIELDS(PERCUSS_COPY)
    if (from->within_high == 0.0)
        to->within_low = to->within_high = NAN;
}

enum percuss_result convert_ensemble_reply(const percuss_v1_EnsembleReply *from,
                                           struct percuss_ensemble_reply *to)
{
    struct storage all = {0}, *storage = &all;
    *to = (struct percuss_ensemble_reply){0};
    PERCUSS_HEAD_FIELDS(PERCUSS_COPY)
    PERCUSS_ENSEMBLE_REPLY_FIELDS(PERCUSS_COPY, CONVERT)
    to->count_length = least(from->sub_impact_counts._length, from->significant_counts._length);
    to->storage = all.blocks;
    if (!all.failed)
        return PERCUSS_RESULT_OK;
    percuss_ensemble_reply_free(to);
    return error_set(PERCUSS_RESULT_NO_MEMORY, "the reply of an ensemble");
}

void percuss_ensemble_reply_free(struct percuss_ensemble_reply *reply)
{
    if (!reply)
        return;
    storage_free(reply->storage);
    free(reply->rows);
    *reply = (struct percuss_ensemble_reply){0};
}
