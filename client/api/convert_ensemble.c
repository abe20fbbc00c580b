/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <string.h>

#include "convert.h"
#include "error.h"
#include "percuss/fields.h"

static enum percuss_result convert_input(const struct percuss_input *from, size_t index,
                                         percuss_v1_EnsembleInput *to)
{
    if (!memchr(from->name, '\0', sizeof from->name) ||
        !memchr(from->body, '\0', sizeof from->body))
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "inputs[%zu]: name or body is not terminated; up to %d bytes are allowed",
                         index, PERCUSS_ID_SIZE - 1);
    if (from->value_count > 0 && !from->values)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "inputs[%zu].values: NULL: %zu numbers are needed", index,
                         from->value_count);
    *to = (percuss_v1_EnsembleInput){0};
    PERCUSS_INPUT_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
    /* writing only reads it */
    to->values._buffer = (double *)from->values;
    to->values._length = to->values._maximum = (uint32_t)from->value_count;
    return PERCUSS_RESULT_OK;
}

static void convert_correlation(const struct percuss_correlation *from,
                                percuss_v1_EnsembleCorrelation *to)
{
    PERCUSS_CORRELATION_FIELDS(PERCUSS_COPY)
}

static enum percuss_result check_counts(const struct percuss_ensemble_request *request)
{
    const struct {
        const char *field;
        size_t count, most;
    } counts[] = {
        {"inputs", request->input_count, PERCUSS_MAX_INPUTS},
        {"correlations", request->correlation_count, PERCUSS_MAX_CORRELATIONS},
        {"quantiles", request->quantile_count, PERCUSS_MAX_QUANTILES},
    };
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        if (counts[i].count > counts[i].most)
            return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                             "%s: %zu are too many; up to %zu are allowed", counts[i].field,
                             counts[i].count, counts[i].most);
    return PERCUSS_RESULT_OK;
}

enum percuss_result convert_ensemble_request(const struct percuss_ensemble_request *from,
                                             struct ensemble_storage *storage,
                                             percuss_v1_EnsembleRequest *to)
{
    *to = (percuss_v1_EnsembleRequest){0};
    PERCUSS_ENSEMBLE_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
    enum percuss_result result = check_counts(from);
    if (result == PERCUSS_RESULT_OK)
        result = convert_request(&from->scene, &storage->scene, &to->scene);
    for (size_t i = 0; result == PERCUSS_RESULT_OK && i < from->input_count; i++)
        result = convert_input(&from->inputs[i], i, &storage->inputs[i]);
    if (result != PERCUSS_RESULT_OK)
        return result;
    for (size_t i = 0; i < from->correlation_count; i++)
        convert_correlation(&from->correlations[i], &storage->correlations[i]);
    to->inputs._buffer = storage->inputs;
    to->inputs._length = to->inputs._maximum = (uint32_t)from->input_count;
    to->correlations._buffer = storage->correlations;
    to->correlations._length = to->correlations._maximum = (uint32_t)from->correlation_count;
    to->quantiles._buffer = (double *)from->quantiles;
    to->quantiles._length = to->quantiles._maximum = (uint32_t)from->quantile_count;
    return PERCUSS_RESULT_OK;
}
