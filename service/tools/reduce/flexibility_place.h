/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A mesh's surface as the flexibility needs it: quadrature over its faces, its sharp edges, and the
 * places where a force of 1 N presses with the half-space's field that is split off there. */
#ifndef PERCUSS_REDUCE_FLEXIBILITY_PLACE_H
#define PERCUSS_REDUCE_FLEXIBILITY_PLACE_H

#include <stdbool.h>
#include <stddef.h>

#include "mesh/solid_mesh.h"
#include "mesh/surface.h"
#include "model/boussinesq3.h"

/* Quadrature over the faces: triangles of degree 6 (a quadrilateral is two). */
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

/* Loads at a place: along the inward normal of the mesh's own face, and along both tangents. */
enum { FLEXIBILITY_LOADS = 3 };

struct flexibility_place {
    size_t face;
    double u, v;             /* local coordinates */
    struct boussinesq3 load; /* along the inward normal */
    double along[2][3];      /* tangents, unit */
    int loads;               /* wanted: the normal one (1), or all */
    size_t part;             /* of the mesh: the load has its material */
    bool flat;               /* the face is plane */
    double curvature[9];     /* of the mesh's face, > 0 where convex, 1/m */
    double rim;              /* the face's radius about the point: mean of its logarithm, m */
    double cut;              /* curved: no energy is counted within this radius, m */
    double edge;             /* distance to the nearest sharp edge, INFINITY: none, m */
    double wall;             /* how thick the body is there, INFINITY: cannot be seen, m */
    double element;          /* mean edge of the face, m */
};

/* The direction of a load. */
const double *flexibility_place_direction(const struct flexibility_place *place, int load);

/* The half-space's field of a load (boussinesq3.h); NULL: not wanted. */
void flexibility_place_field(const struct flexibility_place *place, int load, const double x[3],
                             double displacement[3], double stress[6]);

/* Stress that the reach adds to it, and what it adds to the loaded point's displacement along the
 * load, m/N; no others. */
void flexibility_place_added_stress(const struct flexibility_place *place, int load,
                                    const double x[3], double stress[6]);
double flexibility_place_added(const struct flexibility_place *place, int load);

/* The wall is too thin for the mesh: elements 2.5 times as long and longer. Of the compliance of
 * plates of 1 and 2 mm without their modes the mesh's own solution misses 2 % with elements 1.5
 * times as long as they are thick, 4 to 10 % (twice), 34 to 40 % (4 times), 55 % (8 times). */
bool flexibility_place_thin(const struct flexibility_place *place);

/* A mass on that node is too close to the place: within an element of it. */
bool flexibility_place_beside(const struct flexibility_place *place, const double node[3]);

/* A mass of the mesh is: the flexibility there is that of how the mass is fixed, which the mesh
 * does not know. */
bool flexibility_place_massive(const struct flexibility_place *place,
                               const struct solid_mesh *mesh);

/* Patches of a surface and their sharp edges. Sharp edges are those that a patch has alone. Owns
 * its arrays. */
struct flexibility_edges {
    size_t count;
    double (*points)[3][3]; /* [count]: end, middle, end, m */
    size_t *patches;        /* [count] */
    bool *hollow;           /* [count]: the body is more than a half-space there */
    bool *plane;            /* [patch_count]: the patch is plane */
    double
        *reach; /* [face_count]: how far the face reaches from them, at most the mesh's size, m */
};

/* False: no memory. */
bool flexibility_edges_make(struct flexibility_edges *edges, const struct surface_rule *rule);
void flexibility_edges_free(struct flexibility_edges *edges);

/* Distance from x to the nearest edge of the patch, INFINITY: it has none. */
double flexibility_edges_distance(const struct flexibility_edges *edges, size_t patch,
                                  const double x[3]);

/* From so near to an edge on the mesh knows the flexibility on a face, m: a third of an element, or
 * of half a wall. */
double flexibility_edges_known(const struct flexibility_edges *edges, size_t face);

/* The place at (u, v) of a face, for the normal load. On a patch that is not plane it is moved off
 * the face's rim, where the mesh's surface has a kink. */
struct flexibility_place flexibility_place_make(const struct surface_rule *rule,
                                                const struct flexibility_edges *edges, size_t face,
                                                double u, double v);

#endif
