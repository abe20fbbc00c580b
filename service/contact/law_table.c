/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Every curve is interpolated in F^(2/3), which is a straight line for Hertz and nearly one beyond
 * yield, by monotone splines.
 * Between two branches of the family the values are mixed linearly in the largest indentation's
 * logarithm; what springs back, as a share, is a spline of that logarithm.
 * The contact region is static and without a length of its own: for surfaces `scale` times as large
 * lengths are scale times, forces scale^2 times and works scale^3 times the table's. */
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "contact/plastic.h"
#include "contact/table.h"
#include "numeric/spline.h"

enum { MAX_JOINTS = 6 };

struct contact_curves {
    struct spline loading; /* F^(2/3) of d */
    struct spline radius;  /* a^2 of d */
    struct spline spring;  /* 1 - residual/largest of log(largest) */
    struct spline *branch; /* [branches]: share^(2/3) of x */
    double *work;          /* [points]: of the loading curve up to each, J */
    double yield, error;
    double surface_radius;         /* m; 0: not stated */
    double joints[MAX_JOINTS + 1]; /* ascending; INFINITY: no more */
    size_t branches;
    double memory[];
};

/* Four-point Gauss-Legendre rule on (0, 1). */
static const double gauss_node[] = {0.069431844202973712388, 0.33000947820757186760,
                                    0.66999052179242813240, 0.93056815579702628761};
static const double gauss_weight[] = {0.17392742256872692869, 0.32607257743127307131,
                                      0.32607257743127307131, 0.17392742256872692869};

static double two_thirds(double value)
{
    double root = cbrt(value);
    return root * root;
}

/* Integral of value^(3/2) over a part of a segment of a mix of two splines, which share their
 * places: with x = u^2, as the value begins like x. */
static double work_on(const struct spline *a, const struct spline *b, double mix, size_t i,
                      const double part[2])
{
    double from = sqrt(part[0]);
    double range = sqrt(part[1]) - from;
    double sum = 0.0;
    for (int g = 0; g < 4; g++) {
        double slope;
        double u = from + range * gauss_node[g];
        double value = (1.0 - mix) * spline_on(a, i, u * u, &slope);
        value += mix * spline_on(b, i, u * u, &slope);
        sum += 2.0 * u * gauss_weight[g] * value * sqrt(value);
    }
    return sum * range;
}

static const struct contact_curves *curves_of(const struct contact_law *law)
{
    return law->table;
}

static double scale_of(const struct contact_law *law)
{
    return law->parameters[0];
}

static double loading_force(const struct contact_law *law, double d, double *slope)
{
    double scale = scale_of(law);
    double value = spline_at(&curves_of(law)->loading, d / scale, slope);
    double root = sqrt(value);
    *slope *= 1.5 * root * scale;
    return value * root * scale * scale;
}

static double table_work(const struct contact_curves *curves, double d)
{
    const struct spline *loading = &curves->loading;
    size_t last = loading->count - 1;
    if (d > loading->place[last]) {
        /* a straight line to the power 3/2 */
        double slope;
        double from = loading->value[last];
        double to = spline_at(loading, d, &slope);
        return curves->work[last] + 0.4 / slope * (to * to * sqrt(to) - from * from * sqrt(from));
    }
    size_t i = spline_segment(loading, d);
    return curves->work[i] + work_on(loading, loading, 0.0, i, (double[]){loading->place[i], d});
}

static double loading_work(const struct contact_law *law, double d)
{
    double scale = scale_of(law);
    return table_work(curves_of(law), d / scale) * scale * scale * scale;
}

static double next_joint(const struct contact_law *law, double d)
{
    double scale = scale_of(law);
    const double *joint = curves_of(law)->joints;
    while (!(*joint * scale > d))
        joint++;
    return *joint * scale;
}

static double yield_depth(const struct contact_law *law)
{
    return curves_of(law)->branches ? curves_of(law)->yield * scale_of(law) : INFINITY;
}

static double residual_depth(const struct contact_law *law, double d)
{
    const struct contact_curves *curves = curves_of(law);
    double scale = scale_of(law);
    if (!curves->branches || !(d > curves->yield * scale))
        return 0.0;
    double slope;
    double last = curves->spring.place[curves->spring.count - 1];
    /* beyond the family: what the last branch gives back */
    return d * (1.0 - spline_at(&curves->spring, fmin(log(d / scale), last), &slope));
}

static double contact_radius(const struct contact_law *law, double d)
{
    double slope;
    double scale = scale_of(law);
    return sqrt(spline_at(&curves_of(law)->radius, d / scale, &slope)) * scale;
}

/* The two branches around the law's largest indentation, and the second one's part. */
static double branches_of(const struct contact_law *law, const struct spline *pair[2])
{
    const struct contact_curves *curves = curves_of(law);
    /* spring.place[0] is the yield, branch j belongs to place j + 1 */
    const double *place = curves->spring.place + 1;
    double at = log(law->history.max_indentation / scale_of(law));
    size_t last = curves->branches - 1;
    size_t j = 0;
    while (j + 1 < last && place[j + 1] <= at)
        j++;
    size_t next = j < last ? j + 1 : j;
    pair[0] = &curves->branch[j];
    pair[1] = &curves->branch[next];
    return next == j ? 0.0 : fmin(fmax((at - place[j]) / (place[next] - place[j]), 0.0), 1.0);
}

static double branch_share(const struct contact_law *law, double x, double *slope)
{
    const struct spline *pair[2];
    double mix = branches_of(law, pair);
    double slopes[2];
    size_t i = (size_t)(x * (double)(pair[0]->count - 1));
    i = i < pair[0]->count - 1 ? i : pair[0]->count - 2;
    double value = (1.0 - mix) * spline_on(pair[0], i, x, &slopes[0]) +
                   mix * spline_on(pair[1], i, x, &slopes[1]);
    double root = sqrt(value);
    *slope = 1.5 * root * ((1.0 - mix) * slopes[0] + mix * slopes[1]);
    return value * root;
}

static double branch_work(const struct contact_law *law, double x)
{
    const struct spline *pair[2];
    double mix = branches_of(law, pair);
    const double *place = pair[0]->place;
    double sum = 0.0;
    for (size_t i = 0; i + 1 < pair[0]->count && place[i] < x; i++)
        sum += work_on(pair[0], pair[1], mix, i, (double[]){place[i], fmin(place[i + 1], x)});
    return sum;
}

static const struct plastic_curve curve = {
    .force = loading_force,
    .work = loading_work,
    .joint = next_joint,
    .yield = yield_depth,
    .residual = residual_depth,
    .radius = contact_radius,
    .branch = branch_share,
    .branch_work = branch_work,
};

static const struct contact_law_operations operations = {
    .model = PERCUSS_CONTACT_TABLE,
    .force = plastic_force,
    .stored = plastic_stored,
    .indentation = plastic_indentation,
    .curve = &curve,
};

struct contact_law contact_law_table(const struct contact_curves *curves)
{
    return (struct contact_law){.operations = &operations, .parameters = {1.0}, .table = curves};
}

struct contact_law contact_law_table_at(const struct contact_curves *curves, double radius)
{
    struct contact_law law = contact_law_table(curves);
    double scale = curves->surface_radius > 0.0 ? radius / curves->surface_radius : 1.0;
    /* the same radius but for rounding: the table as it is */
    if (fabs(scale - 1.0) > 1e-12)
        law.parameters[0] = scale;
    return law;
}

double contact_law_table_range(const struct contact_law *law)
{
    return contact_curves_range(law->table) * scale_of(law);
}

static bool rises(size_t count, const double *values)
{
    for (size_t i = 1; i < count; i++)
        if (!(values[i] > values[i - 1]))
            return false;
    return isfinite(values[count - 1]);
}

static enum percuss_status check_table(const struct contact_table *table, struct fault *fault)
{
    if (table->points < 3 || !rises(table->points, table->indentation) ||
        !rises(table->points, table->force) || !rises(table->points, table->contact_radius) ||
        table->indentation[0] != 0.0 || table->force[0] != 0.0 || table->contact_radius[0] != 0.0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "table: %zu points of loading: must be 3 or more that rise from 0",
                         table->points);
    if (table->branches &&
        (table->samples < 3 || !(table->yield > 0.0) || !(table->largest[0] > table->yield) ||
         !rises(table->branches, table->largest)))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "table: %zu branches of %zu samples, yield at %g m: must be 3 or more "
                         "samples each, from rising indentations beyond the yield",
                         table->branches, table->samples, table->yield);
    for (size_t b = 0; b < table->branches; b++) {
        const double *share = table->share + b * table->samples;
        if (!(table->residual[b] >= 0.0 && table->residual[b] < table->largest[b]) ||
            !rises(table->samples, share) || share[0] != 0.0 || share[table->samples - 1] != 1.0)
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

static void fill_loading(struct contact_curves *curves, const struct contact_table *table,
                         double *scratch)
{
    struct spline *loading = &curves->loading;
    for (size_t i = 0; i < table->points; i++) {
        loading->place[i] = curves->radius.place[i] = table->indentation[i];
        loading->value[i] = two_thirds(table->force[i]);
        curves->radius.value[i] = table->contact_radius[i] * table->contact_radius[i];
    }
    spline_set_slopes(loading, scratch);
    spline_set_slopes(&curves->radius, scratch);
    curves->work[0] = 0.0;
    for (size_t i = 0; i + 1 < table->points; i++)
        curves->work[i + 1] =
            curves->work[i] +
            work_on(loading, loading, 0.0, i, (double[]){loading->place[i], loading->place[i + 1]});
}

/* Jump of the third derivative at an inner point, for a step as long as the indentation is deep. */
static double roughness_at(const struct spline *spline, size_t i)
{
    double third[2];
    for (int side = 0; side < 2; side++) {
        size_t j = i - 1 + (size_t)side;
        double h = spline->place[j + 1] - spline->place[j];
        double chord = (spline->value[j + 1] - spline->value[j]) / h;
        third[side] = 6.0 * (spline->slope[j] + spline->slope[j + 1] - 2.0 * chord) / (h * h);
    }
    double d = spline->place[i];
    return fabs(third[1] - third[0]) * d * d * d / spline->value[i];
}

/* The roughest points beyond yield: steps end there. */
static void find_joints(struct contact_curves *curves)
{
    const struct spline *loading = &curves->loading;
    double bound = INFINITY;
    for (int i = 0; i <= MAX_JOINTS; i++)
        curves->joints[i] = INFINITY;
    for (int found = 0; found < MAX_JOINTS; found++) {
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
        int at = found;
        for (; at > 0 && curves->joints[at - 1] > place; at--)
            curves->joints[at] = curves->joints[at - 1];
        curves->joints[at] = place;
    }
}

static void fill_branches(struct contact_curves *curves, const struct contact_table *table,
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
            branch->value[i] = two_thirds(table->share[b * table->samples + i]);
        }
        spline_set_slopes(branch, scratch);
    }
    spline_set_slopes(&curves->spring, scratch);
}

struct contact_curves *contact_curves_create(const struct contact_table *table, struct fault *fault)
{
    if (check_table(table, fault))
        return NULL;
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
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        return NULL;
    }
    double *block = curves->memory;
    curves->loading = take_spline(&block, points);
    curves->radius = take_spline(&block, points);
    curves->spring = take_spline(&block, branches + 1);
    curves->branch = branch;
    for (size_t b = 0; b < branches; b++)
        branch[b] = take_spline(&block, samples);
    curves->work = block;
    curves->yield = table->yield;
    curves->error = table->error;
    curves->surface_radius = table->surface_radius;
    curves->branches = branches;
    fill_loading(curves, table, scratch);
    find_joints(curves);
    if (branches)
        fill_branches(curves, table, scratch);
    free(scratch);
    return curves;
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
    return curves->loading.place[curves->loading.count - 1];
}

double contact_curves_error(const struct contact_curves *curves)
{
    return curves->error;
}
