/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/matched.h"

#include <math.h>

/* Radial displacement at the pole of a unit sphere under the surface stress sigma_rr = P_n(cos
 * theta) without shear, times the shear modulus. With the harmonic f = r^n P_n two fields are
 * regular: grad f and r^2 grad f + alpha r f (Love, Theory of Elasticity, art. 172); the sum
 * without shear on r = 1 is wanted. `lame` is lambda over the shear modulus. */
static double pole_response(double lame, double n)
{
    if (n == 0.0) /* uniform: 1 / (3 bulk) */
        return 1.0 / (3.0 * lame + 2.0);
    if (n == 1.0) {
        /* The resultant accelerates the sphere: u = p (r^2 e_z - 2 z r) with the body force
         * -(6 lambda + 4 mu) p balances it without shear on r = 1; u_z is -p at the pole and p/5 in
         * the mean. */
        return 1.2 / (6.0 * lame + 4.0);
    }
    double alpha = -2.0 * (n * lame + 3.0 * n + 1.0) / ((n + 3.0) * lame + n + 5.0);
    /* shear of the first is 2 (n - 1), of the second 2 n + alpha */
    double first = -0.5 * (2.0 * n + alpha) / (n - 1.0);
    double stress = lame * (2.0 * n + alpha * (n + 3.0)) + 2.0 * (n + alpha) * (n + 1.0) +
                    2.0 * n * (n - 1.0) * first;
    return (n * first + n + alpha) / stress;
}

/* transform of Hertz's pressure, 1 at 0: 3 (sin t - t cos t) / t^3 */
static double hertz_transform(double t)
{
    if (t < 0.05)
        return 1.0 - t * t / 10.0 + t * t * t * t / 280.0;
    return 3.0 * (sin(t) - t * cos(t)) / (t * t * t);
}

double matched_sphere(double poisson, double patch)
{
    /* A load of 1 spread as Hertz's pressure has the surface stress sum (2n + 1) / (4 pi) h_n P_n
     * with h_n the transform at (n + 1/2) patch; displacement is averaged with the same pressure.
     * Of each term the half-space's is taken off; their sum over n + 1/2 is its integral (midpoint
     * rule of a smooth even function). What is left falls off like 1/n, whence the logarithm. */
    double lame = 2.0 * poisson / (1.0 - 2.0 * poisson);
    double half_space = (1.0 - poisson * poisson) / M_PI;
    double sum = 0.0;
    for (double n = 0.0; (n + 0.5) * patch < 40.0; n += 1.0) {
        double transform = hertz_transform((n + 0.5) * patch);
        /* E = 2 (1 + nu) mu */
        double term =
            2.0 * (1.0 + poisson) * (2.0 * n + 1.0) / (4.0 * M_PI) * pole_response(lame, n);
        sum += (term - half_space) * transform * transform;
    }
    return sum;
}

bool matched_compliance(const struct body *body, double patch, double *compliance)
{
    struct solid solid = body_solid(body);
    double poisson = body->material.poisson;
    double scale = 1.0 / (body->material.young * solid.radius);
    double slenderness = solid.length / solid.radius;
    double held = body_is_flexible(body) ? slenderness / (3.0 * M_PI) : 0.0;
    /* in units of 1/(E R), by form; none for what has no answer */
    switch (solid.form) {
    case SOLID_HALF_SPACE:
        *compliance = 0.0;
        return true;
    case SOLID_BALL:
        *compliance = scale * matched_sphere(poisson, patch / solid.radius);
        return true;
    case SOLID_CYLINDER:
        if (solid.approximate || isfinite(solid.tip_radius))
            break;
        if (!matched_cylinder(poisson, slenderness, compliance))
            return false;
        *compliance = scale * (*compliance - held);
        return true;
    default:
        break;
    }
    *compliance = NAN;
    return true;
}
