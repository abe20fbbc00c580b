/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/boussinesq.h"

#include <math.h>

void boussinesq_displacement(double young, double poisson, double r, double z,
                             double displacement[2])
{
    double depth = -z;
    double distance = hypot(r, z);
    double cube = distance * distance * distance;
    double scale = (1.0 + poisson) / (2.0 * M_PI * young);
    displacement[0] =
        scale * (r * depth / cube - (1.0 - 2.0 * poisson) * r / (distance * (distance + depth)));
    displacement[1] = -scale * (2.0 * (1.0 - poisson) / distance + depth * depth / cube);
}

void boussinesq_stress(double poisson, double r, double z, double stress[STRESS_COMPONENTS])
{
    double depth = -z;
    double distance = hypot(r, z);
    double cube = distance * distance * distance;
    double fifth = cube * distance * distance;
    double side = (1.0 - 2.0 * poisson) / (distance * (distance + depth));
    double scale = 0.5 / M_PI;
    stress[0] = scale * (side - 3.0 * r * r * depth / fifth);
    stress[1] = -scale * 3.0 * depth * depth * depth / fifth;
    stress[2] = scale * ((1.0 - 2.0 * poisson) * depth / cube - side);
    /* shear on the outward z: the depth's sign turns */
    stress[3] = scale * 3.0 * r * depth * depth / fifth;
}
