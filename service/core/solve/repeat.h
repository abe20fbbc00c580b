/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Many impacts with one model: the accuracy search fixes the modes and steps once, then every
 * impact is one run without an error estimate. Same request and model, same bits, on any worker and
 * after any other solve. */
#ifndef PERCUSS_SOLVE_REPEAT_H
#define PERCUSS_SOLVE_REPEAT_H

#include <stdint.h>

#include "solve/request.h"
#include "solve/result.h"
#include "solve/solution.h"

/* One contact of one impact. */
struct repeat_outcome {
    enum percuss_status status; /* OK, TRUNCATED, a refusal, or TIMEOUT: stopped */
    double restitution;         /* NAN where the contact does not approach, or nothing was solved */
    double impulse;
    double end_time;                          /* of the last sub-impact; 0 without any */
    double peak_force;                        /* largest of all sub-impacts */
    unsigned sub_impacts, significant;        /* all; those of at least 1 % of the impulse */
    double compression;                       /* impulse that stops the approach, N s */
    double tangential[2];                     /* impulses on body a; 0 without friction */
    double tangential_restitution;            /* NAN without slip or friction */
    double restitution_kinematic;             /* NAN for groups */
    double error;                             /* estimated; repeat_search only, else NAN */
    enum percuss_contact_model contact_model; /* HERTZ, CLOSED_FORM or TABLE */
    uint32_t warnings;                        /* 1 << enum warning_kind of each */
};

/* Memory of one worker. */
struct repeat;
struct repeat *repeat_create(void); /* NULL: out of memory */
void repeat_free(struct repeat *repeat);

/* Forgets the last problem: its bodies are other ones from now on. */
void repeat_forget(struct repeat *repeat);

/* Solves by the accuracy search; fills `model` (NULL: not wanted) and the outcome of `contact`.
 * Returns outcome->status; refusals carry a message. The request must have passed solve(). */
enum percuss_status repeat_search(struct repeat *repeat, const struct solve_context *context,
                                  const struct solve_request *request, size_t contact,
                                  struct solution_model *model, struct repeat_outcome *outcome,
                                  struct fault *fault);

/* Solves once with that model. `same_scene`: the request differs from this worker's last one in
 * velocities only and the model not at all, so that the scene is kept. Bodies are prepared once a
 * revision of the catalogue, but for those forgotten. */
enum percuss_status repeat_solve(struct repeat *repeat, const struct solve_context *context,
                                 const struct solve_request *request, size_t contact,
                                 const struct solution_model *model, bool same_scene,
                                 struct repeat_outcome *outcome, struct fault *fault);

/* Warnings of the last solution that had a result. */
const struct warnings *repeat_warnings(const struct repeat *repeat);

#endif
