/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Records the contact forces of a solution step by step. They suffice to repeat the motion, since
 * the modes follow them exactly. */
#ifndef PERCUSS_IMPACT_FORCE_LOG_H
#define PERCUSS_IMPACT_FORCE_LOG_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "impact/collocation.h"
#include "impact/track.h"

/* An accepted step of a contact phase. Between the steps no contact acts. */
struct force_step {
    double start;                 /* s from the stated instant */
    int level;                    /* its length, see step_length */
    double (*force)[NODES];       /* [row], N */
    double (*indentation)[NODES]; /* [row], m, from the dent on; of a contact <= 0: open */
    double *deepened;             /* [row], m: how much its dent has grown since the touch; NULL */
};

struct force_log {
    struct arena *arena; /* holds everything */
    size_t rows;
    struct force_step *steps;
    double (*values)[NODES]; /* room for forces and indentations to come */
    size_t count, room;
    size_t most;   /* most recorded steps; 0: any number */
    bool dents;    /* steps have `deepened` */
    bool complete; /* false: out of memory, or more steps */
};

/* An empty log of so many rows. */
struct force_log force_log_make(struct arena *arena, size_t rows);

/* Copies a step's values. tracks: [contacts], of the present. */
void force_log_add(struct force_log *log, double start, int level, double (*const force)[NODES],
                   double (*const indentation)[NODES], size_t contacts, const struct track *tracks);

#endif
