/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Plain Coulomb friction on the steps of a contact phase: the bodies' own flexibility is all the
 * tangential compliance there is, so that a contact that sticks is a constraint. The law holds at
 * the four points of Radau's rule, s = 0.089 ... 1, between the rate of the local displacement d of
 * the contact's tangents (scene.h), a vector v, the tangential force T and the normal one N:
 *
 *   |T| <= mu N where v = 0,    T = mu N v/|v| where the surfaces slide.
 *
 * The rates are those of the polynomial of degree five through d at the start, the nodes and the
 * end, which is that of rigid bodies; N follows from the nodes by its cubic, and T's cubic through
 * the points gives the nodes. So where all four points stick the rate is zero at the end, whatever
 * it was, and d there what it was at the start: no rate is left to ring, and no place drifts (a
 * rule that is stiffly accurate; Hairer, Lubich and Roche, The Numerical Solution of
 * Differential-Algebraic Systems by Runge-Kutta Methods, 1989, section 4). A place held at the
 * nodes themselves would multiply a rate that is left by 21 in each step. In bodies with a residual
 * flexibility C the same holds of d - C T: their stiff oscillations are damped where the steps are
 * too long to follow them. */
#ifndef PERCUSS_IMPACT_COULOMB_H
#define PERCUSS_IMPACT_COULOMB_H

#include "base/arena.h"
#include "impact/coupling.h"
#include "impact/slip_way.h"

/* Values and derivatives by the step's own time, of Lagrange's polynomials. */
struct coulomb_points {
    double rate[NODES][WAY_POINTS];      /* [point]: of those through the way's points */
    double node_rate[NODES][WAY_POINTS]; /* [node] */
    double to_node[NODES][NODES];        /* [node]: of those through Radau's points */
    double from_node[NODES][NODES];      /* [point]: of those through the nodes */
    /* The force that the residual flexibility follows goes through that at the start, too. With J
     * the start's force less that of the cubic, the rates have J times `jump` more of it than the
     * polynomial through the way's points has. */
    double at_start[NODES]; /* of the cubic, by its points */
    double jump[NODES];     /* [point] */
};

/* Fall of the rate of a tangent at a point, times the step's length, by a force along a tangent at
 * a point, m/N. */
struct coulomb_response {
    double by[2][2][NODES][NODES];
};

struct coulomb {
    size_t count; /* contacts with friction */
    struct coulomb_points *points;
    struct coulomb_response *level[STEP_LEVELS]; /* [count]; NULL: not yet */
    double (*stuck)[NODES];                      /* [count]: 1 where a point sticks, else 0 */
    double (*force)[2], (*after)[2];             /* [count]: at the present, at the step's end, N */
    double *lost, *losing; /* [count]: by slip so far, and on the step under way, J */
    /* [count]: size of the terms whose sum d is on the step under way, m, and by their rounding
     * that of its forces, N: a short step makes it large */
    double *reach, *rounding;
};

/* Memory for a scene from the arena. False: out of memory. */
bool coulomb_create(struct coulomb *coulomb, const struct scene *scene, struct arena *arena);

/* The responses of a level whose coupling is prepared. False: out of memory. */
bool coulomb_prepare(struct coulomb *coulomb, const struct scene *scene,
                     const struct coupling *coupling, int level, struct arena *arena);

/* A contact phase begins: no contact bears a force. */
void coulomb_begin(struct coulomb *coulomb);

/* The forces of friction `i` under the others: force[j][node] of row t_j, N, to which the way
 * belongs, becomes that of the law. `normal`: of the contact, at the nodes. False: no solution
 * found, the step is too long. */
bool coulomb_solve(struct coulomb *coulomb, const struct scene *scene, size_t i, int level,
                   const struct friction_way *way, const double normal[NODES],
                   double (*force)[NODES]);

/* The step is solved, with this way. */
void coulomb_end(struct coulomb *coulomb, size_t i, const struct friction_way *way,
                 double (*const force)[NODES]);

/* Its end becomes the present. */
void coulomb_take(struct coulomb *coulomb);

#endif
