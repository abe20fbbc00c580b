/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "distance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "random.h"

/* Cells of the lattice that the exact distribution may take. */
static const double MOST_CELLS = 4e7;

/* A value of the pooled sample. */
struct pooled {
    double value;
    bool first; /* it is one of x */
};

static int compare_pooled(const void *a, const void *b)
{
    double x = ((const struct pooled *)a)->value, y = ((const struct pooled *)b)->value;
    return (x > y) - (x < y);
}

static struct pooled *pool(const double *x, size_t nx, const double *y, size_t ny)
{
    struct pooled *all = nx && ny ? calloc(nx + ny, sizeof *all) : NULL;
    for (size_t i = 0; all && i < nx + ny; i++)
        all[i] = (struct pooled){i < nx ? x[i] : y[i - nx], i < nx};
    if (all)
        qsort(all, nx + ny, sizeof *all, compare_pooled);
    return all;
}

static double largest_difference(const struct pooled *all, size_t nx, size_t ny)
{
    double worst = 0.0;
    size_t x = 0, y = 0;
    for (size_t i = 0; i < nx + ny; i++) {
        x += all[i].first;
        y += !all[i].first;
        /* the distributions jump together at equal values */
        if (i + 1 < nx + ny && all[i + 1].value == all[i].value)
            continue;
        worst = fmax(worst, fabs((double)x / (double)nx - (double)y / (double)ny));
    }
    return worst;
}

/* Probability that a random order of nx and ny values keeps the difference below d: u(i, j) is the
 * share of all paths from (0, 0) to (i, j) that do so all the way. */
static double exact_below(double d, size_t nx, size_t ny, double *u)
{
    /* differences equal to d up to rounding count as reached */
    double limit = d - 1e-9 / ((double)nx * (double)ny);
    for (size_t i = 0; i <= nx; i++) {
        for (size_t j = 0; j <= ny; j++) {
            bool inside = fabs((double)i / (double)nx - (double)j / (double)ny) < limit;
            double share = (double)i / (double)(i + j);
            if (!inside)
                u[j] = 0.0;
            else if (i == 0 || j == 0)
                u[j] = i + j == 0 ? 1.0 : i == 0 ? u[j - 1] : u[j];
            else
                u[j] = share * u[j] + (1.0 - share) * u[j - 1];
        }
    }
    return u[ny];
}

/* Kolmogorov's limit with Stephens' correction for small samples. */
static double asymptotic_p(double d, double nx, double ny)
{
    double root = sqrt(nx * ny / (nx + ny));
    double z = d * (root + 0.12 + 0.11 / root), sum = 0.0;
    for (int k = 1; k <= 100; k++)
        sum += (k % 2 ? 2.0 : -2.0) * exp(-2.0 * k * k * z * z);
    return z < 0.2 ? 1.0 : fmin(1.0, fmax(0.0, sum));
}

bool distance_kolmogorov(const double *x, size_t nx, const double *y, size_t ny,
                         struct distance *distance)
{
    struct pooled *all = pool(x, nx, y, ny);
    double *u = all ? calloc(ny + 1, sizeof *u) : NULL;
    if (u) {
        double d = largest_difference(all, nx, ny);
        bool exact = (double)nx * (double)ny <= MOST_CELLS;
        distance->value = d;
        distance->p = exact ? fmax(0.0, 1.0 - exact_below(d, nx, ny, u))
                            : asymptotic_p(d, (double)nx, (double)ny);
    }
    free(u);
    free(all);
    return u != NULL;
}

static double energy_of(const struct pooled *all, size_t nx, size_t ny)
{
    double sum = 0.0, x = 0.0, y = 0.0;
    for (size_t i = 0; i + 1 < nx + ny; i++) {
        x += all[i].first;
        y += !all[i].first;
        double difference = x / (double)nx - y / (double)ny;
        sum += 2.0 * difference * difference * (all[i + 1].value - all[i].value);
    }
    return sum;
}

/* Hands the names out anew (Fisher and Yates). */
static void shuffle(struct pooled *all, size_t count, struct random *random)
{
    for (size_t i = count - 1; i > 0; i--) {
        size_t j = (size_t)(random_uniform(random) * (double)(i + 1));
        bool first = all[i].first;
        all[i].first = all[j].first;
        all[j].first = first;
    }
}

bool distance_energy(const double *x, size_t nx, const double *y, size_t ny, unsigned permutations,
                     uint64_t seed, struct distance *distance)
{
    struct pooled *all = pool(x, nx, y, ny);
    if (!all)
        return false;
    struct random random = {seed};
    unsigned reached = 0;
    distance->value = energy_of(all, nx, ny);
    for (unsigned k = 0; k < permutations; k++) {
        shuffle(all, nx + ny, &random);
        reached += energy_of(all, nx, ny) >= distance->value * (1.0 - 1e-12);
    }
    /* the order found is one of the permutations */
    distance->p = (1.0 + reached) / (1.0 + permutations);
    free(all);
    return true;
}

double sample_mean(const double *x, size_t n)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += x[i];
    return n ? sum / (double)n : NAN;
}

double sample_deviation(const double *x, size_t n)
{
    double mean = sample_mean(x, n), sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += (x[i] - mean) * (x[i] - mean);
    return n > 1 ? sqrt(sum / (double)(n - 1)) : NAN;
}

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double sample_median(double *x, size_t n)
{
    if (n == 0)
        return NAN;
    qsort(x, n, sizeof *x, compare_numbers);
    return 0.5 * (x[(n - 1) / 2] + x[n / 2]);
}

/* P(|T| <= t) by the integral of the density; substitution t = sqrt(freedom) tan(phi) makes it the
 * integral of cos^(freedom - 1), smooth and bounded. */
static double student_within(double t, double freedom)
{
    enum { PANELS = 400 };
    double end = atan(t / sqrt(freedom)), h = end / PANELS, sum = 0.0;
    for (int i = 0; i <= PANELS; i++) {
        double weight = i == 0 || i == PANELS ? 1.0 : i % 2 ? 4.0 : 2.0;
        sum += weight * pow(cos(i * h), freedom - 1.0);
    }
    double scale = exp(lgamma(0.5 * (freedom + 1.0)) - lgamma(0.5 * freedom)) / sqrt(M_PI);
    return 2.0 * scale * sum * h / 3.0;
}

double student_quantile(double p, double freedom)
{
    double within = fabs(2.0 * p - 1.0), low = 0.0, high = 1.0;
    while (student_within(high, freedom) < within && high < 1e9)
        high *= 2.0;
    for (int i = 0; i < 100 && high - low > 1e-13 * high; i++) {
        double middle = 0.5 * (low + high);
        if (student_within(middle, freedom) < within)
            low = middle;
        else
            high = middle;
    }
    return p < 0.5 ? -high : high;
}
