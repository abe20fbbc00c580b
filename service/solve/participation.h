/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Participations of a body's modes in loads, kept for the loads that were asked of last: a solve
 * asks several times, a rig and an ensemble the same site thousands of times. A hit and a miss give
 * the same bits: every mode is computed by itself. */
#ifndef PERCUSS_SOLVE_PARTICIPATION_H
#define PERCUSS_SOLVE_PARTICIPATION_H

#include "model/modal_basis.h"

/* Loads that are kept of a family. */
enum { PARTICIPATION_LOADS = 8 };

/* Of one family of a body. */
struct participations;
struct participations *participations_create(size_t modes); /* NULL: out of memory */
void participations_free(struct participations *kept);      /* NULL is allowed */

/* As modal_participations, of modes that it was created for; `which` ascends. */
void participations_get(struct participations *kept, const struct body *body,
                        const struct modal_family *modes, const size_t *which, size_t count,
                        const struct family_load *load, double *shape);

#endif
