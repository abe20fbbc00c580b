/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <string.h>

#include "convert.h"
#include "error.h"

static enum percuss_result convert_input(const struct percuss_input *input, size_t index,
                                         percuss_v1_EnsembleInput *wire)
{
    if (strnlen(input->name, sizeof input->name) == sizeof input->name ||
        strnlen(input->body, sizeof input->body) == sizeof input->body)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "inputs[%zu]: name or body is not terminated; up to %d bytes are allowed",
                         index, PERCUSS_ID_SIZE - 1);
    *wire = (percuss_v1_EnsembleInput){
        .distribution = input->distribution,
        .first = input->first,
        .second = input->second,
        .lower = input->lower,
        .upper = input->upper,
    };
    strcpy(wire->name, input->name);
    strcpy(wire->body, input->body);
    // writing only reads it
    wire->values._buffer = (double *)input->values;
    wire->values._length = wire->values._maximum = (uint32_t)input->value_count;
    return PERCUSS_RESULT_OK;
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
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; ++i)
        if (counts[i].count > counts[i].most)
            return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                             "%s: %zu are too many; up to %zu are allowed", counts[i].field,
                             counts[i].count, counts[i].most);
    return PERCUSS_RESULT_OK;
}

enum percuss_result convert_ensemble_request(const struct percuss_ensemble_request *request,
                                             struct ensemble_storage *storage,
                                             percuss_v1_EnsembleRequest *wire)
{
    *wire = (percuss_v1_EnsembleRequest){
        .sampling = request->sampling,
        .samples = request->samples,
        .seed = request->seed,
        .half_width = request->half_width,
        .quantile_half_width = request->quantile_half_width,
        .bins = request->bins,
        .contact = request->contact,
        .list_samples = request->list_samples,
    };
    enum percuss_result result = check_counts(request);
    if (result == PERCUSS_RESULT_OK)
        result = convert_request(&request->scene, &storage->scene, &wire->scene);
    for (size_t i = 0; result == PERCUSS_RESULT_OK && i < request->input_count; ++i)
        result = convert_input(&request->inputs[i], i, &storage->inputs[i]);
    if (result != PERCUSS_RESULT_OK)
        return result;
    for (size_t i = 0; i < request->correlation_count; ++i)
        storage->correlations[i] = (percuss_v1_EnsembleCorrelation){
            .first = request->correlations[i].first,
            .second = request->correlations[i].second,
            .coefficient = request->correlations[i].coefficient,
        };
    wire->inputs._buffer = storage->inputs;
    wire->inputs._length = wire->inputs._maximum = (uint32_t)request->input_count;
    wire->correlations._buffer = storage->correlations;
    wire->correlations._length = wire->correlations._maximum = (uint32_t)request->correlation_count;
    wire->quantiles._buffer = (double *)request->quantiles;
    wire->quantiles._length = wire->quantiles._maximum = (uint32_t)request->quantile_count;
    return PERCUSS_RESULT_OK;
}
