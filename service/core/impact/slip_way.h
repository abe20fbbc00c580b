/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The way of a contact's slip on a step, by the polynomials through the step's start and nodes, or
 * through its end as well, and the walk of the cells (contact/friction.h) from point to point of
 * it. */
#ifndef PERCUSS_IMPACT_SLIP_WAY_H
#define PERCUSS_IMPACT_SLIP_WAY_H

#include "contact/friction.h"
#include "impact/collocation.h"

/* The local d of a contact's rows n, t1, t2 (scene.h) at the start, the nodes and the end of a
 * step, m. */
struct friction_way {
    double start[3];
    const double *nodes[3]; /* [NODES] */
    double end[3];
    double time; /* of the step, s */
};

/* The start, the nodes and the end. */
enum { WAY_POINTS = NODES + 2 };

/* Lagrange's polynomials and their slopes at an instant of the step's own time, of the first
 * `count` places: the start, the nodes and the end. */
struct slip_point {
    double at;
    size_t count;
    double value[WAY_POINTS], slope[WAY_POINTS];
};

/* The start, the nodes and the middles between two of them; the last node and the end by the
 * polynomials through the end. The parts from the start to the first node and from the last one to
 * the end are shorter than the halves between two. */
struct slip_points {
    struct slip_point start, node[NODES], middle[NODES - 1], last, end;
    double node_rate[NODES][WAY_POINTS]; /* by those through all places */
};

void slip_points_make(struct slip_points *points);

/* Where a way is at a point: indentation and displacement (m), and their rates by the step's own
 * time. */
struct slip_place {
    double at, value[3], rate[3];
};

struct slip_place slip_place_at(const struct friction_way *way, const struct slip_point *point);

/* Work of a force, a cubic through its values at the nodes, on displacements along one tangent at
 * all places. */
double slip_work(const struct slip_points *points, const double displacement[WAY_POINTS],
                 const double force[NODES]);

/* Walks on from one place of the way to a point, which becomes the place; through the instant
 * between them at which a contact that slides begins to stick. force[j] becomes the tangential
 * force, N. */
void slip_walk(struct friction *friction, const struct friction_way *way,
               const struct slip_point *to, struct slip_place *now, double force[2]);

#endif
