/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* List of the sub-impacts of a contact, kept during the solution. */
#ifndef PERCUSS_IMPACT_TRACK_H
#define PERCUSS_IMPACT_TRACK_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "contact/law.h"
#include "impact/collocation.h"
#include "impact/result.h"

/* One contact. */
struct track {
    struct sub_impact *list; /* PERCUSS_MAX_SUB_IMPACTS */
    size_t count;            /* exact, may exceed the list */
    double impulse;          /* of all of them, N s */
    double moment;           /* of the force over time from the stated instant, N s^2 */
    double end_time;         /* of the last one */
    double tangential[2];    /* impulse along the tangents, N s */
    /* work of the force on the rigid gap while it shrinks, and by it while it grows, J */
    double compressed, released;
    struct sub_impact open; /* the one under way */
    /* effect of omitted inertia and viscosity: integrals of K' F' (N^2/(m s)) and of F'^2 (N^2/s)
     * over all of them, K the law's stiffness */
    double inertia, viscosity;
    bool stuck,
        slid; /* friction of the one under way: at some instant not all of it slid, all did */
    double largest_force; /* of the one under way, where its law is lossy; 0: else */
    double deepened; /* growth of the dent since the touch, m; indentations in the list count from
                       its bottom at that touch */
};

/* Memory from the arena. False: out of memory. */
bool track_create(struct track *track, struct arena *arena);

void track_clear(struct track *track);

void track_open(struct track *track, double time, double gap_rate);

/* One contact on one step: local indentations at its start, nodes and end, forces at the nodes. */
struct track_values {
    double start, end;
    const double *indentation, *force, *stiffness; /* [NODES] */
};

/* Adds a step of length h from `time`. */
void track_step(struct track *track, double time, double h, const struct track_values *values);

/* Adds the work on the rigid gap, whose rates at the nodes these are. */
void track_work(struct track *track, double h, const double *force, const double *rate);

/* Adds the tangents' forces at the nodes of a step beside the normal ones; `stuck`: the stiffness
 * of what sticks there, 0 where all of the contact slides. */
void track_slide(struct track *track, double h, const double *normal, double (*const force)[NODES],
                 const double *stuck);

/* Ends the one under way: separation, or the end of the window. One of a lossy law that has borne
 * no force, above a surface that has not come back, is none. */
void track_close(struct track *track, const struct contact_law *law, double time, double gap_rate);

/* Sets `negligible` of every listed one: below 1 % of the contact's impulse. */
void track_mark_negligible(struct track *track);

#endif
