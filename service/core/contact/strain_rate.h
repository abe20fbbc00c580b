/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mean rate of strain of a contact while it is loaded. */
#ifndef PERCUSS_CONTACT_STRAIN_RATE_H
#define PERCUSS_CONTACT_STRAIN_RATE_H

#include "contact/hertz.h"
#include "model/yield_rate.h"

/* One impact on a contact. */
struct strain_rate_blow {
    double speed; /* m/s, at the touch */
    double work;  /* J, that the contact takes up until its largest indentation; > 0 */
};

/* The rate (1/s) and, of both bodies, the yield stress at that rate over the stated one; at least
 * one of them can yield. The representative strain of a dent of radius a in a sphere's
 * contact of radius R is 0.2 a/R (Tabor, The Hardness of Metals, 1951); the contact reaches its
 * largest indentation d after pi/2 d/speed, as under a force that is proportional to it (Johnson,
 * Contact Mechanics, 1985, section 11.5; Hertz's law takes 0.94 of that). Depth and radius are
 * those of the closed form at the yield stress of that rate. */
double strain_rate_of(const struct hertz_contact *hertz, const struct material *const materials[2],
                      const struct yield_rate *const stated[2], const struct strain_rate_blow *blow,
                      double factors[2]);

#endif
