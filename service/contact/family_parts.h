/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What family_make.c and family_curves.c (a place in it) share. */
#ifndef PERCUSS_CONTACT_FAMILY_PARTS_H
#define PERCUSS_CONTACT_FAMILY_PARTS_H

#include <math.h>

#include "contact/family.h"

/* Points of the loading curve up to first yield, where it is Hertz's: the spline's bend at yield
 * reaches back over some of them. */
enum { FAMILY_ELASTIC = 8 };

/* Branches put in between first yield and the first sampled one, where a dent and what its branch
 * differs by from Hertz's begin with the square of the way: the first of them is Hertz's, at yield
 * but for rounding. Laws mix branches linearly: with fewer a blow there might give back more than
 * it brought. */
enum { FAMILY_ONSET = 8 };

struct family_axis {
    size_t count;
    double place[CONTACT_FAMILY_MOST];
};

/* Numbers of one table: values and slopes of three curves; of all branches. */
struct contact_family {
    struct family_axis axis[CONTACT_FAMILY_AXES];
    size_t tables, points, springs, branches, samples;
    double *depth;  /* [points] from 0 on */
    double *log;    /* [springs] of the depth, from that of yield on */
    double *step;   /* [samples] of the way back */
    double *curves; /* [tables][4 points + 2 springs] */
    double *shapes; /* [tables][2 branches samples] */
    double computed, error;
    double memory[];
};

static inline size_t family_curve_numbers(const struct contact_family *family)
{
    return 4 * family->points + 2 * family->springs;
}

static inline size_t family_shape_numbers(const struct contact_family *family)
{
    return 2 * family->branches * family->samples;
}

/* Along the axes: the root of the hardening, as cubics through it hold both what grows like it and
 * what grows like the hardening; and a logarithm of the share, as curves bend ever more the smaller
 * it is (of the force at 900 times the yield's depth, hardening 0.1, it is straight within 6 %). */
static inline double family_along(size_t axis, double value)
{
    const double bend = 0.1;
    return axis == 0 ? sqrt(value) : axis == 2 ? log(value + bend) : value;
}

#endif
