/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A force law that a catalogue states for the contacts of two materials, in place of Hertz's and of
 * those that yield: a power of the indentation, or points of a measurement or computation. It is
 * that of the whole pair: radii and materials do not change it. */
#ifndef PERCUSS_MODEL_OWN_LAW_H
#define PERCUSS_MODEL_OWN_LAW_H

#include <stdbool.h>
#include <stddef.h>

#include "numeric/spline.h"
#include "percuss/vocabulary.h"

/* Deviation of the force of a law that is stated without one, as a share of it: that of repeated
 * quasistatic tests. */
#define OWN_LAW_USUAL_DEVIATION 0.05

/* Points of a force over indentations: both rise strictly, the first force is 0. */
struct own_curve {
    size_t count;                /* 0: there is none */
    double *indentation, *force; /* [count], m and N; one block, which `indentation` owns */
    char file[256];              /* as the catalogue names it */
};

struct own_law {
    char name[PERCUSS_ID_SIZE];
    char between[2][PERCUSS_ID_SIZE]; /* materials, as struct friction_pair's */
    double stiffness;           /* F = stiffness d^exponent, N/m^exponent; 0: `points` instead */
    double exponent;            /* >= 1 */
    double hysteresis;          /* share of the work of loading that unloading does not give back */
    double dissipation;         /* s/m, Hunt and Crossley's; 0: none */
    double deviation;           /* of the force, one standard deviation over it */
    struct own_curve points;    /* loading, from 0 m */
    struct own_curve unloading; /* from the last of `points` back; count 0: the same way */
};

/* A monotone spline of F^(2/3) over the indentation, by which a law goes through its points; values
 * and slopes are in *block, for free(), the places the curve's. False: out of memory. */
bool own_curve_spline(const struct own_curve *curve, double **block, struct spline *spline);

/* The force at an indentation by such a spline, N. */
double own_curve_force(const struct spline *spline, double indentation);

/* Frees its curves. */
void own_law_clear(struct own_law *law);

#endif
