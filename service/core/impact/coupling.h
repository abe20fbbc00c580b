/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Effects of the rows' forces on a step on each other's approaches: through the rigid bodies,
 * the residual flexibility and the modes. Only pairs that share one of these are computed. Few
 * rows have a block for each pair. With many, the forces move the modes and these the rows,
 * so that one more row costs its modes, not a block for each other row. */
#ifndef PERCUSS_IMPACT_COUPLING_H
#define PERCUSS_IMPACT_COUPLING_H

#include "base/arena.h"
#include "base/watch.h"
#include "impact/scene.h"

/* Up to so many rows, blocks of pairs are cheaper than sums over modes. */
enum { COUPLING_FEW = 7 };

/* Reduction of the approach at node i, or at the end, by a unit force at node j, m/N. */
struct coupling_block {
    double by[STEP_POINTS][NODES];
};

/* Another row, or the row itself. */
struct coupling_pair {
    size_t other;
    size_t block; /* of a level: the row itself, and from the number of rows on those of others */
    double w, residual;
};

struct coupling {
    bool by_modes;                             /* many rows: blocks only of each with itself */
    size_t *first;                             /* [rows + 1]: where a row's pairs begin */
    struct coupling_pair *pairs;               /* coupled ones, ascending; always with itself */
    size_t blocks;                             /* of a level: the rows' own first */
    struct coupling_block *level[STEP_LEVELS]; /* NULL: not yet */
    double *thrust, *answer; /* [stride][NODES], [STEP_POINTS][stride]: scratch, of a group */
};

/* Of an empty one, all zero. False: out of memory. */
bool coupling_create(struct coupling *coupling, const struct scene *scene, struct arena *arena);

/* The tables and blocks of a level. OK, INTERNAL without memory, TIMEOUT where the pace stopped it.
 */
enum percuss_status coupling_prepare(struct coupling *coupling, const struct scene *scene,
                                     int level, struct arena *arena, struct pace *pace);

/* A row's effect on itself. */
static inline const struct coupling_block *coupling_own(const struct coupling *coupling, int level,
                                                        size_t row)
{
    return &coupling->level[level][row];
}

/* Effect of row b's force on row a, of few rows; NULL: none. */
const struct coupling_block *coupling_between_two(const struct coupling *coupling, int level,
                                                  size_t a, size_t b);

/* The same for any number. */
void coupling_between(const struct scene *scene, int level, size_t a, size_t b,
                      double by[STEP_POINTS][NODES]);

/* taken[row] becomes the reduction of its approach at the nodes and the end by these forces,
 * [row][node]; without the residual flexibility at the end. */
void coupling_take(const struct coupling *coupling, const struct scene *scene, int level,
                   double (*const force)[NODES], double (*taken)[STEP_POINTS]);

/* The same for the end alone; the values at the nodes are undefined. */
void coupling_take_end(const struct coupling *coupling, const struct scene *scene, int level,
                       double (*const force)[NODES], double (*taken)[STEP_POINTS]);

#endif
