/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The closed-form elastic-plastic law: Jackson and Green, J. Tribology 127 (2005) 343 (loading),
 * and Jackson, Green and Marghitu, Nonlinear Dynamics 60 (2010) 217 (permanent indentation),
 * both fitted to finite elements of an elastic, ideally plastic sphere against a rigid plane. */
#ifndef PERCUSS_CONTACT_LAW_CLOSED_FORM_H
#define PERCUSS_CONTACT_LAW_CLOSED_FORM_H

#include "contact/hertz.h"
#include "contact/law.h"

/* Hertz's peak pressure at which a material yields by this law: C(poisson) yield, C = 1.295
 * exp(0.736 poisson), Pa. */
double closed_form_pressure(const struct material *material);

/* The body that yields first, at the lower of these pressures. 0: a, 1: b, -1: neither. */
int closed_form_softer(const struct material *a, const struct material *b);

/* The pressure at which b yields over that of a. */
double closed_form_yield_ratio(const struct material *a, const struct material *b);

/* Indentation at which yield begins, m; INFINITY: never. Elliptic contacts follow the law of
 * the sphere that is as stiff, yielding where their own peak pressure is that of yield. In full
 * plastic flow the mean pressure over the ellipse's area 2 pi d sqrt(R1 R2) then is the sphere's
 * but for 1, 3, 6 and 10 % where B/A is 2.5, 5, 10 and 21. */
double closed_form_yield(const struct hertz_contact *hertz, const struct material *a,
                         const struct material *b);

/* The law of a contact: exactly Hertz up to 1.9 times the indentation of yield, see
 * law_closed_form.c, and at any indentation if neither body can yield. */
struct contact_law contact_law_closed_form(const struct hertz_contact *hertz,
                                           const struct material *a, const struct material *b);

/* Restitution of a contact alone, at `times` the energy at which it yields: Jackson, Green and
 * Marghitu's fit, for yield / E-star `strain`; beyond a thousand times the speed of yield by its
 * power -1/4 (Johnson, Contact Mechanics, section 11.5). */
double closed_form_restitution(double times, double strain);

/* Radius of the sphere on a plane that is as stiff: k = (4/3) E-star sqrt(R), m. */
double closed_form_radius(const struct hertz_contact *hertz);

#endif
