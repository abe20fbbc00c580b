/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The closed-form elastic-plastic law: Jackson and Green, J. Tribology 127 (2005) 343 (loading),
 * and Jackson, Green and Marghitu, Nonlinear Dynamics 60 (2010) 217 (what stays after unloading),
 * both fitted to finite elements of an elastic, ideally plastic sphere against a rigid plane. */
#ifndef PERCUSS_CONTACT_LAW_CLOSED_FORM_H
#define PERCUSS_CONTACT_LAW_CLOSED_FORM_H

#include "contact/hertz.h"
#include "contact/law.h"

/* The body that yields first: the lower C(poisson) yield, C = 1.295 exp(0.736 poisson). 0: a, 1: b,
 * -1: neither. */
int closed_form_softer(const struct material *a, const struct material *b);

/* How much later the second body yields: its C(poisson) yield over the first one's. */
double closed_form_yield_ratio(const struct material *a, const struct material *b);

/* Indentation at which yield begins, m; INFINITY: never. Elliptic contacts: of the sphere that is
 * as stiff. */
double closed_form_yield(const struct hertz_contact *hertz, const struct material *a,
                         const struct material *b);

/* The law of a contact. Hertz exactly up to 1.9 times the indentation of yield, see
 * law_closed_form.c, and for ever where neither body can yield. */
struct contact_law contact_law_closed_form(const struct hertz_contact *hertz,
                                           const struct material *a, const struct material *b);

/* Radius of the sphere on a plane that is as stiff: k = (4/3) E-star sqrt(R), m. */
double closed_form_radius(const struct hertz_contact *hertz);

#endif
