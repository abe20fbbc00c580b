/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/create.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact/law.h"
#include "ensemble/worker.h"
#include "solve/solve.h"

/* The choice of one model for all samples, by pilot samples. */

enum {
    PILOTS = 24,
    JUDGES = 21, /* of these at least, for a coarser model than the finest */
    MODEL_LEVELS = 12
};

static const double MODEL_RATIO = 1.25; /* between frequencies that are tried */

/* Share of the tolerance within which a pilot agrees while the model is chosen: of other samples
 * some are worse than the worst of so few pilots. */
static const double STRICT = 0.5;

/* A pilot's inputs, its solution by the full search, and the model of that. */
struct pilot {
    double values[ENSEMBLE_MAX_INPUTS];
    double restitution, tangential[2];
    double allowed; /* difference from it with which a model agrees; INFINITY: none can */
    struct solution_model model;
};

/* State while the model is chosen. */
struct choice {
    struct ensemble *ensemble;
    struct ensemble_worker *worker;
    const struct watch *watch; /* NULL: none */
    struct pilot *pilots;
    unsigned count; /* pilots with an answer */
};

static bool is_wanted(const struct choice *choice)
{
    return !choice->watch || choice->watch->proceed(choice->watch->context, 0.0);
}

/* Solves the pilots. Where all are refused, so is the ensemble. */
static enum percuss_status solve_pilots(struct choice *choice, struct fault *fault)
{
    const struct ensemble *ensemble = choice->ensemble;
    struct random_stream stream = {ensemble->spec.seed, STREAM_PILOTS};
    enum percuss_status status = PERCUSS_INTERNAL;
    for (unsigned k = 0; k < PILOTS && is_wanted(choice); k++) {
        double point[SAMPLING_MAX_DIMENSIONS];
        struct pilot *pilot = &choice->pilots[choice->count];
        struct repeat_outcome outcome;
        /* a Latin hypercube: no part of an input's range is without one */
        for (size_t d = 0; d < ensemble->sampling.dimensions; d++) {
            uint64_t cell = random_permute(random_bits(&stream, PILOTS, d), k, PILOTS);
            point[d] = ((double)cell + random_uniform(&stream, k, d)) / PILOTS;
        }
        copula_apply(&ensemble->copula, point);
        /* lists taken in order: values from their whole length */
        ensemble_values(ensemble, point, k * ensemble->count / PILOTS, pilot->values);
        /* a pilot counts if the search answers it */
        status = worker_search(choice->worker, pilot->values, &pilot->model, &outcome, fault);
        pilot->restitution = outcome.restitution;
        memcpy(pilot->tangential, outcome.tangential, sizeof pilot->tangential);
        choice->count += ensemble_has_result(status);
    }
    return choice->count > 0 ? PERCUSS_OK : status;
}

/* Difference of the model's answer to pilot k from the search's, of the restitution or of the
 * tangential impulse in its unit; INFINITY: it has none. */
static double difference_of(struct choice *choice, unsigned k)
{
    struct ensemble *ensemble = choice->ensemble;
    struct repeat_outcome outcome;
    /* the first with another model must not keep the scene */
    ensemble->same_scene = k > 0 && !spec_changes_scene(&ensemble->spec);
    worker_solve(choice->worker, choice->pilots[k].values, &outcome, NULL);
    const double *tangential = choice->pilots[k].tangential;
    double difference = fabs(outcome.restitution - choice->pilots[k].restitution);
    if (ensemble->has_friction && outcome.compression > 0.0)
        difference = fmax(difference, hypot(outcome.tangential[0] - tangential[0],
                                            outcome.tangential[1] - tangential[1]) /
                                          outcome.compression);
    return ensemble_has_result(outcome.status) && isfinite(difference) ? difference : INFINITY;
}

static bool all_agree(struct choice *choice)
{
    for (unsigned k = 0; k < choice->count && is_wanted(choice); k++)
        if (difference_of(choice, k) > choice->pilots[k].allowed)
            return false;
    return true;
}

/* Sets each pilot's allowed difference by the finest model's agreement. */
static void find_allowed(struct choice *choice)
{
    double tolerance = choice->ensemble->model.tolerance;
    for (unsigned k = 0; k < choice->count && is_wanted(choice); k++) {
        double difference = difference_of(choice, k);
        choice->pilots[k].allowed = difference <= STRICT * tolerance ? STRICT * tolerance
                                    : difference <= tolerance        ? tolerance
                                                                     : INFINITY;
    }
}

static unsigned count_agreeing(struct choice *choice)
{
    unsigned agreeing = 0;
    for (unsigned k = 0; k < choice->count && is_wanted(choice); k++)
        agreeing += difference_of(choice, k) <= choice->ensemble->model.tolerance;
    return agreeing;
}

/* Whether enough pilots can judge a model at all. */
static bool can_judge(const struct choice *choice)
{
    unsigned judges = 0;
    for (unsigned k = 0; k < choice->count; k++)
        judges += isfinite(choice->pilots[k].allowed);
    return judges * PILOTS >= choice->count * JUDGES;
}

/* As few modes as do not lose a pilot, from all that the search takes for any of them down to a
 * small share. By halves, since many steps down would give a coarse model as many chances to agree
 * by luck. */
static void choose_modes(struct choice *choice)
{
    struct solution_model *model = &choice->ensemble->model.model;
    double highest = model->cut;
    int agrees = 0, fails = highest > 0.0 ? MODEL_LEVELS + 1 : 1;
    while (fails - agrees > 1) {
        int below = (agrees + fails) / 2;
        model->cut = highest * pow(MODEL_RATIO, -below);
        if (all_agree(choice))
            agrees = below;
        else
            fails = below;
    }
    model->cut = highest * pow(MODEL_RATIO, -agrees);
}

/* As long steps as do not lose a pilot. */
static void choose_steps(struct choice *choice)
{
    struct ensemble_model *chosen = &choice->ensemble->model;
    double finest = chosen->model.accuracy;
    for (double accuracy = 10.0 * chosen->tolerance; accuracy > finest; accuracy /= 10.0) {
        chosen->model.accuracy = accuracy;
        if (all_agree(choice))
            return;
    }
    chosen->model.accuracy = finest;
}

/* From the finest, with all modes and steps that the search takes for any pilot. Where sequences of
 * sub-impacts are so chaotic that few pilots agree even with that, it stays. */
static void choose(struct choice *choice)
{
    struct ensemble_model *chosen = &choice->ensemble->model;
    chosen->model = (struct solution_model){0.0, INFINITY};
    for (unsigned k = 0; k < choice->count; k++) {
        chosen->model.cut = fmax(chosen->model.cut, choice->pilots[k].model.cut);
        chosen->model.accuracy = fmin(chosen->model.accuracy, choice->pilots[k].model.accuracy);
    }
    find_allowed(choice);
    if (can_judge(choice)) {
        choose_modes(choice);
        choose_steps(choice);
    }
    chosen->pilots = choice->count;
    chosen->agreeing = count_agreeing(choice);
}

/* Fills ensemble->model: the coarsest one that answers some pilot samples as the accuracy search
 * does. PERCUSS_OK; a refusal of all pilots; TIMEOUT where the watch (NULL: none) stopped it;
 * INTERNAL: out of memory. */
static enum percuss_status choice_of_model(struct ensemble *ensemble, const struct watch *watch,
                                           struct fault *fault)
{
    /* the pilots, and the model that they agree on */
    ensemble->model.tolerance = solve_tolerance(&ensemble->spec.request->options);
    struct choice choice = {.ensemble = ensemble, .watch = watch};
    enum percuss_status status = ensemble_worker_create(&choice.worker, ensemble, watch, fault);
    if (status)
        return status;
    choice.pilots = calloc(PILOTS, sizeof *choice.pilots);
    status = choice.pilots ? solve_pilots(&choice, fault)
                           : fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    if (!status)
        choose(&choice);
    /* a stop leaves no model */
    if (!is_wanted(&choice))
        status = fault_set(fault, PERCUSS_TIMEOUT, "stopped before the first sample");
    /* the scene is kept where only velocities vary */
    ensemble->same_scene = !spec_changes_scene(&ensemble->spec);
    ensemble_worker_free(choice.worker);
    free(choice.pilots);
    return status;
}

/* Refuses laws that take seconds an impact: an ensemble would take too long. */
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

/* solve() must answer the impact as stated. */
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
        const struct solve_context means = {spec->catalogue, spec->tables,
                                            watch ? *watch : (struct watch){0}};
        status = solve(workspace, &means, spec->request, result);
        *fault = result->fault;
        ensemble->stated_model = result->contact_model;
        ensemble->has_friction =
            spec->contact < result->contact_count && result->contacts[spec->contact].friction > 0.0;
    } else {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    }
    solve_workspace_free(workspace);
    free(result);
    return ensemble_has_result(status) ? PERCUSS_OK : status;
}

/* An input that gives the contact friction, or shifts the friction that it has. */
static enum percuss_status check_friction(struct ensemble *ensemble, struct fault *fault)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    for (size_t i = 0; i < spec->input_count; i++) {
        if (spec->inputs[i].quantity == INPUT_MODEL_FRICTION && !ensemble->has_friction)
            return fault_set(
                fault, PERCUSS_BAD_REQUEST,
                "inputs[%zu].name: model-friction: contacts[%zu] must have friction, "
                "by contacts[%zu].friction or the catalogue (the input friction states "
                "a coefficient)",
                i, spec->contact, spec->contact);
    }
    for (size_t i = 0; i < spec->input_count; i++)
        ensemble->has_friction =
            ensemble->has_friction || spec->inputs[i].quantity == INPUT_FRICTION;
    return PERCUSS_OK;
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
        status = check_friction(ensemble, fault);
    if (!status)
        status = find_dimensions(ensemble, fault);
    if (!status)
        status = choice_of_model(ensemble, watch, fault);
    if (status)
        ensemble_release(ensemble);
    return status;
}
