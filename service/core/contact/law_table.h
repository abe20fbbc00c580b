/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tabulated laws of contacts that yield: a loading curve and a family of unloading branches,
 * sampled from a computation of the contact region and interpolated smoothly. */
#ifndef PERCUSS_CONTACT_LAW_TABLE_H
#define PERCUSS_CONTACT_LAW_TABLE_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"
#include "contact/law.h"
#include "model/material.h"
#include "numeric/spline.h"

/* Samples, struct of arrays; borrowed by contact_curves_create only while it runs. All rise
 * strictly, the first of each curve is 0. */
struct contact_table {
    size_t points;
    const double *indentation;    /* [points] of the loading curve, m */
    const double *force;          /* [points], N */
    const double *contact_radius; /* [points], m */
    double yield;                 /* largest elastic indentation; > 0 */
    size_t branches;              /* 0: an elastic table */
    const double *largest;  /* [branches]: indentation at which unloading begins, m, > yield */
    const double *residual; /* [branches]: permanent indentation, m */
    size_t samples;         /* of each branch, at equal steps of x in 0..1 */
    const double *share;    /* [branches][samples]: F/F_largest at x = (d - residual) /
                               (largest - residual); 0 at x = 0, 1 at x = 1 */
    double surface_radius;  /* m, 1 / (1/R_a + 1/R_b) of the computation; 0: not stated, the law
                               is then used unscaled for any */
    double error;           /* relative, of the force, as its computation states it */
    double range;           /* m: the table is extrapolated beyond; 0: nowhere */
};

struct contact_family; /* family.h */

/* A table ready for interpolation; immutable, may be shared. Every curve is interpolated in
 * F^(2/3), which is a straight line for Hertz and nearly one beyond yield, by monotone splines. The
 * members are for law_table.c and family.c, which make it. */
enum { CURVES_JOINTS = 6 };

struct contact_curves {
    struct spline loading; /* F^(2/3) of d */
    struct spline radius;  /* a^2 of d */
    struct spline spring;  /* 1 - residual/largest of log(largest) */
    struct spline *branch; /* [branches]: share^(2/3) of x, at equal steps */
    double *work;          /* [points]: of the loading curve up to each, J */
    double yield, error;
    double range;                     /* m: the curves are extrapolated beyond */
    double surface_radius;            /* m; 0: not stated */
    double joints[CURVES_JOINTS + 1]; /* ascending; INFINITY: no more */
    size_t branches;
    double memory[];
};

/* OK; BAD_REQUEST: bad samples; INTERNAL: out of memory. *curves is NULL then; otherwise the caller
 * frees it. */
enum percuss_status contact_curves_create(const struct contact_table *table,
                                          struct contact_curves **curves, struct fault *fault);
void contact_curves_free(struct contact_curves *curves); /* NULL is allowed */

/* Last indentation that was computed, m: beyond it the law continues as a fully plastic contact,
 * see law_table.c. */
double contact_curves_range(const struct contact_curves *curves);
/* Relative error of the force that the table states. */
double contact_curves_error(const struct contact_curves *curves);

/* The law of a table, which must outlive it. */
struct contact_law contact_law_table(const struct contact_curves *curves);
/* The same, reported as a law of the catalogue (contact/law_own.h). */
struct contact_law contact_law_points(const struct contact_curves *curves);
/* The same for surfaces of another radius (m, 1 / (1/R_a + 1/R_b)), exact by dimensions: a static
 * contact region of given materials has no length of its own. */
struct contact_law contact_law_table_at(const struct contact_curves *curves, double radius);
/* Last computed indentation of such a law, m. */
double contact_law_table_range(const struct contact_law *law);

/* The contact for which a table is requested. Curvatures as in struct hertz_contact. */
struct contact_pair {
    const struct material *a, *b;
    double curvature[2];
};

/* How a missing table is made, for messages. */
struct contact_table_remedy {
    const char *command; /* without its bodies; NULL: not known */
    const char *then;    /* how it is put to use */
};

/* Source of tables. `find` returns NULL if there is none; several threads call it at once, and it
 * must not wait. */
struct contact_table_source {
    void *context;
    const struct contact_curves *(*find)(void *context, const struct contact_pair *pair);
    const struct contact_family *family; /* for pairs without a table of their own; NULL: none */
    struct contact_table_remedy remedy;
};

/* For family.c, which makes curves of its own. */

static inline double curves_two_thirds(double value)
{
    double root = cbrt(value);
    return root * root;
}

/* Whether values rise strictly, to a finite last one. */
static inline bool curves_rise(size_t count, const double *values)
{
    for (size_t i = 1; i < count; i++)
        if (!(values[i] > values[i - 1]))
            return false;
    return isfinite(values[count - 1]);
}

/* Work and joints of a loading curve that has its places, values and slopes. */
void curves_finish(struct contact_curves *curves);

/* The law of curves in their own units of length (m), force (N) and contact radius (m). */
struct contact_law contact_law_table_in(const struct contact_curves *curves, double length,
                                        double force, double radius);

#endif
