/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Axisymmetric structured meshes of quadrilaterals, graded towards a contact patch. Every body lies
 * in z <= 0 with the contact point at the origin and z outward; its partner is a mesh of the same
 * kind in its own frame, looked at from the other side. Bodies of the same grade have contact nodes
 * at the same radii as far as `matched`.
 *
 * Around the contact point lies a square core of core x core elements of the length `size`; rings
 * of 2 core elements surround it, each wider than the one inside by `growth`. Nodes are numbered
 * outward ring by ring, so that the matrices are narrow bands of about 4 core. */
#ifndef PERCUSS_FE_MESH_H
#define PERCUSS_FE_MESH_H

#include <stddef.h>
#include <stdint.h>

#include "base/fault.h"

/* Where the rings of a mesh lie: positions along the contact surface and rows along a rod. */

struct mesh_grade {
    double size;    /* m, elements of the core */
    size_t core;    /* elements along a side of the core, 2 ... 200 */
    double growth;  /* of the rings' widths, 1 ... 2 */
    double matched; /* m, contact nodes up to here are the same in every body of this grade */
    double coarse;  /* m, longest element wanted beyond a rod's end region; 0: as in the region */
};

struct mesh_nodes {
    uint32_t *index;
    size_t count;
};

struct mesh {
    size_t nodes, elements;
    double *r, *z;             /* m, by node */
    uint32_t (*quads)[4];      /* nodes of an element, counter-clockwise in (r, z) */
    struct mesh_nodes axis;    /* r = 0, in the order of the node numbers */
    struct mesh_nodes contact; /* the contact surface, outward from the axis */
    struct mesh_nodes far;     /* cylinder: the other end, outward from the axis; half-space:
                                * the hemisphere that bounds it, from the axis to the surface;
                                * sphere: the opposite pole */
};

/* A whole sphere. OK, or BAD_REQUEST naming a grade that does not fit the body (the core at most
 * half the radius), or INTERNAL without memory; then the mesh is empty. The caller frees it. */
enum percuss_status mesh_sphere(double radius, const struct mesh_grade *grade, struct mesh *mesh,
                                struct fault *fault);

/* A whole cylinder or rod hit on its end face; the end region is one radius long (or as long as the
 * body), the rest is rows of `core` elements. */
enum percuss_status mesh_cylinder(double radius, double length, const struct mesh_grade *grade,
                                  struct mesh *mesh, struct fault *fault);

/* The half-ball of radius `extent` below the surface of a half-space (or of a large block). */
enum percuss_status mesh_half_space(double extent, const struct mesh_grade *grade,
                                    struct mesh *mesh, struct fault *fault);

/* Frees the arrays; the mesh is empty then. */
void mesh_free(struct mesh *mesh);

#endif
