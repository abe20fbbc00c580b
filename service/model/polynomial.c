/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/polynomial.h"

#include <math.h>

void polynomial_legendre(size_t count, double x, double *value)
{
    double before = 0.0, now = 1.0;
    for (size_t n = 0; n < count; n++) {
        value[n] = sqrt(2.0 * (double)n + 1.0) * now;
        double next = ((2.0 * (double)n + 1.0) * x * now - (double)n * before) / ((double)n + 1.0);
        before = now;
        now = next;
    }
}

/* The mean square of (1 - x)^(a/2) (1 + x)^(b/2) P_n is 2^(a+b)/(2 n + a + b + 1) times
 * (n + a)! (n + b)!/(n! (n + a + b)!), which is 1 unless both ends are held. */
static double held_norm(double n, double a, double b)
{
    double factorials = a * b > 0.0 ? (n + 1.0) * (n + 2.0) / ((n + 3.0) * (n + 4.0)) : 1.0;
    return sqrt((2.0 * n + a + b + 1.0) / (pow(2.0, a + b) * factorials));
}

void polynomial_held(size_t count, const bool held[2], double x, double *value, double *slope)
{
    double a = held[1] ? 2.0 : 0.0, b = held[0] ? 2.0 : 0.0;
    double factor = (held[1] ? 1.0 - x : 1.0) * (held[0] ? 1.0 + x : 1.0);
    double steep =
        (held[0] ? (held[1] ? 1.0 - x : 1.0) : 0.0) - (held[1] ? (held[0] ? 1.0 + x : 1.0) : 0.0);
    double p = 1.0, before = 0.0, d = 0.0, d_before = 0.0;
    for (size_t k = 0; k < count; k++) {
        double n = (double)k, norm = held_norm(n, a, b), next, d_next;
        value[k] = norm * factor * p;
        if (slope)
            slope[k] = norm * (steep * p + factor * d);
        /* Jacobi's recurrence, and its derivative */
        double i = n + 1.0, c = 2.0 * i + a + b;
        if (k == 0) {
            next = (a + 1.0) + 0.5 * (a + b + 2.0) * (x - 1.0);
            d_next = 0.5 * (a + b + 2.0);
        } else {
            double a1 = 2.0 * i * (i + a + b) * (c - 2.0), a2 = (c - 1.0) * (a * a - b * b);
            double a3 = (c - 2.0) * (c - 1.0) * c, a4 = 2.0 * (i + a - 1.0) * (i + b - 1.0) * c;
            next = ((a2 + a3 * x) * p - a4 * before) / a1;
            d_next = ((a2 + a3 * x) * d + a3 * p - a4 * d_before) / a1;
        }
        before = p;
        d_before = d;
        p = next;
        d = d_next;
    }
}

void polynomial_zernike(size_t count, double y, double z, double *value, double *along_y,
                        double *along_z)
{
    double radius = hypot(y, z), angle = atan2(z, y), x = 2.0 * radius * radius - 1.0;
    for (size_t m = 0; m < count; m++) {
        double power = pow(radius, (double)m), order = (double)m;
        double lower = m > 0 ? pow(radius, order - 1.0) : 0.0;
        double cosine = cos(order * angle), sine = sin(order * angle);
        double p = 1.0, before = 0.0, slope = 0.0, slope_before = 0.0;
        for (size_t k = 0; m + 2 * k < count; k++) {
            size_t n = m + 2 * k;
            double norm = sqrt((m > 0 ? 2.0 : 1.0) * ((double)n + 1.0));
            double r = power * p, radial = order * lower * p + power * 4.0 * radius * slope;
            double turned = m > 0 ? order * lower * p : 0.0;
            for (int odd = 0; odd < (m > 0 ? 2 : 1); odd++) {
                size_t at_r = odd ? n - m + 1 : n - m, at = (n - at_r) * POLYNOMIAL_MOST + at_r;
                double round = odd ? sine : cosine, other = odd ? cosine : -sine;
                value[at] = norm * r * round;
                if (!along_y)
                    continue;
                double out = norm * radial * round, around = norm * turned * other;
                along_y[at] = cos(angle) * out - sin(angle) * around;
                along_z[at] = sin(angle) * out + cos(angle) * around;
            }
            /* Jacobi's recurrence, and its derivative */
            double i = (double)k + 1.0, c = 2.0 * i + order;
            double a1 = 2.0 * i * (i + order) * (c - 2.0);
            double a2 = (c - 1.0) * -order * order, a3 = (c - 2.0) * (c - 1.0) * c;
            double a4 = 2.0 * (i - 1.0) * (i + order - 1.0) * c;
            double next, steep;
            if (k == 0) {
                next = 1.0 + 0.5 * (order + 2.0) * (x - 1.0);
                steep = 0.5 * (order + 2.0);
            } else {
                next = ((a2 + a3 * x) * p - a4 * before) / a1;
                steep = ((a2 + a3 * x) * slope + a3 * p - a4 * slope_before) / a1;
            }
            before = p;
            slope_before = slope;
            p = next;
            slope = steep;
        }
    }
}

void polynomial_gauss(size_t n, double *x, double *weight)
{
    for (size_t i = 0; i < n; i++) {
        double at = cos(M_PI * ((double)i + 0.75) / ((double)n + 0.5)), slope = 1.0;
        for (int turn = 0; turn < 100; turn++) {
            double before = 0.0, p = 1.0;
            for (size_t k = 0; k < n; k++) {
                double next =
                    ((2.0 * (double)k + 1.0) * at * p - (double)k * before) / ((double)k + 1.0);
                before = p;
                p = next;
            }
            slope = (double)n * (at * p - before) / (at * at - 1.0);
            double step = p / slope;
            at -= step;
            if (fabs(step) < 1e-15)
                break;
        }
        x[i] = 0.5 * (1.0 + at);
        weight[i] = 1.0 / ((1.0 - at * at) * slope * slope);
    }
}
