/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/table_curves.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "numeric/spline.h"

/* Samples of a branch at equal steps of the way back: twice those of the computation, which lie
 * close together where the force is small. */
enum { SHARES = 2 * INDENTATION_SAMPLES - 1 };

/* Points up to first yield: the spline's bend there reaches back over some of them, by a quarter
 * from one to the next; the others are Hertz's. */
enum { ELASTIC_POINTS = 8 };

/* Branches put in between first yield and the first computed one, where a dent and what its branch
 * differs by from Hertz's begin with the square of the way beyond yield: with the computed branch
 * taken down to yield a blow there would give back more than it brought. The first of them is
 * elastic and lies at yield but for rounding. In between laws mix branches linearly, so that what
 * grows with the square is off by up to 1/(4 ONSET^2) of the computed branch's. */
enum { ONSET = 8 };
static const double just_beyond = 1.0 + 1e-6;

static double rising(double value, double before)
{
    return fmax(value, before * (1.0 + 1e-9));
}

/* The origin, Hertz up to first yield, the computed points beyond. The computed contact radius is
 * known to half an element only, and must not shrink. Returns the number of points. */
static size_t fill_loading(const struct indentation_table *table, double *indentation,
                           double *force, double *radius)
{
    double yield = table->indentation[0];
    size_t count = 0;
    indentation[count] = force[count] = radius[count] = 0.0;
    count++;
    for (; count <= ELASTIC_POINTS; count++) {
        indentation[count] = yield * (double)count / ELASTIC_POINTS;
        force[count] = table->hertz * indentation[count] * sqrt(indentation[count]);
        radius[count] = sqrt(table->input.radius * indentation[count]);
    }
    for (size_t i = 1; i < table->points; i++, count++) {
        indentation[count] = table->indentation[i];
        force[count] = table->force[i];
        radius[count] = rising(table->radius[i], radius[count - 1]);
    }
    return count;
}

/* One branch at equal steps: F^(2/3) is nearly a straight line of the way back. `part` of the way
 * from Hertz's branch (0) to the computed one (1). */
static void fill_branch(const double *recovery, double part, double *share, double *memory)
{
    struct spline spline = {INDENTATION_SAMPLES, memory, memory + INDENTATION_SAMPLES,
                            memory + 2 * INDENTATION_SAMPLES};
    for (size_t j = 0; j < INDENTATION_SAMPLES; j++) {
        double root = cbrt(indentation_fraction(j));
        spline.value[j] = root * root;
        spline.place[j] = spline.value[j] + part * (recovery[j] - spline.value[j]);
    }
    spline_set_slopes(&spline, memory + 3 * INDENTATION_SAMPLES);
    for (size_t i = 1; i + 1 < SHARES; i++) {
        double slope;
        double value = spline_at(&spline, (double)i / (SHARES - 1), &slope);
        share[i] = value * sqrt(value);
    }
    share[0] = 0.0;
    share[SHARES - 1] = 1.0;
}

static bool is_way(const double *recovery)
{
    for (size_t j = 1; j < INDENTATION_SAMPLES; j++)
        if (!(recovery[j] > recovery[j - 1]))
            return false;
    return recovery[0] == 0.0 && recovery[INDENTATION_SAMPLES - 1] == 1.0;
}

static enum percuss_status check(const struct indentation_table *table, struct fault *fault)
{
    if (table->points == 0 || table->branches == 0 || !(table->indentation[0] > 0.0) ||
        (table->points > 1) != (table->branches > 1))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "contact table: %zu points and %zu branches: must begin at first yield "
                         "and have branches beyond it if it has points there",
                         table->points, table->branches);
    for (size_t b = 1; b < table->branches; b++)
        if (!is_way(&table->recovery[b * INDENTATION_SAMPLES]))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "contact table: the way back from %g m: must rise from 0 to 1",
                             table->largest[b]);
    return PERCUSS_OK;
}

struct contact_curves *table_curves_make(const struct indentation_table *table, struct fault *fault)
{
    if (check(table, fault))
        return NULL;
    size_t room = table->points + ELASTIC_POINTS;
    size_t branches = table->branches > 1 ? table->branches - 1 + ONSET : 0;
    double *memory =
        calloc(3 * room + branches * (SHARES + 2) + 5 * INDENTATION_SAMPLES, sizeof *memory);
    if (!memory) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        return NULL;
    }
    double *indentation = memory, *force = memory + room, *radius = memory + 2 * room;
    double *largest = memory + 3 * room, *residual = largest + branches;
    double *share = residual + branches;
    double *scratch = share + branches * SHARES;
    size_t points = fill_loading(table, indentation, force, radius);
    for (size_t b = 0; b < branches; b++) {
        size_t from = b < ONSET ? 1 : b - ONSET + 1;
        double way = b < ONSET ? (double)b / ONSET : 1.0;
        double ratio = table->largest[from] / table->indentation[0];
        largest[b] = b < ONSET ? table->indentation[0] * pow(ratio, way) : table->largest[from];
        residual[b] =
            fmax(0.0, table->residual[from]) / table->largest[from] * largest[b] * (way * way);
        fill_branch(&table->recovery[from * INDENTATION_SAMPLES], way * way, &share[b * SHARES],
                    scratch);
    }
    if (branches)
        largest[0] *= just_beyond;
    struct contact_table samples = {
        .points = points,
        .indentation = indentation,
        .force = force,
        .contact_radius = radius,
        .yield = table->indentation[0],
        .branches = branches,
        .largest = largest,
        .residual = residual,
        .samples = SHARES,
        .share = share,
        .surface_radius = table->input.radius,
        .error = table->force_error,
    };
    struct contact_curves *curves = contact_curves_create(&samples, fault);
    free(memory);
    return curves;
}
