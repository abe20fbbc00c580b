/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "contact/curves.h"
#include "contact/family_parts.h"

static const double JUST_BEYOND = 1e-6; /* of the depth of yield */

static bool is_rising(size_t count, const double *values)
{
    for (size_t i = 0; i + 1 < count; i++)
        if (!(values[i + 1] > values[i]))
            return false;
    return isfinite(values[0]) && isfinite(values[count - 1]);
}

static enum percuss_status check_axes(const struct contact_family_samples *samples,
                                      struct fault *fault)
{
    /* axes */
    for (size_t a = 0; a < CONTACT_FAMILY_AXES; a++)
        if (samples->count[a] < 2 || samples->count[a] > CONTACT_FAMILY_MOST ||
            !is_rising(samples->count[a], samples->axis[a]) || !(samples->axis[a][0] >= 0.0))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "family: axis %zu of %zu places: must be 2 to %d that rise from 0 on",
                             a, samples->count[a], CONTACT_FAMILY_MOST);
    /* grids of the curves */
    if (samples->depths < 3 || samples->springs < 3 || samples->branches < 1 ||
        samples->branches > samples->springs || samples->samples < 3 ||
        !is_rising(samples->depths, samples->depth) || !(samples->depth[0] > 1.0) ||
        !is_rising(samples->springs, samples->largest) || !(samples->largest[0] > 1.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "family: %zu depths, %zu unloadings, %zu branches of %zu samples: must be "
                         "3 or more that rise from first yield, and no more branches than "
                         "unloadings",
                         samples->depths, samples->springs, samples->branches, samples->samples);
    /* what is said of them */
    if (!(samples->computed > 1.0) || !(samples->error >= 0.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "family: computed up to %g with an error of %g: must be beyond first "
                         "yield, and not negative",
                         samples->computed, samples->error);
    return PERCUSS_OK;
}

/* Whether a table's curves are such as a law needs. */
static bool is_sound(const struct contact_family_samples *samples, size_t table)
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
    /* what springs back is a part of the depth */
    for (size_t i = 0; i < samples->springs; i++) {
        double back = samples->back[table * samples->springs + i];
        if (!(back > 0.0 && back <= 1.0))
            return false;
    }
    /* branches rise from 0 to 1 */
    for (size_t b = 0; b < samples->branches; b++) {
        const double *share = samples->share + (table * samples->branches + b) * samples->samples;
        if (!is_rising(samples->samples, share) || share[0] != 0.0 ||
            share[samples->samples - 1] != 1.0)
            return false;
    }
    return true;
}

/* The way to the first sampled unloading of the i-th branch before it. */
static double onset(size_t i)
{
    return (double)i / FAMILY_ONSET;
}

static void fill_curves(const struct contact_family *family,
                        const struct contact_family_samples *samples, size_t table, double *scratch)
{
    size_t n = family->points;
    double *block = family->curves + table * family_curve_numbers(family);
    struct spline loading = {n, family->depth, block, block + n};
    struct spline radius = {n, family->depth, block + 2 * n, block + 3 * n};
    struct spline spring = {family->springs, family->log, block + 4 * n,
                            block + 4 * n + family->springs};
    /* Hertz's curve up to yield, then what was sampled */
    for (size_t i = 0; i <= FAMILY_ELASTIC; i++)
        loading.value[i] = radius.value[i] = family->depth[i];
    for (size_t i = 0; i < samples->depths; i++) {
        size_t from = table * samples->depths + i;
        size_t to = FAMILY_ELASTIC + 1 + i;
        loading.value[to] = samples->depth[i] * curves_two_thirds(samples->force[from]);
        radius.value[to] = samples->depth[i] * samples->area[from];
    }
    /* from all springs back at yield by the square of the way to the samples */
    const double *back = samples->back + table * samples->springs;
    spring.value[0] = 1.0;
    for (size_t i = 0; i < FAMILY_ONSET; i++)
        spring.value[i + 1] = 1.0 - (1.0 - back[0]) * onset(i) * onset(i);
    for (size_t i = 0; i < samples->springs; i++)
        spring.value[FAMILY_ONSET + 1 + i] = back[i];
    /* slopes */
    spline_set_slopes(&loading, scratch);
    spline_set_slopes(&radius, scratch);
    spline_set_slopes(&spring, scratch);
}

static void fill_shapes(const struct contact_family *family,
                        const struct contact_family_samples *samples, size_t table, double *scratch)
{
    size_t n = family->samples;
    double *block = family->shapes + table * family_shape_numbers(family);
    for (size_t b = 0; b < family->branches; b++) {
        struct spline branch = {n, family->step, block + 2 * b * n, block + (2 * b + 1) * n};
        size_t from = b < FAMILY_ONSET ? 0 : b - FAMILY_ONSET;
        double part = b < FAMILY_ONSET ? onset(b) * onset(b) : 1.0;
        const double *share = samples->share + (table * samples->branches + from) * n;
        /* Hertz's is a straight line */
        for (size_t i = 0; i < n; i++)
            branch.value[i] =
                family->step[i] + part * (curves_two_thirds(share[i]) - family->step[i]);
        spline_set_slopes(&branch, scratch);
    }
}

static void fill_places(struct contact_family *family, const struct contact_family_samples *samples)
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
        family->log[i + 1] = fmax(JUST_BEYOND, onset(i) * first);
    for (size_t i = 0; i < samples->springs; i++)
        family->log[FAMILY_ONSET + 1 + i] = log(samples->largest[i]);
    for (size_t i = 0; i < samples->samples; i++)
        family->step[i] = (double)i / (double)(samples->samples - 1);
}

static struct contact_family *make_room(const struct contact_family_samples *samples)
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
    if (check_axes(samples, fault))
        return NULL;
    /* room, for itself and for setting slopes */
    struct contact_family *family = make_room(samples);
    double *scratch =
        family ? calloc(2 * (family->points + family->springs + family->samples), sizeof *scratch)
               : NULL;
    if (!scratch) {
        free(family);
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        return NULL;
    }
    /* one table after the other */
    fill_places(family, samples);
    for (size_t table = 0; table < family->tables; table++) {
        if (!is_sound(samples, table)) {
            fault_set(fault, PERCUSS_BAD_REQUEST,
                      "family: table %zu: forces, areas and branches must rise, and what springs "
                      "back be a part of the indentation",
                      table);
            free(scratch);
            free(family);
            return NULL;
        }
        fill_curves(family, samples, table, scratch);
        fill_shapes(family, samples, table, scratch);
    }
    free(scratch);
    return family;
}

void contact_family_free(struct contact_family *family)
{
    free(family);
}
