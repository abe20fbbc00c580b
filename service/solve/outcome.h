/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a solution says in the terms of its problem. */
#ifndef PERCUSS_SOLVE_OUTCOME_H
#define PERCUSS_SOLVE_OUTCOME_H

#include "impact/impact.h"
#include "solve/problem.h"

/* Whether it ended by itself: nothing that vibration does can follow. */
bool outcome_is_complete(const struct impact_outcome *outcome);

/* Whether nothing was solved: the effort was spent before any force. */
bool outcome_is_unsolved(const struct problem *problem, const struct impact_outcome *outcome);

/* Restitution of a contact, which of what is unsolved says nothing; NAN where the compression
 * impulse is 0: Eq. (6). */
double outcome_restitution(const struct problem *problem, const struct impact_outcome *outcome,
                           size_t contact);

/* How far a restitution can be from the true one: of one contact of bodies at rest in themselves,
 * which have separated, that is from 0 to 1; else the width from no impulse (-1) to a full rebound,
 * or to what they are. */
double outcome_range(const struct problem *problem, const struct impact_outcome *outcome);

/* Largest force (N) and indentation (m) of a contact's listed sub-impacts. */
double outcome_peak_force(const struct impact_outcome *outcome, size_t contact);
double outcome_deepest(const struct impact_outcome *outcome, size_t contact);

/* Restitution that what follows the largest indentations makes. */
double outcome_rebound(const struct problem *problem, const struct impact_outcome *outcome,
                       size_t contact);

/* Largest differences between two solutions over the contacts. */
struct outcome_difference {
    double restitution, impulse;
};
struct outcome_difference outcome_compare(const struct problem *problem,
                                          const struct impact_outcome *a,
                                          const struct impact_outcome *b);

/* Raises each contact's change of impulse (N s) to that between the two. */
void outcome_widen_impulses(const struct problem *problem, const struct impact_outcome *a,
                            const struct impact_outcome *b, double *change);

/* Raises each body's energy (J) to that of the difference between the two of what the forces have
 * made of its vibration, by the modes that both have. */
void outcome_widen_vibration(const struct problem *problem, const struct impact_outcome *a,
                             const struct impact_outcome *b, double *energy);

/* Impulse that the shares of a contact's restitution are of, N s: that which stops its approach, or
 * what has compressed it where that is more, by way of others. */
double outcome_impulse_scale(const struct problem *problem, const struct impact_outcome *outcome,
                             size_t contact);

/* Share of the energy that a solution gains or loses. What acceleration takes may leave next to
 * nothing available: the approach counts too. */
double outcome_energy_defect(const struct problem *problem, const struct impact_outcome *outcome);

/* Whether the energy closes to a share of what is available. What acceleration takes may leave next
 * to nothing of that: what is rounding of the approach's closes too. */
bool outcome_energy_closes(const struct problem *problem, const struct impact_outcome *outcome,
                           double share);

/* More of its energy no solution may gain or lose: an answer that is wrong by half a percent of e.
 */
static const double OUTCOME_WORST_DEFECT = 0.01;

/* Whether a solution with that defect is one at all. */
bool outcome_keeps_energy(double defect);

/* PERCUSS_BAD_REQUEST: no touch lies behind an overlap (outcome->always_overlapped), or none within
 * the horizon; the request contradicts itself. */
enum percuss_status outcome_refuse_overlap(const struct problem *problem,
                                           const struct impact_outcome *outcome, double horizon,
                                           struct fault *fault);

#endif
