/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One solution of a problem with given modes and time steps. */
#ifndef PERCUSS_SOLVE_ATTEMPT_H
#define PERCUSS_SOLVE_ATTEMPT_H

#include "solve/assemble.h"
#include "solve/outcome.h"

struct nearby;       /* nearby.h */
struct tangent_path; /* tangent.h */

/* What all attempts at a problem share. */
struct attempt_context {
    const struct problem *problem;
    struct arena *arena;   /* of the outcomes */
    struct pace *pace;     /* NULL: nothing stops them; otherwise a status may be PERCUSS_TIMEOUT */
    double work;           /* left for all of them (impact.h) */
    struct nearby *nearby; /* of the best attempt so far, for its comparisons with others */
};

struct attempt {
    struct mode_choice choice;
    double accuracy; /* of the time steps, see impact_settings */
    struct assembly *assembly;
    struct impact_outcome outcome;
    const struct force_log *log; /* of that outcome; NULL: it was not taken down */
    struct tangent_path *path;   /* along that log; NULL: not asked for yet */
    enum impact_care care;       /* of the time steps; a sequence's where one was found */
};

/* Until when a scene is watched: the request's horizon, or the default, s. */
double attempt_horizon(const struct problem *problem, const struct scene *scene);

/* Solves a scene by the request's method: the attempt's own, or one derived from it. What was to be
 * a single blow and is none is solved with a sequence's care: from the beginning where several
 * contacts, a law that yields or acceleration tell so, or else again. */
enum percuss_status attempt_run(struct attempt_context *context, struct attempt *attempt,
                                const struct scene *scene);

/* The same, and takes the forces down where first order can tell what small changes do to them: in
 * sequences of the modal method. */
enum percuss_status attempt_run_logged(struct attempt_context *context, struct attempt *attempt,
                                       const struct scene *scene);

/* Assembles the attempt's scene by its choice. PERCUSS_OK or PERCUSS_INTERNAL. */
enum percuss_status attempt_assemble(struct attempt_context *context, struct attempt *attempt);

/* The same with all gap rates times `factor`; impulses are divided by it. */
enum percuss_status attempt_run_scaled(struct attempt_context *context, struct attempt *attempt,
                                       double factor);

/* Work (impact.h) that all solutions by a method with one contact model may take. */
double attempt_work_allowed(enum percuss_method method);

/* Whether it was cut off: for its effort, or where no step could be solved. */
bool attempt_is_spent(const struct attempt *attempt);

/* Whether a contact closes more than once, or there are several: later sub-impacts amplify what the
 * first ones miss. */
bool attempt_is_sequence(const struct attempt *attempt);

/* How much longer steps another solution takes for comparison, as accuracy (impact_settings). */
static const double ATTEMPT_LONGER = 100.0;

/* What steps of an accuracy have been seen to leave of one blow's e (docs/accuracy.md). */
double attempt_steps_leave(double accuracy);

/* For an attempt that a sequence is compared with: contacts begin and end by other means, so that
 * the two do not err alike. */
static inline void attempt_by_other_means(struct attempt *attempt)
{
    if (attempt->care == IMPACT_CARE_SEQUENCE)
        attempt->care = IMPACT_CARE_BESIDE;
}

/* Finest accuracy of the time steps that is tried. */
static const double ATTEMPT_FINEST = 1e-17;

/* Whether steps can still be shortened: rounding may have left them a little above the finest. */
static inline bool attempt_can_shorten(double accuracy)
{
    return accuracy > 1.01 * ATTEMPT_FINEST;
}

/* Whether first order tells what small changes do to it: its forces were taken down, of a contact
 * that approaches, does not yield and does not close too often. */
bool attempt_is_followed(const struct attempt_context *context, const struct attempt *attempt);

/* Whether a contact closes so often that one comparison may agree by chance. */
bool attempt_is_long(const struct attempt *attempt);

#endif
