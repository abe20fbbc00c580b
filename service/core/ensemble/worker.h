/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Solver of the impacts of an ensemble, by its own model or by the accuracy search. */
#ifndef PERCUSS_ENSEMBLE_WORKER_H
#define PERCUSS_ENSEMBLE_WORKER_H

#include "ensemble/ensemble.h"
#include "solve/repeat.h"

struct ensemble_worker;
/* A solution asks `watch` (NULL: none; copied) about once a millisecond whether to go on.
 * BAD_REQUEST: an input that this impact cannot have; INTERNAL: out of memory. */
enum percuss_status ensemble_worker_create(struct ensemble_worker **worker,
                                           const struct ensemble *ensemble,
                                           const struct watch *watch, struct fault *fault);
void ensemble_worker_free(struct ensemble_worker *worker);

const struct ensemble *worker_ensemble(const struct ensemble_worker *worker);

/* Runs the ensemble's model on one set of values. Returns outcome->status; a refusal's message goes
 * to `fault` (NULL: not wanted). */
enum percuss_status worker_solve(struct ensemble_worker *worker, const double *values,
                                 struct repeat_outcome *outcome, struct fault *fault);

/* The same by the full accuracy search, which tells the model it took (NULL: not wanted). */
enum percuss_status worker_search(struct ensemble_worker *worker, const double *values,
                                  struct solution_model *model, struct repeat_outcome *outcome,
                                  struct fault *fault);

/* Solves sample `index`; its status is TIMEOUT where the watch stopped it: it is not solved. The
 * message of a refusal goes to `fault` (NULL: not wanted). */
void ensemble_solve(struct ensemble_worker *worker, uint64_t index, struct ensemble_sample *sample,
                    struct fault *fault);

/* The warnings of the sample that the worker solved last. */
const struct warnings *ensemble_warnings(const struct ensemble_worker *worker);

#endif
