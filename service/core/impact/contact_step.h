/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The steps of a contact phase: the forces at the nodes are the only unknowns, the modes between
 * them are exact. */
#ifndef PERCUSS_IMPACT_CONTACT_STEP_H
#define PERCUSS_IMPACT_CONTACT_STEP_H

#include <stdbool.h>

#include "base/watch.h"
#include "impact/carrier.h"
#include "impact/coupling.h"

struct contact_step {
    double (*indentation)[NODES]; /* [contact] local, at the nodes */
    double (*force)[NODES];
    double (*stiffness)[NODES]; /* of the law, dF/d(indentation) */
    double *end_indentation;    /* [contact] */
    double loss;                /* taken by damping, J */
    unsigned long iterations;   /* Newton's, since creation */
    double last_change;         /* relative, see node_solver.h */

    struct carrier carrier;
    struct coupling coupling;
    double (*target)[STEP_POINTS]; /* approaches without force */
    double (*taken)[STEP_POINTS];  /* what the forces take from them */
    double *matrix;                /* contacts^2 */
    double *together; /* (contacts NODES)^2: NULL until contacts had to be solved for at once */
    double *approach, *end_force;
    struct arena *arena;
    struct pace *pace; /* asked before a level's tables are made; NULL (as created): nobody */
};

/* Memory for a scene from the arena. `accuracy`: relative, of the forces; 0: to rounding. False:
 * out of memory. */
bool contact_step_create(struct contact_step *step, const struct scene *scene, double accuracy,
                         struct arena *arena);

/* Local values of a contact at the start of a step: starting values of the iteration. */
struct contact_start {
    double indentation; /* m */
    double rate;        /* m/s */
    double curvature;   /* m/s^2 */
    double bend;        /* its rate, m/s^3 */
};

enum contact_step_end {
    STEP_SOLVED,
    STEP_UNSOLVED, /* no solution was found: it is too long */
    STEP_STOPPED,  /* by the pace */
    STEP_MEMORY    /* it ran out */
};

/* Solves a step of a level from `motion`, which is not changed; `start` by contact. From the first
 * one on the motion's modes are the step's, until contact_step_leave. */
enum contact_step_end contact_step_solve(struct contact_step *step, const struct scene *scene,
                                         const struct motion *motion, int level,
                                         const struct contact_start *start);

/* Makes the end of the step just solved the present. */
void contact_step_take(struct contact_step *step, const struct scene *scene, struct motion *motion);

/* Ends a phase, after any step, solved, taken or not: the motion is whole at the present. */
void contact_step_leave(struct contact_step *step, const struct scene *scene,
                        struct motion *motion);

/* Energy (J) that damping takes on a step from `motion`, at a level whose tables are ready, under
 * the contacts' forces at the nodes: the quadratic forms of the tables. */
double contact_step_loss(const struct scene *scene, const struct motion *motion, int level,
                         double (*const force)[NODES]);

/* Whether the series compliance of a contact bears a law of that stiffness, N/m: a negative one
 * (see solve/contact_model.h) takes |C| dF/dd < 0.5, else small differences of the approach are large
 * ones of the indentation, and from 1 on there are several. */
bool contact_bears(const struct scene *scene, size_t contact, double stiffness);

/* Local indentations and forces of all contacts for approaches d: F_i = law_i(d_i - sum_j C_ij F_j)
 * with the residual flexibility C. `indentation` holds starting values; `matrix`: contacts^2,
 * scratch. False: no solution found. */
bool contact_local_indentation(const struct scene *scene, const double *approach,
                               double *indentation, double *force, double *matrix);

#endif
