/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A scene of a problem, with the data that its result is read by. */
#ifndef PERCUSS_SOLVE_ASSEMBLY_H
#define PERCUSS_SOLVE_ASSEMBLY_H

#include "impact/scene.h"
#include "solve/problem.h"

/* The modes from `first` on of a family of a body, omitted, as one row on it sees them. */
struct omitted_part {
    size_t body, row;
    size_t family;
    size_t first;
    double compliance; /* m/N */
    double omega;      /* of the first, rad/s; of a body that has no more, of its last one */
};

/* Effect of all bodies' omitted modes on a row besides residual flexibility: their response to
 * a slow force F is C F - viscosity F' - inertia F'' + ... */
struct omitted {
    double inertia;   /* sum phi^2/omega^4, m s^2/N */
    double viscosity; /* sum 2 damping phi^2/omega^3, m s/N */
};

struct assembly {
    struct scene scene;
    struct scene_group *groups;
    const struct prepared_group **sources; /* of each group; NULL: a half-space's */
    size_t *families;                      /* of each group; BODY_MOST_FAMILIES: a half-space's */
    struct omitted_part *parts;
    size_t part_count;
    struct omitted *omitted; /* [row] */
    size_t *modes;           /* [body], taking part */
    size_t *offered;         /* [body], with those of their groups that hardly would */
    size_t all_modes;        /* taking part, of all bodies */
    bool adjustable;         /* the choice decided about some of them */
    bool capped;             /* a family wants more modes than are allowed */
    double highest;          /* of the frequencies that take part, rad/s */
    double lowest_omitted;   /* rad/s; INFINITY: no more modes to be had */
    double radiated_error;   /* in e, by the waves that radiation.h omits */
};

#endif
