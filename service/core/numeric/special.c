/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/special.h"

#include <float.h>
#include <math.h>

double special_normal_cdf(double z)
{
    return 0.5 * erfc(-z * M_SQRT1_2);
}

static double special_polynomial(const double *c, int count, double x)
{
    double sum = c[0];
    for (int i = 1; i < count; i++)
        sum = sum * x + c[i];
    return sum;
}

/* P. J. Acklam's approximation (2003), relative error 1.15e-9. */
static double normal_start(double p)
{
    static const double a[] = {-3.969683028665376e+01, 2.209460984245205e+02,
                               -2.759285104469687e+02, 1.383577518672690e+02,
                               -3.066479806614716e+01, 2.506628277459239e+00};
    static const double b[] = {-5.447609879822406e+01, 1.615858368580409e+02,
                               -1.556989798598866e+02, 6.680131188771972e+01,
                               -1.328068155288572e+01, 1.0};
    static const double c[] = {-7.784894002430293e-03, -3.223964580411365e-01,
                               -2.400758277161838e+00, -2.549732539343734e+00,
                               4.374664141464968e+00,  2.938163982698783e+00};
    static const double d[] = {7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                               3.754408661907416e+00, 1.0};
    if (p < 0.02425) {
        double q = sqrt(-2.0 * log(p));
        return special_polynomial(c, 6, q) / special_polynomial(d, 5, q);
    }
    double q = p - 0.5;
    return special_polynomial(a, 6, q * q) * q / special_polynomial(b, 6, q * q);
}

double special_normal_quantile(double p)
{
    /* by symmetry in the lower half, where p has all its digits */
    if (p > 0.5)
        return -special_normal_quantile(1.0 - p);
    double z = normal_start(p);
    for (int i = 0; i < 2; i++) {
        double error = (special_normal_cdf(z) - p) * sqrt(2.0 * M_PI) * exp(0.5 * z * z);
        z -= error / (1.0 + 0.5 * z * error);
    }
    return z;
}

/* The fraction converges fast for x < (a + 1)/(a + b + 2). */
static double beta_fraction(double a, double b, double x)
{
    const double tiny = 1e-300;
    /* Lentz's method, c and d kept from zero */
    double c = 1.0;
    double d = 1.0 - (a + b) * x / (a + 1.0);
    d = 1.0 / (fabs(d) < tiny ? tiny : d);
    double f = d;
    for (int m = 1; m < 20000; m++) {
        double change = 1.0;
        /* even and odd coefficients in turn (DLMF 8.17.23) */
        for (int odd = 0; odd < 2; odd++) {
            double s = a + 2.0 * m;
            double term = odd ? -(a + m) * (a + b + m) * x / (s * (s + 1.0))
                              : m * (b - m) * x / ((s - 1.0) * s);
            d = 1.0 + term * d;
            c = 1.0 + term / c;
            d = 1.0 / (fabs(d) < tiny ? tiny : d);
            c = fabs(c) < tiny ? tiny : c;
            change = c * d;
            f *= change;
        }
        if (fabs(change - 1.0) < DBL_EPSILON)
            break;
    }
    return f;
}

/* lgamma() writes a global */
static double log_gamma(double x)
{
    int sign;
    return lgamma_r(x, &sign);
}

double special_beta_cdf(double a, double b, double x)
{
    if (!(x > 0.0))
        return 0.0;
    if (!(x < 1.0))
        return 1.0;
    double front = exp(log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * log(x) + b * log1p(-x));
    if (x < (a + 1.0) / (a + b + 2.0))
        return front * beta_fraction(a, b, x) / a;
    return 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

static double student_upper(double n, double t)
{
    return 0.5 * special_beta_cdf(0.5 * n, 0.5, n / (n + t * t));
}

double special_student_quantile(double n, double p)
{
    if (p < 0.5)
        return -special_student_quantile(n, 1.0 - p);
    if (n > 1e7)
        return special_normal_quantile(p);
    double low = 0.0;
    double high = 1.0;
    while (student_upper(n, high) > 1.0 - p && high < 1e150)
        high *= 2.0;
    while (high - low > 4.0 * DBL_EPSILON * high) {
        double middle = 0.5 * (low + high);
        if (middle == low || middle == high)
            break;
        if (student_upper(n, middle) > 1.0 - p)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

double special_binomial_cdf(double k, double n, double p)
{
    if (k < 0.0)
        return 0.0;
    if (k >= n)
        return 1.0;
    return special_beta_cdf(n - k, k + 1.0, 1.0 - p);
}

double special_elliptic_rf0(double y, double z)
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

double special_elliptic_rd0(double y, double z)
{
    /* duplication theorem until the arguments agree to 1e-3, then the fifth-order series,
     * with an error below 3e-18 there (Carlson, Numerical computation of real or complex elliptic
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
    /* elementary symmetric functions of the remaining differences */
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
