/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* All tables share their places, so that the curves of a place between them are weighted means of
 * values and slopes: cubics along each axis for the loading curve, the contact's area and what
 * springs back; straight lines for the shape of the branches, which differs by a few hundredths. */
#include <math.h>
#include <stdbool.h>

#include "contact/curves.h"
#include "contact/family_parts.h"
#include "contact/law_closed_form.h"

enum { LINEAR = 2, CUBIC = 4 };

static double plane_compliance(const struct material *material)
{
    return (1.0 - material->poisson * material->poisson) / material->young;
}

static const double HARD_ENOUGH = 2.0;

bool contact_family_both_yield(const struct material *a, const struct material *b)
{
    double ratio = closed_form_yield_ratio(a, b);
    return fmax(ratio, 1.0 / ratio) < HARD_ENOUGH;
}

struct contact_family_place contact_family_place(const struct material *a, const struct material *b)
{
    bool second = closed_form_softer(a, b) == 1;
    const struct material *soft = second ? b : a;
    const struct material *other = second ? a : b;
    double own = plane_compliance(soft);
    double share = own / (own + plane_compliance(other));
    /* The other body flows as well where its own yield is less than twice that of the softer one,
     * whose hardness is some 3.2 yields while Hertz's pressure at first yield is 1.6 of them. The
     * part of its compliance that counts as the softer one's: all at equal yields, and the fourth
     * power beyond, from contact regions of two equal bodies but for their yields (5e-3 of the
     * force and 3e-3 of the indentation that springs back, at 1.2 and 1.5 times the yield). */
    double ratio = closed_form_yield_ratio(soft, other);
    double both = ratio < HARD_ENOUGH ? pow(HARD_ENOUGH - ratio, 4.0) : 0.0;
    return (struct contact_family_place){soft->tangent / soft->young, soft->poisson,
                                         share + (1.0 - share) * both};
}

static double coordinate(const struct contact_family_place *place, size_t axis)
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
        double at = coordinate(place, a);
        most = fmax(most, (axis->place[0] - at) / (axis->place[1] - axis->place[0]));
        most = fmax(most, (at - *end) / (*end - end[-1]));
    }
    return most;
}

/* Lagrange's weights of the `order` places around one, all others 0. Outside the axis: of the place
 * at most half a step away from its end, of the end itself for straight lines. */
static void find_weights(const struct family_axis *axis, double at, size_t order, double *weight)
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

/* restrict: four numbers at a time */
static void add(size_t count, double part, const double *restrict from, double *restrict sum)
{
    for (size_t i = 0; i < count; i++)
        sum[i] += part * from[i];
}

/* The weighted mean of all tables' numbers. */
static void mix(const struct contact_family *family, const struct contact_family_place *place,
                size_t order, size_t count, const double *numbers, double *sum)
{
    double weight[CONTACT_FAMILY_AXES][CONTACT_FAMILY_MOST];
    for (size_t a = 0; a < CONTACT_FAMILY_AXES; a++)
        find_weights(&family->axis[a], coordinate(place, a), order, weight[a]);
    for (size_t i = 0; i < count; i++)
        sum[i] = 0.0;
    size_t second = family->axis[1].count, third = family->axis[2].count;
    for (size_t t = 0; t < family->tables; t++) {
        double part =
            weight[0][t / third / second] * weight[1][t / third % second] * weight[2][t % third];
        if (part != 0.0)
            add(count, part, numbers + t * count, sum);
    }
}

/* Whether a law can follow them; what springs back is cut to all of it where it is more by
 * rounding. */
static bool is_good(const struct contact_curves *curves)
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

static struct contact_curves *take_curves(const struct contact_family *family, struct arena *arena,
                                          double **numbers, double **shapes)
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
    struct contact_curves *curves = take_curves(family, arena, &numbers, &shapes);
    if (!curves)
        return NULL;
    mix(family, place, CUBIC, family_curve_numbers(family), family->curves, numbers);
    /* means with positive weights are as sound as the tables */
    if (!is_good(curves))
        mix(family, place, LINEAR, family_curve_numbers(family), family->curves, numbers);
    mix(family, place, LINEAR, family_shape_numbers(family), family->shapes, shapes);
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
