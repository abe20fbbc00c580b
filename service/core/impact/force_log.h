/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The contact forces of a solution, step by step: all that is needed to go through the motion
 * again, since the modes follow the forces exactly. */
#ifndef PERCUSS_IMPACT_FORCE_LOG_H
#define PERCUSS_IMPACT_FORCE_LOG_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "impact/collocation.h"

/* An accepted step of a contact phase. Between the steps no contact acts. */
struct force_step {
    double start;                 /* s from the stated instant */
    int level;                    /* its length, see step_length */
    double (*force)[NODES];       /* [contact], N */
    double (*indentation)[NODES]; /* [contact], m; <= 0: open */
};

struct force_log {
    struct arena *arena; /* everything lives here */
    size_t contacts;
    struct force_step *steps;
    double (*values)[NODES]; /* for the forces and indentations of those to come */
    size_t count, room;
    size_t most;   /* steps that are taken down; 0: any number */
    bool complete; /* false: memory ran out, or there were more */
};

/* An empty log of so many contacts. */
struct force_log force_log_make(struct arena *arena, size_t contacts);

/* Copies what a step holds. */
void force_log_add(struct force_log *log, double start, int level, double (*const force)[NODES],
                   double (*const indentation)[NODES]);

#endif
