/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A single contact that remembers (contact/memory.h) on the steps of its contact phase. What it
 * remembers follows the cubic through the nodes exactly, so that the force at a node depends
 * linearly on the indentations d, or on their d^(3/2), of all nodes. */
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
    double stiffness, compliance;   /* of the law, N/m^(3/2); in series with it, m/N */
    struct memory_level *levels[STEP_LEVELS]; /* NULL: not yet */
    double slope[NODES][NODES];               /* of the forces at the nodes, N/m */
    double length;                            /* of the step, s */
    double turn;                  /* share of the step where it begins to shrink; > 1: nowhere */
    struct contact_memory turned; /* there */
    bool parted;                  /* no force since, */
    double touched_at, parted_at; /* the first force, and the end of the last one, s */
    double largest;               /* force since the touch, N */
    double force;                 /* at the present, N */
    double work;                  /* of all forces on the local indentation, J */
};

/* NULL: the scene's contacts do not remember. False: out of memory. */
bool memory_step_create(struct memory_step **step, const struct scene *scene, struct arena *arena);

/* Makes sure of a level. False: out of memory. */
bool memory_step_prepare(struct memory_step *step, int level, struct arena *arena);

/* The contact begins, or closes again: since the last step its surface has recovered freely. */
void memory_step_begin(struct memory_step *step, double time);

/* Indentations at the nodes of a step of a prepared level, from starting values, to a relative
 * change below `last`: d_i + sum_j coupling_ij F_j = target_i. False: no solution. */
bool memory_step_solve(struct memory_step *step, int level, const double (*coupling)[NODES],
                       const double target[NODES], double last, double indentation[NODES],
                       double force[NODES], unsigned long *iterations);

/* The same at the step's end, for the approach there. */
bool memory_step_end(const struct memory_step *step, int level, const double nodes[NODES],
                     double approach, double last, double *indentation, double *force);

/* Whether a contact begins to grow again within the step just solved, by the indentations at its
 * last node and its end: after it has shrunk, or where it touches what was left of its surface. */
bool memory_step_renews(const struct memory_step *step, double last, double end, double end_force);

/* One step that is accepted, which began at `time`: indentations at its start and end, there with
 * the rate and the force. */
struct memory_taken {
    double time;
    int level;
    const double *nodes, *forces; /* [NODES] */
    double start, end, end_rate, end_force;
};

void memory_step_take(struct memory_step *step, const struct memory_taken *taken);

#endif
