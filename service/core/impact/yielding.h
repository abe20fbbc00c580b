/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Contacts that yield, on the fast scale. A law's slope jumps where unloading begins and where
 * reloading comes back to the virgin curve, and the curve itself may have joints: steps of the
 * contact phase end there, found by halving within the ladder of steps. The law's history changes
 * where unloading begins. */
#ifndef PERCUSS_IMPACT_YIELDING_H
#define PERCUSS_IMPACT_YIELDING_H

#include <stdbool.h>

#include "base/arena.h"
#include "impact/contact_step.h"
#include "impact/impact.h"
#include "impact/impact_scale.h"

/* An expected event of a contact: a step must end near it. */
struct yielding_event {
    enum {
        EVENT_NONE,
        EVENT_PASSING, /* an indentation at which the loading curve has a kink */
        EVENT_PEAK     /* the largest indentation, from which on the contact unloads */
    } kind;
    double time;        /* s */
    double within;      /* the step's end must be this near, s */
    double indentation; /* the passed one; that of the peak on its step; m */
};

/* The contact phase owns the data behind the pointers. */
struct yielding {
    const struct scene *scene; /* with the laws of the outcome */
    struct impact_outcome *outcome;
    struct contact_step *step;         /* the one just solved */
    struct contact_start *now;         /* [contact] */
    const bool *closed;                /* [contact] */
    const struct impact_scale *scales; /* [contact], of closed ones */
    double accuracy;
    bool any; /* a law can yield; false: nothing below is used */

    struct yielding_event *event; /* [contact], the first expected */
    bool approaching;             /* shorter steps lead to an event; */
    int resume;                   /* the level before them */
};

/* The members down to `accuracy` are set. False: out of memory. */
bool yielding_create(struct yielding *yielding, struct arena *arena);

/* The level of the next step, which passes no expected event. */
int yielding_level(const struct yielding *yielding, int level);

/* Looks for events on the step of length h just solved. True: one would be passed, the step must be
 * solved again, at *level. */
bool yielding_passes(struct yielding *yielding, double h, int *level);

/* After a step of length h was accepted: laws at their peak yield, their dents deepen and gaps and
 * indentations count from the new bottom. True: *level is that before the approach. */
bool yielding_meet(struct yielding *yielding, double h, int *level);

/* At the window's end contacts under load yield up to their present indentation. */
void yielding_end(struct yielding *yielding);

#endif
