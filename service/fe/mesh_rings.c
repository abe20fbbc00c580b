/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/mesh_rings.h"

#include <math.h>
#include <stdlib.h>

static double arc_of(double radius, double sphere)
{
    return isinf(sphere) ? radius : sphere * asin(radius / sphere);
}

/* q + q^2 + ... + q^n */
static double geometric(double q, size_t n)
{
    return fabs(q - 1.0) < 1e-9 ? (double)n : q * (pow(q, (double)n) - 1.0) / (q - 1.0);
}

/* ratio that lets n steps, the first of width * ratio, fill the rest: bisection of a monotone sum
 */
static double fitting_ratio(double rest, double width, size_t n)
{
    double low = 0.0;
    double high = 1.0 + rest / width;
    for (int i = 0; i < 200 && high - low > 1e-15 * high; i++) {
        double q = 0.5 * (low + high);
        if (width * geometric(q, n) < rest)
            low = q;
        else
            high = q;
    }
    return 0.5 * (low + high);
}

/* number of steps whose fitting ratio is nearest to the wanted one */
static size_t fitting_count(double rest, double width, double growth)
{
    size_t n = 1;
    while (n < MESH_RINGS_MAX && width * geometric(growth, n) < rest)
        n++;
    if (n > 1 && rest - width * geometric(growth, n - 1) < width * geometric(growth, n) - rest)
        n--;
    return n;
}

size_t mesh_rings(const struct mesh_grade *grade, double sphere, double end, double **positions)
{
    double *list = malloc((MESH_RINGS_MAX + 1) * sizeof *list);
    *positions = list;
    if (!list)
        return 0;
    /* exact geometric steps, alike in all bodies of the grade */
    double radius = (double)grade->core * grade->size;
    double width = grade->size;
    size_t rings = 0;
    list[0] = arc_of(radius, sphere);
    while (radius < grade->matched && rings < MESH_RINGS_MAX) {
        width *= grade->growth;
        radius += width;
        if (!(radius < (isinf(sphere) ? end : sphere)))
            return 0;
        list[++rings] = arc_of(radius, sphere);
    }
    /* the rest by a ratio that ends where the surface does */
    double reached = list[rings];
    double rest = end - reached;
    size_t more = fitting_count(rest, width, grade->growth);
    if (!(rest > 0.2 * width) || rings + more > MESH_RINGS_MAX)
        return 0;
    double ratio = fitting_ratio(rest, width, more);
    for (size_t i = 1; i <= more; i++)
        list[rings + i] = reached + width * geometric(ratio, i);
    list[rings + more] = end;
    return rings + more;
}

size_t mesh_rows(double length, double first, const struct mesh_grade *grade, double **heights)
{
    double *list = malloc(MESH_RINGS_MAX * sizeof *list);
    *heights = list;
    if (!list)
        return 0;
    /* each higher than the one before, up to the coarsest, until they reach the end */
    double coarse = fmax(grade->coarse, first);
    double sum = 0.0;
    size_t rows = 0;
    for (double height = first; sum < length * (1.0 - 1e-9); rows++) {
        if (rows == MESH_RINGS_MAX)
            return 0;
        height = fmin(height * grade->growth, coarse);
        list[rows] = height;
        sum += height;
    }
    /* all lowered alike, so that they end there */
    for (size_t i = 0; i < rows; i++)
        list[i] *= length / sum;
    return rows;
}
