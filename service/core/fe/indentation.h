/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Force against indentation of an elastic-plastic pair, tabulated from the static contact region:
 * the loading curve and the unloading branches from several largest indentations, on which
 * reloading runs back. Indentation is the local one of region.h, interchangeable with Hertz's. */
#ifndef PERCUSS_FE_INDENTATION_H
#define PERCUSS_FE_INDENTATION_H

#include "base/watch.h"
#include "fe/region.h"

/* One passage over the contact region, from the first touch to the largest indentation, with
 * unloadings on the way. */

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
    const struct watch *watch; /* NULL: none */
};

/* Statuses as indentation_table_make. */
enum percuss_status indentation_run(const struct indentation_plan *plan,
                                    struct indentation_run *run, struct fault *fault);

/* Where sample j of a branch lies, of its largest force: (j / (INDENTATION_SAMPLES - 1))^3. */
double indentation_fraction(size_t sample);

/* Cubic through the four points nearest in the logarithm of x[n] (ascending, > 0); the values are
 * y[0], y[stride], ... */
double indentation_interpolate(size_t n, const double *x, const double *y, size_t stride,
                               double at);

/* Changes whenever the same input would give another table. */
#define INDENTATION_VERSION 1

struct indentation_table {
    struct region_input input; /* with the version, the table's key */
    unsigned version;
    double hertz; /* N/m^1.5, k of F = k d^1.5 up to point 0 */

    /* Loading, ascending. Point 0 is the last one without flow, or the only one: no flow up to
     * input.indentation; otherwise the last point reaches that or a little more. */
    size_t points;
    double *indentation, *force, *radius; /* m, N, m of contact to half an element */

    /* Unloading from the largest indentations `largest` (ascending, the first is point 0: elastic,
     * without a dent) with the force `largest_force` (on the loading curve) to the indentation
     * `residual` at which the contact opens. Sample j of every branch is at the fraction (j /
     * (INDENTATION_SAMPLES - 1))^3 of its largest force; recovery[branch * INDENTATION_SAMPLES + j]
     * is (d - residual) / (largest
     * - residual), 0 ... 1 ascending. */
    size_t branches;
    double *largest, *largest_force, *residual, *recovery;

    /* Largest differences to a mesh 1.5 times coarser, and for the force a third of the change by
     * shorter steps: above the remaining error. */
    double force_error;    /* of the loading force, relative */
    double residual_error; /* of the residual over the largest indentation */
    double recovery_error; /* of the recovery */

    size_t nodes, newton_steps; /* of the fine solution */
};

/* Computes a table; `watch` is told the part done at every Newton step and may be NULL. OK;
 * BAD_REQUEST as region_create; INTERNAL where an equilibrium was not found or memory ran out;
 * TIMEOUT where the watch stopped it. The table is empty then; otherwise the caller frees it.
 * Resolution 12 takes some seconds, see docs. */
enum percuss_status indentation_table_make(const struct region_input *input,
                                           const struct watch *watch,
                                           struct indentation_table *table, struct fault *fault);
void indentation_table_free(struct indentation_table *table);

#endif
