/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/law_own.h"

#include <stdlib.h>
#include <string.h>

/* The unloading curve at equal steps. */
enum { SAMPLES = 129 };
/* A law with a loss has it from this share of its first indentation on. */
static const double FIRST = 1e-3;

/* The curve's forces over its last one at equal steps between its ends. */
static bool sample(const struct own_curve *curve, double share[SAMPLES])
{
    struct spline spline;
    double *block;
    if (!own_curve_spline(curve, &block, &spline))
        return false;
    double from = curve->indentation[0], range = curve->indentation[curve->count - 1] - from;
    double most = curve->force[curve->count - 1];
    for (int i = 0; i < SAMPLES; i++)
        share[i] = own_curve_force(&spline, from + range * i / (SAMPLES - 1)) / most;
    share[0] = 0.0;
    share[SAMPLES - 1] = 1.0;
    free(block);
    return true;
}

enum percuss_status own_curves_create(const struct own_law *own, struct contact_curves **curves,
                                      struct fault *fault)
{
    const struct own_curve *points = &own->points, *back = &own->unloading;
    *curves = NULL;
    if (!points->count)
        return PERCUSS_OK;
    double share[2 * SAMPLES];
    double *radius = calloc(points->count, sizeof *radius);
    if (!radius || (back->count && !sample(back, share))) {
        free(radius);
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    }
    /* of a dent, which nothing remembers after the impact: only its order matters */
    for (size_t i = 0; i < points->count; i++)
        radius[i] = sqrt(points->indentation[i]);
    memcpy(share + SAMPLES, share, SAMPLES * sizeof *share);
    double last = points->indentation[points->count - 1];
    double first = FIRST * points->indentation[1];
    double stays = back->count ? back->indentation[0] / last : 0.0;
    const double largest[2] = {2.0 * first, last};
    const double residual[2] = {stays * largest[0], stays * largest[1]};
    const struct contact_table table = {
        .points = points->count,
        .indentation = points->indentation,
        .force = points->force,
        .contact_radius = radius,
        .yield = first,
        .branches = back->count ? 2 : 0,
        .largest = largest,
        .residual = residual,
        .samples = SAMPLES,
        .share = share,
    };
    enum percuss_status status = contact_curves_create(&table, curves, fault);
    free(radius);
    return status;
}

struct contact_law contact_law_own(const struct own_law *own, const struct contact_curves *curves)
{
    if (curves)
        return contact_law_points(curves);
    if (own->dissipation > 0.0)
        return contact_law_dissipative(own->stiffness, own->exponent, own->dissipation);
    return contact_law_power(own->stiffness, own->exponent, own->hysteresis);
}
