/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/dynamics.h"

#include <math.h>

static void kick_level(struct dynamics *dynamics, unsigned k)
{
    const struct dynamics_level *level = &dynamics->level[k];
    double step = ldexp(dynamics->step, (int)k);
    elastic_blocks_kick(level->elastic, level->elastics, dynamics->y, dynamics->v, step);
    plastic_blocks_kick(level->plastic, level->plastics, dynamics->y, dynamics->v, step);
}

void dynamics_kick(struct dynamics *dynamics, size_t n)
{
    for (unsigned k = 0; k < dynamics->levels && n % ((size_t)1 << k) == 0; k++)
        kick_level(dynamics, k);
}

void dynamics_drift(struct dynamics *dynamics, size_t n)
{
    double *y = dynamics->y;
    double *v = dynamics->v;
    for (unsigned k = 0; k < dynamics->levels && (n + 1) % ((size_t)1 << k) == 0; k++) {
        const struct dynamics_level *level = &dynamics->level[k];
        double step = ldexp(dynamics->step, (int)k);
        for (size_t i = level->first; i < level->axis; i++)
            v[2 * i] = 0.0; /* the axis is a symmetry line */
        for (size_t i = 2 * level->first; i < 2 * level->last; i++)
            y[i] += step * v[i];
    }
}

void dynamics_launch(struct dynamics *dynamics, size_t body, double velocity)
{
    for (size_t i = 0; i < dynamics->body[body].mesh->nodes; i++) {
        uint32_t node = dynamics->number[body][i];
        dynamics->v[2 * node + 1] = dynamics->root_mass[node] * velocity;
    }
}

double dynamics_mean(const struct dynamics *dynamics, size_t body, const double *x)
{
    double sum = 0.0;
    for (size_t i = 0; i < dynamics->body[body].mesh->nodes; i++) {
        uint32_t node = dynamics->number[body][i];
        sum += dynamics->root_mass[node] * x[2 * node + 1];
    }
    return sum / dynamics->mass[body];
}

static void add_strain_energy(const struct dynamics *dynamics, const struct dynamics_level *level,
                              struct dynamics_energy *energy)
{
    for (size_t i = 0; i < level->elastics; i++) {
        const struct elastic_block *block = &level->elastic[i];
        double strain[FE_LANES];
        elastic_block_energy(block, dynamics->y, strain);
        for (int lane = 0; lane < FE_LANES; lane++)
            if (block->element[lane] != UINT32_MAX)
                energy->strain[block->element[lane] >= dynamics->first_element[1]] += strain[lane];
    }
    for (size_t i = 0; i < level->plastics; i++) {
        /* blocks with a history hold elements of one body */
        const struct plastic_block *block = &level->plastic[i];
        size_t body = block->element[0] >= dynamics->first_element[1];
        plastic_block_energy(block, dynamics->y, &energy->strain[body], &energy->plastic[body]);
    }
}

struct dynamics_energy dynamics_energy(const struct dynamics *dynamics, const double *v_before)
{
    struct dynamics_energy energy = {0};
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        /* of the nodes: v is known half a step either side, and holds the root of their mass */
        for (size_t i = 0; i < dynamics->body[b].mesh->nodes; i++) {
            uint32_t node = dynamics->number[b][i];
            bool on_axis = dynamics->at[node][0] == 0.0;
            for (int c = on_axis; c < 2; c++) {
                double v = 0.5 * (dynamics->v[2 * node + c] + v_before[2 * node + c]);
                energy.kinetic[b] += 0.5 * v * v;
            }
        }
        /* of vibration: less that of the mean motion */
        double mean =
            0.5 * (dynamics_mean(dynamics, b, dynamics->v) + dynamics_mean(dynamics, b, v_before));
        energy.vibration[b] = energy.kinetic[b] - 0.5 * dynamics->mass[b] * mean * mean;
    }
    /* of strain, and what flow took */
    for (unsigned k = 0; k < dynamics->levels; k++)
        add_strain_energy(dynamics, &dynamics->level[k], &energy);
    return energy;
}
