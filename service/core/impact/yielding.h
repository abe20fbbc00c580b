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

/* What is expected of a contact: a step must end near it. */
struct yielding_event {
    enum {
        EVENT_NONE,
        EVENT_PASSING, /* an indentation at which the loading curve has a kink */
        EVENT_PEAK     /* the largest indentation, from which on the contact unloads */
    } kind;
    double time;        /* s */
    double within;      /* how near, s */
    double indentation; /* that is passed; of the peak, on the step that has it; m */
};

/* What it looks at belongs to the contact phase. */
struct yielding {
    const struct scene *scene; /* with the laws of the outcome */
    struct impact_outcome *outcome;
    const struct contact_step *step;   /* the one just solved */
    struct contact_start *now;         /* [contact] */
    const bool *closed;                /* [contact] */
    const struct impact_scale *scales; /* [contact], of closed ones */
    double accuracy;
    bool any; /* a law can yield; false: nothing below is used */

    struct yielding_event *event; /* [contact], the first one */
    bool approaching;             /* an event, by shorter steps ... */
    int resume;                   /* ... than those of this level before */
};

/* The first members are set. False: out of memory. */
bool yielding_create(struct yielding *yielding, struct arena *arena);

/* The level of the next step: expected events are not passed. */
int yielding_level(const struct yielding *yielding, int level);

/* Looks for events on the step of length h just solved. True: one would be passed, the step must be
 * solved again, at *level. */
bool yielding_passes(struct yielding *yielding, double h, int *level);

/* After a step of length h was accepted: laws whose event has come yield, their dents deepen and
 * gaps and indentations count from the new bottom. True: *level is that of before. */
bool yielding_meet(struct yielding *yielding, double h, int *level);

/* The window ends within a contact that is being loaded: what was dissipated so far. */
void yielding_end(struct yielding *yielding);

#endif
