/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The fast time scale of one impact: contact phases and flights until vibration can cause no further
 * contact. */
#ifndef PERCUSS_IMPACT_IMPACT_H
#define PERCUSS_IMPACT_IMPACT_H

#include "impact/motion.h"
#include "impact/result.h"
#include "impact/track.h"

struct impact_settings {
    double accuracy;          /* relative error of an impulse that the time steps may cause */
    double horizon;           /* s from the stated instant */
    unsigned long max_steps;  /* contact steps and flight intervals, together */
};

/* Everything here lives in the arena given to impact_create. */
struct impact_outcome {
    enum percuss_end_reason end_reason;
    double window;           /* s: the end of the fast scale */
    double time_shift;       /* the touch before (< 0) or after the stated instant, s */
    struct track *tracks;    /* [contact] */
    struct impact_energy energy;
    double *vibration;       /* [body], J, at the end */
    struct motion motion;    /* at the end */
    unsigned long steps;     /* contact steps accepted */
    unsigned long rejected;
    unsigned long intervals; /* of flights */
};

/* Memory for outcomes of a scene (and of scenes with fewer oscillators). */
bool impact_create(struct impact_outcome *outcome, const struct scene *scene, struct arena *arena);

/* Solves by exact modal propagation. `arena` holds scratch memory until its next reset. PERCUSS_OK, or
 * PERCUSS_INTERNAL when memory runs out. */
enum percuss_status impact_modal(const struct scene *scene, const struct impact_settings *settings,
                                 struct arena *arena, struct impact_outcome *outcome);

/* The same by CVODE with root finding: the independent reference. */
enum percuss_status impact_cvode(const struct scene *scene, const struct impact_settings *settings,
                                 struct arena *arena, struct impact_outcome *outcome);

/* Brings the state to the touch when the bodies overlap at the stated instant: sets time_shift. */
void impact_find_start(const struct scene *scene, double longest, struct motion *motion,
                       double *time_shift);

/* Duration, indentation and force of an elastic collision of the contact alone as rigid bodies at an
 * approach rate: the scales of a contact. */
struct impact_scale {
    double duration; /* indentation / rate, s */
    double indentation;
    double force;
};
struct impact_scale impact_scale_of(const struct scene *scene, size_t contact, double rate);

#endif
