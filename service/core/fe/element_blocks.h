/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Elements packed in fours for explicit dynamics. Coordinates are mass-weighted, y = sqrt(m) u, and
 * so are all matrices here: forces act on the velocities without a mass. Two numbers a node: r, z.
 */
#ifndef PERCUSS_FE_ELEMENT_BLOCKS_H
#define PERCUSS_FE_ELEMENT_BLOCKS_H

#include <stddef.h>
#include <stdint.h>

#include "fe/plasticity.h"
#include "fe/quad.h"

enum { FE_LANES = 4, QUAD_ENTRIES = QUAD_FREEDOMS * (QUAD_FREEDOMS + 1) / 2 };

/* Four elements that are and were elastic: a stiffness, no history. */
struct elastic_block {
    _Alignas(32) double stiffness[QUAD_ENTRIES][FE_LANES]; /* lower triangle by rows */
    double limit[FE_LANES]; /* strain energy below which no point can yield, J */
    uint32_t node[QUAD_NODES][FE_LANES];
    uint32_t element[FE_LANES]; /* UINT32_MAX: an empty lane, all zero */
};

/* Four elements with a history at each point. */
struct plastic_block {
    _Alignas(32) double gradient[QUAD_POINTS][QUAD_NODES][3][FE_LANES];
    double weight[QUAD_POINTS][FE_LANES];
    double mean[QUAD_FREEDOMS][FE_LANES];
    double bulk_volume[FE_LANES]; /* bulk modulus x volume */
    double shear[FE_LANES], yield[FE_LANES], hardening[FE_LANES];
    double strain[QUAD_POINTS][3][FE_LANES]; /* plastic: rr, zz, gamma rz; tt is -rr - zz */
    double accumulated[QUAD_POINTS][FE_LANES];
    double raised[QUAD_POINTS][FE_LANES]; /* work of flow by the rate's part of the stress, J/m^3 */
    struct yield_rate rate;               /* the caller's, of all four */
    uint32_t node[QUAD_NODES][FE_LANES];
    uint32_t element[FE_LANES];
};

/* Puts an element into an empty lane; `scale` is 1 / sqrt(m) of its nodes, `node` their numbers. */
void elastic_block_put(struct elastic_block *block, size_t lane, const struct quad *quad,
                       const struct material *material, const double scale[QUAD_NODES]);
void plastic_block_put(struct plastic_block *block, size_t lane, const struct quad *quad,
                       const struct material *material, const double scale[QUAD_NODES]);

/* Moves lane `from` to lane `to` (which may be the same: it is emptied); `empty` is the number of
 * the node of empty lanes. */
void elastic_block_move(struct elastic_block *to, size_t to_lane, struct elastic_block *from,
                        size_t from_lane, uint32_t empty);

/* v -= step x force(y) for `count` blocks; plastic ones flow (radial return, total strains; with
 * a rate, that of a step). */
void elastic_blocks_kick(const struct elastic_block *blocks, size_t count, const double *y,
                         double *v, double step);
void plastic_blocks_kick(struct plastic_block *blocks, size_t count, const double *y, double *v,
                         double step);

/* Strain energies of the four elements, J. */
void elastic_block_energy(const struct elastic_block *block, const double *y,
                          double energy[FE_LANES]);

/* Adds the strain energy and the work of plastic flow of a block, J. */
void plastic_block_energy(const struct plastic_block *block, const double *y, double *stored,
                          double *plastic);

#endif
