/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Quantities of a solution in the terms of its problem. */
#ifndef PERCUSS_SOLVE_OUTCOME_H
#define PERCUSS_SOLVE_OUTCOME_H

#include "impact/impact.h"
#include "solve/problem.h"

/* Whether it ended by itself: vibration cannot cause another contact. */
bool outcome_is_complete(const struct impact_outcome *outcome);

/* Whether nothing was solved: the effort was spent before any force. */
bool outcome_is_unsolved(const struct problem *problem, const struct impact_outcome *outcome);

/* Restitution of a contact, meaningless where outcome_is_unsolved; NAN where the compression
 * impulse is 0: Eq. (6). */
double outcome_restitution(const struct problem *problem, const struct impact_outcome *outcome,
                           size_t contact);

/* Largest possible error of a restitution: a single contact of bodies that do not vibrate at first,
 * separated at the end, has one from 0 to 1; else the width from no impulse (-1) to a full rebound,
 * or to the largest restitution. */
double outcome_range(const struct problem *problem, const struct impact_outcome *outcome);

/* Largest force (N) and indentation (m) of a contact's listed sub-impacts. */
double outcome_peak_force(const struct impact_outcome *outcome, size_t contact);
double outcome_deepest(const struct impact_outcome *outcome, size_t contact);

/* Restitution by the impulses after the largest indentations alone. */
double outcome_rebound(const struct problem *problem, const struct impact_outcome *outcome,
                       size_t contact);

/* Largest differences between two solutions over the contacts. */
struct outcome_difference {
    double restitution, impulse;
};
struct outcome_difference outcome_compare(const struct problem *problem,
                                          const struct impact_outcome *a,
                                          const struct impact_outcome *b);

/* Slip after all impulses of the rigid bodies, along both tangents of problem->friction[index],
 * m/s.
 */
void outcome_slip_after(const struct problem *problem, const struct impact_outcome *outcome,
                        size_t index, double slip[2]);

/* -after.before / before^2 of that slip; NAN without slip before. */
double outcome_tangential_restitution(const struct problem *problem,
                                      const struct impact_outcome *outcome, size_t index);

/* Rate of the gap after over before of a single contact with that restitution, negative; NAN for
 * groups. */
double outcome_kinematic(const struct problem *problem, const struct impact_outcome *outcome,
                         size_t contact, double restitution);

/* Length of the difference of a contact's tangential impulses, N s. */
double outcome_tangential_change(const struct impact_outcome *a, const struct impact_outcome *b,
                                 size_t contact);

/* Raises each contact's change of impulse (N s) to that between the two. */
void outcome_widen_impulses(const struct problem *problem, const struct impact_outcome *a,
                            const struct impact_outcome *b, double *change);

/* Raises each body's energy (J) to that of the difference between the vibrations that the forces
 * caused in the two solutions, by the modes that both have. */
void outcome_widen_vibration(const struct problem *problem, const struct impact_outcome *a,
                             const struct impact_outcome *b, double *energy);

/* Reference impulse of a contact's restitution, N s: the one that stops its approach, or the larger
 * one that compressed it by way of other contacts. */
double outcome_impulse_scale(const struct problem *problem, const struct impact_outcome *outcome,
                             size_t contact);

/* Share of the energy that a solution gains or loses: of the available energy, or of the approach's
 * where acceleration leaves less than that. */
double outcome_energy_defect(const struct problem *problem, const struct impact_outcome *outcome);

/* Whether the energy closes to a share of the available energy, or to rounding of the approach's
 * where acceleration leaves next to nothing available. */
bool outcome_energy_closes(const struct problem *problem, const struct impact_outcome *outcome,
                           double share);

/* Largest share of its energy that a solution may gain or lose: an error of half a percent of e. */
static const double OUTCOME_WORST_DEFECT = 0.01;

/* Whether a solution with that defect is one at all. */
bool outcome_keeps_energy(double defect);

/* PERCUSS_BAD_REQUEST: no touch lies behind an overlap (outcome->always_overlapped), or none within
 * the horizon; the request contradicts itself. */
enum percuss_status outcome_refuse_overlap(const struct problem *problem,
                                           const struct impact_outcome *outcome, double horizon,
                                           struct fault *fault);

#endif
