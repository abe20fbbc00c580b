/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/elliptic.h"

#include <math.h>

double elliptic_rf0(double y, double z)
{
    /* complete case: pi/2 over the arithmetic-geometric mean (DLMF 19.22.8) */
    double a = sqrt(y);
    double g = sqrt(z);
    for (int i = 0; i < 60 && fabs(a - g) > 1e-16 * a; i++) {
        double mean = 0.5 * (a + g);
        g = sqrt(a * g);
        a = mean;
    }
    return M_PI / (a + g);
}

double elliptic_rd0(double y, double z)
{
    /* duplication theorem until the arguments agree to 1e-3, then the fifth-order series whose
     * error is below 3e-18 there (Carlson, Numerical computation of real or complex elliptic
     * integrals, 1995, section 2; DLMF 19.36.2) */
    double x = 0.0;
    double sum = 0.0;
    double factor = 1.0;
    double mean = (x + y + 3.0 * z) / 5.0;
    for (int i = 0; i < 700; i++) {
        double spread = fmax(fabs(mean - x), fmax(fabs(mean - y), fabs(mean - z)));
        if (spread <= 1e-3 * mean)
            break;
        double lambda = sqrt(x) * (sqrt(y) + sqrt(z)) + sqrt(y * z);
        sum += factor / (sqrt(z) * (z + lambda));
        factor *= 0.25;
        x = 0.25 * (x + lambda);
        y = 0.25 * (y + lambda);
        z = 0.25 * (z + lambda);
        mean = (x + y + 3.0 * z) / 5.0;
    }
    /* elementary symmetric functions of what is left between them */
    double dx = (mean - x) / mean;
    double dy = (mean - y) / mean;
    double dz = -(dx + dy) / 3.0;
    double xy = dx * dy;
    double zz = dz * dz;
    double e2 = xy - 6.0 * zz;
    double e3 = (3.0 * xy - 8.0 * zz) * dz;
    double e4 = 3.0 * (xy - zz) * zz;
    double e5 = xy * zz * dz;
    double series = 1.0 - 3.0 / 14.0 * e2 + e3 / 6.0 + 9.0 / 88.0 * e2 * e2 - 3.0 / 22.0 * e4 -
                    9.0 / 52.0 * e2 * e3 + 3.0 / 26.0 * e5;
    return 3.0 * sum + factor * series / (mean * sqrt(mean));
}
