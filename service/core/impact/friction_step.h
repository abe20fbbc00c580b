/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The tangential forces of contacts with friction on the steps of a contact phase. With micro-slip
 * the law depends on the way (contact/friction.h): it is walked along the polynomials through the
 * step's start and nodes, with points between the nodes, so that no instant of sticking or sliding
 * is looked for: the cells smear them. Plain friction (scene.h) has the law of impact/coulomb.h. */
#ifndef PERCUSS_IMPACT_FRICTION_STEP_H
#define PERCUSS_IMPACT_FRICTION_STEP_H

#include "contact/friction.h"
#include "impact/collocation.h"
#include "impact/coulomb.h"
#include "impact/scene.h"

struct friction_step {
    size_t count; /* contacts with friction */
    bool plain;
    struct friction *now;   /* [count]: histories at the present */
    struct friction *along; /* [count]: on the step under way, up to its last node */
    struct friction *after; /* [count]: at its end */
    double (*stuck)[NODES]; /* [count]: stiffness of the cells that stick at the nodes, N/m;
                               plain: 1 where it sticks */
    struct friction_points *points;
    struct coulomb coulomb; /* plain friction: instead of all but `count` and `stuck` */
};

/* Lagrange's polynomials and their slopes at the points of the ways to the nodes, through the start
 * and the nodes; at the end through the end as well. The ways between two nodes may be halved;
 * those from the start to the first and from the last to the end are shorter than these halves. */
struct friction_point {
    double value[NODES + 2], slope[NODES + 2];
};

struct friction_points {
    struct friction_point to_node[NODES], to_middle[NODES - 1], to_end;
};

/* Memory for a scene from the arena, with cells for a relative accuracy of the forces. False: out
 * of memory. */
bool friction_step_create(struct friction_step *step, const struct scene *scene, double accuracy,
                          struct arena *arena);

/* A contact phase begins, at the rows' local d: the cells of all contacts, open, by their laws and
 * the largest indentations that are expected, [contact]. */
void friction_step_begin(struct friction_step *step, const struct scene *scene, const double *d,
                         const double *depth);

/* Walks friction `i` from the present to the nodes, where `halved` in two parts from one to the
 * next: force[j][node] becomes the force of row t_j, N, stiffness[j][node] its slope by that row's
 * d, N/m. `normal`: the contact's forces there, as the iteration left them. */
void friction_step_nodes(struct friction_step *step, size_t i, const struct friction_way *way,
                         bool halved, const double normal[NODES], double (*force)[NODES],
                         double (*stiffness)[NODES]);

/* The same from the last node to the end. */
void friction_step_end(struct friction_step *step, size_t i, const struct friction_way *way,
                       double normal, double force[2], double stiffness[2]);

/* The law of a contact has yielded at the present: its dent has deepened (m). */
void friction_step_deepen(struct friction_step *step, const struct scene *scene, size_t contact,
                          double deeper);

/* The end becomes the present. */
void friction_step_take(struct friction_step *step);

/* Of the forces of friction `i` on the step under way by the rounding of what they follow from, N.
 */
double friction_step_rounding(const struct friction_step *step, size_t i);

/* At the present, of friction `i`: lost by slip so far and stored, J; the tangential force, N. */
double friction_step_lost(const struct friction_step *step, size_t i);
double friction_step_stored(const struct friction_step *step, size_t i);
void friction_step_force(const struct friction_step *step, size_t i, double force[2]);

#endif
