/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/ritz.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/watch.h"
#include "model/ritz_parts.h"
#include "model/vector.h"
#include "numeric/linear.h"

/* Thinner boxes would need polynomials of a higher degree than is numerically stable. */
static const double THINNEST = 1.0 / 200.0;
/* Polynomials beyond pi for each wave with which frequencies are good to 1e-3. */
static const double SPARE = 3.0;

bool ritz_reaches(const struct ritz_shape *shape)
{
    const double *side = shape->side;
    double longest = fmax(side[0], fmax(side[1], side[2]));
    return fmin(side[0], fmin(side[1], side[2])) >= THINNEST * longest;
}

size_t ritz_mode_count(const struct ritz *ritz)
{
    return ritz->count;
}

const double *ritz_omega(const struct ritz *ritz)
{
    return ritz->omega;
}

double ritz_highest(const struct ritz *ritz)
{
    return ritz->highest;
}

/* The coordinate of a component's polynomial of degree one along `axis` (-1: of none). */
static size_t find_order(const struct ritz_class *class, int component, int axis)
{
    for (size_t i = class->terms.begin[component]; i < class->terms.begin[component + 1]; i++) {
        const unsigned char *order = class->terms.order[i];
        bool same = true;
        for (int d = 0; d < 3; d++)
            same = same && order[d] == (d == axis ? 1 : 0);
        if (same)
            return i;
    }
    return class->terms.count;
}

static bool add_rigid(struct ritz_class *class, size_t i, double one, size_t j, double other)
{
    double *vector = calloc(class->terms.count, sizeof *vector);
    double norm = hypot(one, other);
    if (!vector)
        return false;
    vector[i] = one / norm;
    if (j < class->terms.count)
        vector[j] = other / norm;
    class->rigid[class->rigids++] = vector;
    return true;
}

/* A coordinate over the polynomial of degree one, up to a common factor: sqrt(12) of a side, 4 of a
 * diameter. */
static double axis_spread(const struct ritz *ritz, int axis)
{
    return ritz->basis.side[axis] * (ritz->basis.round && axis > 0 ? sqrt(0.75) : 1.0);
}

/* Translations, and rotations u_b = -x_c, u_c = x_b. */
static bool find_rigids(const struct ritz *ritz, struct ritz_class *class)
{
    bool good = true;
    for (int axis = 0; good && axis < 3 && ritz_basis_holds(&ritz->basis) == 0; axis++) {
        int b = (axis + 1) % 3, c = (axis + 2) % 3;
        size_t along = find_order(class, axis, -1);
        size_t i = find_order(class, b, c), j = find_order(class, c, b);
        if (along < class->terms.count)
            good = add_rigid(class, along, 1.0, class->terms.count, 0.0);
        if (good && i < class->terms.count && j < class->terms.count)
            good = add_rigid(class, i, -axis_spread(ritz, c), j, axis_spread(ritz, b));
    }
    return good;
}

/* Up to the frequency of the slowest waves that the polynomials resolve: 1/omega^2 = 1/(bending
 * k^2)^2 + 1/(c_R k)^2 of waves along each side, with Rayleigh's speed c_R. Its formula ends below
 * poisson -0.4, where it is at least 0.69 of the shear wave's. */
static double find_highest(const struct ritz *ritz)
{
    double shear = sqrt(0.5 / (1.0 + ritz->poisson));
    double surface = shear * fmax((0.87 + 1.12 * ritz->poisson) / (1.0 + ritz->poisson), 0.69);
    double least = INFINITY, thickness = ritz->basis.side[ritz_basis_thinnest(&ritz->basis)];
    double bending = thickness / sqrt(12.0 * (1.0 - ritz->poisson * ritz->poisson));
    for (int d = 0; d < 3; d++) {
        double k = 2.0 * ((double)ritz->basis.orders[d] - SPARE) / ritz->basis.side[d];
        double slow = 1.0 / (bending * k * k), quick = 1.0 / (surface * k);
        least = fmin(least, 1.0 / hypot(slow, quick));
    }
    return least;
}

/* The lower triangle with the rigid motions held; it is unchanged for all other motions. */
static void hold_rigids(const struct ritz_class *class, const double *k, double *held)
{
    size_t n = class->terms.count;
    for (size_t j = 0, at = 0; j < n; j++)
        for (size_t i = j; i < n; i++) {
            double sum = k[j * n + i];
            for (size_t r = 0; r < class->rigids; r++)
                sum += class->rigid[r][i] * class->rigid[r][j];
            held[at++] = sum;
        }
}

/* The lowest modes of a class, and the factor. */
static bool solve_class(const struct ritz *ritz, struct ritz_class *class, double top)
{
    size_t n = class->terms.count, found = SIZE_MAX;
    if (n == 0)
        return true;
    double *k = calloc(n * n, sizeof *k);
    double *vectors = calloc(n * n, sizeof *vectors);
    class->omega = calloc(n, sizeof *class->omega);
    class->factor = calloc(n * (n + 1) / 2, sizeof *class->factor);
    if (k && vectors && class->omega && class->factor && find_rigids(ritz, class)) {
        ritz_basis_stiffness(&ritz->basis, &class->terms, ritz->poisson, k);
        hold_rigids(class, k, class->factor);
        /* above the rigid motions' rounding, below the lowest bending */
        double bottom = ritz_basis_holds(&ritz->basis)
                            ? 0.0
                            : 0.5 * ritz->basis.side[ritz_basis_thinnest(&ritz->basis)];
        bool factored = linear_packed_factor(n, class->factor);
        if (factored && top <= bottom)
            found = 0;
        else if (factored)
            found = linear_eigen_between(n, k, bottom * bottom, top * top, class->omega, vectors);
    }
    class->modes = found == SIZE_MAX ? 0 : found;
    for (size_t m = 0; m < class->modes; m++)
        class->omega[m] = sqrt(class->omega[m]);
    double *fitting = realloc(vectors, (class->modes * n + 1) * sizeof *vectors);
    class->vectors = fitting ? fitting : vectors;
    free(k);
    return found != SIZE_MAX;
}

/* Sorts the modes of all classes by their frequencies; equal ones by their class. */
static bool merge(struct ritz *ritz)
{
    size_t next[RITZ_CLASSES] = {0}, all = 0;
    for (int c = 0; c < RITZ_CLASSES; c++)
        all += ritz->class[c].modes;
    ritz->omega = calloc(all + 1, sizeof *ritz->omega);
    ritz->mode = calloc(all + 1, sizeof *ritz->mode);
    if (!ritz->omega || !ritz->mode)
        return false;
    for (ritz->count = 0; ritz->count < all; ritz->count++) {
        int lowest = -1;
        double omega = INFINITY;
        for (int c = 0; c < RITZ_CLASSES; c++)
            if (next[c] < ritz->class[c].modes && ritz->class[c].omega[next[c]] < omega) {
                lowest = c;
                omega = ritz->class[c].omega[next[c]];
            }
        ritz->omega[ritz->count] = omega;
        ritz->mode[ritz->count] =
            (struct ritz_mode){(unsigned char)lowest, (unsigned)next[lowest]++};
    }
    return true;
}

/* Solves all classes once the polynomials and the highest frequency are chosen. */
static bool solve_classes(struct ritz *ritz, struct pace *pace)
{
    bool good = ritz_basis_prepare(&ritz->basis);
    for (int c = 0; good && c < RITZ_CLASSES; c++)
        good = pace_ask(pace, 0.0) && ritz_basis_list(&ritz->basis, c, &ritz->class[c].terms) &&
               solve_class(ritz, &ritz->class[c], ritz -> highest);
    ritz_basis_drop_means(&ritz->basis);
    return good && merge(ritz);
}

/* The free box of a held one, without modes: the polynomials of the held one are those of the free
 * one that vanish on the held faces. */
static bool make_free(struct ritz *ritz, struct pace *pace)
{
    struct ritz *made = calloc(1, sizeof *made);
    if (!made)
        return false;
    ritz->free = made;
    made->poisson = ritz->poisson;
    made->basis.volume = ritz->basis.volume;
    made->basis.mixed = ritz->basis.mixed;
    made->basis.lifted = ritz_basis_holds(&ritz->basis);
    memcpy(made->basis.side, ritz->basis.side, sizeof made->basis.side);
    memcpy(made->basis.orders, ritz->basis.orders, sizeof made->basis.orders);
    made->basis.orders[0] += made->basis.lifted;
    return solve_classes(made, pace);
}

struct ritz *ritz_create(const struct ritz_shape *shape, double poisson, struct pace *pace)
{
    struct ritz *ritz = calloc(1, sizeof *ritz);
    const double *side = shape->side;
    double longest = fmax(side[0], fmax(side[1], side[2]));
    if (!ritz)
        return NULL;
    ritz->basis.round = shape->round;
    memcpy(ritz->basis.held, shape->held, sizeof ritz->basis.held);
    ritz->basis.mixed = ritz_basis_holds(&ritz->basis) == 1;
    ritz->poisson = poisson;
    ritz->basis.volume = shape->round ? 0.25 * M_PI : 1.0;
    for (int d = 0; d < 3; d++) {
        ritz->basis.side[d] = side[d] / longest;
        ritz->basis.volume *= ritz->basis.side[d];
    }
    ritz_basis_choose_orders(&ritz->basis);
    ritz->highest = find_highest(ritz);
    if (solve_classes(ritz, pace) && (ritz_basis_holds(&ritz->basis) == 0 || make_free(ritz, pace)))
        return ritz;
    ritz_free(ritz);
    return NULL;
}

size_t ritz_size(const struct ritz *ritz)
{
    size_t numbers = 0;
    for (int c = 0; c < RITZ_CLASSES; c++) {
        size_t n = ritz->class[c].terms.count;
        numbers += n * (n + 1) / 2 + n * ritz->class[c].modes;
    }
    return numbers * sizeof(double) + (ritz->free ? ritz_size(ritz->free) : 0);
}

void ritz_free(struct ritz *ritz)
{
    for (int c = 0; ritz && c < RITZ_CLASSES; c++) {
        struct ritz_class *class = &ritz->class[c];
        for (size_t r = 0; r < class->rigids; r++)
            free(class->rigid[r]);
        free(class->terms.order);
        free(class->factor);
        free(class->omega);
        free(class->vectors);
    }
    if (ritz) {
        ritz_free(ritz->free);
        ritz_basis_clear(&ritz->basis);
        free(ritz->omega);
        free(ritz->mode);
    }
    free(ritz);
}

void ritz_shapes(const struct ritz *ritz, const double point[3], const double direction[3],
                 size_t first, size_t count, double *row)
{
    enum { LARGEST = 4 * RITZ_MOST_OF_CLASS };
    double functions[LARGEST];
    struct ritz_functions at;
    ritz_functions_fill(&ritz->basis, point, &at);
    for (int c = 0; c < RITZ_CLASSES; c++) {
        const struct ritz_class *class = &ritz->class[c];
        bool filled = false;
        for (size_t k = 0; k < count; k++) {
            const struct ritz_mode *mode = &ritz->mode[first + k];
            if (mode->class != c)
                continue;
            if (!filled)
                ritz_functions_along(&ritz->basis, &class->terms, &at, direction, functions);
            filled = true;
            const double *vector = class->vectors + mode->number * class->terms.count;
            double sum = 0.0;
            for (size_t i = 0; i < class->terms.count; i++)
                sum += vector[i] * functions[i];
            row[k] = sum;
        }
    }
}
