/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One family of tables for the circular contacts of any two metals. In the static contact region of
 * finite-elements.md (half-spaces that part like r^2 / (2 R), small strains, von Mises, linear
 * hardening) lengths scale with R and strains with yield/E-star: with indentations in units of that
 * of first yield, d_c = (pi C S_y / (2 E-star))^2 R, and forces in units of Hertz's force there,
 * results depend neither on R nor on yield/E-star, but only on three ratios of the materials:
 *
 * - hardening: tangent / young of the body that yields;
 * - poisson: of the body that yields;
 * - share: its part of the compliance 1/E-star. The other body enters by (1 - poisson^2)/young
 *   alone. Two equal bodies that both yield are each one against a rigid flat: 1. */
#ifndef PERCUSS_CONTACT_FAMILY_H
#define PERCUSS_CONTACT_FAMILY_H

#include <stdbool.h>

#include "base/arena.h"
#include "contact/hertz.h"
#include "contact/law_table.h"

enum { CONTACT_FAMILY_AXES = 3, CONTACT_FAMILY_MOST = 12 };

/* A point of the family, in the order of the axes. */
struct contact_family_place {
    double hardening, poisson, share;
};

/* Samples in reduced units, struct of arrays; borrowed by contact_family_create only while it runs.
 * Tables lie with the last axis fastest; depths are d/d_c. */
struct contact_family_samples {
    size_t count[CONTACT_FAMILY_AXES];       /* 2 ... CONTACT_FAMILY_MOST places along each axis */
    const double *axis[CONTACT_FAMILY_AXES]; /* ascending */
    size_t depths;                           /* of the loading curves */
    const double *depth;                     /* [depths], ascending, > 1 */
    const double *force;                     /* [tables][depths]: over Hertz's */
    const double *area;                      /* [tables][depths]: a^2 / (R d) */
    size_t springs;
    const double *largest; /* [springs]: depths at which unloading begins, ascending, > 1 */
    const double *back;    /* [tables][springs]: 1 - residual/largest */
    size_t branches;       /* <= springs: those of the first depths in `largest`; the last is that
                            * of all further ones */
    size_t samples;        /* of each branch, at equal steps of the way back */
    const double *share;   /* [tables][branches][samples], as in struct contact_table */
    double computed;       /* depth up to which it was computed; extrapolated beyond */
    double error;          /* relative, of the force, as its computation states it */
};

/* A family ready for interpolation; immutable, may be shared. */
struct contact_family;

/* Bad samples: NULL, and BAD_REQUEST with the reason in the fault; out of memory: INTERNAL. */
struct contact_family *contact_family_create(const struct contact_family_samples *samples,
                                             struct fault *fault);
void contact_family_free(struct contact_family *family); /* NULL is allowed */

/* The point of two materials, at least one of which can yield (that of closed_form_softer). */
struct contact_family_place contact_family_place(const struct material *a,
                                                 const struct material *b);

/* A metal that would yield later than so many times the pressure at which the other body flows
 * stays elastic. */
static const double CONTACT_FAMILY_HARD_ENOUGH = 2.0;

/* Whether both bodies flow: the harder one yields at less than twice the pressure of the other. */
bool contact_family_both_yield(const struct material *a, const struct material *b);

/* Distance of a place from the range of the axes, as a part of the nearest step; 0: inside. */
double contact_family_outside(const struct contact_family *family,
                              const struct contact_family_place *place);

/* The curves of a place, in reduced units, from the arena; they depend on family and place alone.
 * NULL: out of memory. */
const struct contact_curves *contact_family_curves(const struct contact_family *family,
                                                   const struct contact_family_place *place,
                                                   struct arena *arena);

/* The law of such curves for a contact; an elliptic one follows the sphere that is as stiff. */
struct contact_law contact_law_family(const struct contact_curves *curves,
                                      const struct hertz_contact *hertz, const struct material *a,
                                      const struct material *b);

#endif
