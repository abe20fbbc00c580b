/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The tangential forces of contacts with friction on the steps of a contact phase. With micro-slip
 * the law depends on the way (contact/friction.h; impact/circle_step.h where the contact has a
 * loss): it is walked along the polynomials through the step's start and nodes (impact/slip_way.h).
 * Where a slide ends is looked for; the cells smear all other instants at which some begin to stick
 * or to slide. Plain friction (scene.h) has the law of impact/coulomb.h. */
#ifndef PERCUSS_IMPACT_FRICTION_STEP_H
#define PERCUSS_IMPACT_FRICTION_STEP_H

#include "contact/friction.h"
#include "impact/circle_step.h"
#include "impact/collocation.h"
#include "impact/coulomb.h"
#include "impact/scene.h"
#include "impact/slip_way.h"

struct friction_step {
    size_t count; /* contacts with friction */
    bool plain;
    struct friction *now;   /* [count]: histories at the present */
    struct friction *along; /* [count]: on the step under way, up to its last node */
    struct friction *after; /* [count]: at its end */
    double (*stuck)[NODES]; /* [count]: stiffness of the cells that stick at the nodes, N/m;
                               plain: 1 where it sticks */
    double (
        *across)[NODES]; /* [count]: slope of each tangent's force there by the other's d, N/m */
    /* of the step before, at its last three nodes and its end: the forces of the normal and the
     * tangents, N, [3 count], and its level */
    double (*taken)[NODES];
    int level;
    struct slip_points *points;
    struct circle_step **circles; /* [count]: of contacts whose law has a loss, instead of cells */
    struct coulomb coulomb;       /* plain friction: instead of all but `count` and `stuck` */
};

/* Memory for a scene from the arena, with cells for a relative accuracy of the forces. False: out
 * of memory. */
bool friction_step_create(struct friction_step *step, const struct scene *scene, double accuracy,
                          struct arena *arena);

/* A contact phase begins at a time (s), at the rows' local d and their rates: the cells of all
 * contacts, open, by their laws and the largest indentations that are expected, [contact]. */
void friction_step_begin(struct friction_step *step, const struct scene *scene, double time,
                         const double *d, const double *rate, const double *depth);

/* Predicts force[row] of the tangents at the nodes of a step of that level: those of the normals
 * there times the ratio of both as it went on the step before, within the coefficient. */
void friction_step_predict(const struct friction_step *step, const struct scene *scene, int level,
                           double (*force)[NODES]);

/* Walks friction `i` from the present to the nodes: force[j][node] becomes the force of row t_j, N,
 * stiffness[j][node] its slope by that row's d, N/m. Between two nodes the way has two parts, or
 * one where the contact slides throughout and the slip hardly turns. `normal`: the contact's forces
 * there, as the iteration left them. */
void friction_step_nodes(struct friction_step *step, size_t i, const struct friction_way *way,
                         const double normal[NODES], double (*force)[NODES],
                         double (*stiffness)[NODES]);

/* The same from the last node to the end. */
void friction_step_end(struct friction_step *step, size_t i, const struct friction_way *way,
                       double normal, double force[2], double stiffness[2]);

/* Of friction `i`, not plain: whether no cell sticks at the present; and on the step that was
 * walked, at its nodes and its end. */
bool friction_step_slid(const struct friction_step *step, size_t i);
bool friction_step_slides(const struct friction_step *step, size_t i);

/* The law of a contact has yielded at the present: its dent has deepened (m). */
void friction_step_deepen(struct friction_step *step, const struct scene *scene, size_t contact,
                          double deeper);

/* The end becomes the present, of a step of that level with the rows' forces at its nodes and its
 * end. */
void friction_step_take(struct friction_step *step, const struct scene *scene, int level,
                        double (*const force)[NODES], const double *end_force);

/* Of the forces of friction `i` on the step under way by the rounding of what they follow from, N.
 */
double friction_step_rounding(const struct friction_step *step, size_t i);

/* At the present, of friction `i`: lost by slip so far and stored, J; the tangential force, N. */
double friction_step_lost(const struct friction_step *step, size_t i);
double friction_step_stored(const struct friction_step *step, size_t i);
void friction_step_force(const struct friction_step *step, size_t i, double force[2]);

#endif
