/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What solves the impacts of an ensemble, by its own model or by the accuracy search. */
#ifndef PERCUSS_ENSEMBLE_WORKER_H
#define PERCUSS_ENSEMBLE_WORKER_H

#include "ensemble/ensemble.h"

static inline bool worker_has_result(enum percuss_status status)
{
    return status == PERCUSS_OK || status == PERCUSS_TRUNCATED;
}

const struct ensemble *worker_ensemble(const struct ensemble_worker *worker);

/* Values of all inputs, spec.input_count of them, from a point of the unit cube; lists that are
 * taken in order give their value `index`. */
void worker_fill_values(const struct ensemble *ensemble, const double *point, uint64_t index,
                        double *values);

/* Runs the ensemble's model on one set of values. Returns outcome->status; a refusal's message goes
 * to `fault` (NULL: nobody reads it). */
enum percuss_status worker_solve(struct ensemble_worker *worker, const double *values,
                                 struct repeat_outcome *outcome, struct fault *fault);

/* The same by the full accuracy search, which tells the model it took (NULL: not wanted). */
enum percuss_status worker_search(struct ensemble_worker *worker, const double *values,
                                  struct solution_model *model, struct repeat_outcome *outcome,
                                  struct fault *fault);

#endif
