/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Every curve is interpolated in F^(2/3), which is a straight line for Hertz and nearly one beyond
 * yield, by monotone splines.
 * Between two branches of the family the values are mixed linearly in the largest indentation's
 * logarithm; the elastic recovery, as a share, is a spline of that logarithm.
 * The contact region is static and has no intrinsic length: for surfaces k times as large lengths
 * are k times, forces k^2 times and works k^3 times those of the table. A family's curves are in
 * reduced units besides, so that a law has a unit each of indentation, force and contact radius.
 *
 * Beyond its last point a table of a contact that yields continues as a fully plastic contact
 * (K. L. Johnson, Contact Mechanics, 1985, sections 6.3 and 6.4): the pressure has reached the
 * hardness and the contact's area grows like the indentation, so that the force is linear;
 * it springs back like an elastic body from under that pressure, by a length that grows like the
 * contact radius, so that the share of the indentation falls with its root. Hence e ~ v^(-1/4). An
 * elastic table continues like Hertz, with the last slope of F^(2/3). */
#include "contact/law_table.h"

#include <stdlib.h>

#include "contact/law_closed_form.h"
#include "contact/plastic.h"

/* Four-point Gauss-Legendre rule on (0, 1). */
static const double gauss_node[] = {0.069431844202973712388, 0.33000947820757186760,
                                    0.66999052179242813240, 0.93056815579702628761};
static const double gauss_weight[] = {0.17392742256872692869, 0.32607257743127307131,
                                      0.32607257743127307131, 0.17392742256872692869};

/* Integral of value^(3/2) over a part of segment i of the mix (1 - mix) a + mix b of two splines
 * that share their places. With x = u^2, as the value begins like x. */
static double curves_work_on(const struct spline *a, const struct spline *b, double mix, size_t i,
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

/* Takes the three arrays of a spline from the block. */
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

/* Finds the roughest points beyond yield, at which steps end. */
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
    /* figures that the table states */
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

enum { LENGTH, FORCE, RADIUS }; /* units of the table in SI */

static const struct contact_curves *curves_of(const struct contact_law *law)
{
    return law->table;
}

static double last_of(const struct spline *spline)
{
    return spline->place[spline->count - 1];
}

/* Distance of d beyond the last point of a law that continues linearly, in the table's units; <= 0:
 * d is not beyond, or the law continues like Hertz. */
static double straight_on(const struct contact_curves *curves, double d)
{
    return curves->branches ? d - last_of(&curves->loading) : 0.0;
}

/* Force and slope at depth d; the search for its segment starts at *segment. */
static double table_force(const struct contact_curves *curves, size_t *segment, double d,
                          double *slope)
{
    double beyond = straight_on(curves, d);
    double value = spline_near(&curves->loading, segment, beyond > 0.0 ? d - beyond : d, slope);
    double root = sqrt(value);
    *slope *= 1.5 * root;
    return value * root + (beyond > 0.0 ? beyond * *slope : 0.0);
}

static double loading_near(const struct contact_law *law, size_t *segment, double d, double *slope)
{
    const double *unit = law->parameters;
    double force = table_force(curves_of(law), segment, d / unit[LENGTH], slope);
    *slope *= unit[FORCE] / unit[LENGTH];
    return force * unit[FORCE];
}

static double table_loading_force(const struct contact_law *law, double d, double *slope)
{
    size_t segment = 0;
    return loading_near(law, &segment, d, slope);
}

static double table_work(const struct contact_curves *curves, double d)
{
    const struct spline *loading = &curves->loading;
    size_t last = loading->count - 1;
    double beyond = straight_on(curves, d);
    double slope;
    /* under the straight line beyond the last point */
    if (beyond > 0.0) {
        size_t segment = last - 1;
        double force = table_force(curves, &segment, loading->place[last], &slope);
        return curves->work[last] + beyond * (force + 0.5 * slope * beyond);
    }
    if (d > loading->place[last]) {
        /* a linear function to the power 3/2 */
        double from = loading->value[last];
        double to = spline_at(loading, d, &slope);
        return curves->work[last] + 0.4 / slope * (to * to * sqrt(to) - from * from * sqrt(from));
    }
    /* up to the segment of d, and on it */
    size_t i = spline_segment(loading, d);
    return curves->work[i] +
           curves_work_on(loading, loading, 0.0, i, (double[]){loading->place[i], d});
}

static double table_loading_work(const struct contact_law *law, double d)
{
    const double *unit = law->parameters;
    return table_work(curves_of(law), d / unit[LENGTH]) * unit[LENGTH] * unit[FORCE];
}

static double table_next_joint(const struct contact_law *law, double d)
{
    double unit = law->parameters[LENGTH];
    const double *joint = curves_of(law)->joints;
    while (!(*joint * unit > d))
        joint++;
    return *joint * unit;
}

static double table_yield_depth(const struct contact_law *law)
{
    return curves_of(law)->branches ? curves_of(law)->yield * law->parameters[LENGTH] : INFINITY;
}

static double table_residual_depth(const struct contact_law *law, double d)
{
    const struct contact_curves *curves = curves_of(law);
    double depth = d / law->parameters[LENGTH];
    if (!curves->branches || !(depth > curves->yield))
        return 0.0;
    double slope;
    double at = log(depth);
    double last = last_of(&curves->spring);
    double back = spline_at(&curves->spring, fmin(at, last), &slope);
    return d * (1.0 - back * (at > last ? exp(0.5 * (last - at)) : 1.0));
}

static double table_contact_radius(const struct contact_law *law, double d)
{
    const double *unit = law->parameters;
    double slope;
    return sqrt(spline_at(&curves_of(law)->radius, d / unit[LENGTH], &slope)) * unit[RADIUS];
}

/* The two branches around the law's largest indentation; returns the weight of the second. */
static double branches_of(const struct contact_law *law, const struct spline *pair[2])
{
    const struct contact_curves *curves = curves_of(law);
    /* spring.place[0] is the yield, branch j belongs to place j + 1 */
    const double *place = curves->spring.place + 1;
    double at = log(law->history.max_indentation / law->parameters[LENGTH]);
    size_t last = curves->branches - 1;
    size_t j = 0;
    while (j + 1 < last && place[j + 1] <= at)
        j++;
    size_t next = j < last ? j + 1 : j;
    pair[0] = &curves->branch[j];
    pair[1] = &curves->branch[next];
    return next == j ? 0.0 : fmin(fmax((at - place[j]) / (place[next] - place[j]), 0.0), 1.0);
}

/* Share of the force between two branches: they have the same places, at equal steps, so that the
 * mix of their cubics is the cubic of the mix. */
static double share_between(const struct spline *const pair[2], double mix, double x, double *slope)
{
    double value[2];
    double slopes[2];
    double steps = (double)(pair[0]->count - 1);
    size_t i = (size_t)(x * steps);
    i = i < pair[0]->count - 1 ? i : pair[0]->count - 2;
    for (size_t end = 0; end < 2; end++) {
        value[end] = (1.0 - mix) * pair[0]->value[i + end] + mix * pair[1]->value[i + end];
        slopes[end] = (1.0 - mix) * pair[0]->slope[i + end] + mix * pair[1]->slope[i + end];
    }
    double between = spline_between(1.0 / steps, x * steps - (double)i, value, slopes, slope);
    double root = sqrt(between);
    *slope *= 1.5 * root;
    return between * root;
}

static double branch_share(const struct contact_law *law, double x, double *slope)
{
    const struct spline *pair[2];
    double mix = branches_of(law, pair);
    return share_between(pair, mix, x, slope);
}

/* plastic_force at several indentations, with one search for branches and segment. */
static void table_forces(const struct contact_law *law,
                         const double indentation[CONTACT_LAW_AT_ONCE],
                         double force[CONTACT_LAW_AT_ONCE], double stiffness[CONTACT_LAW_AT_ONCE])
{
    const struct contact_history *history = &law->history;
    const struct spline *pair[2] = {NULL, NULL};
    double span = history->max_indentation - history->dent;
    double mix = 0.0;
    size_t segment = 0;
    for (int i = 0; i < CONTACT_LAW_AT_ONCE; i++) {
        double d = indentation[i];
        force[i] = stiffness[i] = 0.0;
        if (!(d > 0.0))
            continue;
        if (d >= span) {
            force[i] = loading_near(law, &segment, d + history->dent, &stiffness[i]);
            continue;
        }
        if (!pair[0])
            mix = branches_of(law, pair);
        force[i] = history->max_force * share_between(pair, mix, d / span, &stiffness[i]);
        stiffness[i] *= history->max_force / span;
    }
}

static double table_branch_work(const struct contact_law *law, double x)
{
    const struct spline *pair[2];
    double mix = branches_of(law, pair);
    const double *place = pair[0]->place;
    double sum = 0.0;
    for (size_t i = 0; i + 1 < pair[0]->count && place[i] < x; i++)
        sum +=
            curves_work_on(pair[0], pair[1], mix, i, (double[]){place[i], fmin(place[i + 1], x)});
    return sum;
}

/* Strains scale with the yield stress, see family.h: depths with its square, forces with its cube
 * and contact radii with itself, so that Hertz's part does not change. */
static void table_rescale(struct contact_law *law, double force, double yield)
{
    law->parameters[LENGTH] *= yield * yield;
    law->parameters[FORCE] *= force * yield * yield * yield;
    law->parameters[RADIUS] *= yield;
}

/* Relative distance from a knot that counts as rounding. */
static const double ON_KNOT = 1e-12;

/* A mix of two splines that share their places, in units of length and force. */
struct placed_curve {
    const struct spline *pair[2];
    double mix;
    double length, force;
    double from; /* its origin, in indentations */
};

/* Beyond a knot g = F^(2/3) increases by a sixth of the jump of its third derivative times the cube
 * of the way, and F by 3/2 g^(1/2) times that. */
static double cube_at(const struct placed_curve *curve, size_t i)
{
    double jump = 0.0;
    double value = 0.0;
    for (int k = 0; k < (curve->mix > 0.0 ? 2 : 1); k++) {
        const struct spline *spline = curve->pair[k];
        double part = k ? curve->mix : 1.0 - curve->mix;
        jump += part * (spline_third(spline, i) - spline_third(spline, i - 1));
        value += part * spline->value[i];
    }
    return 0.25 * sqrt(value) * jump * curve->force /
           (curve->length * curve->length * curve->length);
}

/* The inner places between `from` and `to`. */
static size_t knots_on(const struct placed_curve *curve, double from, double to,
                       struct contact_knot knots[CONTACT_KNOTS])
{
    const struct spline *spline = curve->pair[0];
    bool rising = to > from;
    double x = (from - curve->from) / curve->length;
    double end = (to - curve->from) / curve->length;
    size_t i = spline_segment(spline, x * (rising ? 1.0 + ON_KNOT : 1.0 - ON_KNOT)) + rising;
    size_t found = 0;
    for (; found < CONTACT_KNOTS && i > 0 && i + 1 < spline->count; rising ? i++ : i--) {
        if (rising ? !(spline->place[i] < end) : !(spline->place[i] > end))
            break;
        double cube = cube_at(curve, i);
        knots[found].indentation = curve->from + spline->place[i] * curve->length;
        knots[found++].cube = rising ? cube : -cube;
    }
    return found;
}

/* Unloading from the largest indentation follows a branch, even if `from` exceeds it by rounding.
 */
static size_t next_knots(const struct contact_law *law, double from, double to,
                         struct contact_knot knots[CONTACT_KNOTS])
{
    const struct contact_history *history = &law->history;
    const struct spline *loading = &curves_of(law)->loading;
    double span = history->max_indentation - history->dent;
    struct placed_curve curve = {.pair = {loading, loading},
                                 .length = law->parameters[LENGTH],
                                 .force = law->parameters[FORCE],
                                 .from = -history->dent};
    if (span > 0.0 && (from < span || to < from)) {
        curve = (struct placed_curve){.length = span, .force = history->max_force};
        curve.mix = branches_of(law, curve.pair);
    }
    return knots_on(&curve, from, to, knots);
}

static const struct plastic_curve table_curve = {
    .force = table_loading_force,
    .work = table_loading_work,
    .joint = table_next_joint,
    .knots = next_knots,
    .yield = table_yield_depth,
    .residual = table_residual_depth,
    .radius = table_contact_radius,
    .branch = branch_share,
    .branch_work = table_branch_work,
};

const struct contact_law_operations contact_law_TABLE = {
    .model = PERCUSS_CONTACT_TABLE,
    .effort = CONTACT_EFFORT_SHORT,
    .tables = CONTACT_TABLES_ONLY,
    .make = contact_law_closed_form,
    .title = "a table of the contact region",
    .three_halves = true,
    .force = plastic_force,
    .forces = table_forces,
    .stored = plastic_stored,
    .indentation = plastic_indentation,
    .curve = &table_curve,
    .rescale = table_rescale,
};

struct contact_law contact_law_table_in(const struct contact_curves *curves, double length,
                                        double force, double radius)
{
    return (struct contact_law){
        .operations = &contact_law_TABLE,
        .parameters = {[LENGTH] = length, [FORCE] = force, [RADIUS] = radius},
        .table = curves,
    };
}

struct contact_law contact_law_table(const struct contact_curves *curves)
{
    return contact_law_table_in(curves, 1.0, 1.0, 1.0);
}

/* As contact_law_TABLE: its points may lie on any curve, which begins like d^(3/2) by the
 * interpolation. */
static const struct contact_law_operations points_operations = {
    .model = PERCUSS_CONTACT_LAW,
    .tables = CONTACT_TABLES_ONLY,
    .title = "points of the catalogue",
    .three_halves = true,
    .elliptic = true,
    .force = plastic_force,
    .forces = table_forces,
    .stored = plastic_stored,
    .indentation = plastic_indentation,
    .curve = &table_curve,
    .rescale = table_rescale,
};

struct contact_law contact_law_points(const struct contact_curves *curves)
{
    struct contact_law law = contact_law_table(curves);
    law.operations = &points_operations;
    return law;
}

struct contact_law contact_law_table_at(const struct contact_curves *curves, double radius)
{
    double scale = curves->surface_radius > 0.0 ? radius / curves->surface_radius : 1.0;
    /* the same radius but for rounding: the table as it is */
    if (!(fabs(scale - 1.0) > 1e-12))
        scale = 1.0;
    return contact_law_table_in(curves, scale, scale * scale, scale);
}

double contact_law_table_range(const struct contact_law *law)
{
    return contact_curves_range(law->table) * law->parameters[LENGTH];
}
