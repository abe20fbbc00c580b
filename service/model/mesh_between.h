/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The static response of a meshed body at one place of its surface to a force at another, from the
 * sites of its file. */
#ifndef PERCUSS_MODEL_MESH_BETWEEN_H
#define PERCUSS_MODEL_MESH_BETWEEN_H

#include "model/mesh_body.h"

/* A unit force normal to the surface, in the file's frame and size. */
struct mesh_push {
    unsigned face;
    double point[3], direction[3];
};

/* Displacement (m/N) along the one per newton of the other, without the first mesh->removed modes,
 * of the file's own size and materials; NAN: the file says nothing of it. */
double mesh_between(const struct mesh_body *mesh, const struct mesh_push *i,
                    const struct mesh_push *j);

#endif
