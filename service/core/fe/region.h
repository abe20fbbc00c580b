/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The contact region of two bodies: axisymmetric, static, elastic-plastic, frictionless, small
 * strains. Both are half-spaces with surfaces that part like r^2 / (2 radius); indentation is the
 * approach of their points at infinity, as in Hertz's F = k d^1.5, so that the region takes the
 * place of Hertz's law in series with modes and residual flexibility. Contact is exact at the nodes
 * (forces as unknowns, no penalty). Stepping: press or load as often as wanted, each time from the
 * state last committed; then commit. */
#ifndef PERCUSS_FE_REGION_H
#define PERCUSS_FE_REGION_H

#include <stddef.h>

#include "base/fault.h"
#include "base/watch.h"
#include "model/material.h"

struct region_input {
    struct material materials[2];
    double radius;      /* m, 1 / (1/R_a + 1/R_b) */
    double indentation; /* m, the largest that will be asked for */
    size_t resolution;  /* elements along a side of the mesh's core, 4 ... 60; about 1.3 times as
                         * many lie within a contact radius, whatever the load */
    double phase;       /* 0 <= phase < 1: moves the nodes by this part of a ring against the rim of
                         * every contact: see swing.h */
};

struct region_answer {
    double indentation; /* m */
    double force;       /* N */
    double stiffness;   /* dF/dd, N/m, of the present active nodes and flow */
    double radius;      /* m, of contact: to half an element */
};

struct region;

/* OK; BAD_REQUEST naming the input, its value and its allowed range; INTERNAL: memory. */
enum percuss_status region_create(const struct region_input *input, struct region **region,
                                  struct fault *fault);
void region_destroy(struct region *region);

/* From now on every Newton step asks `pace` (borrowed; NULL: none) whether to go on and reports
 * `done`, the finished part of the whole work. A stop makes later calls return TIMEOUT. */
void region_watch(struct region *region, struct pace *pace, double done);

/* Static equilibrium at an indentation (m; any sign), or under a force (N, > 0), reached from the
 * committed state. INTERNAL with a reason where no equilibrium is found or the indentation is
 * beyond the range of the mesh (BAD_REQUEST where a body flows long before the finest element
 * touches); the committed state stays as it was. */
enum percuss_status region_press(struct region *region, double indentation,
                                 struct region_answer *answer, struct fault *fault);
enum percuss_status region_load(struct region *region, double force, struct region_answer *answer,
                                struct fault *fault);

/* The same in series with a spring: indentation + softness * force = approach, m. softness, m/N: of
 * either sign, above -1 / stiffness, below which there is no one equilibrium. */
enum percuss_status region_approach(struct region *region, double approach, double softness,
                                    struct region_answer *answer, struct fault *fault);

/* Equilibrium in which contact node `node` (its radius: region_edge_radius) just touches without a
 * force and all within press: these states lie alike within their elements, so that curves through
 * them are free of the ripple of nodes coming into contact one by one. INTERNAL also where such a
 * state does not exist (contact in a ring). */
enum percuss_status region_edge(struct region *region, size_t node, struct region_answer *answer,
                                struct fault *fault);

/* Radius of a contact node, m; INFINITY beyond those that may touch. */
double region_edge_radius(const struct region *region, size_t node);

/* The present state becomes the committed one. */
void region_commit(struct region *region);

/* Indentation at which the unloaded surfaces, dents and all, just touch, reached from the committed
 * state without contact forces: 0 for virgin bodies. */
enum percuss_status region_touch(struct region *region, double *indentation, struct fault *fault);

/* Of each body at present. */
struct region_ledger {
    double flow[2];    /* largest accumulated plastic strain */
    double plastic[2]; /* J, work that went into plastic flow, hardening included */
    double elastic[2]; /* J, energy of the elastic strains within the mesh; without a load these are
                        * the residual stresses' and the mesh holds all of it but for 1e-3 */
};
void region_ledger(const struct region *region, struct region_ledger *ledger);

/* Effort since creation. */
struct region_effort {
    size_t newton_steps, nodes;
};
struct region_effort region_effort(const struct region *region);

#endif
