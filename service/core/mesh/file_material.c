/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/file_material.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* no solid is softer, stiffer, lighter or heavier: values outside are in other units */
static const double LEAST_YOUNG = 1e4, MOST_YOUNG = 5e12, LEAST_DENSITY = 5.0, MOST_DENSITY = 3e4;

/* m/s, sqrt(E/rho): diamond has 17,000 and rubber 30; steel whose modulus is in GPa has 160 */
static const double MOST_SPEED = 2e4, SLOW_SPEED = 200.0;

static const double INCH = 0.0254; /* m */

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
    double speed = sqrt(to->young / to->density);
    if (speed > MOST_SPEED)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%s: %s: %s %g and %s %g are %g Pa and %g kg/m^3 in units of N, s and the "
                         "file's length: waves of %g m/s: must be at most %g: are both in these "
                         "units?",
                         from->file, from->name, from->young_field, from->young,
                         from->density_field, from->density, to->young, to->density, speed,
                         MOST_SPEED);
    if (!isnan(to->young) && !isnan(to->density) && material_check(to, &inner) != PERCUSS_OK)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s: %.400s", from->file, from->name,
                         inner.text);
    return PERCUSS_OK;
}

void file_material_doubt(const struct file_material *from, double unit, const struct material *to,
                         char *doubt, size_t size)
{
    /* figures in pounds-force are 4.4 times too small in newtons */
    bool imperial = fabs(unit - INCH) < 1e-9 || fabs(unit - 12.0 * INCH) < 1e-9;
    double speed = sqrt(to->young / to->density);
    char density[48] = "";
    doubt[0] = '\0';
    if (!isnan(to->density))
        snprintf(density, sizeof density, ", %s %.4g kg/m^3", from->density_field, to->density);
    if (imperial)
        snprintf(doubt, size,
                 "%s: %s is read in newtons: E %.4g Pa%s; of a deck in pounds-force give the "
                 "material yourself",
                 from->file, from->name, to->young, density);
    else if (speed < SLOW_SPEED)
        snprintf(doubt, size,
                 "%s: %s: E %.4g Pa%s: waves of %.3g m/s, as in rubber and foam; of another solid, "
                 "%s or %s is in other units",
                 from->file, from->name, to->young, density, speed, from->young_field,
                 from->density_field);
}
