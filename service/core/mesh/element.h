/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Finite elements of second order: shape functions and quadrature, nodes in Gmsh's order. Natural
 * coordinates run from 0 to 1 in a tetrahedron (corner 0 at the origin, corners 1 to 3 on the
 * axes), from -1 to 1 in a hexahedron; in a wedge x and y from 0 to 1 over its triangles, z from -1
 * to 1. */
#ifndef PERCUSS_MESH_ELEMENT_H
#define PERCUSS_MESH_ELEMENT_H

#include "mesh/solid_mesh.h"

enum { ELEMENT_MOST_POINTS = 27 };

/* Points of quadrature with the shape functions there: fourteen of degree 5 for a tetrahedron,
 * three a direction for a hexahedron, seven times three for a wedge. All weights are positive, so
 * that no mass matrix is indefinite. */
struct element_rule {
    size_t node_count, point_count;
    double at[ELEMENT_MOST_POINTS][3];
    double weight[ELEMENT_MOST_POINTS];
    double shape[ELEMENT_MOST_POINTS][ELEMENT_MOST_NODES];
    double gradient[ELEMENT_MOST_POINTS][ELEMENT_MOST_NODES][3]; /* natural */
};

/* Values of an element at one point. */
struct element_point {
    double volume;                          /* det J, times the weight for a point of quadrature */
    double position[3];                     /* m */
    double gradient[ELEMENT_MOST_NODES][3]; /* of the shape functions, 1/m; 0 where det J = 0 */
};

static inline size_t element_node_count(enum element_type type)
{
    static const size_t COUNTS[ELEMENT_TYPES] = {10, 20, 27, 15};
    return COUNTS[type];
}

/* The first nodes of an element are its corners. */
static inline size_t element_corner_count(enum element_type type)
{
    static const size_t COUNTS[ELEMENT_TYPES] = {4, 8, 8, 6};
    return COUNTS[type];
}

/* In natural coordinates. */
static inline double element_natural_volume(enum element_type type)
{
    return type == ELEMENT_TET10 ? 1.0 / 6.0 : type == ELEMENT_WEDGE15 ? 1.0 : 8.0;
}

/* Natural coordinates of a node. */
void element_node(enum element_type type, size_t node, double at[3]);

/* The corners whose middle a node is; false: it is a corner, or that of a face or of the element.
 */
bool element_edge(enum element_type type, size_t node, size_t ends[2]);

/* Shape functions and their natural gradients at a point. */
void element_shapes(enum element_type type, const double at[3], double *shape,
                    double (*gradient)[3]);

void element_rule_make(enum element_type type, struct element_rule *rule);

/* Points of an element's nodes, in its order. */
void element_points(const struct solid_mesh *mesh, size_t element,
                    double points[ELEMENT_MOST_NODES][3]);

/* Maps shape functions and natural gradients to space. */
void element_map(size_t node_count, double (*points)[3], const double *shape, double (*gradient)[3],
                 struct element_point *result);

/* The same at a point of quadrature, `volume` weighted. */
void element_at(const struct element_rule *rule, size_t point, double (*points)[3],
                struct element_point *result);

#endif
