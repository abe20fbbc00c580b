/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The error of a sequence of sub-impacts, from solutions beside the answer. Later sub-impacts
 * amplify what the model and the steps leave out of the first ones, and not evenly. */
#ifndef PERCUSS_SOLVE_SEQUENCE_H
#define PERCUSS_SOLVE_SEQUENCE_H

#include "solve/attempt.h"

/* What the omitted modes do to the answer. */
struct mode_error {
    double restitution, impulse;
    bool covers_steps; /* what longer time steps do to a sequence is in it */
    bool by_steps;     /* it is too large, and longer time steps do more */
    double strained;   /* change of a sub-impact's impulse, over itself, or of e where only that is
                          known, over what was changed of one blow's e; 0: neither is known */
    bool unchecked;    /* the effort did not suffice to find it out */
    const struct attempt
        *longer; /* solved with longer time steps; NULL: not needed. In the arena */
};

/* Share of the tolerance that the modes may take, and the steps. */
static const double SEQUENCE_MODES_SHARE = 0.7;
static const double SEQUENCE_STEPS_SHARE = 0.3;

/* True error over the difference to a better or a cruder solution: below 2 for 19 of 20 random
 * sequences of every class (docs/accuracy.md). */
static const double SEQUENCE_FACTOR = 3.0;

/* The most that omitted modes may change of one blow's restitution, to first order, for this to say
 * what they do: with fewer modes they do not follow the force slowly, and the next better model
 * says little of what they all do, of a contact in a group that hardly approaches least. */
static const double SEQUENCE_MOST = 1e-4;
static const double SEQUENCE_MOST_GROUP = 2e-5;

/* Compares a sequence with solutions beside it; `error` holds what is known without them, and is
 * widened. PERCUSS_OK, PERCUSS_INTERNAL or PERCUSS_TIMEOUT. */
enum percuss_status sequence_compare(struct attempt_context *context, struct attempt *best,
                                     struct mode_error *error);

/* Widens the error of a single blow whose bodies have fewer modes by the catalogue than the
 * tolerance asks for by a solution that has them. The same returns. */
enum percuss_status sequence_compare_unfixed(struct attempt_context *context, struct attempt *best,
                                             struct mode_error *error);

#endif
