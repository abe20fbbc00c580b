/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Metals whose yield is not stated. A contact takes them as elastic, which they are while they
 * yield above its peak pressure / 1.6; how much the restitution changes if they do not is a part of
 * the model's error.
 *
 * That part is of a metal that yields at young/500: metals have yield strains of 0.001 (annealed)
 * to 0.01 (hardened steels, the strongest titanium and aluminium; Ashby, Materials Selection in
 * Mechanical Design, chapter 4, chart of strength against modulus), two of three structural alloys
 * of 0.002 and more. Of the energy of its peak the contact gives back by itself what the closed
 * form does (closed_form_restitution), and what follows the largest indentation is lowered by that
 * share. Later sub-impacts begin at other instants then, or not at all. */
#ifndef PERCUSS_SOLVE_UNSTATED_H
#define PERCUSS_SOLVE_UNSTATED_H

#include "impact/impact.h"
#include "solve/problem.h"
#include "solve/warnings.h"

/* Whether a contact has such a metal. */
bool unstated_any(const struct problem *problem, size_t contact);

/* One contact of an answer as it is judged by. */
struct unstated_blow {
    double force;   /* largest, N */
    double depth;   /* of flow, largest over that of yield; 0: nothing flowed */
    double rebound; /* restitution that follows the largest indentations */
    double later;   /* that sub-impacts after the first make */
    double range;   /* what a restitution can be off by at most */
};

struct unstated_blow unstated_blow_of(const struct problem *problem,
                                      const struct impact_outcome *outcome, size_t contact);

/* The yield above which the metals of a contact whose yield is not stated are elastic under a
 * force, Pa; 0: there are none. */
double unstated_holds_above(const struct problem *problem, size_t contact, double force);

/* By how much the restitution changes where such a metal yields at young/500. */
double unstated_change(const struct problem *problem, size_t contact,
                       const struct unstated_blow *blow);

/* The largest of all contacts. */
double unstated_worst(const struct problem *problem, const struct impact_outcome *outcome);

/* Writes the yield above which a solution holds, of all contacts. */
void unstated_explain(const struct problem *problem, const struct impact_outcome *outcome,
                      struct text *text);

/* Adds what is more than the tolerance. */
void unstated_find(const struct problem *problem, size_t contact, const struct unstated_blow *blow,
                   struct warnings *warnings);

#endif
