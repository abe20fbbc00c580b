/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Errors of the contact law itself, beside modes and steps: its size and shape, its tables, metals
 * of unstated yield, and losses of the materials.
 *
 * Metals of unstated yield: a contact takes them as elastic, which they are while they
 * yield above its peak pressure / 1.6; the change of the restitution if they do not is a part of
 * the model's error. That part is of a metal that yields at young/500: metals have yield strains of
 * 0.001 (annealed) to 0.01 (hardened steels, the strongest titanium and aluminium; Ashby, Materials
 * Selection in Mechanical Design, chapter 4, chart of strength against modulus), two of three
 * structural alloys of 0.002 and more. Of the energy of its peak the contact gives back by itself
 * the closed form's share (closed_form_restitution), and the rebound after the largest indentation
 * is lowered by it. Later sub-impacts begin at other instants then, or not at all.
 *
 * Losses of materials that no contact law has: polymers, rubber, wood. (Their vibration is damped,
 * see the key `damping`.) A material of loss factor eta loses 2 pi eta of the energy that it stores
 * at most in a cycle of strain, and pi eta in the half of one that a contact is. A rebound gives
 * back exp(-pi eta) of its energy, the resilience of rubber (Gent, Engineering with Rubber, chapter
 * 4), and exp(-pi eta/2) of the restitution. Of two bodies each stores its share of the
 * indentation: (1 - nu^2)/E, of the sum of both. Hertz's contact with a viscosity that gives eta at
 * the frequency of its duration T, pi/T, loses 1.77 eta instead of 1.57 (Kuwabara and Kono, Jpn. J.
 * Appl. Phys. 26 (1987) 1230).
 *
 * A loss factor eta that was measured at another frequency w_0 is taken as it is, as that of many
 * materials varies slowly. How much it may vary is that of the material that varies most around it:
 * the standard solid whose loss factor is largest, and eta, at w_0. A share g that relaxes in the
 * time t has the loss factor g w t/(1 - g + (w t)^2), which is largest at w t = sqrt(1 - g), and
 * g/(2 sqrt(1 - g)) there. So it is eta/cosh(ln(w/w_0)) for every eta: a loss modulus is a sum of
 * such terms, and no sum falls faster than one. */
#ifndef PERCUSS_SOLVE_ERROR_LAW_H
#define PERCUSS_SOLVE_ERROR_LAW_H

#include "impact/impact.h"
#include "solve/contact_model.h"
#include "solve/problem.h"
#include "solve/result.h"

/* An estimate for a contact after a solution, as a part of the restitution; 0: Hertz below yield.
 */
double law_error(const struct problem *problem, const struct impact_outcome *outcome,
                 size_t contact);

/* The same of one that yielded, by its history: by size and shape of the contact, by the law
 * itself, and by the rate of strain of its yield stress. */
enum law_error_part { LAW_ERROR_SIZE, LAW_ERROR_LAW, LAW_ERROR_RATE, LAW_ERROR_COUNT };
void law_error_parts(const struct problem *problem, size_t contact,
                     const struct contact_history *history, double parts[LAW_ERROR_COUNT]);

/* Factor of the yield stress that changes the rebound of a contact alone from a depth by
 * the share `share` of its restitution; at most 3. */
double law_error_yield(const struct contact_law *law, double depth, double share);

/* The largest part of it, in words. */
const char *law_error_reason(const struct problem *problem, const struct impact_outcome *outcome,
                             size_t contact);

/* The largest of all contacts. */
double law_error_worst(const struct problem *problem, const struct impact_outcome *outcome);

/* Whether a contact has such a metal. */
bool unstated_any(const struct problem *problem, size_t contact);

/* One contact of an answer as it is judged by. */
struct unstated_impact {
    double force;   /* largest, N */
    double depth;   /* of flow, largest over that of yield; 0: nothing flowed */
    double rebound; /* restitution that follows the largest indentations */
    double later;   /* that sub-impacts after the first make */
    double range;   /* largest possible error of a restitution */
};

struct unstated_impact unstated_impact_of(const struct problem *problem,
                                          const struct impact_outcome *outcome, size_t contact);

/* The yield above which the metals of unstated yield of a contact are elastic under a
 * force, Pa; 0: there are none. */
double unstated_holds_above(const struct problem *problem, size_t contact, double force);

/* By how much the restitution changes where such a metal yields at young/500. */
double unstated_change(const struct problem *problem, size_t contact,
                       const struct unstated_impact *impact);

/* The largest of all contacts. */
double unstated_worst(const struct problem *problem, const struct impact_outcome *outcome);

/* Writes the yield above which a solution holds, of all contacts. */
void unstated_explain(const struct problem *problem, const struct impact_outcome *outcome,
                      struct text *text);

/* Warns of a change of more than the tolerance. */
void unstated_find(const struct problem *problem, size_t contact,
                   const struct unstated_impact *impact, struct warnings *warnings);

/* By how much the restitution may be wrong by the loss factor of a contact that has it: by what
 * measurements leave, or by the distance of the frequency at which it was measured. */
double loss_deviation(const struct problem *problem, size_t contact, double rebound);

/* Loss of a contact's restitution by the stated loss_factor of its materials, where its law does
 * not have it, and by the least that soft ones have of which none is stated; `rebound` is the
 * restitution that the motion after the largest indentations makes. */
double loss_of_contact(const struct problem *problem, size_t contact, double rebound);

/* The largest of all contacts. */
double loss_worst(const struct problem *problem, const struct impact_outcome *outcome);

/* Warns of losses of more than the tolerance: stated, or certain of so soft a material. */
void loss_find(const struct problem *problem, size_t contact, double rebound,
               struct warnings *warnings);

#endif
