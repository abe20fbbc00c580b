/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/element_blocks.h"

#include <math.h>

#include "base/vector_clones.h"

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
        /* energy of pressure, then at each point energy of shear and work of flow */
        *stored += 0.5 * block->bulk_volume[lane] * dilatation * dilatation;
        for (int p = 0; p < QUAD_POINTS; p++) {
            double weight = block->weight[p][lane];
            double path = block->accumulated[p][lane];
            *stored += weight * shear_energy(block, p, lane, u);
            /* the yield stress of a slow test is linear in the path */
            *plastic +=
                weight * (path * (block->yield[lane] + 0.5 * block->hardening[lane] * path) +
                          block->raised[p][lane]);
        }
    }
}

/* The inner loops of explicit dynamics: forces of four elements at once, straight onto the
 * velocities. */

typedef double lanes __attribute__((vector_size(FE_LANES * sizeof(double)), may_alias));
typedef double pair __attribute__((vector_size(2 * sizeof(double)), may_alias));
typedef long long mask __attribute__((vector_size(FE_LANES * sizeof(double))));

#define INLINE static inline __attribute__((always_inline))

/* x in the lanes of the mask, 0 elsewhere */
#define ONLY(of, x) ((lanes)((mask)(x) & (of)))
#define AT(array)   (*(const lanes *)(array))
#define PUT(array)  (*(lanes *)(array))

/* u[2a] and u[2a + 1] of the four elements from the nodes' pairs */
INLINE void gather(const uint32_t node[QUAD_NODES][FE_LANES], const double *y,
                   lanes u[QUAD_FREEDOMS])
{
    for (int a = 0; a < QUAD_NODES; a++) {
        const uint32_t *n = node[a];
        pair p0 = *(const pair *)(y + 2 * (size_t)n[0]);
        pair p1 = *(const pair *)(y + 2 * (size_t)n[1]);
        pair p2 = *(const pair *)(y + 2 * (size_t)n[2]);
        pair p3 = *(const pair *)(y + 2 * (size_t)n[3]);
        lanes even = __builtin_shufflevector(p0, p2, 0, 1, 2, 3);
        lanes odd = __builtin_shufflevector(p1, p3, 0, 1, 2, 3);
        u[2 * a] = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
        u[2 * a + 1] = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
    }
}

/* v -= step f, lane after lane: elements of a block may share nodes */
INLINE void scatter(const uint32_t node[QUAD_NODES][FE_LANES], const lanes f[QUAD_FREEDOMS],
                    double step, double *v)
{
    for (int a = 0; a < QUAD_NODES; a++) {
        const uint32_t *n = node[a];
        lanes r = step * f[2 * a];
        lanes z = step * f[2 * a + 1];
        lanes even = __builtin_shufflevector(r, z, 0, 4, 2, 6);
        lanes odd = __builtin_shufflevector(r, z, 1, 5, 3, 7);
        *(pair *)(v + 2 * (size_t)n[0]) -= __builtin_shufflevector(even, even, 0, 1);
        *(pair *)(v + 2 * (size_t)n[1]) -= __builtin_shufflevector(odd, odd, 0, 1);
        *(pair *)(v + 2 * (size_t)n[2]) -= __builtin_shufflevector(even, even, 2, 3);
        *(pair *)(v + 2 * (size_t)n[3]) -= __builtin_shufflevector(odd, odd, 2, 3);
    }
}

VECTOR_CLONES void elastic_blocks_kick(const struct elastic_block *blocks, size_t count,
                                       const double *y, double *v, double step)
{
    for (const struct elastic_block *block = blocks; block < blocks + count; block++) {
        lanes u[QUAD_FREEDOMS];
        lanes f[QUAD_FREEDOMS] = {{0.0}};
        /* displacements of four elements */
        gather(block->node, y, u);
        /* f = K u, of which the lower triangle is kept */
#pragma GCC unroll 8
        for (int i = 0; i < QUAD_FREEDOMS; i++) {
            const double(*row)[FE_LANES] = block->stiffness + i * (i + 1) / 2;
#pragma GCC unroll 8
            for (int j = 0; j < i; j++) {
                lanes k = AT(row[j]);
                f[i] += k * u[j];
                f[j] += k * u[i];
            }
            f[i] += AT(row[i]) * u[i];
        }
        /* onto their nodes' velocities */
        scatter(block->node, f, step, v);
    }
}

/* Slip at point p beyond yield where the stress depends on the rate; adds its work. */
static void slip_by_rate(struct plastic_block *block, int p, const double q[FE_LANES], double step,
                         double slip[FE_LANES])
{
    for (int lane = 0; lane < FE_LANES; lane++) {
        const struct plastic_law law = {.shear = block->shear[lane],
                                        .yield = block->yield[lane],
                                        .hardening = block->hardening[lane]};
        if (!(slip[lane] > 0.0))
            continue;
        double path = block->accumulated[p][lane];
        slip[lane] = plasticity_increment(&law, &block->rate, path, q[lane], step);
        double stress = q[lane] - 3.0 * law.shear * slip[lane];
        block->raised[p][lane] +=
            slip[lane] * (stress - law.yield - law.hardening * (path + slip[lane]));
    }
}

/* Radial return where the trial stress exceeds the yield stress; s: deviator rr, zz, tt, rz. */
INLINE void flow(struct plastic_block *block, int p, double step, lanes s[4])
{
    lanes g = AT(block->shear);
    lanes path = AT(block->accumulated[p]);
    /* q^2 = 3/2 s:s, at most the yield stress' square */
    lanes limit = AT(block->yield) + AT(block->hardening) * path;
    lanes square = 1.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2.0 * s[3] * s[3]);
    mask beyond = square > limit * limit;
    if (!(beyond[0] | beyond[1] | beyond[2] | beyond[3]))
        return;
    /* beyond it 3 G slip + H slip = q - limit (Simo and Hughes, box 3.2) */
    lanes q = {sqrt(square[0]), sqrt(square[1]), sqrt(square[2]), sqrt(square[3])};
    lanes slip = ONLY(beyond, (q - limit) / (3.0 * g + AT(block->hardening)));
    if (yield_rate_is_stated(&block->rate))
        slip_by_rate(block, p, (const double *)&q, step, (double *)&slip);
    /* plastic strain over the deviator of the trial stress */
    lanes along = ONLY(beyond, 1.5 * slip / q);
    PUT(block->accumulated[p]) = path + slip;
    PUT(block->strain[p][0]) += along * s[0];
    PUT(block->strain[p][1]) += along * s[1];
    PUT(block->strain[p][2]) += 2.0 * along * s[3];
    for (int i = 0; i < 4; i++)
        s[i] -= 2.0 * g * along * s[i];
}

/* Deviatoric trial stress at point p. */
INLINE void trial(const struct plastic_block *block, int p, const lanes u[QUAD_FREEDOMS],
                  lanes s[4])
{
    lanes rr = {0.0}, zz = {0.0}, tt = {0.0}, rz = {0.0};
    for (int a = 0; a < QUAD_NODES; a++) {
        lanes dr = AT(block->gradient[p][a][0]);
        lanes dz = AT(block->gradient[p][a][1]);
        rr += dr * u[2 * a];
        zz += dz * u[2 * a + 1];
        tt += AT(block->gradient[p][a][2]) * u[2 * a];
        rz += dz * u[2 * a] + dr * u[2 * a + 1];
    }
    lanes third = (rr + zz + tt) * (1.0 / 3.0);
    lanes g = AT(block->shear);
    s[0] = 2.0 * g * (rr - third - AT(block->strain[p][0]));
    s[1] = 2.0 * g * (zz - third - AT(block->strain[p][1]));
    s[2] = -s[0] - s[1];
    s[3] = g * (rz - AT(block->strain[p][2]));
}

VECTOR_CLONES void plastic_blocks_kick(struct plastic_block *blocks, size_t count, const double *y,
                                       double *v, double step)
{
    for (struct plastic_block *block = blocks; block < blocks + count; block++) {
        lanes u[QUAD_FREEDOMS];
        lanes f[QUAD_FREEDOMS];
        /* displacements of four elements */
        gather(block->node, y, u);
        /* the pressure, of the mean change of volume */
        lanes dilatation = {0.0};
        for (int i = 0; i < QUAD_FREEDOMS; i++)
            dilatation += AT(block->mean[i]) * u[i];
        lanes pressure = AT(block->bulk_volume) * dilatation;
        for (int i = 0; i < QUAD_FREEDOMS; i++)
            f[i] = pressure * AT(block->mean[i]);
        /* the deviator at each point, after flow, onto the nodes */
        for (int p = 0; p < QUAD_POINTS; p++) {
            lanes s[4];
            trial(block, p, u, s);
            flow(block, p, step, s);
            for (int i = 0; i < 4; i++)
                s[i] *= AT(block->weight[p]);
            for (int a = 0; a < QUAD_NODES; a++) {
                lanes dr = AT(block->gradient[p][a][0]);
                lanes dz = AT(block->gradient[p][a][1]);
                f[2 * a] += dr * s[0] + dz * s[3] + AT(block->gradient[p][a][2]) * s[2];
                f[2 * a + 1] += dz * s[1] + dr * s[3];
            }
        }
        /* onto their nodes' velocities */
        scatter(block->node, f, step, v);
    }
}
