/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/family.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "contact/law_closed_form.h"

/* Points of the loading curve up to first yield, where it is Hertz's: the spline's bend at yield
 * reaches back over some of them. */
enum { FAMILY_ELASTIC = 8 };

/* Branches inserted between first yield and the first sampled one, where a dent and the deviation
 * of its branch from Hertz's begin with the square of the way: the first of them is Hertz's, at
 * yield but for rounding. Laws mix branches linearly: with fewer, an impact there might return more
 * energy than it brought. */
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

static size_t family_curve_numbers(const struct contact_family *family)
{
    return 4 * family->points + 2 * family->springs;
}

static size_t family_shape_numbers(const struct contact_family *family)
{
    return 2 * family->branches * family->samples;
}

/* Coordinates along the axes: the root of the hardening, in which cubics represent functions of the
 * root and of the hardening; and a logarithm of the share, as curves bend more the smaller it is
 * (the force at 900 times the yield's depth, hardening 0.1, is linear in it within 6 %). */
static double family_along(size_t axis, double value)
{
    const double bend = 0.1;
    return axis == 0 ? sqrt(value) : axis == 2 ? log(value + bend) : value;
}

static const double JUST_BEYOND = 1e-6; /* of the depth of yield */

static enum percuss_status family_check_axes(const struct contact_family_samples *samples,
                                             struct fault *fault)
{
    /* axes */
    for (size_t a = 0; a < CONTACT_FAMILY_AXES; a++)
        if (samples->count[a] < 2 || samples->count[a] > CONTACT_FAMILY_MOST ||
            !curves_rise(samples->count[a], samples->axis[a]) || !(samples->axis[a][0] >= 0.0))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "family: axis %zu of %zu places: must be 2 to %d that rise from 0 on",
                             a, samples->count[a], CONTACT_FAMILY_MOST);
    /* grids of the curves */
    if (samples->depths < 3 || samples->springs < 3 || samples->branches < 1 ||
        samples->branches > samples->springs || samples->samples < 3 ||
        !curves_rise(samples->depths, samples->depth) || !(samples->depth[0] > 1.0) ||
        !curves_rise(samples->springs, samples->largest) || !(samples->largest[0] > 1.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "family: %zu depths, %zu unloadings, %zu branches of %zu samples: must be "
                         "3 or more that rise from first yield, and no more branches than "
                         "unloadings",
                         samples->depths, samples->springs, samples->branches, samples->samples);
    /* their range and error */
    if (!(samples->computed > 1.0) || !(samples->error >= 0.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "family: computed up to %g with an error of %g: must be beyond first "
                         "yield, and not negative",
                         samples->computed, samples->error);
    return PERCUSS_OK;
}

/* Whether a table's curves are valid for a law. */
static bool family_is_sound(const struct contact_family_samples *samples, size_t table)
{
    double force = 1.0;
    double area = 1.0;
    /* force and area rise with the depth from their values at yield */
    for (size_t i = 0; i < samples->depths; i++) {
        double d = samples->depth[i];
        double next = samples->force[table * samples->depths + i] * d * sqrt(d);
        double size = samples->area[table * samples->depths + i] * d;
        if (!(next > force) || !(size > area) || !isfinite(next + size))
            return false;
        force = next;
        area = size;
    }
    /* the elastic recovery is a part of the depth */
    for (size_t i = 0; i < samples->springs; i++) {
        double back = samples->back[table * samples->springs + i];
        if (!(back > 0.0 && back <= 1.0))
            return false;
    }
    /* branches rise from 0 to 1 */
    for (size_t b = 0; b < samples->branches; b++) {
        const double *share = samples->share + (table * samples->branches + b) * samples->samples;
        if (!curves_rise(samples->samples, share) || share[0] != 0.0 ||
            share[samples->samples - 1] != 1.0)
            return false;
    }
    return true;
}

/* The way to the first sampled unloading of the i-th branch before it. */
static double family_onset(size_t i)
{
    return (double)i / FAMILY_ONSET;
}

static void family_fill_curves(const struct contact_family *family,
                               const struct contact_family_samples *samples, size_t table,
                               double *scratch)
{
    size_t n = family->points;
    double *block = family->curves + table * family_curve_numbers(family);
    struct spline loading = {n, family->depth, block, block + n};
    struct spline radius = {n, family->depth, block + 2 * n, block + 3 * n};
    struct spline spring = {family->springs, family->log, block + 4 * n,
                            block + 4 * n + family->springs};
    /* Hertz's curve up to yield, then the samples */
    for (size_t i = 0; i <= FAMILY_ELASTIC; i++)
        loading.value[i] = radius.value[i] = family->depth[i];
    for (size_t i = 0; i < samples->depths; i++) {
        size_t from = table * samples->depths + i;
        size_t to = FAMILY_ELASTIC + 1 + i;
        loading.value[to] = samples->depth[i] * curves_two_thirds(samples->force[from]);
        radius.value[to] = samples->depth[i] * samples->area[from];
    }
    /* from full elastic recovery at yield, by the square of the way, to the samples */
    const double *back = samples->back + table * samples->springs;
    spring.value[0] = 1.0;
    for (size_t i = 0; i < FAMILY_ONSET; i++)
        spring.value[i + 1] = 1.0 - (1.0 - back[0]) * family_onset(i) * family_onset(i);
    for (size_t i = 0; i < samples->springs; i++)
        spring.value[FAMILY_ONSET + 1 + i] = back[i];
    /* slopes */
    spline_set_slopes(&loading, scratch);
    spline_set_slopes(&radius, scratch);
    spline_set_slopes(&spring, scratch);
}

static void family_fill_shapes(const struct contact_family *family,
                               const struct contact_family_samples *samples, size_t table,
                               double *scratch)
{
    size_t n = family->samples;
    double *block = family->shapes + table * family_shape_numbers(family);
    for (size_t b = 0; b < family->branches; b++) {
        struct spline branch = {n, family->step, block + 2 * b * n, block + (2 * b + 1) * n};
        size_t from = b < FAMILY_ONSET ? 0 : b - FAMILY_ONSET;
        double part = b < FAMILY_ONSET ? family_onset(b) * family_onset(b) : 1.0;
        const double *share = samples->share + (table * samples->branches + from) * n;
        /* Hertz's is a straight line */
        for (size_t i = 0; i < n; i++)
            branch.value[i] =
                family->step[i] + part * (curves_two_thirds(share[i]) - family->step[i]);
        spline_set_slopes(&branch, scratch);
    }
}

static void family_fill_places(struct contact_family *family,
                               const struct contact_family_samples *samples)
{
    for (size_t a = 0; a < CONTACT_FAMILY_AXES; a++) {
        family->axis[a].count = samples->count[a];
        for (size_t i = 0; i < samples->count[a]; i++)
            family->axis[a].place[i] = family_along(a, samples->axis[a][i]);
    }
    for (size_t i = 0; i <= FAMILY_ELASTIC; i++)
        family->depth[i] = (double)i / FAMILY_ELASTIC;
    for (size_t i = 0; i < samples->depths; i++)
        family->depth[FAMILY_ELASTIC + 1 + i] = samples->depth[i];
    double first = log(samples->largest[0]);
    for (size_t i = 0; i < FAMILY_ONSET; i++)
        family->log[i + 1] = fmax(JUST_BEYOND, family_onset(i) * first);
    for (size_t i = 0; i < samples->springs; i++)
        family->log[FAMILY_ONSET + 1 + i] = log(samples->largest[i]);
    for (size_t i = 0; i < samples->samples; i++)
        family->step[i] = (double)i / (double)(samples->samples - 1);
}

static struct contact_family *family_make_room(const struct contact_family_samples *samples)
{
    /* counts, with the points that are put in before the samples */
    struct contact_family shape = {
        .tables = samples->count[0] * samples->count[1] * samples->count[2],
        .points = samples->depths + FAMILY_ELASTIC + 1,
        .springs = samples->springs + FAMILY_ONSET + 1,
        .branches = samples->branches + FAMILY_ONSET,
        .samples = samples->samples,
        .computed = samples->computed,
        .error = samples->error,
    };
    /* places, then the numbers of all tables, behind the struct */
    size_t places = shape.points + shape.springs + shape.samples;
    size_t numbers = shape.tables * (family_curve_numbers(&shape) + family_shape_numbers(&shape));
    struct contact_family *family = calloc(1, sizeof *family + (places + numbers) * sizeof(double));
    if (!family)
        return NULL;
    *family = shape;
    family->depth = family->memory;
    family->log = family->depth + family->points;
    family->step = family->log + family->springs;
    family->curves = family->step + family->samples;
    family->shapes = family->curves + family->tables * family_curve_numbers(family);
    return family;
}

struct contact_family *contact_family_create(const struct contact_family_samples *samples,
                                             struct fault *fault)
{
    if (family_check_axes(samples, fault))
        return NULL;
    /* room, for itself and for setting slopes */
    struct contact_family *family = family_make_room(samples);
    double *scratch =
        family ? calloc(2 * (family->points + family->springs + family->samples), sizeof *scratch)
               : NULL;
    if (!scratch) {
        free(family);
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        return NULL;
    }
    /* one table after the other */
    family_fill_places(family, samples);
    for (size_t table = 0; table < family->tables; table++) {
        if (!family_is_sound(samples, table)) {
            fault_set(fault, PERCUSS_BAD_REQUEST,
                      "family: table %zu: forces, areas and branches must rise, and what springs "
                      "back be a part of the indentation",
                      table);
            free(scratch);
            free(family);
            return NULL;
        }
        family_fill_curves(family, samples, table, scratch);
        family_fill_shapes(family, samples, table, scratch);
    }
    free(scratch);
    return family;
}

void contact_family_free(struct contact_family *family)
{
    free(family);
}

/* A place in the family. All tables share their places, so that the curves of a place between them
 * are weighted means of values and slopes: cubic along each axis for the loading curve, the
 * contact's area and the elastic recovery; linear for the shape of the branches, which differs by a
 * few hundredths. */
enum { LINEAR = 2, CUBIC = 4 };

static double family_plane_compliance(const struct material *material)
{
    return (1.0 - material->poisson * material->poisson) / material->young;
}

bool contact_family_both_yield(const struct material *a, const struct material *b)
{
    double ratio = closed_form_yield_ratio(a, b);
    return fmax(ratio, 1.0 / ratio) < CONTACT_FAMILY_HARD_ENOUGH;
}

struct contact_family_place contact_family_place(const struct material *a, const struct material *b)
{
    bool second = closed_form_softer(a, b) == 1;
    const struct material *soft = second ? b : a;
    const struct material *other = second ? a : b;
    double own = family_plane_compliance(soft);
    double share = own / (own + family_plane_compliance(other));
    /* The other body flows as well if its yield stress is less than twice that of the softer one:
     * the hardness of the softer one is some 3.2 yields, Hertz's pressure at first yield 1.6 of
     * them. The part of its compliance that counts as the softer one's is 1 at equal yields and
     * falls with the fourth power, from contact regions of two bodies that are equal but for their
     * yields (5e-3 of the force and 3e-3 of the elastic recovery, at 1.2 and 1.5 times it). */
    double ratio = closed_form_yield_ratio(soft, other);
    double both =
        ratio < CONTACT_FAMILY_HARD_ENOUGH ? pow(CONTACT_FAMILY_HARD_ENOUGH - ratio, 4.0) : 0.0;
    return (struct contact_family_place){soft->tangent / soft->young, soft->poisson,
                                         share + (1.0 - share) * both};
}

static double family_coordinate(const struct contact_family_place *place, size_t axis)
{
    const double values[] = {place->hardening, place->poisson, place->share};
    return family_along(axis, values[axis]);
}

double contact_family_outside(const struct contact_family *family,
                              const struct contact_family_place *place)
{
    double most = 0.0;
    for (size_t a = 0; a < CONTACT_FAMILY_AXES; a++) {
        const struct family_axis *axis = &family->axis[a];
        const double *end = axis->place + axis->count - 1;
        double at = family_coordinate(place, a);
        most = fmax(most, (axis->place[0] - at) / (axis->place[1] - axis->place[0]));
        most = fmax(most, (at - *end) / (*end - end[-1]));
    }
    return most;
}

/* Lagrange's weights of the `order` places around `at`, all others 0. Outside the axis: of a place
 * at most half a step beyond its end, or of the end itself for LINEAR. */
static void family_find_weights(const struct family_axis *axis, double at, size_t order,
                                double *weight)
{
    const double *place = axis->place;
    size_t last = axis->count - 1;
    double beyond = order == LINEAR ? 0.0 : 0.5;
    order = order < axis->count ? order : axis->count;
    at = fmax(at, place[0] - beyond * (place[1] - place[0]));
    at = fmin(at, place[last] + beyond * (place[last] - place[last - 1]));
    size_t first = 0;
    while (first + order < axis->count && place[first + order / 2] <= at)
        first++;
    for (size_t i = 0; i < axis->count; i++) {
        bool within = i >= first && i < first + order;
        weight[i] = within ? 1.0 : 0.0;
        for (size_t j = first; within && j < first + order; j++)
            if (j != i)
                weight[i] *= (at - place[j]) / (place[i] - place[j]);
    }
}

/* restrict: the compiler may add four numbers at a time */
static void family_add(size_t count, double part, const double *restrict from, double *restrict sum)
{
    for (size_t i = 0; i < count; i++)
        sum[i] += part * from[i];
}

/* The weighted mean of all tables' numbers. */
static void family_mix(const struct contact_family *family,
                       const struct contact_family_place *place, size_t order, size_t count,
                       const double *numbers, double *sum)
{
    double weight[CONTACT_FAMILY_AXES][CONTACT_FAMILY_MOST];
    for (size_t a = 0; a < CONTACT_FAMILY_AXES; a++)
        family_find_weights(&family->axis[a], family_coordinate(place, a), order, weight[a]);
    for (size_t i = 0; i < count; i++)
        sum[i] = 0.0;
    size_t second = family->axis[1].count, third = family->axis[2].count;
    for (size_t t = 0; t < family->tables; t++) {
        double part =
            weight[0][t / third / second] * weight[1][t / third % second] * weight[2][t % third];
        if (part != 0.0)
            family_add(count, part, numbers + t * count, sum);
    }
}

/* Whether the curves are valid for a law; a recovery that exceeds 1 by rounding becomes 1. */
static bool family_is_good(const struct contact_curves *curves)
{
    const double rounding = 1e-6;
    for (size_t i = 0; i + 1 < curves->loading.count; i++)
        if (!(curves->loading.value[i + 1] > curves->loading.value[i]) ||
            !(curves->radius.value[i + 1] > curves->radius.value[i]))
            return false;
    for (size_t i = 0; i < curves->spring.count; i++) {
        if (!(curves->spring.value[i] > 0.0 && curves->spring.value[i] <= 1.0 + rounding))
            return false;
        curves->spring.value[i] = fmin(curves->spring.value[i], 1.0);
    }
    return true;
}

static struct contact_curves *family_take_curves(const struct contact_family *family,
                                                 struct arena *arena, double **numbers,
                                                 double **shapes)
{
    size_t n = family->points;
    /* room for values and slopes, which the caller mixes */
    struct contact_curves *curves = arena_take(arena, 1, sizeof *curves);
    struct spline *branch = arena_take(arena, family->branches, sizeof *branch);
    double *block = arena_reserve(
        arena, family_curve_numbers(family) + family_shape_numbers(family) + n, sizeof *block);
    if (!curves || !branch || !block)
        return NULL;
    *numbers = block;
    *shapes = block + family_curve_numbers(family);
    /* splines over it, at the places that all tables share */
    curves->loading = (struct spline){n, family->depth, block, block + n};
    curves->radius = (struct spline){n, family->depth, block + 2 * n, block + 3 * n};
    curves->spring = (struct spline){family->springs, family->log, block + 4 * n,
                                     block + 4 * n + family->springs};
    /* branches */
    for (size_t b = 0; b < family->branches; b++) {
        double *values = *shapes + 2 * b * family->samples;
        branch[b] =
            (struct spline){family->samples, family->step, values, values + family->samples};
    }
    curves->branch = branch;
    curves->branches = family->branches;
    curves->work = *shapes + family_shape_numbers(family);
    /* in reduced units yield is at 1 */
    curves->yield = 1.0;
    curves->error = family->error;
    curves->range = family->computed;
    return curves;
}

const struct contact_curves *contact_family_curves(const struct contact_family *family,
                                                   const struct contact_family_place *place,
                                                   struct arena *arena)
{
    double *numbers, *shapes;
    struct contact_curves *curves = family_take_curves(family, arena, &numbers, &shapes);
    if (!curves)
        return NULL;
    family_mix(family, place, CUBIC, family_curve_numbers(family), family->curves, numbers);
    /* linear means have positive weights and are as sound as the tables */
    if (!family_is_good(curves))
        family_mix(family, place, LINEAR, family_curve_numbers(family), family->curves, numbers);
    family_mix(family, place, LINEAR, family_shape_numbers(family), family->shapes, shapes);
    curves_finish(curves);
    return curves;
}

struct contact_law contact_law_family(const struct contact_curves *curves,
                                      const struct hertz_contact *hertz, const struct material *a,
                                      const struct material *b)
{
    double depth = closed_form_yield(hertz, a, b);
    return contact_law_table_in(curves, depth, hertz->stiffness * depth * sqrt(depth),
                                sqrt(closed_form_radius(hertz) * depth));
}
