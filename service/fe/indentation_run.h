/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One passage over the contact region, from the first touch to the largest indentation, with
 * unloadings on the way. */
#ifndef PERCUSS_FE_INDENTATION_RUN_H
#define PERCUSS_FE_INDENTATION_RUN_H

#include "base/watch.h"
#include "fe/region.h"

enum { INDENTATION_RINGS_MAX = 1000, INDENTATION_SAMPLES = 21 };

/* As the contact edge crosses an element the force ripples about the smooth curve by a part of the
 * element's size (flow cannot be undone, so this is of first order); the mean over one crossing is
 * free of it. */
struct indentation_run {
    size_t rings;
    double middle[INDENTATION_RINGS_MAX]; /* m, indentation (geometric mean of a crossing) */
    double ratio[INDENTATION_RINGS_MAX]; /* mean force over Hertz's, the elastic mesh error removed;
                                          * ring 0 is the last elastic one: 1 */
    double radius[INDENTATION_RINGS_MAX]; /* m */
    size_t branches; /* as in struct indentation_table, the elastic one first */
    double largest[INDENTATION_RINGS_MAX], residual[INDENTATION_RINGS_MAX];
    double recovery[INDENTATION_RINGS_MAX * INDENTATION_SAMPLES];
    struct region_effort effort;
};

struct indentation_plan {
    struct region_input input;
    size_t steps;              /* of a crossing */
    size_t branch_every;       /* crossings between unloadings; 0: none */
    double done, share;        /* of the whole work: before this run, and its own */
    const struct watch *watch; /* NULL: nobody */
};

/* Statuses as indentation_table_make. */
enum percuss_status indentation_run(const struct indentation_plan *plan,
                                    struct indentation_run *run, struct fault *fault);

/* Where sample j of a branch lies, of its largest force: (j / (INDENTATION_SAMPLES - 1))^3. */
double indentation_fraction(size_t sample);

/* k of F = k d^1.5, N/m^1.5. */
double indentation_hertz(const struct region_input *input);

/* Cubic through the four points nearest in the logarithm of x[n] (ascending, > 0); the values are
 * y[0], y[stride], ... */
double indentation_interpolate(size_t n, const double *x, const double *y, size_t stride,
                               double at);

#endif
