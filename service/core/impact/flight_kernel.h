/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Inner loops of the flights over the modes of a group. Arrays are padded with zeros to whole lanes
 * and 32-byte aligned; sums are formed lane by lane in a fixed order, so that every vector unit
 * gives the same bits. */
#ifndef PERCUSS_IMPACT_FLIGHT_KERNEL_H
#define PERCUSS_IMPACT_FLIGHT_KERNEL_H

#include "impact/scene.h"
#include "impact/step_table.h"

/* Modes at one contact. */
struct flight_modes {
    size_t length;         /* whole lanes */
    const double *damping; /* ratios; NULL: undamped */
    const double *omega, *phi, *q, *v;
};

/* From a group. */
static inline struct flight_modes flight_modes_of(const struct scene_group *group, size_t contact,
                                                  const double *q, const double *v)
{
    const struct oscillators *set = group->set;
    return (struct flight_modes){.length = group->stride,
                                 .damping = set->most_damping > 0.0 ? set->damping : NULL,
                                 .omega = set->omega,
                                 .phi = group->participation[contact],
                                 .q = q,
                                 .v = v};
}

enum {
    SCAN_TERMS = 8, /* of the power series by which an interval is proved open */
    ROOT_TERMS = 20 /* of that which gives a touch */
};

/* Bounds of the modes at the contact from now on: reach[j] is the sum of |phi| a over all lanes
 * from the j-th on, bend[j] that of |phi| a omega^SCAN_TERMS over those before it, for 0 <= j <=
 * length/LANES; a = sqrt(q^2 + v^2/omega^2). */
void flight_kernel_bounds(const struct flight_modes *modes, double *reach, double *bend);

/* sums[n] += sum_k phi_k d^n q_k/dt^n in free motion, by q'' = -2 damping omega q' - omega^2 q. */
void flight_kernel_derivatives(const struct flight_modes *modes, double sums[SCAN_TERMS]);

/* The same times length^n, for the series that gives the touch. */
void flight_kernel_terms(const struct flight_modes *modes, double length, double sums[ROOT_TERMS]);

/* Free motion over `time` >= 0, from q and v of the modes (phi is not used) into others or the
 * same; omega time <= FLIGHT_TURN_ANGLE. As exact as oscillator_advance. */
void flight_kernel_turn(const struct flight_modes *modes, double time, double *q, double *v);
extern const double FLIGHT_TURN_ANGLE;

/* The same by a table for that time, TURN_TERMS numbers for each of the modes (omega and damping
 * are used), to the same bits. */
enum { TURN_TERMS = 4 };
void flight_kernel_table(const struct flight_modes *modes, double time, double *table);
void flight_kernel_step(const double *table, const struct flight_modes *modes, double *q,
                        double *v);

/* Energy that damped modes lose to damping in that time, from q and v. */
double flight_kernel_loss(const struct flight_modes *modes, double time);

/* The map of a set's free motion over the step of a level (see flight_kernel_step), made on first
 * use; belongs to the set. NULL: out of memory. */
const double *flight_table(struct oscillators *set, int level);

#endif
