/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/spec.h"

#include <math.h>
#include <string.h>

bool spec_is_drawn(const struct ensemble_spec *spec, size_t input)
{
    const struct ensemble_input *one = &spec->inputs[input];
    switch (one->distribution) {
    case DISTRIBUTION_IS_CONSTANT:
        return false;
    case DISTRIBUTION_IS_UNIFORM:
        return one->second > one->first;
    case DISTRIBUTION_IS_LIST:
        return spec->samples > 0 && one->value_count > 1;
    default:
        return one->second > 0.0;
    }
}

static bool changes_body(const struct ensemble_input *input)
{
    return input_is_of_body(input->quantity) && input->quantity != INPUT_SITE;
}

bool spec_changes_bodies(const struct ensemble_spec *spec)
{
    bool changes = false;
    for (size_t i = 0; i < spec->input_count; i++)
        changes = changes || changes_body(&spec->inputs[i]);
    return changes;
}

bool spec_changes_scene(const struct ensemble_spec *spec)
{
    bool changes = spec_changes_bodies(spec);
    for (size_t i = 0; i < spec->input_count; i++)
        changes = changes || spec->inputs[i].quantity == INPUT_SITE;
    return changes;
}

/* Without a number of samples the lists say how many: all of them the same. */
static enum percuss_status check_lists(const struct ensemble_spec *spec, struct fault *fault)
{
    size_t count = 0;
    for (size_t i = 0; i < spec->input_count; i++) {
        const struct ensemble_input *input = &spec->inputs[i];
        if (input->distribution != DISTRIBUTION_IS_LIST)
            continue;
        if (count > 0 && input->value_count != count)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "inputs[%zu].values: %zu given: must be %zu as in the list before "
                             "(samples: 0: their values are taken side by side)",
                             i, input->value_count, count);
        count = input->value_count;
    }
    if (count == 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "samples: 0: must be 1 to %d (0 goes with inputs that are lists)",
                         ENSEMBLE_MAX_SAMPLES);
    if (spec->sampling != SAMPLING_IS_PLAIN)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "sampling: %s: must be plain with samples: 0 (lists taken in order)",
                         sampling_name(spec->sampling));
    return PERCUSS_OK;
}

static enum percuss_status check_numbers(const struct ensemble_spec *spec, struct fault *fault)
{
    if (spec->samples > ENSEMBLE_MAX_SAMPLES)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "samples: %llu: must be at most %d",
                         (unsigned long long)spec->samples, ENSEMBLE_MAX_SAMPLES);
    if (!(spec->half_width >= 0.0 && isfinite(spec->half_width)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "half_width: %g: must be >= 0 and finite",
                         spec->half_width);
    if (!(spec->quantile_half_width >= 0.0 && isfinite(spec->quantile_half_width)))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "quantile_half_width: %g: must be >= 0 and finite",
                         spec->quantile_half_width);
    for (size_t i = 0; i < spec->quantile_count; i++) {
        if (!(spec->quantiles[i] > 0.0 && spec->quantiles[i] < 1.0))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "quantiles[%zu]: %g: must be a probability between 0 and 1", i,
                             spec->quantiles[i]);
    }
    if (spec->quantile_count > ENSEMBLE_MAX_QUANTILES)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "quantiles: %zu given: must be at most %d",
                         spec->quantile_count, ENSEMBLE_MAX_QUANTILES);
    if (spec->bins > ENSEMBLE_MAX_BINS)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "bins: %zu: must be at most %d", spec->bins,
                         ENSEMBLE_MAX_BINS);
    if (spec->contact >= spec->request->contact_count)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "contact: %zu: must be an index into contacts, 0 to %zu", spec->contact,
                         spec->request->contact_count - 1);
    return PERCUSS_OK;
}

/* The same number cannot be replaced twice. */
static bool clash(const struct ensemble_spec *spec, size_t i, size_t j)
{
    const struct ensemble_input *a = &spec->inputs[i], *b = &spec->inputs[j];
    const struct solve_body *bodies = spec->request->bodies;
    return a->quantity == b->quantity &&
           (!input_is_of_body(a->quantity) || strcmp(bodies[a->body].id, bodies[b->body].id) == 0);
}

/* What the inputs do must be possible with this impact. */
static enum percuss_status check_input(const struct ensemble_spec *spec, size_t i,
                                       struct fault *fault)
{
    const struct ensemble_input *input = &spec->inputs[i];
    const char *name = input_quantity_name(input->quantity);
    if (changes_body(input) && spec->request->bodies[input->body].state)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "inputs[%zu].body: %s: must have no state token: its vibration is that of "
                         "the catalogue's %s",
                         i, spec->request->bodies[input->body].id, name);
    bool moves = input->quantity == INPUT_SITE || input->quantity == INPUT_RADIUS;
    if (moves && spec->request->contact_count > 1)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "inputs[%zu].name: %s: must be another one where there are %zu contacts: "
                         "it would move them apart",
                         i, name, spec->request->contact_count);
    for (size_t j = 0; j < i; j++)
        if (clash(spec, i, j))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "inputs[%zu].name: %s: is inputs[%zu] already", i, name, j);
    return input_check(input, i, fault);
}

static enum percuss_status check_correlations(const struct ensemble_spec *spec, struct fault *fault)
{
    for (size_t p = 0; p < spec->correlation_count; p++) {
        const struct copula_pair *pair = &spec->correlations[p];
        bool known = pair->first < spec->input_count && pair->second < spec->input_count &&
                     pair->first != pair->second;
        if (!known || !spec_is_drawn(spec, pair->first) || !spec_is_drawn(spec, pair->second))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "correlations[%zu]: inputs %zu and %zu: must be two different "
                             "uncertain inputs",
                             p, pair->first, pair->second);
    }
    return PERCUSS_OK;
}

enum percuss_status spec_check(const struct ensemble_spec *spec, struct fault *fault)
{
    enum percuss_status status = check_numbers(spec, fault);
    if (!status && spec->input_count == 0)
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "inputs: none given: must be 1 to %d",
                           ENSEMBLE_MAX_INPUTS);
    for (size_t i = 0; !status && i < spec->input_count; i++)
        status = check_input(spec, i, fault);
    if (!status && spec->samples == 0)
        status = check_lists(spec, fault);
    if (!status)
        status = check_correlations(spec, fault);
    return status;
}
