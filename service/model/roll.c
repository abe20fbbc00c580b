/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/roll.h"

#include <math.h>

#include "model/bar.h"

static const double NEGLIGIBLE = 1e-9;

static bool find_alike(const struct body *body, size_t *first)
{
    return body->kind->alike && body->kind->alike(body, first);
}

size_t roll_common_family(const struct body *body, size_t family)
{
    size_t first;
    return find_alike(body, &first) && family == first + 1 ? first : family;
}

bool roll_choose(const struct body *body, const struct site_load *load, struct roll *roll)
{
    size_t first;
    /* only where two families are alike, and the load acts on them */
    *roll = (struct roll){0, 1.0, 0.0};
    if (!find_alike(body, &first))
        return false;
    const struct family_load *y = &load->family[first];
    const struct family_load *z = &load->family[first + 1];
    if (!y->acts && !z->acts)
        return false;

    /* the plane of a force on the side or on a cap, whose moment may be rounding, or of the moment
     * of one beside the axis of an end */
    double moment = hypot(y->bar.moment, z->bar.moment);
    double force = hypot(y->bar.force, z->bar.force);
    if (moment <= NEGLIGIBLE * force * body_smallest_radius(body))
        moment = 0.0;
    double along_y = moment > 0.0 ? y->bar.moment / moment : y->bar.force / force;
    double along_z = moment > 0.0 ? z->bar.moment / moment : z->bar.force / force;
    /* turned by as little as puts the second family there */
    double sign = along_z < 0.0 ? -1.0 : 1.0;
    if (fabs(along_y) > NEGLIGIBLE)
        *roll = (struct roll){first, sign * along_z, sign * along_y};
    return true;
}

void roll_load(const struct body *body, const struct roll *roll, struct site_load *load)
{
    struct family_load *y = &load->family[roll->first];
    struct family_load *z = y + 1;
    roll_coordinates(roll, 1, &y->bar.force, &z->bar.force);
    roll_coordinates(roll, 1, &y->bar.moment, &z->bar.moment);
    roll_coordinates(roll, 1, &y->bar.curvature, &z->bar.curvature);
    bar_load_settle(body, y);
    bar_load_settle(body, z);
}

void roll_coordinates(const struct roll *roll, size_t count, double *y, double *z)
{
    for (size_t i = 0; i < count; i++) {
        double along_y = y[i];
        double along_z = z[i];
        y[i] = roll->cosine * along_y - roll->sine * along_z;
        z[i] = roll->cosine * along_z + roll->sine * along_y;
    }
}
