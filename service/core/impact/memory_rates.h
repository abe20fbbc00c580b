/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a contact remembers (contact/memory.h) as ordinary differential equations, for a general
 * solver (reference.c): the terms of its memory are states, between the instants at which it turns,
 * parts or touches. */
#ifndef PERCUSS_IMPACT_MEMORY_RATES_H
#define PERCUSS_IMPACT_MEMORY_RATES_H

#include "contact/law.h"
#include "contact/memory.h"

struct memory_rates {
    struct recovery_modes modes;
    struct contact_memory memory; /* at the last event */
    double time;                  /* of that, s */
    double stiffness, compliance; /* of the law, N/m^(3/2); in series with it, m/N */
};

/* Of a law that remembers; the struct stays where it is. */
void memory_rates_create(struct memory_rates *rates, const struct contact_law *law,
                         double compliance);

/* Numbers of its state: center, total, slope and bend of each term, one after the other. While it
 * shrinks `total` is of all that it remembers. */
size_t memory_rates_size(const struct memory_rates *rates);

/* Absolute tolerances of them for a contact of that indentation, m. */
void memory_rates_tolerate(const struct memory_rates *rates, double relative, double indentation,
                           double *absolute);

/* An instant of the contact: the approach is given, and a starting value of the indentation, which
 * becomes d with d + compliance F(d) = approach. */
struct memory_instant {
    double time, approach, indentation;
    double force, stiffness; /* N, N/m */
    double fades;            /* the force's rate at the same indentation, N/s */
    double recedes;          /* while it grows: rate of the free surface where it grows to, m/s */
    double pressed;          /* > 0: the middle bears a force, m */
};

/* `rate` becomes the derivative of `state`. */
void memory_rates_find(const struct memory_rates *rates, const double *state,
                       struct memory_instant *at, double *rate);

/* The rate of d less `recedes`, or `pressed`, changes its sign at that instant: the state goes on
 * from there. */
void memory_rates_meet(struct memory_rates *rates, double *state, const struct memory_instant *at);

#endif
