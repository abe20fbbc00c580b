/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One solution of a problem with given modes and time steps. */
#ifndef PERCUSS_SOLVE_ERROR_ATTEMPT_H
#define PERCUSS_SOLVE_ERROR_ATTEMPT_H

#include "solve/assemble.h"
#include "solve/outcome.h"

struct neighbours;       /* neighbours.h */
struct sensitivity_path; /* sensitivity.h */

/* The problem and the effort that all attempts at it share. */
struct attempt_context {
    const struct problem *problem;
    struct arena *arena; /* of the outcomes */
    struct pace *pace;   /* NULL: nothing stops them; otherwise a status may be PERCUSS_TIMEOUT */
    double work;         /* left for all of them (impact.h) */
    struct neighbours *neighbours; /* of the solutions around the best attempt so far */
};

struct attempt {
    struct mode_choice choice;
    double accuracy; /* of the time steps, see impact_settings */
    struct assembly *assembly;
    struct impact_outcome outcome;
    const struct force_log *log;   /* of that outcome; NULL: it was not recorded */
    struct sensitivity_path *path; /* along that log; NULL: not asked for yet */
    enum step_profile profile;     /* of the time steps; a sequence's where one was found */
};

/* Accuracy of the time steps to begin with; a sequence of sub-impacts is expected to amplify their
 * error. */
double attempt_first_accuracy(double tolerance, bool sequence, bool group);

/* Error that steps of an accuracy leave of one impact's e (docs/lab/accuracy.md). */
double attempt_steps_leave(double accuracy);

/* Until when a scene is watched: the request's horizon, or the default, s. */
double attempt_horizon(const struct problem *problem, const struct scene *scene);

/* Assembles the attempt's scene by its choice. PERCUSS_OK or PERCUSS_INTERNAL. */
enum percuss_status attempt_assemble(struct attempt_context *context, struct attempt *attempt);

/* Solves a scene by the request's method: the attempt's own, or one derived from it. A solution
 * that was to be a single impact and is none is solved with a sequence's profile: from the
 * beginning where several contacts, a law that yields or acceleration tell so, or else again. */
enum percuss_status attempt_run(struct attempt_context *context, struct attempt *attempt,
                                const struct scene *scene);

/* The same, and records the normal forces where first order along them can tell the effect of small
 * changes: in sequences of the modal method, where friction hardly acts on them. */
enum percuss_status attempt_run_logged(struct attempt_context *context, struct attempt *attempt,
                                       const struct scene *scene);

/* The same with all gap rates times `factor`; impulses are divided by it. */
enum percuss_status attempt_run_scaled(struct attempt_context *context, struct attempt *attempt,
                                       double factor);

/* Work (impact.h) that all solutions by a method with one contact model may take. */
double attempt_work_allowed(enum percuss_method method);

/* Whether it was cut off: for its effort, or where no step could be solved. */
bool attempt_is_spent(const struct attempt *attempt);

/* Whether a contact closes more than once, or there are several: later sub-impacts amplify the
 * errors of the first ones. */
bool attempt_is_sequence(const struct attempt *attempt);

/* Whether a contact closes so often that one comparison may agree by chance. */
bool attempt_is_long(const struct attempt *attempt);

/* Whether first order tells the effect of small changes: its forces were recorded, of a contact
 * that approaches, neither yields nor is lossy, and does not close too often. */
bool attempt_is_followed(const struct attempt_context *context, const struct attempt *attempt);

/* For an attempt that a sequence is compared with: contacts begin and end by other means, so that
 * the two do not err alike. */
static inline void attempt_by_other_means(struct attempt *attempt)
{
    if (attempt->profile == STEP_PROFILE_SEQUENCE)
        attempt->profile = STEP_PROFILE_COMPARED;
}

/* Whether steps can still be shortened: rounding may have left them a little above the finest. */
bool attempt_can_shorten(double accuracy);

/* A solved scene without its highest modes, for solutions that need to be much less accurate: the
 * inertia and viscosity of those modes would change no contact's impulse by more than `allowed` of
 * that of compression, as the answer's forces tell; their static compliance goes into
 * `truncated->residual`. Modes in motion at the beginning stay. Arrays come from the problem's
 * arena, sets of modes from the scene. False: out of memory. */
bool attempt_truncate(const struct problem *problem, const struct scene *scene,
                      const struct impact_outcome *answer, double allowed, struct scene *truncated);

/* The scene that first order follows along a logged answer: without the modes that it does not
 * need, and without tangents. False: out of memory. */
bool attempt_followed_scene(const struct problem *problem, const struct scene *scene,
                            const struct impact_outcome *answer, struct scene *followed);

#endif
