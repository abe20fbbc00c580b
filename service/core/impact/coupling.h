/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Effects of the contacts' forces on a step on each other's approaches: through the rigid bodies,
 * the residual flexibility and the modes. Only pairs that share something are looked at. Few
 * contacts have a block of numbers for each pair; of many, the forces go to the modes and from
 * there to the contacts, so that a contact more costs its modes and not a block for each other one.
 */
#ifndef PERCUSS_IMPACT_COUPLING_H
#define PERCUSS_IMPACT_COUPLING_H

#include "base/arena.h"
#include "base/watch.h"
#include "impact/scene.h"

/* Up to so many contacts blocks of pairs are cheaper than the way by the modes. */
enum { COUPLING_FEW = 7 };

/* Approach at node i, then at the end, that a unit force at node j takes away, m/N. */
struct coupling_block {
    double by[STEP_POINTS][NODES];
};

/* Another contact, or the contact itself. */
struct coupling_pair {
    size_t other;
    double w, residual;
};

struct coupling {
    bool by_modes;               /* many contacts: blocks only of each with itself */
    size_t *first;               /* [contacts + 1]: where a contact's pairs begin */
    struct coupling_pair *pairs; /* those that share something, ascending; with itself always */
    size_t blocks;               /* of a level */
    size_t *own;                 /* [contact]: which block is its own */
    struct coupling_block *level[STEP_LEVELS]; /* NULL: not yet */
    double *thrust, *answer; /* [stride][NODES], [STEP_POINTS][stride]: scratch, of a group */
};

/* False: out of memory. */
bool coupling_create(struct coupling *coupling, const struct scene *scene, struct arena *arena);

/* The tables and blocks of a level. OK, INTERNAL without memory, TIMEOUT where the pace stopped it.
 */
enum percuss_status coupling_prepare(struct coupling *coupling, const struct scene *scene,
                                     int level, struct arena *arena, struct pace *pace);

/* A contact's effect on itself. */
static inline const struct coupling_block *coupling_own(const struct coupling *coupling, int level,
                                                        size_t contact)
{
    return &coupling->level[level][coupling->own[contact]];
}

/* Of force of contact b on contact a, among few contacts; NULL: they share nothing. */
const struct coupling_block *coupling_between_two(const struct coupling *coupling, int level,
                                                  size_t a, size_t b);

/* The same of any contacts. */
void coupling_between(const struct scene *scene, int level, size_t a, size_t b,
                      double by[STEP_POINTS][NODES]);

/* taken[contact]: what these forces, [contact][node], take from its approach at the nodes and the
 * end. But for the end the residual flexibility is counted. */
void coupling_take(const struct coupling *coupling, const struct scene *scene, int level,
                   double (*const force)[NODES], double (*taken)[STEP_POINTS]);

/* The same for the end alone: what it leaves at the nodes is of no use. */
void coupling_take_end(const struct coupling *coupling, const struct scene *scene, int level,
                       double (*const force)[NODES], double (*taken)[STEP_POINTS]);

#endif
