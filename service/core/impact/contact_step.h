/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Solves the steps of a contact phase: the nodal forces are the only unknowns, the modes are exact.
 */
#ifndef PERCUSS_IMPACT_CONTACT_STEP_H
#define PERCUSS_IMPACT_CONTACT_STEP_H

#include <stdbool.h>

#include "base/watch.h"
#include "impact/coupling.h"
#include "impact/friction_step.h"
#include "impact/midpoint.h"
#include "impact/way_step.h"

/* Of functions that friction or a lossy law alone need: inline they cost each step without these
 * twenty instructions more, for registers. */
#define NOT_INLINE __attribute__((noinline))

struct contact_step {
    double (*indentation)[NODES]; /* [row] local, at the nodes */
    double (*force)[NODES];
    double (*stiffness)[NODES]; /* of the law, dF/d(indentation) */
    double *end_indentation;    /* [row] */
    double loss;                /* energy lost to damping, J */
    unsigned long iterations;   /* Newton's, since creation */
    double last_change;         /* relative, see node_solver.h */
    int level;                  /* of the step just solved */

    struct way_step *way; /* of contacts whose force depends on their way, else NULL */
    struct midpoint midpoint;
    struct coupling coupling;
    double (*target)[STEP_POINTS]; /* approaches without force */
    double (*taken)[STEP_POINTS];  /* their reductions by the forces */
    double *matrix;                /* contacts^2 */
    double *together;              /* (contacts NODES)^2; NULL before a solution of all at once */
    double *approach, *end_force;
    double *base; /* [row]: plain friction: d of its tangents that the gaps leave out */
    /* with friction: [row] the last change of tangents' displacements, and their forces' relative
     * change that ends the rounds */
    double (*change)[NODES];
    double last_slide;
    struct friction_step *friction; /* NULL: without friction */
    struct arena *arena;
    struct pace *pace; /* asked before a level's tables are made; NULL (as created): none */
};

/* Memory of an empty step, all zero, for a scene from the arena. `accuracy`: relative, of the
 * forces; 0: to rounding. False: out of memory. */
bool contact_step_create(struct contact_step *step, const struct scene *scene, double accuracy,
                         struct arena *arena);

/* Local values of a row at the start of a step: starting values of the iteration. */
struct contact_start {
    double indentation; /* m */
    double rate;        /* m/s */
    double curvature;   /* m/s^2 */
    double bend;        /* rate of curvature, m/s^3 */
};

enum contact_step_end {
    STEP_SOLVED,
    STEP_UNSOLVED, /* no solution: the step is too long */
    STEP_STOPPED,  /* by the pace */
    STEP_MEMORY    /* out of memory */
};

/* Solves a step of a level from `motion`, which is not changed; `start` by row. From the first
 * call on `step` holds the undamped modes, until contact_step_leave. */
enum contact_step_end contact_step_solve(struct contact_step *step, const struct scene *scene,
                                         const struct motion *motion, int level,
                                         const struct contact_start *start);

/* Makes the end of the step just solved the present. */
void contact_step_take(struct contact_step *step, const struct scene *scene, struct motion *motion);

/* Ends a phase after any step, taken or not: the motion holds all modes at the present. */
void contact_step_leave(struct contact_step *step, const struct scene *scene,
                        struct motion *motion);

/* Energy (J) lost to damping on a step from `motion` under the contacts' nodal forces, by the
 * quadratic forms of the level's tables, which must be ready. */
double contact_step_loss(const struct scene *scene, const struct motion *motion, int level,
                         double (*const force)[NODES]);

/* Whether the series compliance C of a contact permits a law of that stiffness, N/m. A negative C
 * (see solve/contact_model.h) needs |C| dF/dd < 0.5: above, small changes of the approach are large
 * ones of the indentation, which is not unique from 1 on. */
bool contact_bears(const struct scene *scene, size_t contact, double stiffness);

/* Local indentations and forces of all contacts for approaches d: F_i = law_i(d_i - sum_j C_ij F_j)
 * with the residual flexibility C. `indentation` holds starting values; `matrix`: contacts^2,
 * scratch. False: no solution found. */
bool contact_local_indentation(const struct scene *scene, const double *approach,
                               double *indentation, double *force, double *matrix);

#endif
