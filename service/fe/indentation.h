/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Force against indentation of an elastic-plastic pair, tabulated from the static contact region:
 * the loading curve and the unloading branches from several largest indentations, on which
 * reloading runs back. Indentation is the local one of region.h, interchangeable with Hertz's. */
#ifndef PERCUSS_FE_INDENTATION_H
#define PERCUSS_FE_INDENTATION_H

#include "fe/indentation_run.h"

/* Changes whenever the same input would give another table. */
#define INDENTATION_VERSION 1

struct indentation_table {
    struct region_input input; /* all there is: the table's key, with the version */
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

    /* Largest differences to a mesh 1.5 times coarser, and for the force a third of what shorter
     * steps still change: more than what is left. */
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
