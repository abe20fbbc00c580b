/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/coupling.h"

#include <string.h>

#include "impact/kernel.h"
#include "impact/motion.h"
#include "impact/simd.h"

static bool share_modes(const struct scene *scene, size_t a, size_t b)
{
    for (size_t g = 0; g < scene->groups; g++)
        if (scene->group[g].participation[a] && scene->group[g].participation[b])
            return true;
    return false;
}

/* Finds the coupled pairs. */
static void find_pairs(struct coupling *coupling, const struct scene *scene)
{
    size_t n = scene->rows;
    size_t count = 0;
    coupling->blocks = n;
    for (size_t a = 0; a < n; a++) {
        coupling->first[a] = count;
        for (size_t b = 0; b < n; b++) {
            double w = scene->w[a * n + b];
            double residual = scene->residual[a * n + b];
            /* one of both may be a rounding */
            bool both = w != 0.0 || scene->w[b * n + a] != 0.0 || residual != 0.0 ||
                        scene->residual[b * n + a] != 0.0;
            if (a != b && !both && (coupling->by_modes || !share_modes(scene, a, b)))
                continue;
            size_t block = a == b || coupling->by_modes ? a : coupling->blocks++;
            coupling->pairs[count++] = (struct coupling_pair){b, block, w, residual};
        }
    }
    coupling->first[n] = count;
}

bool coupling_create(struct coupling *coupling, const struct scene *scene, struct arena *arena)
{
    size_t n = scene->rows;
    size_t longest = 0;
    coupling->by_modes = n > COUPLING_FEW;
    coupling->first = arena_reserve(arena, n + 1, sizeof *coupling->first);
    coupling->pairs = arena_reserve(arena, n * n, sizeof *coupling->pairs);
    if (!coupling->first || !coupling->pairs)
        return false;
    find_pairs(coupling, scene);
    if (!coupling->by_modes)
        return true;
    /* room for the forces on a group's modes and their answer */
    for (size_t g = 0; g < scene->groups; g++)
        longest = scene->group[g].stride > longest ? scene->group[g].stride : longest;
    coupling->thrust = arena_reserve(arena, NODES * longest, sizeof(double));
    coupling->answer = arena_reserve(arena, STEP_POINTS * longest, sizeof(double));
    return coupling->thrust && coupling->answer;
}

/* The rigid bodies by the force's double integral, and the series compliance at the same node. */
static void rigid_block(double w, double residual, double h, double by[STEP_POINTS][NODES])
{
    for (int j = 0; j < NODES; j++)
        by[NODES][j] = w * h * h * collocation.position_end[j];
    for (int i = 0; i < NODES; i++) {
        for (int j = 0; j < NODES; j++)
            by[i][j] = w * h * h * collocation.position[i][j];
        by[i][i] += residual;
    }
}

void coupling_between(const struct scene *scene, int level, size_t a, size_t b,
                      double by[STEP_POINTS][NODES])
{
    size_t at = a * scene->rows + b;
    rigid_block(scene->w[at], scene->residual[at], step_length(level), by);
    /* the modes that move both */
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *row = group->participation[a], *other = group->participation[b];
        if (row && other)
            kernel_response(group->set->tables[level], group->stride, row, other, by);
    }
}

/* The pair of b among those of a; NULL: none. */
static const struct coupling_pair *find_pair(const struct coupling *coupling, size_t a, size_t b)
{
    for (size_t p = coupling->first[a]; p < coupling->first[a + 1]; p++)
        if (coupling->pairs[p].other == b)
            return &coupling->pairs[p];
    return NULL;
}

const struct coupling_block *coupling_between_two(const struct coupling *coupling, int level,
                                                  size_t a, size_t b)
{
    const struct coupling_pair *pair = find_pair(coupling, a, b);
    return pair ? &coupling->level[level][pair->block] : NULL;
}

enum percuss_status coupling_prepare(struct coupling *coupling, const struct scene *scene,
                                     int level, struct arena *arena, struct pace *pace)
{
    /* the modes' tables */
    enum percuss_status status = scene_prepare(scene, level, pace);
    if (status != PERCUSS_OK)
        return status;
    struct coupling_block *blocks = arena_reserve(arena, coupling->blocks, sizeof *blocks);
    if (!blocks)
        return PERCUSS_INTERNAL;
    for (size_t a = 0; a < scene->rows; a++) {
        coupling_between(scene, level, a, a, blocks[a].by);
        /* W, the residual flexibility and the modes' products are symmetric */
        const struct coupling_pair *pair = &coupling->pairs[coupling->first[a]];
        for (; !coupling->by_modes && pair->other < a; pair++) {
            coupling_between(scene, level, a, pair->other, blocks[pair->block].by);
            blocks[find_pair(coupling, pair->other, a)->block] = blocks[pair->block];
        }
    }
    coupling->level[level] = blocks;
    return PERCUSS_OK;
}

/* Adds a block's products with four forces, of a row (m0 f0 + m1 f1) + (m2 f2 + m3 f3), two rows at
 * a time. */
static inline void multiply(const double *m, const double force[NODES], quad *nodes, double *end)
{
    const quad f = CONST_QUAD(force);
    const quad last = CONST_QUAD(m + NODES * NODES) * f;
    quad sums[2];
    for (int i = 0; i < 2; i++) {
        const quad row = CONST_QUAD(m + 2 * i * NODES) * f;
        const quad next = CONST_QUAD(m + (2 * i + 1) * NODES) * f;
        sums[i] = __builtin_shufflevector(row, next, 0, 4, 2, 6) +
                  __builtin_shufflevector(row, next, 1, 5, 3, 7);
    }
    *nodes += __builtin_shufflevector(sums[0], sums[1], 0, 1, 4, 5) +
              __builtin_shufflevector(sums[0], sums[1], 2, 3, 6, 7);
    *end += (last[0] + last[1]) + (last[2] + last[3]);
}

VECTOR_CLONES static void take_by_blocks(const struct coupling *coupling, size_t rows, int level,
                                         double (*const force)[NODES], double (*taken)[STEP_POINTS])
{
    bool bears[COUPLING_FEW];
    for (size_t c = 0; c < rows; c++)
        bears[c] = motion_bears(force[c]);
    for (size_t a = 0; a < rows; a++) {
        quad nodes = {0};
        double end = 0.0;
        for (size_t p = coupling->first[a]; p < coupling->first[a + 1]; p++) {
            const struct coupling_pair *pair = &coupling->pairs[p];
            if (bears[pair->other])
                multiply(coupling->level[level][pair->block].by[0], force[pair->other], &nodes,
                         &end);
        }
        QUAD(taken[a]) = nodes;
        taken[a][NODES] = end;
    }
}

/* Effect of rigid bodies and residual flexibility, pair by pair. */
VECTOR_CLONES static void take_rigid(const struct coupling *coupling, size_t rows, double h,
                                     double (*const force)[NODES], double (*taken)[STEP_POINTS])
{
    for (size_t a = 0; a < rows; a++) {
        quad thrust = {0};
        quad local = {0};
        double end = 0.0;
        for (size_t p = coupling->first[a]; p < coupling->first[a + 1]; p++) {
            const struct coupling_pair *pair = &coupling->pairs[p];
            thrust += pair->w * CONST_QUAD(force[pair->other]);
            local += pair->residual * CONST_QUAD(force[pair->other]);
        }
        thrust *= h * h;
        for (int i = 0; i < NODES; i++) {
            const double *m = collocation.position[i];
            taken[a][i] = (m[0] * thrust[0] + m[1] * thrust[1]) +
                          (m[2] * thrust[2] + m[3] * thrust[3]) + local[i];
            end += collocation.position_end[i] * thrust[i];
        }
        taken[a][NODES] = end;
    }
}

/* Adds modal forces of the forces at `phi`. */
VECTOR_CLONES static void gather(size_t length, const double *phi, const double force[NODES],
                                 double *thrust)
{
    const quad f = CONST_QUAD(force);
    for (size_t k = 0; k < length; k++)
        QUAD(thrust + k * NODES) += phi[k] * f;
}

/* Modal displacements by these forces at nodes and end. */
VECTOR_CLONES static void respond(const double *response, size_t length, const double *thrust,
                                  double *answer)
{
    for (size_t k = 0; k < length; k++, response += RESPONSE_TERMS, thrust += NODES) {
        quad nodes = {0};
        double end = 0.0;
        multiply(response, thrust, &nodes, &end);
        for (size_t i = 0; i < NODES; i++)
            answer[i * length + k] = nodes[i];
        answer[NODES * length + k] = end;
    }
}

/* Sums these at a contact. */
VECTOR_CLONES static void scatter(size_t length, const double *phi, const double *answer,
                                  double taken[STEP_POINTS])
{
    lanes sum[STEP_POINTS] = {{0}};
    for (size_t k = 0; k < length; k += LANES)
        for (size_t i = 0; i < STEP_POINTS; i++)
            sum[i] += AT(phi, k) * AT(answer, i * length + k);
    for (int i = 0; i < STEP_POINTS; i++)
        taken[i] += TOTAL(sum[i]);
}

/* Effect of a group's modes. */
static void take_by_modes(const struct coupling *coupling, const struct scene *scene,
                          const struct scene_group *group, int level, double (*const force)[NODES],
                          double (*taken)[STEP_POINTS])
{
    bool moved = false;
    memset(coupling->thrust, 0, group->stride * NODES * sizeof(double));
    for (size_t b = 0; b < scene->rows; b++)
        if (group->participation[b] && motion_bears(force[b])) {
            gather(group->stride, group->participation[b], force[b], coupling->thrust);
            moved = true;
        }
    if (!moved)
        return;
    respond(group->set->tables[level]->response, group->stride, coupling->thrust, coupling->answer);
    for (size_t a = 0; a < scene->rows; a++)
        if (group->participation[a])
            scatter(group->stride, group->participation[a], coupling->answer, taken[a]);
}

void coupling_take(const struct coupling *coupling, const struct scene *scene, int level,
                   double (*const force)[NODES], double (*taken)[STEP_POINTS])
{
    if (!coupling->by_modes) {
        take_by_blocks(coupling, scene->rows, level, force, taken);
        return;
    }
    take_rigid(coupling, scene->rows, step_length(level), force, taken);
    for (size_t g = 0; g < scene->groups; g++)
        take_by_modes(coupling, scene, &scene->group[g], level, force, taken);
}

/* Only the rows of the end. */
static void end_by_blocks(const struct coupling *coupling, size_t rows, int level,
                          double (*const force)[NODES], double (*taken)[STEP_POINTS])
{
    for (size_t a = 0; a < rows; a++)
        taken[a][NODES] = 0.0;
    for (size_t a = 0; a < rows; a++)
        for (size_t p = coupling->first[a]; p < coupling->first[a + 1]; p++) {
            const struct coupling_pair *pair = &coupling->pairs[p];
            const double *m = coupling->level[level][pair->block].by[NODES];
            const double *f = force[pair->other];
            taken[a][NODES] += (m[0] * f[0] + m[1] * f[1]) + (m[2] * f[2] + m[3] * f[3]);
        }
}

void coupling_take_end(const struct coupling *coupling, const struct scene *scene, int level,
                       double (*const force)[NODES], double (*taken)[STEP_POINTS])
{
    if (coupling->by_modes)
        coupling_take(coupling, scene, level, force, taken);
    else
        end_by_blocks(coupling, scene->rows, level, force, taken);
}
