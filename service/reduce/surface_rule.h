/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Quadrature over the faces of a mesh's surface: triangles of degree 6 (a quadrilateral is two). */
#ifndef PERCUSS_REDUCE_SURFACE_RULE_H
#define PERCUSS_REDUCE_SURFACE_RULE_H

#include <stdbool.h>
#include <stddef.h>

#include "mesh/solid_mesh.h"
#include "mesh/surface.h"

enum { SURFACE_RULE_POINTS = 12, SURFACE_RULE_MOST = 2 * SURFACE_RULE_POINTS };

/* A triangle in a face's local coordinates. */
struct surface_triangle {
    double corners[3][2];
};

/* Owns its arrays; mesh and surface are borrowed. */
struct surface_rule {
    const struct solid_mesh *mesh;
    const struct surface *surface;
    double shapes[FACE_MOST_NODES + 1][SURFACE_RULE_MOST][FACE_MOST_NODES]; /* by count of nodes */
    size_t *first;        /* [face_count + 1]: a face's points are points[first[f]] .. */
    double (*points)[3];  /* m */
    double (*areas)[3];   /* outward, as large as the point's part of the face, m^2 */
    double (*centres)[3]; /* [face_count] */
    double *radii;        /* [face_count]: farthest node from the centre, m */
};

/* False: no memory. */
bool surface_rule_make(struct surface_rule *rule, const struct solid_mesh *mesh,
                       const struct surface *surface);
void surface_rule_free(struct surface_rule *rule);

/* Points of a face's nodes. */
void surface_rule_nodes(const struct surface_rule *rule, size_t face,
                        double nodes[FACE_MOST_NODES][3]);

/* The triangles that make up a face in local coordinates: returns how many (1, 2). */
size_t surface_rule_triangles(size_t count, struct surface_triangle triangles[2]);

/* Points of the rule in a triangle, and the weights that sum up to its area. */
void surface_rule_place(const struct surface_triangle *triangle, double at[][2], double weights[]);

/* The four triangles of half the size. */
void surface_rule_split(const struct surface_triangle *triangle, struct surface_triangle parts[4]);

/* A sphere that holds points: the centre is their mean; returns the radius. */
double surface_rule_sphere(size_t count, double points[][3], double centre[3]);

#endif
