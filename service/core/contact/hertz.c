/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/hertz.h"

#include <math.h>

#include "numeric/special.h"

double hertz_effective_modulus(const struct material *a, const struct material *b)
{
    return 1.0 / ((1.0 - a->poisson * a->poisson) / a->young +
                  (1.0 - b->poisson * b->poisson) / b->young);
}

/* With q = (b/a)^2 both brackets are Carlson integrals times m/3: K - E = m R_D(0,q,1)/3 and
 * (a/b)^2 E - K = m R_D(0,1,q)/3 (DLMF 19.25.1), so that B/A needs no series near the circle. */
static double curvature_ratio(double q)
{
    return special_elliptic_rd0(1.0, q) / special_elliptic_rd0(q, 1.0);
}

/* q = (b/a)^2 for B/A = ratio >= 1: the ratio falls from infinity to 1 as q rises to 1; regula
 * falsi with bisection in log q against log ratio, which is nearly a straight line. */
static double axis_ratio_squared(double ratio)
{
    if (ratio <= 1.0)
        return 1.0;
    /* log q lies between these, the ratio exceeding 1/q^(1/4) at least */
    double target = log(ratio);
    double low = -4.0 * target - 1.0;
    double high = 0.0;
    double f_low = log(curvature_ratio(exp(low))) - target;
    double f_high = -target;
    for (int i = 0; i < 200 && high - low > 1e-15 * fmax(1e-8, -low); i++) {
        /* the secant's root, or the middle now and then */
        double x = low - f_low * (high - low) / (f_high - f_low);
        if (i % 3 == 2 || !(x > low && x < high))
            x = 0.5 * (low + high);
        /* the half that holds it */
        double f = log(curvature_ratio(exp(x))) - target;
        if (f == 0.0)
            return exp(x);
        if (f > 0.0) {
            low = x;
            f_low = f;
        } else {
            high = x;
            f_high = f;
        }
    }
    return exp(0.5 * (low + high));
}

struct hertz_contact hertz_contact_make(double effective_modulus, double a, double b)
{
    double q = axis_ratio_squared(b / a);
    double k = special_elliptic_rf0(q, 1.0);
    double integral = special_elliptic_rd0(q, 1.0);
    double g = integral / (3.0 * a);
    /* the axis ratio gives q back but for rounding */
    double axis_ratio = sqrt(q);
    double again = axis_ratio * axis_ratio;
    return (struct hertz_contact){
        .effective_modulus = effective_modulus,
        .stiffness = 2.0 * M_PI / 3.0 * effective_modulus * sqrt(g) / (k * sqrt(k)),
        .axis_ratio = axis_ratio,
        .curvature = {a, b},
        .integral = again == q ? integral : special_elliptic_rd0(again, 1.0),
    };
}

void hertz_ellipse(const struct hertz_contact *contact, double force, double axes[2])
{
    /* a^3 = 3 F G / (2 pi E-star), with G as above (Johnson, eqs. 4.25 and 4.26) */
    double g = contact->integral / (3.0 * contact->curvature[0]);
    axes[0] = cbrt(1.5 * force * g / (M_PI * contact->effective_modulus));
    axes[1] = axes[0] * contact->axis_ratio;
}

double hertz_peak_pressure(const struct hertz_contact *contact, double force)
{
    double axes[2];
    hertz_ellipse(contact, force, axes);
    return force > 0.0 ? 1.5 * force / (M_PI * axes[0] * axes[1]) : 0.0;
}

double hertz_pressure_ratio(const struct hertz_contact *contact)
{
    double axes[2];
    if (contact->axis_ratio >= HERTZ_CIRCULAR_RATIO)
        return 1.0;
    /* of the circle: a^2 = R d, with k = (4/3) E-star sqrt(R) */
    double root = 0.75 * contact->stiffness / contact->effective_modulus;
    hertz_ellipse(contact, contact->stiffness, axes); /* at an indentation of 1 m */
    return root * root / (axes[0] * axes[1]);
}
