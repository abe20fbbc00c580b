/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A sphere above the middle of a round beam's side, both meshed, with nodes that face each other
 * where they may touch. */
#ifndef PERCUSS_SPATIAL_PAIR_H
#define PERCUSS_SPATIAL_PAIR_H

#include "contact/hertz.h"
#include "spatial/moving.h"

enum { PAIR_BEAM, PAIR_SPHERE };

struct pair_input {
    struct material materials[2]; /* beam, sphere */
    double beam_radius, beam_length, sphere_radius;
    double velocity; /* m/s, the highest approach that the mesh is for */
    size_t bricks;   /* along half the beam */
    size_t across;   /* on 0.7 of its radius: 1 ... 4; 1 makes frequencies 9e-4 high, 2 1e-4 */
    unsigned levels; /* halvings at the contact */
};

/* Owns its arrays. */
struct pair {
    struct pair_input input;
    struct hertz_contact hertz;
    double axes[2]; /* m, of the ellipse within which nodes may touch */
    struct refined meshes[2];
    struct system3 systems[2];
    struct pressed pressed[2]; /* node i of one faces node i of the other */
    double *initial;           /* m: gaps of the touching bodies */
    double mass[2];            /* kg, of the whole bodies */
    size_t axis;               /* the beam's node on its axis below the contact */
};

/* OK; BAD_REQUEST naming the field and what is allowed; INTERNAL: no memory. */
enum percuss_status pair_create(const struct pair_input *input, struct pair *pair,
                                struct fault *fault);
void pair_free(struct pair *pair);

#endif
