/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Explicit dynamics of two axisymmetric bodies, each in its own frame (fe/mesh.h). Elements advance
 * on levels: level k takes steps of step * 2^k. An element acts on its nodes by impulses at its own
 * instants and nodes fly freely between (asynchronous variational integrator, Lew et al. 2004, with
 * nested steps): second order, symplectic, momentum exact.
 *
 * Mass-weighted coordinates y = sqrt(m) u, two a node (r, z). Velocities are those of half a step
 * ago before a kick and those of half a step ahead after it. */
#ifndef PERCUSS_FE_DYNAMICS_H
#define PERCUSS_FE_DYNAMICS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "fe/element_blocks.h"
#include "fe/mesh.h"
#include "model/material.h"

enum { DYNAMICS_LEVELS = 16, DYNAMICS_BODIES = 2 };

struct dynamics_body {
    const struct mesh *mesh;
    struct material material;
    struct yield_rate rate; /* of its points' yield stress, each by its own strain */
    double mass;            /* kg; a mesh of straight edges is scaled to it */
    size_t fine;            /* contact nodes from the axis on with elements of the smallest step */
};

struct dynamics_level {
    struct elastic_block *elastic;
    struct plastic_block *plastic;
    size_t elastics, plastics; /* blocks */
    size_t elements;           /* of both kinds */
    size_t first, axis, last; /* nodes: first ... axis - 1 lie on the axis, axis ... last - 1 not */
};

struct dynamics {
    struct dynamics_body body[DYNAMICS_BODIES];
    size_t nodes, elements;
    size_t first_element[DYNAMICS_BODIES + 1];
    uint32_t *number[DYNAMICS_BODIES]; /* mesh node -> node here */
    uint32_t (*quads)[4];              /* by element */
    uint8_t *element_level;
    bool *plastic;                /* by element: has a history */
    double (*at)[2];              /* coordinates by node, m */
    double *root_mass;            /* by node, sqrt(kg) */
    double *y, *v;                /* 2 a node, and one empty node at the end for empty lanes */
    double mass[DYNAMICS_BODIES]; /* sum over the nodes, kg */
    unsigned levels;
    struct dynamics_level level[DYNAMICS_LEVELS];
    double step; /* of level 0, s */
    struct arena *arena;
};

/* Meshes at rest and free of stress. `safety`: the steps over the stability limit of each element.
 * Memory comes from the arena. OK, BAD_REQUEST for a mesh with a bad element, INTERNAL without
 * memory. */
enum percuss_status dynamics_create(const struct dynamics_body body[DYNAMICS_BODIES], double safety,
                                    struct arena *arena, struct dynamics *dynamics,
                                    struct fault *fault);

/* Gives all nodes of a body the velocity along z, m/s. */
void dynamics_launch(struct dynamics *dynamics, size_t body, double velocity);

/* Smallest steps of one step of the coarsest level: all nodes meet after so many. */
static inline size_t dynamics_period(const struct dynamics *dynamics)
{
    return (size_t)1 << (dynamics->levels - 1);
}

/* Forces of the elements that are due at smallest step `n`. */
void dynamics_kick(struct dynamics *dynamics, size_t n);

/* Free flight of the nodes until the end of smallest step `n`, if theirs ends there. */
void dynamics_drift(struct dynamics *dynamics, size_t n);

/* When all nodes meet: elements of yielding material that come near yield get a history. Returns
 * their number. */
size_t dynamics_watch_yield(struct dynamics *dynamics);

/* Energies, J, when all nodes meet. */
struct dynamics_energy {
    double kinetic[DYNAMICS_BODIES];   /* from y and the means of the velocities before and after */
    double vibration[DYNAMICS_BODIES]; /* the part of `kinetic` beyond that of the mean motion */
    double strain[DYNAMICS_BODIES];
    double plastic[DYNAMICS_BODIES];
};
struct dynamics_energy dynamics_energy(const struct dynamics *dynamics, const double *v_before);

/* sum(m x) / sum(m) along z of a body, for x from y or v. */
double dynamics_mean(const struct dynamics *dynamics, size_t body, const double *x);

#endif
