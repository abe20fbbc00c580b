/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/decode_ensemble.h"

#include <string.h>

#include "exchange/check.h"
#include "exchange/decode.h"

/* The quantity and whose it is. */
static void decode_owner(struct check *check, const percuss_v1_EnsembleInput *wire,
                         const struct solve_request *request, struct ensemble_input *input)
{
    check_text(check, "name", wire->name);
    check_text(check, "body", wire->body);
    /* what varies */
    input->quantity = input_quantity_find(wire->name);
    check_that(check, input->quantity < INPUT_QUANTITY_COUNT,
               "name: '%s': must be one of speed, direction, model-force, model-compliance, "
               "model-yield, site (or at), young, poisson, density, radius, yield, damping, scale",
               wire->name);
    /* a quantity of the contact has no body */
    input->body = 0;
    if (!input_is_of_body(input->quantity)) {
        check_that(check, !wire->body[0], "body: '%s': must be empty: %s is the contact's",
                   wire->body, wire->name);
        return;
    }
    /* any other one is of a body of the scene */
    while (input->body < request->body_count &&
           strcmp(request->bodies[input->body].id, wire->body) != 0)
        input->body++;
    check_that(check, input->body < request->body_count,
               "body: '%s': must be the id of a body of the scene, whose %s it is", wire->body,
               wire->name);
}

static void decode_input(struct check *check, const percuss_v1_EnsembleInput *wire,
                         const struct solve_request *request, struct ensemble_input *input)
{
    decode_owner(check, wire, request, input);
    check_choice(check, "distribution", wire->distribution, DISTRIBUTION_KINDS, distribution_name);
    check_that(check, wire->values._length <= ENSEMBLE_MAX_VALUES,
               "values: %u given: must be at most %d", wire->values._length, ENSEMBLE_MAX_VALUES);
    input->distribution = wire->distribution;
    input->first = wire->first;
    input->second = wire->second;
    input->lower = wire->lower;
    input->upper = wire->upper;
    input->values = wire->values._buffer;
    input->value_count = wire->values._length;
}

static void decode_correlations(struct check *check, const percuss_v1_EnsembleRequest *wire,
                                struct decoded_ensemble *decoded)
{
    size_t count = wire->correlations._length;
    check_that(check, count <= DECODE_MAX_CORRELATIONS,
               "correlations: %zu given: must be at most %d", count, DECODE_MAX_CORRELATIONS);
    for (size_t i = 0; !check->status && i < count; i++) {
        const percuss_v1_EnsembleCorrelation *pair = &wire->correlations._buffer[i];
        decoded->correlations[i] =
            (struct copula_pair){pair->first, pair->second, pair->coefficient};
    }
}

static void check_scene(struct check *check, const percuss_v1_Request *scene)
{
    for (uint32_t i = 0; i < scene->bodies._length; i++) {
        const char *state = scene->bodies._buffer[i].state;
        check_that(check, !state[0],
                   "scene.bodies[%u].state: %s: must be empty: a token names one state, which an "
                   "ensemble cannot vary",
                   i, state);
        const char *specimen = scene->bodies._buffer[i].specimen;
        check_that(
            check, !specimen[0],
            "scene.bodies[%u].specimen: %s: must be empty: no sample of an ensemble leaves a "
            "dent in it",
            i, specimen);
    }
}

enum percuss_status decode_ensemble(const percuss_v1_EnsembleRequest *wire,
                                    struct decoded_ensemble *decoded, struct fault *fault)
{
    struct check check = {.fault = fault};
    /* a scene as in a single request, of bodies without a history */
    enum percuss_status status = decode_request(&wire->scene, &decoded->request, fault);
    if (status)
        return status;
    check_scene(&check, &wire->scene);
    /* its uncertain inputs */
    check_that(&check, wire->inputs._length <= ENSEMBLE_MAX_INPUTS,
               "inputs: %u given: must be at most %d", wire->inputs._length, ENSEMBLE_MAX_INPUTS);
    for (uint32_t i = 0; !check.status && i < wire->inputs._length; i++) {
        check_enter(&check, "inputs", i);
        decode_input(&check, &wire->inputs._buffer[i], &decoded->request, &decoded->inputs[i]);
    }
    /* how they depend on each other and are sampled */
    check.place = NULL;
    decode_correlations(&check, wire, decoded);
    check_choice(&check, "sampling", wire->sampling, SAMPLING_METHODS, sampling_name);
    /* all of it in the ensemble's words */
    decoded->spec = (struct ensemble_spec){
        .request = &decoded->request,
        .contact = wire->contact,
        .input_count = wire->inputs._length,
        .inputs = decoded->inputs,
        .correlation_count = wire->correlations._length,
        .correlations = decoded->correlations,
        .sampling = wire->sampling,
        .samples = wire->samples,
        .seed = wire->seed,
        .half_width = wire->half_width,
        .quantile_half_width = wire->quantile_half_width,
        .quantile_count = wire->quantiles._length,
        .quantiles = wire->quantiles._buffer,
        .bins = wire->bins,
    };
    return check.status;
}
