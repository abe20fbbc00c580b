/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/element_blocks.h"

#include <math.h>

void elastic_block_put(struct elastic_block *block, size_t lane, const struct quad *quad,
                       const struct material *material, const double scale[QUAD_NODES])
{
    double k[QUAD_FREEDOMS][QUAD_FREEDOMS];
    quad_elastic_stiffness(quad, material, k);
    for (int i = 0, at = 0; i < QUAD_FREEDOMS; i++)
        for (int j = 0; j <= i; j++, at++)
            block->stiffness[at][lane] = k[i][j] * scale[i / 2] * scale[j / 2];
    /* a point alone holds weight q^2 / 6G of shear energy */
    double least = INFINITY;
    for (int p = 0; p < QUAD_POINTS; p++)
        least = fmin(least, quad->volume[p]);
    block->limit[lane] =
        least * material->yield * material->yield / (6.0 * material_shear_modulus(material));
}

void elastic_block_move(struct elastic_block *to, size_t to_lane, struct elastic_block *from,
                        size_t from_lane, uint32_t empty)
{
    for (int i = 0; i < QUAD_ENTRIES; i++) {
        to->stiffness[i][to_lane] = from->stiffness[i][from_lane];
        from->stiffness[i][from_lane] = 0.0;
    }
    to->limit[to_lane] = from->limit[from_lane];
    for (int a = 0; a < QUAD_NODES; a++) {
        to->node[a][to_lane] = from->node[a][from_lane];
        from->node[a][from_lane] = empty;
    }
    to->element[to_lane] = from->element[from_lane];
    from->element[from_lane] = UINT32_MAX;
}

void plastic_block_put(struct plastic_block *block, size_t lane, const struct quad *quad,
                       const struct material *material, const double scale[QUAD_NODES])
{
    /* its law */
    struct plastic_law law = plastic_law_make(material);
    block->shear[lane] = law.shear;
    block->yield[lane] = law.yield;
    block->hardening[lane] = law.hardening;
    /* the mean change of volume by its displacements */
    double dilatation[QUAD_FREEDOMS];
    quad_dilatation(quad, dilatation);
    for (int i = 0; i < QUAD_FREEDOMS; i++)
        block->mean[i][lane] = dilatation[i] * scale[i / 2];
    /* at each point the slopes, of which the deviator is made */
    for (int p = 0; p < QUAD_POINTS; p++) {
        double slope[QUAD_NODES][3];
        quad_slopes(quad, p, slope);
        block->weight[p][lane] = quad->volume[p];
        block->bulk_volume[lane] += law.bulk * quad->volume[p];
        for (int a = 0; a < QUAD_NODES; a++)
            for (int i = 0; i < 3; i++)
                block->gradient[p][a][i][lane] = slope[a][i] * scale[a];
    }
}

void elastic_block_energy(const struct elastic_block *block, const double *y,
                          double energy[FE_LANES])
{
    for (int lane = 0; lane < FE_LANES; lane++) {
        double u[QUAD_FREEDOMS];
        for (int i = 0; i < QUAD_FREEDOMS; i++)
            u[i] = y[2 * block->node[i / 2][lane] + i % 2];
        double sum = 0.0;
        for (int i = 0, at = 0; i < QUAD_FREEDOMS; i++) {
            for (int j = 0; j < i; j++, at++)
                sum += block->stiffness[at][lane] * u[i] * u[j];
            sum += 0.5 * block->stiffness[at++][lane] * u[i] * u[i];
        }
        energy[lane] = sum;
    }
}

/* Elastic strain energy density of the deviator at one point. */
static double shear_energy(const struct plastic_block *block, int p, int lane,
                           const double u[QUAD_FREEDOMS])
{
    double strain[4] = {0.0};
    for (int a = 0; a < QUAD_NODES; a++) {
        double dr = block->gradient[p][a][0][lane];
        double dz = block->gradient[p][a][1][lane];
        strain[0] += dr * u[2 * a];
        strain[1] += dz * u[2 * a + 1];
        strain[2] += block->gradient[p][a][2][lane] * u[2 * a];
        strain[3] += dz * u[2 * a] + dr * u[2 * a + 1];
    }
    double third = (strain[0] + strain[1] + strain[2]) / 3.0;
    double rr = strain[0] - third - block->strain[p][0][lane];
    double zz = strain[1] - third - block->strain[p][1][lane];
    double rz = strain[3] - block->strain[p][2][lane];
    return block->shear[lane] * (rr * rr + zz * zz + (rr + zz) * (rr + zz) + 0.5 * rz * rz);
}

void plastic_block_energy(const struct plastic_block *block, const double *y, double *stored,
                          double *plastic)
{
    for (int lane = 0; lane < FE_LANES; lane++) {
        if (block->element[lane] == UINT32_MAX)
            continue;
        /* displacements, and the change of volume */
        double u[QUAD_FREEDOMS];
        double dilatation = 0.0;
        for (int i = 0; i < QUAD_FREEDOMS; i++) {
            u[i] = y[2 * block->node[i / 2][lane] + i % 2];
            dilatation += block->mean[i][lane] * u[i];
        }
        /* what pressure stores, then at each point what shear stores and flow takes */
        *stored += 0.5 * block->bulk_volume[lane] * dilatation * dilatation;
        for (int p = 0; p < QUAD_POINTS; p++) {
            double weight = block->weight[p][lane];
            double path = block->accumulated[p][lane];
            *stored += weight * shear_energy(block, p, lane, u);
            /* the yield stress is linear in the path */
            *plastic += weight * path * (block->yield[lane] + 0.5 * block->hardening[lane] * path);
        }
    }
}
