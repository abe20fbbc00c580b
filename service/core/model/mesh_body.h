/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A body reduced from a mesh, with the contents of its file (mesh/body_file.h): immutable, shared
 * by all variants of the body. Axes are the mesh's; the origin is the centre of mass. */
#ifndef PERCUSS_MODEL_MESH_BODY_H
#define PERCUSS_MODEL_MESH_BODY_H

#include <stdbool.h>
#include <stddef.h>

#include "model/material.h"

enum { MESH_BODY_FACE_NODES = 9, MESH_BODY_WEIGHTS = 12 };

/* A piece of the surface, see mesh/surface.h for the order of nodes. */
struct mesh_body_face {
    unsigned char count;                  /* 6, 8 or 9 nodes */
    unsigned char material;               /* index */
    unsigned patch;                       /* faces of one patch meet smoothly */
    unsigned nodes[MESH_BODY_FACE_NODES]; /* of the surface */
    /* at each of its nodes */
    float normal[MESH_BODY_FACE_NODES][3];    /* outward */
    float curvature[MESH_BODY_FACE_NODES][6]; /* xx yy zz xy yz zx, 1/m */
    float doubt[MESH_BODY_FACE_NODES];        /* of the normal, rad */
    /* flexibility for a unit force along the normal, beyond that of the half-space of the face's
     * material, without that of the first `removed` modes, m/N (MESH: C_K0); NAN: not known there
     */
    double flexibility[MESH_BODY_FACE_NODES];
    /* and its change with the logarithm of the contact's radius, m/N: C(a) = flexibility +
     * slope ln(cut / a) */
    double flexibility_slope[MESH_BODY_FACE_NODES];
    /* the same between all directions, beyond the half-space's under a normal and a tangential
     * force: xx yy zz xy yz zx, m/N; along the normal it is `flexibility`. NAN: not known. */
    float tensor[MESH_BODY_FACE_NODES][6];
};

/* A box about faces, or about the two boxes [first] and [first + 1]. */
struct mesh_box {
    float low[3], high[3];
    unsigned first, count; /* count > 0: faces order[first] .. */
};

/* A piece of a sharp edge. */
struct mesh_rim {
    float from[3], to[3];
};

/* A place of the surface whose flexibility was solved for after the body was made: as in struct
 * mesh_body_face, it holds for contacts around `point` (mesh_body_added_at). */
struct mesh_body_site {
    unsigned face;
    double point[3];    /* on the surface, m, from the centre of mass */
    double flexibility; /* m/N; NAN: the mesh cannot say it there */
    double tensor[6];   /* m/N; NAN: not known */
};

/* Where a body comes from whose sites are solved for later. */
struct mesh_body_origin {
    char *mesh;    /* path of the mesh; from malloc, as the next one */
    char *options; /* how it is read, see service/tools/reduce/recipe.h */
    char hash[65]; /* SHA-256 of mesh, materials and supports */
};

struct mesh_body {
    /* provenance */
    char hash[65];       /* SHA-256 of its sources: mesh, materials, supports, settings */
    char source[256];    /* file's name, version of percuss-reduce, date */
    double unit;         /* m of one unit of the mesh's file */
    double centre[3];    /* centre of mass in the mesh's frame, m */
    double volume;       /* m^3 */
    double mass;         /* kg */
    double inertia[9];   /* about the centre of mass, kg m^2, row-major */
    bool supported;      /* nodes are held: it does not move as a whole */
    char supports[128];  /* names of the held sets */
    double element_size; /* median edge of the surface, m */
    double cut;          /* contact radius that flexibilities are stated for, m */
    size_t material_count;
    struct material *materials;
    /* vibration */
    size_t mode_count; /* elastic modes, ascending */
    double *omega;     /* [mode_count], rad/s */
    size_t removed;    /* modes without which flexibilities are stated */
    /* surface */
    size_t node_count;
    double (*points)[3]; /* [node_count], m, from the centre of mass */
    float *shapes;       /* [node_count][3][mode_count], 1/sqrt(kg) */
    size_t face_count;
    struct mesh_body_face *faces;
    bool all_ways; /* the faces' tensors are there */
    /* flexibility at single places, where faces have none: solved for when it is asked for */
    char *path;                     /* of its file; NULL: not from a file */
    struct mesh_body_origin origin; /* mesh NULL: all its flexibility stands in its faces */
    size_t added_count;
    struct mesh_body_site *added; /* [added_count], in the order in which they were added */
    /* flexibility between places, for several contacts: the response at one surface site to a
     * unit normal force at another, without the first `removed` modes, m/N; good from `near` on */
    size_t site_count;
    unsigned *site_face;                        /* [site_count] */
    double (*site_point)[3], (*site_normal)[3]; /* [site_count] */
    float *between;                             /* [site_count][site_count]; NULL: not computed */
    double near;                                /* m */
    /* search structures of the surface: mesh_surface_prepare makes them from the faces */
    size_t box_count;
    struct mesh_box *boxes; /* a tree */
    unsigned *order;        /* [face_count]: faces in the order of the leaves */
    size_t patch_count;
    size_t *rim_first; /* [patch_count + 1]: a patch's sharp edges are rims[rim_first[p]] .. */
    struct mesh_rim *rims;
    double area;            /* of the surface, m^2 */
    double low[3], high[3]; /* extent from the centre of mass, m */
};

/* Whether the data of a file are consistent: PERCUSS_OK, or PERCUSS_BAD_REQUEST with the dataset
 * and the allowed values. The reader of the file checks single numbers. */
enum percuss_status mesh_body_check(const struct mesh_body *body, struct fault *fault);

/* Whether a contact of the radius body->cut would have a positive compliance in all directions at a
 * node of a face, whose tensor is known there. */
bool mesh_body_tensor_possible(const struct mesh_body *body, const struct mesh_body_face *face,
                               int node);

/* Whether flexibilities are solved for at places that are asked for, and the faces have none. */
static inline bool mesh_body_is_later(const struct mesh_body *body)
{
    return body->origin.mesh != NULL;
}

/* Distance of a point from the sharp edges of a patch, m; INFINITY: it has none. The body is
 * prepared (mesh_surface_prepare). */
double mesh_body_rim_distance(const struct mesh_body *body, unsigned patch, const double p[3]);

/* The first added site on the face's patch whose flexibility holds at a point of the face (m, the
 * file's frame and size), so that further ones change no answer there: within a tenth of half a
 * thickness (volume over surface), as declared normals of named sites do, and a tenth of its
 * distance from a sharp edge. Without one, the first of any patch that the mesh could not say and
 * that is there: on an edge a place belongs to both. NULL: none. */
const struct mesh_body_site *mesh_body_added_at(const struct mesh_body *body, unsigned face,
                                                const double point[3]);

/* Gives a symmetric tensor, xx yy zz xy yz zx, the value n.tensor n along a unit vector. */
void mesh_body_set_normal(const double n[3], double value, double tensor[6]);

/* Frees a body and its arrays, all of which came from malloc; NULL is allowed. */
void mesh_body_free(struct mesh_body *body);

#endif
