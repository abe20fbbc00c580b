/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tabulated laws of contacts that yield: a loading curve and a family of unloading branches,
 * sampled from a computation of the contact region and interpolated smoothly. */
#ifndef PERCUSS_CONTACT_TABLE_H
#define PERCUSS_CONTACT_TABLE_H

#include "base/fault.h"
#include "contact/law.h"
#include "model/material.h"

/* Samples, struct of arrays; borrowed by contact_curves_create only while it runs. All rise
 * strictly, the first of each curve is 0. */
struct contact_table {
    size_t points;
    const double *indentation;    /* [points] of the loading curve, m */
    const double *force;          /* [points], N */
    const double *contact_radius; /* [points], m */
    double yield;                 /* indentation up to which nothing stays; > 0 */
    size_t branches;              /* 0: an elastic table */
    const double *largest;  /* [branches]: indentation at which unloading begins, m, > yield */
    const double *residual; /* [branches]: what stays of it, m */
    size_t samples;         /* of each branch, at equal steps of x in 0..1 */
    const double *share;    /* [branches][samples]: F/F_largest at x = (d - residual) /
                               (largest - residual); 0 at x = 0, 1 at x = 1 */
    double surface_radius;  /* m, 1 / (1/R_a + 1/R_b) of what was sampled; 0: not stated, the law
                               is then taken for any as it is */
    double error;           /* relative, of the force, as its computation states it */
    double range;           /* m: what lies beyond was continued, not computed; 0: all of it was */
};

struct contact_family; /* family.h */

/* A table made ready for interpolation; immutable, may be shared. */
struct contact_curves;

/* OK; BAD_REQUEST: bad samples; INTERNAL: out of memory. *curves is NULL then; otherwise the caller
 * frees it. */
enum percuss_status contact_curves_create(const struct contact_table *table,
                                          struct contact_curves **curves, struct fault *fault);
void contact_curves_free(struct contact_curves *curves); /* NULL is allowed */

/* Last indentation that was computed, m: beyond it the law goes on as a fully plastic contact, see
 * law_table.c. */
double contact_curves_range(const struct contact_curves *curves);
/* Relative error of the force that the table states. */
double contact_curves_error(const struct contact_curves *curves);

/* The law of a table, which must outlive it. */
struct contact_law contact_law_table(const struct contact_curves *curves);
/* The same for surfaces of another radius (m, 1 / (1/R_a + 1/R_b)), exact by dimensions: a static
 * contact region of given materials has no length of its own. */
struct contact_law contact_law_table_at(const struct contact_curves *curves, double radius);
/* Last computed indentation of such a law, m. */
double contact_law_table_range(const struct contact_law *law);

/* What a table is asked for. Curvatures as in struct hertz_contact. */
struct contact_pair {
    const struct material *a, *b;
    double curvature[2];
};

/* How a table that is missing is made, for people. */
struct contact_table_remedy {
    const char *command; /* without the bodies it is of; NULL: not known */
    const char *then;    /* how it comes into use */
};

/* Where tables come from. `find` returns NULL where there is none; it is called by several threads
 * at once and must not wait. */
struct contact_table_source {
    void *context;
    const struct contact_curves *(*find)(void *context, const struct contact_pair *pair);
    const struct contact_family *family; /* for pairs without a table of their own; NULL: none */
    struct contact_table_remedy remedy;
};

#endif
