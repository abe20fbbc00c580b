/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/ritz.h"
#include "base/watch.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "model/boussinesq3.h"
#include "model/polynomial.h"
#include "model/vector.h"
#include "numeric/dense.h"
#include "numeric/linear.h"

/* Thinner boxes would take polynomials of higher degree than are numerically good. */
static const double THINNEST = 1.0 / 200.0;
/* Polynomials along a side: so many and so many more for each thickness in it. Of a plate of 10 the
 * flexibility in its middle is good to 0.002/(E h), of a cube to 2e-5/(E L). */
static const double LEAST = 9.5, MORE = 1.6;
/* The most of a class, for which those along the longer sides are taken off in proportion. */
enum { CLASSES = 8, MOST_OF_CLASS = 1400, MOST_ORDERS = 64 };
/* Across a thin body, and along the shorter sides of a compact one. */
enum { ACROSS = 6, ACROSS_THIN = 5, COMPACT = 11 };
static const double THIN = 0.12;
/* In classes of plates that stretch, which have longer waves. */
static const double STRETCHED = 0.7;
/* Polynomials beyond pi for each wave, until frequencies are good to 1e-3. */
static const double SPARE = 3.0;

/* One class: components, then their polynomials. */
struct ritz_class {
    size_t count;              /* of coordinates */
    size_t begin[4];           /* of each component's, and the end */
    unsigned char (*order)[3]; /* [count] */
    double *factor;            /* Cholesky's of the stiffness matrix with the rigid motions held */
    size_t rigids;             /* rigid motions of the class */
    double *rigid[3];          /* [count], orthonormal */
    size_t modes;
    double *omega, *vectors; /* [modes], [modes][count] */
};

struct ritz {
    double poisson;
    bool round;
    double side[3], mass;
    size_t orders[3];
    size_t *place, places; /* of Zernike's polynomials, [q][r] */
    double *means[5];      /* of a circle, until the classes are solved */
    struct ritz_class class[CLASSES];
    size_t count;
    double *omega; /* [count] */
    struct ritz_mode {
        unsigned char class;
        unsigned number;
    } * mode; /* [count] */
};

/* Gauss' rule of six points on panels that grow away from a place. */
enum { GAUSS = 6, MOST_PANELS = 40, MOST_POINTS = GAUSS * MOST_PANELS };
static const double GROWTH = 2.2;
static const double GAUSS_POINT[3] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
static const double GAUSS_WEIGHT[3] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};

struct rule {
    size_t count;
    double x[MOST_POINTS], weight[MOST_POINTS];
};

static void add_panel(struct rule *rule, double from, double to)
{
    double half = 0.5 * (to - from);
    if (!(half > 0.0) || rule->count + GAUSS > MOST_POINTS)
        return;
    for (int i = 0; i < GAUSS; i++) {
        int k = i < 3 ? 2 - i : i - 3;
        rule->x[rule->count] = 0.5 * (from + to) + (i < 3 ? -half : half) * GAUSS_POINT[k];
        rule->weight[rule->count++] = half * GAUSS_WEIGHT[k];
    }
}

/* Over [-half, half], fine at `place` for what varies over `scale`. */
static void make_rule(double half, double place, double scale, struct rule *rule)
{
    rule->count = 0;
    scale = fmax(scale, 1e-3 * half);
    for (int side = -1; side <= 1; side += 2) {
        double way = half - side * place, from = 0.0;
        for (double to = scale; from < way; to *= GROWTH) {
            double end = to * GROWTH > way ? way : to;
            add_panel(rule, place + side * (side > 0 ? from : end),
                      place + side * (side > 0 ? end : from));
            from = end;
        }
    }
}

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

static int thinnest_axis(const double side[3])
{
    int thin = 0;
    for (int d = 1; d < 3; d++)
        thin = side[d] < side[thin] ? d : thin;
    return thin;
}

/* Parity of a component's polynomials along an axis in a class. */
static unsigned parity(int class, int component, int axis)
{
    return ((unsigned)class >> axis ^ (component == axis ? 1U : 0U)) & 1U;
}

/* Whether the class stretches a plate whose normal is `axis`: displacements along it are odd. */
static bool stretches(int class, int axis)
{
    return parity(class, axis, axis) == 1;
}

/* Polynomials along each side. */
static void choose_orders(struct ritz *ritz)
{
    int thin = thinnest_axis(ritz->side);
    double least = ritz->side[thin];
    double wanted[3], shrink = 1.0, longest = 0.0;
    bool flat = true;
    for (int d = 0; d < 3; d++) {
        wanted[d] = LEAST + MORE * ritz->side[d] / least;
        longest = fmax(longest, wanted[d]);
        flat = flat && (d == thin || least < THIN * ritz->side[d]);
    }
    double across = longest <= 2.0 * ACROSS ? COMPACT : flat ? ACROSS_THIN : ACROSS;
    for (int d = 0; d < 3; d++)
        if (ritz->side[d] < 2.0 * least)
            wanted[d] = fmin(wanted[d], across);
    /* no more than can be afforded */
    double of_class = (ritz->round ? 0.5 : 1.0) * 3.0 / 8.0 * wanted[0] * wanted[1] * wanted[2];
    if (of_class > MOST_OF_CLASS) {
        int longs = 0;
        for (int d = 0; d < 3; d++)
            longs += wanted[d] > 2.0 * ACROSS;
        shrink = longs > 0 ? pow(MOST_OF_CLASS / of_class, 1.0 / longs) : 1.0;
    }
    for (int d = 0; d < 3; d++) {
        if (wanted[d] > 2.0 * ACROSS)
            wanted[d] = fmax(wanted[d] * shrink, 2.0 * ACROSS);
        ritz->orders[d] =
            (size_t)fmin(ceil(wanted[d]), ritz->round && d > 0 ? POLYNOMIAL_MOST : MOST_ORDERS);
    }
}

/* Whether a product of polynomials is taken: of long sides those within an ellipse. */
static bool is_taken(const struct ritz *ritz, const double share, const unsigned order[3])
{
    double sum = 0.0;
    for (int d = 0; d < 3; d++) {
        if (order[d] >= ritz->orders[d])
            return false;
        if (ritz->round && d > 0)
            continue;
        if (ritz->orders[d] <= 2 * ACROSS)
            continue;
        double part = order[d] / (share * (double)ritz->orders[d]);
        sum += part * part;
    }
    return sum < 1.0 && (!ritz->round || order[1] + order[2] < ritz->orders[1]);
}

static bool list_orders(struct ritz *ritz, int number)
{
    struct ritz_class *class = &ritz->class[number];
    const size_t *n = ritz->orders;
    size_t room = 3 * (n[0] + 1) * (n[1] + 1) * (n[2] + 1) / 4;
    int thin = thinnest_axis(ritz->side);
    bool plate = true;
    for (int d = 0; d < 3; d++)
        plate = plate && (d == thin || ritz->orders[d] > 2 * ACROSS);
    double share = plate && stretches(number, thin) ? STRETCHED : 1.0;
    class->order = calloc(room, sizeof *class->order);
    for (int c = 0; class->order && c < 3; c++) {
        class->begin[c] = class->count;
        for (unsigned p = parity(number, c, 0); p < n[0]; p += 2)
            for (unsigned q = parity(number, c, 1); q < n[1]; q += 2)
                for (unsigned r = parity(number, c, 2); r < n[2]; r += 2) {
                    const unsigned order[3] = {p, q, r};
                    if (!is_taken(ritz, share, order))
                        continue;
                    for (int d = 0; d < 3; d++)
                        class->order[class->count][d] = (unsigned char)order[d];
                    class->count++;
                }
    }
    class->begin[3] = class->count;
    return class->order != NULL;
}

/* Mean over [-1, 1] of P'_i P_j of normalised polynomials: 0 unless j < i and i - j is odd. */
static double slope_mean(unsigned i, unsigned j)
{
    return j < i && (i - j) % 2 == 1 ? sqrt((2.0 * i + 1.0) * (2.0 * j + 1.0)) : 0.0;
}

/* And of P'_i P'_j. */
static double slopes_mean(unsigned i, unsigned j)
{
    unsigned m = i < j ? i : j;
    return (i - j) % 2 == 0 ? 0.5 * sqrt((2.0 * i + 1.0) * (2.0 * j + 1.0)) * m * (m + 1.0) : 0.0;
}

/* Means over a circle of radius 1 of Zernike's and their derivatives: [i][j] by pairs, see
 * section_mean. */
enum { Y_NONE, Z_NONE, Y_Y, Z_Z, Y_Z, SECTION_MEANS };

static size_t section_index(const unsigned char order[3])
{
    return (size_t)order[1] * POLYNOMIAL_MOST + order[2];
}

/* Of the derivative of one along c (0: none) and of the other along d. */
static double section_mean(const struct ritz *ritz, const unsigned char a[3], int c,
                           const unsigned char b[3], int d)
{
    size_t i = ritz->place[section_index(a)], j = ritz->place[section_index(b)];
    if (c == 0 && d == 0)
        return i == j ? 1.0 : 0.0;
    double scale = 2.0 / ritz->side[1];
    if (c == 0 || (c == 2 && d == 1)) { /* the other way round */
        size_t k = i;
        int e = c;
        i = j;
        j = k;
        c = d;
        d = e;
    }
    int which = d == 0 ? (c == 1 ? Y_NONE : Z_NONE) : c != d ? Y_Z : c == 1 ? Y_Y : Z_Z;
    double mean = ritz->means[which][j * ritz->places + i];
    return mean * (d == 0 ? scale : scale * scale);
}

/* Values and derivatives along y and z at the points of a rule, times the root of its weight:
 * [3][places][points]. */
static void fill_rows(const struct ritz *ritz, size_t radii, size_t angles, double *rows)
{
    size_t n = ritz->orders[1], count = 0, points = radii * angles;
    double x[POLYNOMIAL_MOST + 2], weight[POLYNOMIAL_MOST + 2];
    double table[3][POLYNOMIAL_MOST * POLYNOMIAL_MOST];
    polynomial_gauss(radii, x, weight);
    for (size_t i = 0; i < radii; i++)
        for (size_t j = 0; j < angles; j++, count++) {
            double angle = 2.0 * M_PI * ((double)j + 0.5) / (double)angles;
            double root = sqrt(2.0 * x[i] * weight[i] / (double)angles);
            polynomial_zernike(n, x[i] * cos(angle), x[i] * sin(angle), table[0], table[1],
                               table[2]);
            for (size_t q = 0; q < n; q++)
                for (size_t r = 0; q + r < n; r++)
                    for (size_t d = 0; d < 3; d++) {
                        size_t at = q * POLYNOMIAL_MOST + r;
                        rows[(d * ritz->places + ritz->place[at]) * points + count] =
                            root * table[d][at];
                    }
        }
}

/* By Gauss' rule in the radius and equal angles, which are exact. False: out of memory. */
static bool make_section(struct ritz *ritz)
{
    static const size_t FIRST[SECTION_MEANS] = {1, 2, 1, 2, 1};
    static const size_t SECOND[SECTION_MEANS] = {0, 0, 1, 2, 2};
    size_t n = ritz->orders[1], angles = 2 * n + 2, radii = n + 2;
    ritz->place = calloc(POLYNOMIAL_MOST * POLYNOMIAL_MOST, sizeof *ritz->place);
    for (size_t q = 0; ritz->place && q < n; q++)
        for (size_t r = 0; q + r < n; r++)
            ritz->place[q * POLYNOMIAL_MOST + r] = ritz->places++;
    size_t all = radii * angles * ritz->places;
    double *rows = calloc(3 * all + 1, sizeof *rows);
    bool good = ritz->place && rows;
    if (good)
        fill_rows(ritz, radii, angles, rows);
    for (int k = 0; good && k < SECTION_MEANS; k++) {
        const struct dense a = {radii * angles, ritz->places, rows + FIRST[k] * all};
        const struct dense b = {radii * angles, ritz->places, rows + SECOND[k] * all};
        ritz->means[k] = calloc(ritz->places * ritz->places, sizeof **ritz->means);
        good = ritz->means[k] != NULL;
        if (good)
            dense_products(a, b, ritz->means[k]);
    }
    free(rows);
    return good;
}

/* Mean over the body of the derivative of one product along axis c and of the other along d. */
static double mean_of(const struct ritz *ritz, const unsigned char a[3], int c,
                      const unsigned char b[3], int d)
{
    double product = 1.0;
    for (int e = 0; e < (ritz->round ? 1 : 3) && product != 0.0; e++) {
        double scale = 2.0 / ritz->side[e];
        if (e == c && e == d)
            product *= scale * scale * slopes_mean(a[e], b[e]);
        else if (e == c)
            product *= scale * slope_mean(a[e], b[e]);
        else if (e == d)
            product *= scale * slope_mean(b[e], a[e]);
        else
            product *= a[e] == b[e] ? 1.0 : 0.0;
    }
    return ritz->round && product != 0.0 ? product * section_mean(ritz, a, c, b, d) : product;
}

static int component_of(const struct ritz_class *class, size_t i)
{
    return i < class->begin[1] ? 0 : i < class->begin[2] ? 1 : 2;
}

/* Lower triangle, by columns. */
static void fill_stiffness(const struct ritz *ritz, const struct ritz_class *class, double *k)
{
    double poisson = ritz->poisson;
    double lambda = poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    double mu = 0.5 / (1.0 + poisson);
    size_t n = class->count;
    for (size_t j = 0; j < n; j++) {
        int d = component_of(class, j);
        for (size_t i = j; i < n; i++) {
            int c = component_of(class, i);
            const unsigned char *a = class->order[i], *b = class->order[j];
            double sum = lambda * mean_of(ritz, a, c, b, d) + mu * mean_of(ritz, a, d, b, c);
            for (int e = 0; c == d && e < 3; e++)
                sum += mu * mean_of(ritz, a, e, b, e);
            k[j * n + i] = sum;
        }
    }
}

/* The coordinate of a component's polynomial of degree one along `axis` (-1: of none). */
static size_t find_order(const struct ritz_class *class, int component, int axis)
{
    for (size_t i = class->begin[component]; i < class->begin[component + 1]; i++) {
        const unsigned char *order = class->order[i];
        bool same = true;
        for (int d = 0; d < 3; d++)
            same = same && order[d] == (d == axis ? 1 : 0);
        if (same)
            return i;
    }
    return class->count;
}

static bool add_rigid(struct ritz_class *class, size_t i, double one, size_t j, double other)
{
    double *vector = calloc(class->count, sizeof *vector);
    double norm = hypot(one, other);
    if (!vector)
        return false;
    vector[i] = one / norm;
    if (j < class->count)
        vector[j] = other / norm;
    class->rigid[class->rigids++] = vector;
    return true;
}

/* A coordinate over the polynomial of degree one, of all alike but for a factor: sqrt(12) of a
 * side, 4 of a diameter. */
static double spread(const struct ritz *ritz, int axis)
{
    return ritz->side[axis] * (ritz->round && axis > 0 ? sqrt(0.75) : 1.0);
}

/* Translations, and rotations u_b = -x_c, u_c = x_b. */
static bool find_rigids(const struct ritz *ritz, struct ritz_class *class)
{
    bool good = true;
    for (int axis = 0; good && axis < 3; axis++) {
        int b = (axis + 1) % 3, c = (axis + 2) % 3;
        size_t along = find_order(class, axis, -1);
        size_t i = find_order(class, b, c), j = find_order(class, c, b);
        if (along < class->count)
            good = add_rigid(class, along, 1.0, class->count, 0.0);
        if (good && i < class->count && j < class->count)
            good = add_rigid(class, i, -spread(ritz, c), j, spread(ritz, b));
    }
    return good;
}

/* Up to the frequency whose slowest waves the polynomials resolve: 1/omega^2 = 1/(bending k^2)^2 +
 * 1/(c_R k)^2 of waves along each side, c_R being Rayleigh's speed,
 * whose formula ends below poisson -0.4 where it is 0.69 of the shear wave's at least. */
static double highest(const struct ritz *ritz)
{
    double shear = sqrt(0.5 / (1.0 + ritz->poisson));
    double surface = shear * fmax((0.87 + 1.12 * ritz->poisson) / (1.0 + ritz->poisson), 0.69);
    double least = INFINITY, thickness = ritz->side[thinnest_axis(ritz->side)];
    double bending = thickness / sqrt(12.0 * (1.0 - ritz->poisson * ritz->poisson));
    for (int d = 0; d < 3; d++) {
        double k = 2.0 * ((double)ritz->orders[d] - SPARE) / ritz->side[d];
        double slow = 1.0 / (bending * k * k), quick = 1.0 / (surface * k);
        least = fmin(least, 1.0 / hypot(slow, quick));
    }
    return least;
}

/* The lower triangle with the rigid motions held, which leaves what they are not as it is. */
static void hold_rigids(const struct ritz_class *class, const double *k, double *held)
{
    size_t n = class->count;
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
    size_t n = class->count, found = SIZE_MAX;
    double *k = calloc(n * n, sizeof *k);
    double *vectors = calloc(n * n, sizeof *vectors);
    class->omega = calloc(n, sizeof *class->omega);
    class->factor = calloc(n * (n + 1) / 2, sizeof *class->factor);
    if (k && vectors && class->omega && class->factor && find_rigids(ritz, class)) {
        fill_stiffness(ritz, class, k);
        hold_rigids(class, k, class->factor);
        /* above the rigid motions' rounding, below the lowest bending */
        double bottom = 0.5 * ritz->side[thinnest_axis(ritz->side)];
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

/* All classes' modes by their frequencies; equal ones in the order of classes. */
static bool merge(struct ritz *ritz)
{
    size_t next[CLASSES] = {0}, all = 0;
    for (int c = 0; c < CLASSES; c++)
        all += ritz->class[c].modes;
    ritz->omega = calloc(all + 1, sizeof *ritz->omega);
    ritz->mode = calloc(all + 1, sizeof *ritz->mode);
    if (!ritz->omega || !ritz->mode)
        return false;
    for (ritz->count = 0; ritz->count < all; ritz->count++) {
        int lowest = -1;
        double omega = INFINITY;
        for (int c = 0; c < CLASSES; c++)
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

struct ritz *ritz_create(const struct ritz_shape *shape, double poisson, struct pace *pace)
{
    struct ritz *ritz = calloc(1, sizeof *ritz);
    const double *side = shape->side;
    double longest = fmax(side[0], fmax(side[1], side[2]));
    if (!ritz)
        return NULL;
    ritz->round = shape->round;
    ritz->poisson = poisson;
    ritz->mass = shape->round ? 0.25 * M_PI : 1.0;
    for (int d = 0; d < 3; d++) {
        ritz->side[d] = side[d] / longest;
        ritz->mass *= ritz->side[d];
    }
    choose_orders(ritz);
    bool good = !ritz->round || make_section(ritz);
    for (int c = 0; good && c < CLASSES; c++)
        good = pace_ask(pace, 0.0) && list_orders(ritz, c) &&
               solve_class(ritz, &ritz->class[c], highest(ritz));
    for (int k = 0; k < SECTION_MEANS; k++) {
        free(ritz->means[k]);
        ritz->means[k] = NULL;
    }
    if (good && merge(ritz))
        return ritz;
    ritz_free(ritz);
    return NULL;
}

size_t ritz_size(const struct ritz *ritz)
{
    size_t numbers = 0;
    for (int c = 0; c < CLASSES; c++) {
        size_t n = ritz->class[c].count;
        numbers += n * (n + 1) / 2 + n * ritz->class[c].modes;
    }
    return numbers * sizeof(double);
}

void ritz_free(struct ritz *ritz)
{
    for (int c = 0; ritz && c < CLASSES; c++) {
        struct ritz_class *class = &ritz->class[c];
        for (size_t r = 0; r < class->rigids; r++)
            free(class->rigid[r]);
        free(class->order);
        free(class->factor);
        free(class->omega);
        free(class->vectors);
    }
    if (ritz) {
        for (int k = 0; k < SECTION_MEANS; k++)
            free(ritz->means[k]);
        free(ritz->place);
        free(ritz->omega);
        free(ritz->mode);
    }
    free(ritz);
}

/* All polynomials at a point: along the axes, and those of a circle. */
struct functions {
    double along[3][MOST_ORDERS];
    double section[POLYNOMIAL_MOST * POLYNOMIAL_MOST];
};

static void fill_point(const struct ritz *ritz, const double point[3], struct functions *at)
{
    for (int d = 0; d < (ritz->round ? 1 : 3); d++)
        polynomial_legendre(ritz->orders[d], 2.0 * point[d] / ritz->side[d], at->along[d]);
    if (ritz->round)
        polynomial_zernike(ritz->orders[1], 2.0 * point[1] / ritz->side[1],
                           2.0 * point[2] / ritz->side[2], at->section, NULL, NULL);
}

/* A class' coordinates there, along a direction. */
static void fill_functions(const struct ritz *ritz, const struct ritz_class *class,
                           const struct functions *at, const double direction[3], double *functions)
{
    double scale = 1.0 / sqrt(ritz->mass);
    for (size_t i = 0; i < class->count; i++) {
        const unsigned char *order = class->order[i];
        double across = ritz->round ? at->section[section_index(order)]
                                    : at->along[1][order[1]] * at->along[2][order[2]];
        functions[i] = scale * direction[component_of(class, i)] * at->along[0][order[0]] * across;
    }
}

void ritz_shapes(const struct ritz *ritz, const double point[3], const double direction[3],
                 size_t first, size_t count, double *row)
{
    enum { LARGEST = 4 * MOST_OF_CLASS };
    double functions[LARGEST];
    struct functions at;
    fill_point(ritz, point, &at);
    for (int c = 0; c < CLASSES; c++) {
        const struct ritz_class *class = &ritz->class[c];
        bool filled = false;
        for (size_t k = 0; k < count; k++) {
            const struct ritz_mode *mode = &ritz->mode[first + k];
            if (mode->class != c)
                continue;
            if (!filled)
                fill_functions(ritz, class, &at, direction, functions);
            filled = true;
            const double *vector = class->vectors + mode->number * class->count;
            double sum = 0.0;
            for (size_t i = 0; i < class->count; i++)
                sum += vector[i] * functions[i];
            row[k] = sum;
        }
    }
}

/* A unit force along the inward normal of a face, and what is summed up over the other five. */
struct push {
    const struct ritz *ritz;
    int axis, side; /* the face */
    struct boussinesq3 load;
    bool inside;      /* of the cut: what is summed up is not the surface */
    double surface;   /* of the half-space's traction times its displacement */
    double motion[3]; /* of the half-space's field times the density, along the outward normal and
                       * in the two rotations that the force takes part in */
    double *force;    /* [component][order along x][y][z]: minus its traction on the products */
};

/* A field in equilibrium with minus the inertia of a rigid motion that leaves the loaded face free
 * and moves the loaded point not: it turns the integral of the half-space's field over the body
 * into ones over the other faces (Betti). Coordinates: x along `other`, z along the outward normal
 * from the middle; other = the axis itself: along the normal. */
static void reciprocal(const struct push *push, int other, const double at[3], double u[3],
                       double stress[6])
{
    const struct ritz *ritz = push->ritz;
    double poisson = ritz->poisson, mu = 0.5 / (1.0 + poisson);
    double lambda = poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), stiff = lambda + 2.0 * mu;
    double top = 0.5 * ritz->side[push->axis], z = push->side * at[push->axis], below = z - top;
    double normal[3] = {0.0}, full[3][3] = {{0.0}};
    int n = push->axis;
    memset(u, 0, 3 * sizeof *u);
    normal[n] = push->side;
    if (other == n) {
        /* u_z'' = -1/stiff */
        double slope = -below / stiff;
        u[n] = -0.5 * below * below / stiff * normal[n];
        for (int i = 0; i < 3; i++)
            full[i][i] = (i == n ? stiff : lambda) * slope;
    } else {
        /* of the rotation (z, -x): u_z = x q(z), u_x = r(z) */
        double x = at[other], kappa = (lambda + mu) / stiff;
        double q = 0.5 * below * below / stiff, slope = below / stiff;
        double turn = -(0.5 * (z * z - top * top) + 0.5 * kappa * below * below) / mu;
        double r =
            -((z * z * z / 3.0 - top * top * z) / 2.0 + kappa * below * below * below / 6.0) / mu;
        u[n] = x * q * normal[n];
        u[other] = r;
        for (int i = 0; i < 3; i++)
            full[i][i] = (i == n ? stiff : lambda) * x * slope;
        full[n][other] = full[other][n] = mu * (q + turn) * normal[n];
    }
    for (int i = 0; i < 3; i++)
        stress[i] = full[i][i];
    stress[3] = full[0][1];
    stress[4] = full[1][2];
    stress[5] = full[2][0];
}

/* What one point of a face adds to the sums: the traction, weighted. */
static void add_point(struct push *push, const double at[3], const double outward[3], double weight,
                      double traction[3])
{
    double u[3], stress[6];
    boussinesq3_field(&push->load, at, u, stress);
    boussinesq3_traction(stress, outward, traction);
    push->surface += push->inside ? 0.0 : weight * dot3(traction, u);
    for (int i = 0; i < 3; i++) {
        double field[3], pulled[3];
        int other = (push->axis + i) % 3;
        reciprocal(push, other, at, field, stress);
        boussinesq3_traction(stress, outward, pulled);
        push->motion[i] += weight * (dot3(traction, field) - dot3(pulled, u));
    }
    scale3(weight, traction, traction);
}

/* One face, its sums with all products. `rows`: [3][MOST_ORDERS] of one line of points. */
static bool add_face(struct push *push, int axis, int side)
{
    const struct ritz *ritz = push->ritz;
    int across = (axis + 1) % 3, along = (axis + 2) % 3;
    const double *half = ritz->side, *place = push->load.point;
    double distance = fabs(0.5 * side * half[axis] - place[axis]);
    size_t n[3] = {ritz->orders[axis], ritz->orders[across], ritz->orders[along]};
    struct rule *rules = calloc(2, sizeof *rules);
    double *products = calloc(3 * MOST_ORDERS * MOST_ORDERS, sizeof *products);
    if (rules && products) {
        make_rule(0.5 * half[across], place[across], distance, &rules[0]);
        make_rule(0.5 * half[along], place[along], distance, &rules[1]);
    }
    double at[3], outward[3] = {0.0}, traction[3], table[MOST_ORDERS];
    outward[axis] = side;
    at[axis] = 0.5 * side * half[axis];
    for (size_t i = 0; rules && products && i < rules[0].count; i++) {
        double line[3][MOST_ORDERS] = {{0.0}};
        at[across] = rules[0].x[i];
        /* along one line, then across */
        for (size_t j = 0; j < rules[1].count; j++) {
            at[along] = rules[1].x[j];
            add_point(push, at, outward, rules[0].weight[i] * rules[1].weight[j], traction);
            polynomial_legendre(n[2], 2.0 * at[along] / half[along], table);
            for (int c = 0; c < 3; c++)
                for (size_t q = 0; q < n[2]; q++)
                    line[c][q] += traction[c] * table[q];
        }
        polynomial_legendre(n[1], 2.0 * at[across] / half[across], table);
        for (int c = 0; c < 3; c++)
            for (size_t p = 0; p < n[1]; p++)
                for (size_t q = 0; q < n[2]; q++)
                    products[(c * MOST_ORDERS + p) * MOST_ORDERS + q] += table[p] * line[c][q];
    }
    /* times those of the face's own place */
    polynomial_legendre(n[0], side, table);
    double scale = -1.0 / sqrt(ritz->mass);
    size_t order[3];
    const size_t *all = ritz->orders;
    for (int c = 0; rules && products && c < 3; c++)
        for (order[0] = 0; order[0] < all[0]; order[0]++)
            for (order[1] = 0; order[1] < all[1]; order[1]++)
                for (order[2] = 0; order[2] < all[2]; order[2]++)
                    push->force[((c * all[0] + order[0]) * all[1] + order[1]) * all[2] +
                                order[2]] +=
                        scale * table[order[axis]] *
                        products[(c * MOST_ORDERS + order[across]) * MOST_ORDERS + order[along]];
    bool good = rules && products;
    free(rules);
    free(products);
    return good;
}

/* A point of a cylinder's surface, with all products. */
static void add_round_point(struct push *push, const double at[3], const double outward[3],
                            double weight)
{
    const struct ritz *ritz = push->ritz;
    const size_t *all = ritz->orders;
    struct functions functions;
    double traction[3], scale = -1.0 / sqrt(ritz->mass);
    add_point(push, at, outward, weight, traction);
    fill_point(ritz, at, &functions);
    for (size_t c = 0; c < 3; c++)
        for (size_t p = 0; p < all[0]; p++) {
            double line = scale * traction[c] * functions.along[0][p];
            for (size_t q = 0; q < all[1]; q++)
                for (size_t r = 0; q + r < all[1]; r++)
                    push->force[((c * all[0] + p) * all[1] + q) * all[2] + r] +=
                        line * functions.section[q * POLYNOMIAL_MOST + r];
        }
}

/* Radii from 0 on, fine for what varies over `scale`, with an end of a panel at `cut`. */
static void make_radii(double most, double scale, double cut, struct rule *rule)
{
    double from = 0.0;
    rule->count = 0;
    if (cut > 0.0 && cut < most) {
        add_panel(rule, 0.0, cut);
        from = cut;
        scale = GROWTH * cut;
    }
    for (double to = fmax(scale, 1e-3 * most); from < most; to *= GROWTH) {
        double end = to * GROWTH > most ? most : to;
        add_panel(rule, from, end);
        from = end;
    }
}

/* The end face at side * length / 2, in polar coordinates about the foot of the load's point. */
static void add_end(struct push *push, int side, struct rule rules[2])
{
    const double *place = push->load.point;
    double radius = 0.5 * push->ritz->side[1], x = 0.5 * side * push->ritz->side[0];
    double own = atan2(place[2], place[1]), square = place[1] * place[1] + place[2] * place[2];
    const double outward[3] = {side, 0.0, 0.0};
    rules[0].count = 0;
    for (int i = 0; i < 8; i++)
        add_panel(&rules[0], own + 0.25 * M_PI * i, own + 0.25 * M_PI * (i + 1));
    for (size_t i = 0; i < rules[0].count; i++) {
        double y = cos(rules[0].x[i]), z = sin(rules[0].x[i]), along = place[1] * y + place[2] * z;
        double most = sqrt(fmax(along * along + radius * radius - square, 0.0)) - along;
        make_radii(most, fabs(x - place[0]), 0.0, &rules[1]);
        for (size_t j = 0; j < rules[1].count; j++) {
            double r = rules[1].x[j];
            const double at[3] = {x, place[1] + r * y, place[2] + r * z};
            add_round_point(push, at, outward, rules[0].weight[i] * rules[1].weight[j] * r);
        }
    }
}

/* The side, of a load on an end. */
static void add_other_side(struct push *push, struct rule rules[2])
{
    const struct ritz *ritz = push->ritz;
    const double *place = push->load.point;
    double radius = 0.5 * ritz->side[1], own = atan2(place[2], place[1]);
    double distance = radius - hypot(place[1], place[2]);
    make_rule(0.5 * ritz->side[0], place[0], distance, &rules[0]);
    make_rule(M_PI, 0.0, distance / radius, &rules[1]);
    for (size_t i = 0; i < rules[0].count; i++)
        for (size_t j = 0; j < rules[1].count; j++) {
            const double outward[3] = {0.0, cos(own + rules[1].x[j]), sin(own + rules[1].x[j])};
            const double at[3] = {rules[0].x[i], radius * outward[1], radius * outward[2]};
            add_round_point(push, at, outward, rules[0].weight[i] * rules[1].weight[j] * radius);
        }
}

/* The side that the load acts on, rolled out, in polar coordinates about its point, which has z =
 * 0: angles between the corners, radii with an end at the cut. */
static void add_own_side(struct push *push, struct rule rules[2])
{
    const struct ritz *ritz = push->ritz;
    double radius = 0.5 * ritz->side[1], half = M_PI * radius, x0 = push->load.point[0];
    double ahead = 0.5 * ritz->side[0] - x0, behind = 0.5 * ritz->side[0] + x0;
    const double corner[9] = {
        0.0,       atan2(half, ahead),         0.5 * M_PI, M_PI - atan2(half, behind),
        M_PI,      M_PI + atan2(half, behind), 1.5 * M_PI, 2.0 * M_PI - atan2(half, ahead),
        2.0 * M_PI};
    double cut = RITZ_CUT * ritz->side[1];
    rules[0].count = 0;
    for (int i = 0; i < 8; i++)
        for (int part = 0; part < 2; part++) {
            double middle = 0.5 * (corner[i] + corner[i + 1]);
            add_panel(&rules[0], part ? middle : corner[i], part ? corner[i + 1] : middle);
        }
    for (size_t i = 0; i < rules[0].count; i++) {
        double x = cos(rules[0].x[i]), s = sin(rules[0].x[i]);
        double most = fmin((x > 0.0 ? ahead : behind) / fabs(x), half / fabs(s));
        make_radii(most, radius, cut, &rules[1]);
        for (size_t j = 0; j < rules[1].count; j++) {
            double r = rules[1].x[j], angle = r * s / radius;
            const double outward[3] = {0.0, cos(angle), sin(angle)};
            const double at[3] = {x0 + r * x, radius * outward[1], radius * outward[2]};
            push->inside = r < cut;
            add_round_point(push, at, outward, rules[0].weight[i] * rules[1].weight[j] * r);
        }
    }
    push->inside = false;
}

/* All but an end's own face. */
static bool add_round(struct push *push, bool on_side)
{
    struct rule *rules = calloc(2, sizeof *rules);
    if (!rules)
        return false;
    for (int side = -1; side <= 1; side += 2)
        if (on_side || side != push->side)
            add_end(push, side, rules);
    if (on_side)
        add_own_side(push, rules);
    else
        add_other_side(push, rules);
    free(rules);
    return true;
}

/* f K^-1 f of a class, without its rigid motions. */
static double energy_of(const struct push *push, const struct ritz_class *class, double *f)
{
    const size_t *all = push->ritz->orders;
    size_t n = class->count;
    double *solved = f + n, sum = 0.0;
    for (size_t i = 0; i < n; i++) {
        const unsigned char *order = class->order[i];
        size_t c = (size_t)component_of(class, i);
        f[i] = push->force[((c * all[0] + order[0]) * all[1] + order[1]) * all[2] + order[2]];
    }
    for (size_t r = 0; r < class->rigids; r++) {
        double part = 0.0;
        for (size_t i = 0; i < n; i++)
            part += class->rigid[r][i] * f[i];
        for (size_t i = 0; i < n; i++)
            f[i] -= part * class->rigid[r][i];
    }
    memcpy(solved, f, n * sizeof *f);
    linear_packed_solve(n, class->factor, solved);
    for (size_t i = 0; i < n; i++)
        sum += f[i] * solved[i];
    return sum;
}

/* Mean square of a coordinate. */
static double mean_square(const struct ritz *ritz, int axis)
{
    return ritz->side[axis] * ritz->side[axis] / (ritz->round && axis > 0 ? 16.0 : 12.0);
}

/* Where and how the load acts; of a cylinder's side turned to z = 0. */
static void place_load(struct push *push, int axis, const double point[3])
{
    const struct ritz *ritz = push->ritz;
    push->load = (struct boussinesq3){.young = 1.0, .poisson = ritz->poisson, .reach = INFINITY};
    push->load.inward[push->axis] = -push->side;
    double *at = push->load.point;
    memcpy(at, point, sizeof push->load.point);
    at[push->axis] = 0.5 * push->side * ritz->side[push->axis];
    if (axis == RITZ_ROUND)
        at[2] = 0.0;
    /* a rim is as good as the edge */
    double off = hypot(at[1], at[2]), most = 0.5 * ritz->side[1];
    if (ritz->round && axis == 0 && off > most) {
        at[1] *= most / off;
        at[2] *= most / off;
    }
}

/* As of meshes: f_d K^-1 f_d - (t_B, u_B) - 2 p gamma of the rigid motions. */
double ritz_flexibility(const struct ritz *ritz, int axis, int side, const double point[3])
{
    const size_t *n = ritz->orders;
    bool on_side = axis == RITZ_ROUND;
    struct push push = {.ritz = ritz, .axis = on_side ? 1 : axis, .side = on_side ? 1 : side};
    place_load(&push, axis, point);
    /* the other faces */
    push.force = calloc(3 * n[0] * n[1] * n[2], sizeof *push.force);
    bool good = push.force != NULL;
    for (int face = 0; good && !ritz->round && face < 6; face++)
        if (face / 2 != axis || (face % 2 ? 1 : -1) != side)
            good = add_face(&push, face / 2, face % 2 ? 1 : -1);
    if (good && ritz->round)
        good = add_round(&push, on_side);
    /* rigid motions: the force is -1 along the outward normal z, x along it in the rotation */
    double sum = -push.surface + 2.0 * push.motion[0] / ritz->mass;
    for (int i = 1; i < 3; i++) {
        int other = (push.axis + i) % 3;
        double inertia = ritz->mass * (mean_square(ritz, other) + mean_square(ritz, push.axis));
        sum -= 2.0 * push.load.point[other] * push.motion[i] / inertia;
    }
    /* and the elastic ones */
    size_t largest = 0;
    for (int c = 0; c < CLASSES; c++)
        largest = ritz->class[c].count > largest ? ritz->class[c].count : largest;
    double *f = calloc(2 * largest + 1, sizeof *f);
    for (int c = 0; good && f && c < CLASSES; c++)
        sum += energy_of(&push, &ritz->class[c], f);
    good = good && f;
    free(push.force);
    free(f);
    return good ? sum : NAN;
}

/* (1 + nu)(1 - 2 nu)^2/(2 pi) of the mean curvature, 1/(2 R). */
double ritz_slope(const struct ritz *ritz)
{
    double side = 1.0 - 2.0 * ritz->poisson;
    return (1.0 + ritz->poisson) * side * side / (2.0 * M_PI * ritz->side[1]);
}

/* Of a plate hit in its middle the flexibility lacks 0.11 exp(-4 (s - 1))/(E h) with s polynomials
 * for each thickness h along its sides, s = 0.5 ... 2; polynomials are denser near the ends. */
static double lacking(const struct ritz *ritz, int axis, const double point[3], double distance)
{
    static const double ONE = 0.11, FALL = 4.0, MOST = 1.2;
    double least = INFINITY;
    for (int i = 1; i < 3; i++) {
        int d = (axis + i) % 3;
        double x = 2.0 * point[d] / ritz->side[d];
        if (ritz->round && axis == 0)
            x = 2.0 * hypot(point[1], point[2]) / ritz->side[1];
        double spacing = ritz->side[d] * sqrt(fmax(1.0 - x * x, 1e-4)) / (double)ritz->orders[d];
        least = fmin(least, distance / spacing);
    }
    return fmin(ONE * exp(FALL * (1.0 - least)), MOST) / distance;
}

struct ritz_unresolved ritz_unresolved_at(const struct ritz *ritz, int axis, const double point[3])
{
    static const double DOUBT = 0.3;
    int along = axis == RITZ_ROUND ? 1 : axis;
    const double turned[3] = {point[0], 0.5 * ritz->side[1], 0.0};
    const double *at = axis == RITZ_ROUND ? turned : point;
    struct ritz_unresolved unresolved = {lacking(ritz, along, at, ritz->side[along]), 0.0};
    unresolved.doubt = DOUBT * unresolved.lacks;
    for (int i = 1; i < 3; i++) {
        int d = (along + i) % 3;
        double off = ritz->round && axis == 0 ? hypot(point[1], point[2]) : fabs(at[d]);
        double near = fmax(0.5 * ritz->side[d] - off, 1e-3 * ritz->side[d]);
        /* of a circle the rim counts once, of its side the ends */
        if (ritz->round && d == 2)
            continue;
        unresolved.doubt += lacking(ritz, along, at, near);
    }
    return unresolved;
}
