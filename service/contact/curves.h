/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a tabulated law interpolates: every curve in F^(2/3), which is a straight line for Hertz and
 * nearly one beyond yield, by monotone splines. Shared by what makes curves (curves.c,
 * family_make.c) and what follows them (law_table.c). */
#ifndef PERCUSS_CONTACT_CURVES_H
#define PERCUSS_CONTACT_CURVES_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "contact/table.h"
#include "numeric/spline.h"

enum { CURVES_JOINTS = 6 };

struct contact_curves {
    struct spline loading; /* F^(2/3) of d */
    struct spline radius;  /* a^2 of d */
    struct spline spring;  /* 1 - residual/largest of log(largest) */
    struct spline *branch; /* [branches]: share^(2/3) of x, at equal steps */
    double *work;          /* [points]: of the loading curve up to each, J */
    double yield, error;
    double range;                     /* m: what lies beyond was continued, not computed */
    double surface_radius;            /* m; 0: not stated */
    double joints[CURVES_JOINTS + 1]; /* ascending; INFINITY: no more */
    size_t branches;
    double memory[];
};

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

/* Integral of value^(3/2) over a part of segment i of a mix of two splines, which share their
 * places: (1 - mix) a + mix b. */
double curves_work_on(const struct spline *a, const struct spline *b, double mix, size_t i,
                      const double part[2]);

/* The law of curves in units of their own: m, N and m of contact radius for one of each. */
struct contact_law contact_law_table_in(const struct contact_curves *curves, double length,
                                        double force, double radius);

/* Work and joints of a loading curve that has its places, values and slopes. */
void curves_finish(struct contact_curves *curves);

#endif
