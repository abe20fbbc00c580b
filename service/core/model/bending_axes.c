/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/bending_axes.h"

#include <math.h>

#include "model/bar.h"

static const double NEGLIGIBLE = 1e-9;

static bool find_alike(const struct body *body, size_t *first)
{
    return body->kind->alike && body->kind->alike(body, first);
}

size_t bending_axes_common_family(const struct body *body, size_t family)
{
    size_t first;
    return find_alike(body, &first) && family == first + 1 ? first : family;
}

bool bending_axes_choose(const struct body *body, const struct site_load *load,
                         struct bending_axes *axes)
{
    size_t first;
    /* not without two families that are alike, one of which the load acts on */
    *axes = (struct bending_axes){0, 1.0, 0.0};
    if (!find_alike(body, &first))
        return false;
    const struct family_load *y = &load->family[first];
    const struct family_load *z = &load->family[first + 1];
    if (!y->acts && !z->acts)
        return false;

    /* the plane of a force on the side or on a cap, where the moment may be rounding; or of the
     * moment of a force on an end, off the axis */
    double moment = hypot(y->bar.moment, z->bar.moment);
    double force = hypot(y->bar.force, z->bar.force);
    if (moment <= NEGLIGIBLE * force * body_smallest_radius(body))
        moment = 0.0;
    double along_y = moment > 0.0 ? y->bar.moment / moment : y->bar.force / force;
    double along_z = moment > 0.0 ? z->bar.moment / moment : z->bar.force / force;
    /* the smallest turn that puts the second family there */
    double sign = along_z < 0.0 ? -1.0 : 1.0;
    if (fabs(along_y) > NEGLIGIBLE)
        *axes = (struct bending_axes){first, sign * along_z, sign * along_y};
    return true;
}

void bending_axes_turn_load(const struct body *body, const struct bending_axes *axes,
                            struct site_load *load)
{
    struct family_load *y = &load->family[axes->first];
    struct family_load *z = y + 1;
    bending_axes_turn(axes, 1, &y->bar.force, &z->bar.force);
    bending_axes_turn(axes, 1, &y->bar.moment, &z->bar.moment);
    bending_axes_turn(axes, 1, &y->bar.curvature, &z->bar.curvature);
    bar_load_settle(body, y);
    bar_load_settle(body, z);
}

void bending_axes_turn(const struct bending_axes *axes, size_t count, double *y, double *z)
{
    for (size_t i = 0; i < count; i++) {
        double along_y = y[i];
        double along_z = z[i];
        y[i] = axes->cosine * along_y - axes->sine * along_z;
        z[i] = axes->cosine * along_z + axes->sine * along_y;
    }
}
