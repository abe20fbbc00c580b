/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/create.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact/law.h"
#include "ensemble/choice.h"
#include "solve/solve.h"

/* Of seconds each there would be too many. */
static enum percuss_status refuse_long(unsigned asked, struct fault *fault)
{
    /* the others, as a list in words */
    char names[128] = "";
    unsigned left = 0;
    for (unsigned m = 0; m < PERCUSS_CONTACT_COUNT; m++)
        left += contact_law_asked(m)->effort != CONTACT_EFFORT_LONG;
    for (unsigned m = 0; m < PERCUSS_CONTACT_COUNT; m++) {
        if (contact_law_asked(m)->effort == CONTACT_EFFORT_LONG)
            continue;
        size_t used = strlen(names);
        left--;
        snprintf(names + used, sizeof names - used, "%s%s", contact_model_name(m),
                 left > 1    ? ", "
                 : left == 1 ? " or "
                             : "");
    }
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "options.contact_model: %s: takes seconds an impact: an ensemble takes %s",
                     contact_model_name(asked), names);
}

/* The impact as it is stated must be one that solve() answers. */
static enum percuss_status try_request(struct ensemble *ensemble, const struct watch *watch,
                                       struct fault *fault)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    unsigned asked = spec->request->options.contact_model;
    if (contact_law_asked(asked)->effort == CONTACT_EFFORT_LONG)
        return refuse_long(asked, fault);
    /* a solve of its own */
    struct solve_workspace *workspace = solve_workspace_create();
    struct solve_result *result = calloc(1, sizeof *result);
    enum percuss_status status = PERCUSS_INTERNAL;
    if (workspace && result) {
        const struct solve_means means = {spec->catalogue, spec->tables,
                                          watch ? *watch : (struct watch){0}};
        status = solve(workspace, &means, spec->request, result);
        *fault = result->fault;
        ensemble->stated_model = result->contact_model;
    } else {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    }
    solve_workspace_free(workspace);
    free(result);
    return ensemble_has_result(status) ? PERCUSS_OK : status;
}

/* Dimensions, their correlations, and how many points. */
static enum percuss_status find_dimensions(struct ensemble *ensemble, struct fault *fault)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    size_t dimension_of[ENSEMBLE_MAX_INPUTS] = {0}, dimensions = 0;
    uint64_t count = spec->samples;
    /* the inputs that are drawn, and how many samples the lists give */
    for (size_t i = 0; i < spec->input_count; i++) {
        if (count == 0 && spec->inputs[i].distribution == DISTRIBUTION_IS_LIST)
            count = spec->inputs[i].value_count;
        if (!spec_is_drawn(spec, i))
            continue;
        dimension_of[i] = dimensions;
        ensemble->drawn[dimensions++] = i;
    }
    /* points of the unit cube */
    enum percuss_status status =
        sampling_create(&ensemble->sampling, spec->sampling, dimensions, count, spec->seed, fault);
    if (status)
        return status;
    ensemble->count = ensemble->sampling.count;
    /* correlations between dimensions instead of inputs */
    struct copula_pair *pairs = calloc(spec->correlation_count + 1, sizeof *pairs);
    if (!pairs)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    for (size_t p = 0; p < spec->correlation_count; p++) {
        pairs[p] = spec->correlations[p];
        pairs[p].first = dimension_of[pairs[p].first];
        pairs[p].second = dimension_of[pairs[p].second];
    }
    status = copula_create(&ensemble->copula, dimensions, pairs, spec->correlation_count, fault);
    free(pairs);
    return status;
}

enum percuss_status ensemble_create(struct ensemble *ensemble, const struct ensemble_spec *spec,
                                    const struct watch *watch, struct fault *fault)
{
    memset(ensemble, 0, sizeof *ensemble);
    ensemble->spec = *spec;
    enum percuss_status status = spec_check_tables(spec, fault);
    if (!status)
        status = try_request(ensemble, watch, fault);
    if (!status)
        status = spec_check(spec, fault);
    if (!status)
        status = find_dimensions(ensemble, fault);
    if (!status)
        status = choice_of_model(ensemble, watch, fault);
    if (status)
        ensemble_release(ensemble);
    return status;
}
