/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One solution of a request with given modes and time steps, and comparisons between two. */
#ifndef PERCUSS_SOLVE_ATTEMPT_H
#define PERCUSS_SOLVE_ATTEMPT_H

#include "impact/impact.h"
#include "solve/assemble.h"

struct nearby; /* nearby.h */

/* What all attempts at a request share. */
struct attempt_context {
    const struct problem *problem;
    const struct solve_request *request;
    struct arena *arena;
    struct pace *pace;
    double tolerance;      /* on the restitution */
    double work;           /* left for the request (impact.h) */
    struct nearby *nearby; /* of the best attempt so far, for its comparisons with others */
};

struct attempt {
    struct mode_choice choice;
    double accuracy; /* of the time steps, see impact_settings */
    struct assembly *assembly;
    struct impact_outcome outcome;
};

/* Until when a scene is watched: the request's horizon, or the default, s. */
double attempt_horizon(const struct problem *problem, const struct scene *scene);

/* Solves a scene by the request's method: the attempt's own, or one derived from it. */
enum percuss_status attempt_run(struct attempt_context *context, struct attempt *attempt,
                                const struct scene *scene);

/* Assembles the attempt's scene by its choice. PERCUSS_OK or PERCUSS_INTERNAL. */
enum percuss_status attempt_assemble(struct attempt_context *context, struct attempt *attempt);

/* The same with all gap rates times `factor`; impulses are divided by it. */
enum percuss_status attempt_run_scaled(struct attempt_context *context, struct attempt *attempt,
                                       double factor);

/* Whether nothing was solved: the effort was spent before any force. */
bool attempt_is_unsolved(const struct problem *problem, const struct impact_outcome *outcome);

/* Restitution of a contact, which of what is unsolved says nothing; NAN where the compression
 * impulse is 0: Eq. (6). */
double attempt_restitution(const struct problem *problem, const struct impact_outcome *outcome,
                           size_t contact);

/* PERCUSS_BAD_REQUEST: no touch lies behind an overlap (outcome.always_overlapped), or none within
 * the horizon; the request contradicts itself. */
enum percuss_status attempt_refuse_overlap(const struct attempt_context *context,
                                           const struct attempt *attempt, double horizon,
                                           struct fault *fault);

/* Largest differences between two solutions over the contacts. */
struct attempt_difference {
    double restitution, impulse;
};
struct attempt_difference attempt_compare(const struct attempt_context *context,
                                          const struct attempt *a, const struct attempt *b);

/* Work (impact.h) that all solutions by a method with one contact model may take. */
double attempt_work_allowed(enum percuss_method method);

/* Share of the energy that a solution gains or loses. What acceleration takes may leave next to
 * nothing available: the approach counts too. */
double attempt_energy_defect(const struct problem *problem, const struct impact_outcome *outcome);

/* More of its energy no solution may gain or lose. */
static const double ATTEMPT_WORST_DEFECT = 0.01;

/* Whether a solution with that defect is one at all. */
bool attempt_keeps_energy(double defect);

/* Whether it was cut off: for its effort, or where no step could be solved. */
bool attempt_is_spent(const struct attempt *attempt);

/* Whether a contact closes more than once, or there are several: later sub-impacts amplify what the
 * first ones miss. */
bool attempt_is_sequence(const struct attempt *attempt);

/* How much longer steps another solution takes for comparison, as accuracy (impact_settings). */
static const double ATTEMPT_LONGER = 100.0;

/* Finest accuracy of the time steps that is tried. */
static const double ATTEMPT_FINEST = 1e-17;

/* Whether a contact closes so often that one comparison may agree by chance. */
bool attempt_is_long(const struct attempt *attempt);

#endif
