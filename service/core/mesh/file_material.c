/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/file_material.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* no solid is softer, stiffer, lighter or heavier: values outside are in other units */
static const double LEAST_YOUNG = 1e4, MOST_YOUNG = 5e12, LEAST_DENSITY = 5.0, MOST_DENSITY = 3e4;

/* the quantity of a unit, where `value` in SI is outside */
static enum percuss_status refuse_quantity(const struct file_material *from, bool young,
                                           double value, struct fault *fault)
{
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "%s: %s: %s: %g is %g %s in units of N, s and the file's length: must be %g to %g; is the "
        "unit of length right?",
        from->file, from->name, young ? from->young_field : from->density_field,
        young ? from->young : from->density, value, young ? "Pa" : "kg/m^3",
        young ? LEAST_YOUNG : LEAST_DENSITY, young ? MOST_YOUNG : MOST_DENSITY);
}

enum percuss_status file_material_convert(const struct file_material *from, double unit,
                                          struct material *to, struct fault *fault)
{
    /* stresses in N per square of the length; the unit of mass is 1 N s^2/unit of length */
    double stress = 1.0 / (unit * unit), density = stress * stress;
    struct fault inner;
    memset(to, 0, sizeof *to);
    snprintf(to->name, sizeof to->name, "%.*s", (int)sizeof to->name - 1, from->name);
    to->young = from->young * stress;
    to->poisson = from->poisson;
    to->density = from->density * density;
    to->yield = INFINITY;
    if (!isnan(to->young) && !(to->young >= LEAST_YOUNG && to->young <= MOST_YOUNG))
        return refuse_quantity(from, true, to->young, fault);
    if (!isnan(to->density) && !(to->density >= LEAST_DENSITY && to->density <= MOST_DENSITY))
        return refuse_quantity(from, false, to->density, fault);
    if (!isnan(to->young) && !isnan(to->density) && material_check(to, &inner) != PERCUSS_OK)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s: %.400s", from->file, from->name,
                         inner.text);
    return PERCUSS_OK;
}
