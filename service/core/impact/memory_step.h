/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a contact remembers (contact/memory.h) along the steps of its contact phase. It
 * follows the cubic through the nodes exactly, so that the force at a node depends linearly on the
 * indentations d, or on their d^(3/2), of all nodes. */
#ifndef PERCUSS_IMPACT_MEMORY_STEP_H
#define PERCUSS_IMPACT_MEMORY_STEP_H

#include "base/arena.h"
#include "contact/memory.h"
#include "impact/collocation.h"
#include "impact/scene.h"
#include "impact/step_table.h"

/* Of the relaxation's terms on a step of a level: what is left at a point of a memory at the start,
 * and what the values at the nodes add to it. */
struct memory_level {
    double kept[RELAXATION_MOST][STEP_POINTS];
    double by[RELAXATION_MOST][STEP_POINTS][NODES];
    double all[STEP_POINTS][NODES]; /* sum of share times by */
    /* of the modes of recovery: what is left of each at a point, and what forces at the nodes, over
     * the stiffness, add at the end */
    double fades[STEP_POINTS][RELAXATION_MOST];
    double pressed[RELAXATION_MOST][NODES];
};

struct memory_step {
    struct recovery_modes modes;
    struct contact_memory memory;   /* where the step begins */
    double time;                    /* there, s from the stated instant */
    double left[STEP_POINTS][3];    /* shape of the free surface, contact/recovery.h, */
    double middle[RELAXATION_MOST]; /* and its terms in the middle where the step begins */
    double stiffness;               /* of the law, N/m^(3/2) */
    struct memory_level *levels[STEP_LEVELS]; /* NULL: not yet */
    int level;                                /* of the step */
    double turn;                  /* share of the step where it begins to shrink; > 1: nowhere */
    struct contact_memory turned; /* there */
};

/* Of a law that remembers; the step stays where it is. */
void memory_step_create(struct memory_step *step, const struct contact_law *law);

/* Makes sure of a level. False: out of memory. */
bool memory_step_prepare(struct memory_step *step, int level, struct arena *arena);

/* A contact phase begins: since the last step the surface has recovered freely. True: and is not at
 * rest. */
bool memory_step_begin(struct memory_step *step, double time);

/* A step of a prepared level, without a turn yet. */
void memory_step_start(struct memory_step *step, int level);

/* Forces (N) at the nodes and the end of the step for indentations there, and their slopes,
 * [point][by the indentation at]. */
void memory_step_forces(const struct memory_step *step, const double indentation[STEP_POINTS],
                        double force[STEP_POINTS], double slope[STEP_POINTS][STEP_POINTS]);

/* Finds the turn for the indentations at the points. False: there is none, and was none before. */
bool memory_step_turns(struct memory_step *step, const double indentation[STEP_POINTS]);

/* One step that is accepted, which began at `time`: the indentation at its end with the rate and
 * the force there. */
struct way_taken {
    double time;
    int level;
    const double *nodes, *forces; /* [NODES] */
    double end, end_rate, end_force;
};

/* Whether the contact begins to grow again within the step just solved: after it has shrunk, or
 * where it touches what was left of its surface; `parted`: it bore no force before. */
bool memory_step_renews(const struct memory_step *step, const struct way_taken *step_ends,
                        bool parted);

/* `parted`: it bears none at the end. */
void memory_step_take(struct memory_step *step, const struct way_taken *taken, bool parted);

#endif
