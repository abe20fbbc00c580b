/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Frictionless contact of two bodies whose contact surfaces have nodes at the same radii: each pair
 * of nodes may not interpenetrate. Impulses that close a pair exactly at the end of a step
 * (Carpenter, Taylor and Katona 1991): no penalty stiffness, no influence on the stable step,
 * momentum exact. The normal is the axis and nodes keep their partner: exact to (contact radius /
 * radius of curvature)^2, as small strains are. */
#ifndef PERCUSS_FE_NODE_CONTACT_H
#define PERCUSS_FE_NODE_CONTACT_H

#include "fe/dynamics.h"

struct node_contact {
    size_t pairs;
    size_t *at[DYNAMICS_BODIES];    /* index into y and v of the axial coordinate, by pair */
    double *scale[DYNAMICS_BODIES]; /* 1 / sqrt(m) */
    double *gap;                    /* undeformed, m */
    double *mass;                   /* reduced mass of the pair, kg */
    double *closing;                /* rate after the last step, m/s */
    double impulse;                 /* sum so far, N s */
    double loss;   /* work of the impulses at the mean rate of a step: of closing pairs, J */
    bool outgrown; /* the outermost pair has closed: the patch was too small */
};

/* Pairs the first `fine` contact nodes of both bodies. OK, INTERNAL without memory, BAD_REQUEST for
 * meshes whose contact nodes lie at different radii. */
enum percuss_status node_contact_create(const struct dynamics *dynamics, struct arena *arena,
                                        struct node_contact *contact, struct fault *fault);

/* After a kick: impulses on all pairs that would otherwise overlap at the end of the smallest step.
 * Returns their sum, N s. */
double node_contact_close(struct node_contact *contact, struct dynamics *dynamics);

#endif
