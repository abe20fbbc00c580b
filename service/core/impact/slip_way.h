/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The way of a contact's slip on a step, by the polynomials through the step's start and nodes, or
 * through its end as well, and the walk of the cells (contact/friction.h) from point to point of
 * it. */
#ifndef PERCUSS_IMPACT_SLIP_WAY_H
#define PERCUSS_IMPACT_SLIP_WAY_H

#include "contact/friction.h"
#include "impact/collocation.h"
#include "impact/coulomb.h"

/* Lagrange's polynomials and their slopes at an instant of the step's own time, of the first
 * `count` places: the start, the nodes and the end. */
struct slip_point {
    double at;
    size_t count;
    double value[NODES + 2], slope[NODES + 2];
};

/* The start, the nodes and the middles between two of them; the last node and the end by the
 * polynomials through the end. The parts from the start to the first node and from the last one to
 * the end are shorter than the halves between two. */
struct slip_points {
    struct slip_point start, node[NODES], middle[NODES - 1], last, end;
};

void slip_points_make(struct slip_points *points);

/* Where a way is at a point: indentation and displacement (m), and their rates by the step's own
 * time. */
struct slip_place {
    double at, value[3], rate[3];
};

struct slip_place slip_place_at(const struct friction_way *way, const struct slip_point *point);

/* Walks on from one place of the way to a point, which becomes the place; through the instant
 * between them at which a contact that slides begins to stick. force[j] becomes the tangential
 * force, N. */
void slip_walk(struct friction *friction, const struct friction_way *way,
               const struct slip_point *to, struct slip_place *now, double force[2]);

#endif
