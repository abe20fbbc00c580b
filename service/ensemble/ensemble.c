/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/ensemble.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ensemble/variation.h"

enum {
    PILOTS = 24,
    AGREEING = 21, /* 7 of 8: where a sequence of sub-impacts is chaotic no affordable model does */
    MODEL_LEVELS = 12
};

static const double MODEL_RATIO = 1.25; /* between frequencies that are tried */

struct ensemble_worker {
    const struct ensemble *ensemble;
    struct repeat *repeat;
    struct variation variation;
};

enum percuss_status ensemble_worker_create(struct ensemble_worker **worker,
                                           const struct ensemble *ensemble, struct fault *fault)
{
    *worker = calloc(1, sizeof **worker);
    if (!*worker)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    (*worker)->ensemble = ensemble;
    enum percuss_status status = variation_create(&(*worker)->variation, &ensemble->spec, fault);
    (*worker)->repeat = status ? NULL : repeat_create();
    if (!status && !(*worker)->repeat)
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    if (!status)
        repeat_set_tables((*worker)->repeat, ensemble->spec.tables);
    if (status) {
        ensemble_worker_free(*worker);
        *worker = NULL;
    }
    return status;
}

void ensemble_worker_watch(struct ensemble_worker *worker, struct watch watch)
{
    repeat_set_watch(worker->repeat, watch);
}

void ensemble_worker_free(struct ensemble_worker *worker)
{
    if (!worker)
        return;
    variation_release(&worker->variation);
    repeat_free(worker->repeat);
    free(worker);
}

/* Values of all inputs from a point of the unit cube. */
static void fill_values(const struct ensemble *ensemble, const double *point, uint64_t index,
                        double *values)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    for (size_t i = 0; i < spec->input_count; i++) {
        const struct ensemble_input *input = &spec->inputs[i];
        bool listed = input->distribution == DISTRIBUTION_IS_LIST;
        values[i] = listed ? input->values[index % input->value_count] : input->first;
    }
    for (size_t d = 0; d < ensemble->sampling.dimensions; d++)
        values[ensemble->drawn[d]] = input_value(&spec->inputs[ensemble->drawn[d]], point[d]);
}

void ensemble_inputs(const struct ensemble *ensemble, uint64_t index, double *values)
{
    double point[SAMPLING_MAX_DIMENSIONS];
    sampling_point(&ensemble->sampling, index, point);
    copula_apply(&ensemble->copula, point);
    fill_values(ensemble, point, index, values);
}

/* Puts the values in place. */
static enum percuss_status apply(struct ensemble_worker *worker, const double *values,
                                 struct fault *fault)
{
    struct variation *variation = &worker->variation;
    enum percuss_status status = variation_apply(variation, values, fault);
    for (size_t i = 0; !status && i < variation->set.count; i++)
        if (variation_changes_body(variation, &variation->set.bodies[i]))
            repeat_forget(worker->repeat, variation->set.bodies[i].id);
    return status;
}

/* Runs the model on one set of values. */
static enum percuss_status solve_values(struct ensemble_worker *worker, const double *values,
                                        struct repeat_outcome *outcome, struct fault *fault)
{
    const struct ensemble *ensemble = worker->ensemble;
    *outcome = (struct repeat_outcome){.restitution = NAN, .error = NAN};
    outcome->status = apply(worker, values, fault);
    if (outcome->status)
        return outcome->status;
    return repeat_solve(worker->repeat, &worker->variation.set, &worker->variation.request,
                        ensemble->spec.contact, &ensemble->model.model, ensemble->same_scene,
                        outcome, fault);
}

/* The same by the full accuracy search. */
static enum percuss_status search_values(struct ensemble_worker *worker, const double *values,
                                         struct repeat_model *model, struct repeat_outcome *outcome,
                                         struct fault *fault)
{
    *outcome = (struct repeat_outcome){.restitution = NAN, .error = NAN};
    outcome->status = apply(worker, values, fault);
    if (outcome->status)
        return outcome->status;
    return repeat_search(worker->repeat, &worker->variation.set, &worker->variation.request,
                         worker->ensemble->spec.contact, model, outcome, fault);
}

static bool has_result(enum percuss_status status)
{
    return status == PERCUSS_OK || status == PERCUSS_TRUNCATED;
}

void ensemble_solve(struct ensemble_worker *worker, uint64_t index, struct ensemble_sample *sample,
                    struct fault *fault)
{
    double values[ENSEMBLE_MAX_INPUTS];
    struct repeat_outcome outcome;
    ensemble_inputs(worker->ensemble, index, values);
    enum percuss_status status = solve_values(worker, values, &outcome, fault);
    bool good = has_result(status);
    *sample = (struct ensemble_sample){
        .restitution = good ? outcome.restitution : NAN,
        .impulse = good ? outcome.impulse : NAN,
        .end_time = good ? outcome.end_time : NAN,
        .peak_force = good ? outcome.peak_force : NAN,
        .sub_impacts =
            (uint16_t)(outcome.sub_impacts < UINT16_MAX ? outcome.sub_impacts : UINT16_MAX),
        .significant = (uint16_t)outcome.significant,
        .warnings = good ? outcome.warnings : 0,
        .status = (uint8_t)status,
        .contact_model = (uint8_t)outcome.contact_model,
    };
}

const struct warnings *ensemble_warnings(const struct ensemble_worker *worker)
{
    return repeat_warnings(worker->repeat);
}

/* A pilot's inputs, its solution by the full search, and the model of that. */
struct pilot {
    double values[ENSEMBLE_MAX_INPUTS];
    double restitution;
    struct repeat_model model;
};

/* What is needed while the model is chosen. */
struct choice {
    struct ensemble *ensemble;
    struct ensemble_worker *worker;
    const struct watch *watch; /* NULL: nobody */
    struct pilot *pilots;
    unsigned count; /* pilots with an answer */
};

static bool is_wanted(const struct choice *choice)
{
    return !choice->watch || choice->watch->proceed(choice->watch->context, 0.0);
}

/* Solves the pilots. A refusal of all is the ensemble's. */
static enum percuss_status solve_pilots(struct choice *choice, struct fault *fault)
{
    const struct ensemble *ensemble = choice->ensemble;
    struct random_stream stream = {ensemble->spec.seed, STREAM_PILOTS};
    enum percuss_status status = PERCUSS_INTERNAL;
    for (unsigned k = 0; k < PILOTS && is_wanted(choice); k++) {
        double point[SAMPLING_MAX_DIMENSIONS];
        struct pilot *pilot = &choice->pilots[choice->count];
        struct repeat_outcome outcome;
        for (size_t d = 0; d < ensemble->sampling.dimensions; d++)
            point[d] = random_uniform(&stream, k, d);
        copula_apply(&ensemble->copula, point);
        /* lists taken in order are looked at along all their length */
        fill_values(ensemble, point, k * ensemble->count / PILOTS, pilot->values);
        status = search_values(choice->worker, pilot->values, &pilot->model, &outcome, fault);
        pilot->restitution = outcome.restitution;
        choice->count += has_result(status);
    }
    return choice->count > 0 ? PERCUSS_OK : status;
}

/* How many pilots agree with the model within the tolerance; it gives up when fewer than `wanted`
 * can. */
static unsigned count_agreeing(struct choice *choice, unsigned wanted)
{
    struct ensemble *ensemble = choice->ensemble;
    unsigned agreeing = 0, left = choice->count;
    for (unsigned k = 0; left > 0 && agreeing + left >= wanted && is_wanted(choice); k++, left--) {
        struct repeat_outcome outcome;
        /* the first with another model must not keep the scene */
        ensemble->same_scene = k > 0 && !spec_changes_scene(&ensemble->spec);
        solve_values(choice->worker, choice->pilots[k].values, &outcome, NULL);
        double difference = fabs(outcome.restitution - choice->pilots[k].restitution);
        agreeing += has_result(outcome.status) && difference <= ensemble->model.tolerance;
    }
    return agreeing;
}

/* As few modes as the pilots allow, from a small share of what the search takes for any of them up
 * to all of that, with steps as fine as the finest. */
static void choose_modes(struct choice *choice)
{
    struct ensemble_model *chosen = &choice->ensemble->model;
    unsigned wanted = (choice->count * AGREEING + PILOTS - 1) / PILOTS;
    double highest = 0.0, steps = INFINITY;
    for (unsigned k = 0; k < choice->count; k++) {
        highest = fmax(highest, choice->pilots[k].model.cut);
        steps = fmin(steps, choice->pilots[k].model.accuracy);
    }
    chosen->pilots = choice->count;
    for (int below = MODEL_LEVELS; below >= 0; below--) {
        chosen->model = (struct repeat_model){highest * pow(MODEL_RATIO, -below), steps};
        chosen->agreeing = count_agreeing(choice, below > 0 ? wanted : 0);
        if (chosen->agreeing >= wanted || highest == 0.0)
            return;
    }
}

/* As long steps as do not lose a pilot. */
static void choose_steps(struct choice *choice)
{
    struct ensemble_model *chosen = &choice->ensemble->model;
    double finest = chosen->model.accuracy;
    for (double accuracy = 10.0 * chosen->tolerance; accuracy > finest; accuracy /= 10.0) {
        chosen->model.accuracy = accuracy;
        unsigned agreeing = count_agreeing(choice, chosen->agreeing);
        if (agreeing >= chosen->agreeing) {
            chosen->agreeing = agreeing;
            return;
        }
    }
    chosen->model.accuracy = finest;
}

static enum percuss_status find_model(struct ensemble *ensemble, const struct watch *watch,
                                      struct fault *fault)
{
    const struct solve_options *options = &ensemble->spec.request->options;
    ensemble->model.tolerance = options->tolerance > 0.0 ? options->tolerance : 1e-3;
    struct choice choice = {.ensemble = ensemble, .watch = watch};
    enum percuss_status status = ensemble_worker_create(&choice.worker, ensemble, fault);
    if (status)
        return status;
    if (watch)
        ensemble_worker_watch(choice.worker, *watch);
    choice.pilots = calloc(PILOTS, sizeof *choice.pilots);
    status = choice.pilots ? solve_pilots(&choice, fault)
                           : fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    if (!status) {
        choose_modes(&choice);
        choose_steps(&choice);
    }
    if (!is_wanted(&choice))
        status = fault_set(fault, PERCUSS_TIMEOUT, "stopped before the first sample");
    ensemble->same_scene = !spec_changes_scene(&ensemble->spec);
    ensemble_worker_free(choice.worker);
    free(choice.pilots);
    return status;
}

/* The impact as it is stated must be one that solve() answers. */
static enum percuss_status try_request(struct ensemble *ensemble, const struct watch *watch,
                                       struct fault *fault)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    enum percuss_contact_model asked = spec->request->options.contact_model;
    if (asked > PERCUSS_CONTACT_TABLE)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.contact_model: %s: takes seconds an impact: an ensemble takes "
                         "auto, hertz, closed-form or table",
                         contact_model_name(asked));
    struct solve_workspace *workspace = solve_workspace_create();
    struct solve_result *result = calloc(1, sizeof *result);
    enum percuss_status status = PERCUSS_INTERNAL;
    if (workspace && result) {
        solve_workspace_set_tables(workspace, spec->tables);
        solve_workspace_watch(workspace, watch ? *watch : (struct watch){0});
        status = solve(workspace, spec->catalogue, spec->request, result);
        *fault = result->fault;
        ensemble->stated_model = result->contact_model;
    } else {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    }
    solve_workspace_free(workspace);
    free(result);
    return has_result(status) ? PERCUSS_OK : status;
}

/* Dimensions, their correlations, and how many points. */
static enum percuss_status find_dimensions(struct ensemble *ensemble, struct fault *fault)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    size_t dimension_of[ENSEMBLE_MAX_INPUTS] = {0}, dimensions = 0;
    uint64_t count = spec->samples;
    for (size_t i = 0; i < spec->input_count; i++) {
        if (count == 0 && spec->inputs[i].distribution == DISTRIBUTION_IS_LIST)
            count = spec->inputs[i].value_count;
        if (!spec_is_drawn(spec, i))
            continue;
        dimension_of[i] = dimensions;
        ensemble->drawn[dimensions++] = i;
    }
    enum percuss_status status =
        sampling_create(&ensemble->sampling, spec->sampling, dimensions, count, spec->seed, fault);
    if (status)
        return status;
    ensemble->count = ensemble->sampling.count;
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
        status = find_model(ensemble, watch, fault);
    if (status)
        ensemble_release(ensemble);
    return status;
}

void ensemble_release(struct ensemble *ensemble)
{
    copula_release(&ensemble->copula);
}

double ensemble_extra(struct ensemble_worker *worker, uint64_t done, uint64_t k)
{
    const struct ensemble *ensemble = worker->ensemble;
    struct ensemble_extra_place place = ensemble_extra_place(ensemble, done, k);
    double values[ENSEMBLE_MAX_INPUTS];
    struct repeat_outcome outcome;
    ensemble_inputs(ensemble, place.sample, values);
    enum percuss_status status;
    if (place.dimension == SIZE_MAX) {
        status = search_values(worker, values, NULL, &outcome, NULL);
    } else {
        struct random_stream stream = {ensemble->spec.seed, STREAM_SUBSTITUTES};
        size_t input = ensemble->drawn[place.dimension];
        values[input] = input_value(&ensemble->spec.inputs[input],
                                    random_uniform(&stream, place.sample, place.dimension));
        status = solve_values(worker, values, &outcome, NULL);
    }
    return has_result(status) ? outcome.restitution : NAN;
}
