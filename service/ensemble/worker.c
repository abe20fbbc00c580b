/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/worker.h"

#include <math.h>
#include <stdlib.h>

#include "ensemble/variation.h"

struct ensemble_worker {
    const struct ensemble *ensemble;
    struct repeat *repeat;
    struct variation variation;
    struct solve_means means; /* with the variation's bodies for a catalogue */
};

enum percuss_status ensemble_worker_create(struct ensemble_worker **worker,
                                           const struct ensemble *ensemble,
                                           const struct watch *watch, struct fault *fault)
{
    *worker = calloc(1, sizeof **worker);
    if (!*worker)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    /* bodies to vary, and what solves with them */
    (*worker)->ensemble = ensemble;
    enum percuss_status status = variation_create(&(*worker)->variation, &ensemble->spec, fault);
    (*worker)->repeat = status ? NULL : repeat_create();
    if (!status && !(*worker)->repeat)
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    (*worker)->means = (struct solve_means){&(*worker)->variation.set, ensemble->spec.tables,
                                            watch ? *watch : (struct watch){0}};
    /* all of it or nothing */
    if (status) {
        ensemble_worker_free(*worker);
        *worker = NULL;
    }
    return status;
}

void ensemble_worker_free(struct ensemble_worker *worker)
{
    if (!worker)
        return;
    variation_release(&worker->variation);
    repeat_free(worker->repeat);
    free(worker);
}

const struct ensemble *worker_ensemble(const struct ensemble_worker *worker)
{
    return worker->ensemble;
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

enum percuss_status worker_solve(struct ensemble_worker *worker, const double *values,
                                 struct repeat_outcome *outcome, struct fault *fault)
{
    const struct ensemble *ensemble = worker->ensemble;
    *outcome = (struct repeat_outcome){.restitution = NAN, .error = NAN};
    outcome->status = apply(worker, values, fault);
    if (outcome->status)
        return outcome->status;
    return repeat_solve(worker->repeat, &worker->means, &worker->variation.request,
                        ensemble->spec.contact, &ensemble->model.model, ensemble->same_scene,
                        outcome, fault);
}

enum percuss_status worker_search(struct ensemble_worker *worker, const double *values,
                                  struct solution_model *model, struct repeat_outcome *outcome,
                                  struct fault *fault)
{
    *outcome = (struct repeat_outcome){.restitution = NAN, .error = NAN};
    outcome->status = apply(worker, values, fault);
    if (outcome->status)
        return outcome->status;
    return repeat_search(worker->repeat, &worker->means, &worker->variation.request,
                         worker->ensemble->spec.contact, model, outcome, fault);
}

void ensemble_solve(struct ensemble_worker *worker, uint64_t index, struct ensemble_sample *sample,
                    struct fault *fault)
{
    /* the sample's inputs, solved */
    double values[ENSEMBLE_MAX_INPUTS];
    struct repeat_outcome outcome;
    ensemble_inputs(worker->ensemble, index, values);
    enum percuss_status status = worker_solve(worker, values, &outcome, fault);
    bool good = ensemble_has_result(status);
    /* in short; NAN where refused */
    *sample = (struct ensemble_sample){
        .restitution = good ? outcome.restitution : NAN,
        .impulse = good ? outcome.impulse : NAN,
        .end_time = good ? outcome.end_time : NAN,
        .peak_force = good ? outcome.peak_force : NAN,
        .sub_impacts =
            (uint16_t)(outcome.sub_impacts < UINT16_MAX ? outcome.sub_impacts : UINT16_MAX),
        .significant = (uint16_t)outcome.significant,
        .warnings = good ? outcome.warnings : 0,
        .status = (uint32_t)status,
        .contact_model = (uint32_t)outcome.contact_model,
    };
}

const struct warnings *ensemble_warnings(const struct ensemble_worker *worker)
{
    return repeat_warnings(worker->repeat);
}
