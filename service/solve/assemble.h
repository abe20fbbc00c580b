/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* From geometry to the fast scale's scene: which modes take part, and the residual flexibility of
 * those that do not. */
#ifndef PERCUSS_SOLVE_ASSEMBLE_H
#define PERCUSS_SOLVE_ASSEMBLE_H

#include "impact/scene.h"
#include "solve/geometry.h"
#include "solve/prepared.h"

/* A scene with what is needed to read its result. */
struct assembly {
    struct scene scene;
    struct scene_group groups[SCENE_MAX_GROUPS];
    const struct prepared_group *sources[SCENE_MAX_GROUPS]; /* of each group */
    enum mode_family families[SCENE_MAX_GROUPS];
    size_t modes[PERCUSS_MAX_BODIES];   /* taking part, by body */
    double omitted[PERCUSS_MAX_BODIES]; /* lowest frequency that does not, rad/s; INFINITY: none */
    size_t all_modes;                   /* taking part, of all bodies */
    bool capped;                        /* a family has more modes below the cut than are allowed */
    double highest;                     /* of the frequencies that take part, rad/s */
    double lowest_omitted;              /* rad/s; INFINITY: no more modes to be had */
};

/* Most modes of one family of one body. */
enum { ASSEMBLE_MAX_MODES = 5000 };

/* Which modes: all up to the angular frequency `cut`, as far as a contact excites them; where the
 * catalogue fixes a body's number of modes, that many times `fixed_share`. */
struct assemble_choice {
    double cut;         /* rad/s */
    double fixed_share; /* 1, or less for an error estimate */
};

/* Modes of a given initial state always take part. Arrays come from the arena. False: out of
 * memory. */
bool assemble(struct assembly *assembly, const struct geometry *geometry,
              const struct solve_request *request, struct prepared_cache *cache,
              const struct assemble_choice *choice, struct arena *arena);

#endif
