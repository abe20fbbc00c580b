/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A curved face of 6, 8 or 9 nodes, in the order of enum surface_face_type (mesh/surface.h): three
 * corners, then the mid nodes of edges 01 12 20; or four corners, the mid nodes of 01 12 23 30, and
 * the middle. Local coordinates: a triangle's corners are (0, 0) (1, 0) (0, 1); a quadrilateral's
 * (-1, -1) (1, -1) (1, 1) (-1, 1). */
#ifndef PERCUSS_MODEL_FACET_H
#define PERCUSS_MODEL_FACET_H

#include <stdbool.h>

enum { FACET_MOST_NODES = 9 };

/* The point of a face that is nearest to a given one. */
struct facet_foot {
    double u, v;
    double point[3];
    double distance; /* >= 0 */
    bool at_rim;     /* it lies on an edge of the face: a neighbour may be nearer */
};

/* Shape functions and their derivatives, [count] each; du and dv may be NULL. */
void facet_shape(int count, double u, double v, double *n, double *du, double *dv);

/* Local coordinates of a node. */
void facet_node(int count, int node, double *u, double *v);

/* Point, and the vector x_u x x_v: outward, of the length dA/(du dv). Either may be NULL. */
void facet_place(int count, const double (*points)[3], double u, double v, double point[3],
                 double area[3]);

/* Shape functions with point and area at once. */
void facet_look(int count, const double (*points)[3], double u, double v, double *n,
                double point[3], double area[3]);

/* Whether it is on the face, or beyond its edges by no more than `margin`. */
bool facet_is_inside(int count, double u, double v, double margin);

/* The middle control value of the parabola with these values at both ends and in the middle
 * (Bernstein's form): it stays between the control values. */
static inline double facet_control(double from, double middle, double to)
{
    return 2.0 * middle - 0.5 * (from + to);
}

/* A lower bound, on the face, of a function with the values h at the nodes: the lowest of its
 * control values (Bernstein's form). */
double facet_lowest(int count, const double *h);

/* The nearest point of the face, by Newton's method. */
struct facet_foot facet_closest(int count, const double (*points)[3], const double p[3]);

#endif
