/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/table_curves.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "contact/plastic.h"
#include "numeric/spline.h"

/* Whether a recovery [INDENTATION_SAMPLES] rises from 0 to 1. */
static bool branch_shares_possible(const double *recovery)
{
    for (size_t j = 1; j < INDENTATION_SAMPLES; j++)
        if (!(recovery[j] > recovery[j - 1]))
            return false;
    return recovery[0] == 0.0 && recovery[INDENTATION_SAMPLES - 1] == 1.0;
}

void branch_shares_fill(const double *recovery, double part, size_t count, double *share,
                        double scratch[BRANCH_SHARES_SCRATCH])
{
    struct spline spline = {INDENTATION_SAMPLES, scratch, scratch + INDENTATION_SAMPLES,
                            scratch + 2 * INDENTATION_SAMPLES};
    for (size_t j = 0; j < INDENTATION_SAMPLES; j++) {
        double root = cbrt(indentation_fraction(j));
        spline.value[j] = root * root;
        spline.place[j] = spline.value[j] + part * (recovery[j] - spline.value[j]);
    }
    spline_set_slopes(&spline, scratch + 3 * INDENTATION_SAMPLES);
    for (size_t i = 1; i + 1 < count; i++) {
        double slope;
        double value = spline_at(&spline, (double)i / (double)(count - 1), &slope);
        share[i] = value * sqrt(value);
    }
    share[0] = 0.0;
    share[count - 1] = 1.0;
}

/* Samples of a branch at equal steps of the recovery: twice as many as the computed ones, which lie
 * close together where the force is small. */
enum { SHARES = 2 * INDENTATION_SAMPLES - 1 };

/* Points up to first yield: the spline's bend there disturbs the points before it, by a quarter
 * from one to the next; the others lie on Hertz's curve. */
enum { ELASTIC_POINTS = 8 };

/* Branches inserted between first yield and the first computed one. There the dent and the branch's
 * difference from Hertz's grow with the square of the indentation beyond yield: with the computed
 * branch scaled down to yield an impact would return more energy than it brought. The first
 * inserted branch is elastic and lies at yield but for rounding. Laws interpolate branches
 * linearly, so that a quantity that grows with the square is off by up to 1/(4 ONSET^2) of the
 * computed branch's. */
enum { ONSET = 8 };
static const double JUST_BEYOND = 1.0 + 1e-6;

/* Points and branches beyond the computed ones, ten to a decade: as deep as the radius. */
enum { BEYOND = 25 };
#define BEYOND_STEP 1.2589254117941673

static double at_least_rising(double value, double before)
{
    return fmax(value, before * (1.0 + 1e-9));
}

/* The origin, Hertz up to first yield, the computed points beyond. The computed contact radius is
 * accurate to half an element only, and must not shrink. Returns the number of points. */
static size_t sample_loading(const struct indentation_table *table, double *indentation,
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
        radius[count] = at_least_rising(table->radius[i], radius[count - 1]);
    }
    return count;
}

static enum percuss_status table_curves_check(const struct indentation_table *table,
                                              struct fault *fault)
{
    if (table->points == 0 || table->branches == 0 || !(table->indentation[0] > 0.0) ||
        (table->points > 1) != (table->branches > 1))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "contact table: %zu points and %zu branches: must begin at first yield "
                         "and have branches beyond it if it has points there",
                         table->points, table->branches);
    for (size_t b = 1; b < table->branches; b++)
        if (!branch_shares_possible(&table->recovery[b * INDENTATION_SAMPLES]))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "contact table: the way back from %g m: must rise from 0 to 1",
                             table->largest[b]);
    return PERCUSS_OK;
}

/* Samples in one block of memory. */
struct samples {
    size_t points, branches;
    double *indentation, *force, *radius;
    double *largest, *residual, *share;
    double *scratch; /* [BRANCH_SHARES_SCRATCH] */
    double range;    /* m, as in struct contact_table */
};

static bool samples_allocate(struct samples *samples, size_t points, size_t branches)
{
    double *memory =
        calloc(3 * points + branches * (SHARES + 2) + BRANCH_SHARES_SCRATCH, sizeof *memory);
    if (!memory)
        return false;
    samples->indentation = memory;
    samples->force = memory + points;
    samples->radius = memory + 2 * points;
    samples->largest = memory + 3 * points;
    samples->residual = samples->largest + branches;
    samples->share = samples->residual + branches;
    samples->scratch = samples->share + branches * SHARES;
    return true;
}

static void sample_branches(const struct indentation_table *table, struct samples *samples)
{
    for (size_t b = 0; b < samples->branches; b++) {
        size_t from = b < ONSET ? 1 : b - ONSET + 1;
        double way = b < ONSET ? (double)b / ONSET : 1.0;
        double ratio = table->largest[from] / table->indentation[0];
        samples->largest[b] =
            b < ONSET ? table->indentation[0] * pow(ratio, way) : table->largest[from];
        samples->residual[b] = fmax(0.0, table->residual[from]) / table->largest[from] *
                               samples->largest[b] * (way * way);
        branch_shares_fill(&table->recovery[from * INDENTATION_SAMPLES], way * way, SHARES,
                           &samples->share[b * SHARES], samples->scratch);
    }
    if (samples->branches)
        samples->largest[0] *= JUST_BEYOND;
}

/* Continues the curves beyond the last samples in proportion to the law's. */
static void samples_continue(const struct contact_law *law, struct samples *samples)
{
    const struct plastic_curve *curve = law->operations->curve;
    size_t last = samples->points - 1;
    size_t end = samples->branches - 1;
    double slope;
    /* factors that join the law's curves to the last values */
    double from = samples->indentation[last], deepest = samples->largest[end];
    double force = samples->force[last] / curve->force(law, from, &slope);
    double radius = samples->radius[last] / curve->radius(law, from);
    double back = (deepest - samples->residual[end]) / (deepest - curve->residual(law, deepest));
    /* loading curve and branches, at equal ratios of the depth */
    for (size_t i = 1; i <= BEYOND; i++) {
        double d = from * pow(BEYOND_STEP, (double)i);
        size_t to = last + i, branch = end + i;
        samples->indentation[to] = d;
        samples->force[to] = force * curve->force(law, d, &slope);
        samples->radius[to] =
            at_least_rising(radius * curve->radius(law, d), samples->radius[to - 1]);
        d = deepest * pow(BEYOND_STEP, (double)i);
        samples->largest[branch] = d;
        samples->residual[branch] = d - back * (d - curve->residual(law, d));
        memcpy(&samples->share[branch * SHARES], &samples->share[end * SHARES],
               SHARES * sizeof(double));
    }
    samples->points += BEYOND;
    samples->branches += BEYOND;
}

static bool samples_continue_by_family(const struct indentation_table *table,
                                       const struct contact_family *family, struct samples *samples)
{
    const struct material *a = &table->input.materials[0], *b = &table->input.materials[1];
    double curvature = 0.5 / table->input.radius;
    struct hertz_contact hertz =
        hertz_contact_make(hertz_effective_modulus(a, b), curvature, curvature);
    struct contact_family_place place = contact_family_place(a, b);
    struct arena arena = {0};
    const struct contact_curves *curves = contact_family_curves(family, &place, &arena);
    if (curves) {
        struct contact_law law = contact_law_family(curves, &hertz, a, b);
        samples_continue(&law, samples);
        samples->range = contact_law_table_range(&law);
    }
    arena_release(&arena);
    return curves;
}

enum percuss_status table_curves_make(const struct indentation_table *table,
                                      const struct contact_family *family,
                                      struct contact_curves **curves, struct fault *fault)
{
    *curves = NULL;
    enum percuss_status status = table_curves_check(table, fault);
    if (status)
        return status;
    /* memory for inserted branches and for the continuation, too */
    size_t branches = table->branches > 1 ? table->branches - 1 + ONSET : 0;
    struct samples samples = {.branches = branches};
    if (!samples_allocate(&samples, table->points + ELASTIC_POINTS + BEYOND, branches + BEYOND))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    /* the samples in the form of a contact table */
    samples.points = sample_loading(table, samples.indentation, samples.force, samples.radius);
    sample_branches(table, &samples);
    if (family && branches && !samples_continue_by_family(table, family, &samples))
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    else
        status = contact_curves_create(
            &(struct contact_table){
                .points = samples.points,
                .indentation = samples.indentation,
                .force = samples.force,
                .contact_radius = samples.radius,
                .yield = table->indentation[0],
                .branches = samples.branches,
                .largest = samples.largest,
                .residual = samples.residual,
                .samples = SHARES,
                .share = samples.share,
                .surface_radius = table->input.radius,
                .error = table->force_error,
                .range = samples.range,
            },
            curves, fault);
    free(samples.indentation);
    return status;
}
