/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/curves.h"

#include <stdlib.h>

/* Four-point Gauss-Legendre rule on (0, 1). */
static const double gauss_node[] = {0.069431844202973712388, 0.33000947820757186760,
                                    0.66999052179242813240, 0.93056815579702628761};
static const double gauss_weight[] = {0.17392742256872692869, 0.32607257743127307131,
                                      0.32607257743127307131, 0.17392742256872692869};

/* With x = u^2, as the value begins like x. */
double curves_work_on(const struct spline *a, const struct spline *b, double mix, size_t i,
                      const double part[2])
{
    double value[2];
    double slopes[2];
    double sum = 0.0;
    double from = sqrt(part[0]);
    double range = sqrt(part[1]) - from;
    double h = a->place[i + 1] - a->place[i];
    /* the mix of two cubics is the cubic of the mix */
    for (size_t end = 0; end < 2; end++) {
        value[end] = (1.0 - mix) * a->value[i + end] + mix * b->value[i + end];
        slopes[end] = (1.0 - mix) * a->slope[i + end] + mix * b->slope[i + end];
    }
    for (int g = 0; g < 4; g++) {
        double slope;
        double u = from + range * gauss_node[g];
        double here = spline_between(h, (u * u - a->place[i]) / h, value, slopes, &slope);
        sum += 2.0 * u * gauss_weight[g] * here * sqrt(here);
    }
    return sum * range;
}

static enum percuss_status check_table(const struct contact_table *table, struct fault *fault)
{
    /* the loading curve */
    if (table->points < 3 || !curves_rise(table->points, table->indentation) ||
        !curves_rise(table->points, table->force) ||
        !curves_rise(table->points, table->contact_radius) || table->indentation[0] != 0.0 ||
        table->force[0] != 0.0 || table->contact_radius[0] != 0.0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "table: %zu points of loading: must be 3 or more that rise from 0",
                         table->points);
    /* the grid of the branches */
    if (table->branches &&
        (table->samples < 3 || !(table->yield > 0.0) || !(table->largest[0] > table->yield) ||
         !curves_rise(table->branches, table->largest)))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "table: %zu branches of %zu samples, yield at %g m: must be 3 or more "
                         "samples each, from rising indentations beyond the yield",
                         table->branches, table->samples, table->yield);
    /* each branch */
    for (size_t b = 0; b < table->branches; b++) {
        const double *share = table->share + b * table->samples;
        if (!(table->residual[b] >= 0.0 && table->residual[b] < table->largest[b]) ||
            !curves_rise(table->samples, share) || share[0] != 0.0 ||
            share[table->samples - 1] != 1.0)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "table: branch %zu from %g m back to %g m: must end between 0 and its "
                             "beginning, with shares that rise from 0 to 1",
                             b, table->largest[b], table->residual[b]);
    }
    return PERCUSS_OK;
}

/* Takes three arrays from the block. */
static struct spline take_spline(double **block, size_t count)
{
    struct spline spline = {count, *block, *block + count, *block + 2 * count};
    *block += 3 * count;
    return spline;
}

static void curves_fill_loading(struct contact_curves *curves, const struct contact_table *table,
                                double *scratch)
{
    struct spline *loading = &curves->loading;
    for (size_t i = 0; i < table->points; i++) {
        loading->place[i] = curves->radius.place[i] = table->indentation[i];
        loading->value[i] = curves_two_thirds(table->force[i]);
        curves->radius.value[i] = table->contact_radius[i] * table->contact_radius[i];
    }
    spline_set_slopes(loading, scratch);
    spline_set_slopes(&curves->radius, scratch);
}

/* Jump of the third derivative at an inner point, for a step as long as the indentation is deep. */
static double roughness_at(const struct spline *spline, size_t i)
{
    double third[2];
    for (int side = 0; side < 2; side++)
        third[side] = spline_third(spline, i - 1 + (size_t)side);
    double d = spline->place[i];
    return fabs(third[1] - third[0]) * d * d * d / spline->value[i];
}

/* The roughest points beyond yield: steps end there. */
static void find_joints(struct contact_curves *curves)
{
    const struct spline *loading = &curves->loading;
    double bound = INFINITY;
    for (int i = 0; i <= CURVES_JOINTS; i++)
        curves->joints[i] = INFINITY;
    for (int found = 0; found < CURVES_JOINTS; found++) {
        /* the roughest point below the last one found */
        double roughest = 0.0;
        double place = INFINITY;
        for (size_t i = 1; i + 1 < loading->count; i++) {
            double here = roughness_at(loading, i);
            if (loading->place[i] < curves->yield || !(here < bound) || !(here > roughest))
                continue;
            roughest = here;
            place = loading->place[i];
        }
        bound = roughest;
        /* into its place among the others, ascending */
        int at = found;
        for (; at > 0 && curves->joints[at - 1] > place; at--)
            curves->joints[at] = curves->joints[at - 1];
        curves->joints[at] = place;
    }
}

void curves_finish(struct contact_curves *curves)
{
    const struct spline *loading = &curves->loading;
    curves->work[0] = 0.0;
    for (size_t i = 0; i + 1 < loading->count; i++)
        curves->work[i + 1] =
            curves->work[i] + curves_work_on(loading, loading, 0.0, i,
                                             (double[]){loading->place[i], loading->place[i + 1]});
    find_joints(curves);
}

static void curves_fill_branches(struct contact_curves *curves, const struct contact_table *table,
                                 double *scratch)
{
    curves->spring.place[0] = log(table->yield);
    curves->spring.value[0] = 1.0;
    for (size_t b = 0; b < table->branches; b++) {
        curves->spring.place[b + 1] = log(table->largest[b]);
        curves->spring.value[b + 1] = 1.0 - table->residual[b] / table->largest[b];
        struct spline *branch = &curves->branch[b];
        for (size_t i = 0; i < table->samples; i++) {
            branch->place[i] = (double)i / (double)(table->samples - 1);
            branch->value[i] = curves_two_thirds(table->share[b * table->samples + i]);
        }
        spline_set_slopes(branch, scratch);
    }
    spline_set_slopes(&curves->spring, scratch);
}

enum percuss_status contact_curves_create(const struct contact_table *table,
                                          struct contact_curves **made, struct fault *fault)
{
    *made = NULL;
    enum percuss_status status = check_table(table, fault);
    if (status)
        return status;
    /* one block for all numbers, scratch for the longest spline */
    size_t points = table->points;
    size_t branches = table->branches;
    size_t samples = branches ? table->samples : 0;
    size_t most = points > branches + 1 ? points : branches + 1;
    size_t numbers = 7 * points + 3 * (branches + 1) + 3 * branches * samples;
    most = most > samples ? most : samples;
    struct contact_curves *curves = calloc(1, sizeof *curves + numbers * sizeof(double));
    double *scratch = calloc(2 * most, sizeof *scratch);
    struct spline *branch = calloc(branches + 1, sizeof *branch);
    if (!curves || !scratch || !branch) {
        free(curves);
        free(scratch);
        free(branch);
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    }
    /* splines over their parts of it */
    double *block = curves->memory;
    curves->loading = take_spline(&block, points);
    curves->radius = take_spline(&block, points);
    curves->spring = take_spline(&block, branches + 1);
    curves->branch = branch;
    for (size_t b = 0; b < branches; b++)
        branch[b] = take_spline(&block, samples);
    curves->work = block;
    /* what the table states */
    curves->yield = table->yield;
    curves->error = table->error;
    curves->surface_radius = table->surface_radius;
    curves->branches = branches;
    curves->range = table->range > 0.0 ? table->range : table->indentation[points - 1];
    /* values, slopes, work */
    curves_fill_loading(curves, table, scratch);
    curves_finish(curves);
    if (branches)
        curves_fill_branches(curves, table, scratch);
    free(scratch);
    *made = curves;
    return PERCUSS_OK;
}

void contact_curves_free(struct contact_curves *curves)
{
    if (!curves)
        return;
    free(curves->branch);
    free(curves);
}

double contact_curves_range(const struct contact_curves *curves)
{
    return curves->range;
}

double contact_curves_error(const struct contact_curves *curves)
{
    return curves->error;
}
