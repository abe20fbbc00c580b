/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The nodes of a surface with their neighbours: a node on a sharp edge is one vertex for each patch
 * that meets there, so that walks from vertex to vertex stay on smooth ground. */
#ifndef PERCUSS_MESH_NET_H
#define PERCUSS_MESH_NET_H

#include <stdbool.h>

#include "mesh/surface.h"

/* Owns its arrays. */
struct net {
    size_t vertex_count;
    size_t *nodes;                       /* [vertex_count], of the mesh */
    double (*normals)[3];                /* [vertex_count]: mean of the faces', unit */
    double *spacing;                     /* [vertex_count]: distance of nodes about it, m */
    bool *left_out;                      /* [vertex_count]: mid nodes that are not on the surface */
    size_t *first;                       /* [vertex_count + 1] */
    size_t *faces;                       /* those at vertex i are faces[first[i]] .. */
    size_t (*vertices)[FACE_MOST_NODES]; /* [face_count]: of each face, in its order;
                                          * SIZE_MAX beyond its nodes */
};

/* False: out of memory. Also counts the edges on curved ground and the straight ones among them.
 */
bool net_make(const struct solid_mesh *mesh, struct surface *surface, struct net *net);

void net_free(struct net *net);

#endif
