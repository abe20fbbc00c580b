/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/ritz.h"
#include "base/watch.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "model/polynomial.h"
#include "model/ritz_parts.h"
#include "numeric/dense.h"
#include "numeric/linear.h"

/* Thinner boxes would take polynomials of higher degree than are numerically good. */
static const double THINNEST = 1.0 / 200.0;
/* Polynomials along a side: so many and so many more for each thickness in it. Of a plate of 10 the
 * flexibility in its middle is good to 0.002/(E h), of a cube to 2e-5/(E L). */
static const double LEAST = 9.5, MORE = 1.6;
/* Across a thin body, and along the shorter sides of a compact one. */
enum { ACROSS = 6, ACROSS_THIN = 5, COMPACT = 11 };
static const double THIN = 0.12;
/* Where faces are held: so few along a long side, and of the most of a class so much, more where
 * both parities of x stand in one. */
static const double LEAST_HELD = 9.0, MOST_HELD = 0.85, MOST_MIXED = 1.5;
/* In classes of plates that stretch, which have longer waves. */
static const double STRETCHED = 0.7;
/* Polynomials beyond pi for each wave, until frequencies are good to 1e-3. */
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

/* Faces that are held. */
static size_t holds(const struct ritz *ritz)
{
    return (size_t)ritz->held[0] + (size_t)ritz->held[1];
}

/* About how many coordinates a class has. */
static double class_size(const struct ritz *ritz)
{
    double product = ritz->mixed ? 3.0 / 4.0 : 3.0 / 8.0;
    int longs = 0;
    for (int d = 0; d < 3; d++) {
        product *= (double)ritz->orders[d];
        longs += ritz->orders[d] > 2 * ACROSS;
    }
    return longs == 2 ? M_PI_4 * product : product;
}

/* Of a held box, which keeps the factors of a free one besides: of long sides a few more are taken
 * off, of the longest first. */
static void save_orders(struct ritz *ritz)
{
    size_t *n = ritz->orders;
    double most = (ritz->mixed ? MOST_MIXED : MOST_HELD) * RITZ_MOST_OF_CLASS;
    while (class_size(ritz) > most) {
        int longest = 0;
        for (int d = 1; d < 3; d++)
            longest = n[d] > n[longest] ? d : longest;
        n[longest]--;
    }
}

/* Polynomials along each side, which vanish on held faces. */
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
    if (ritz->mixed)
        of_class *= M_SQRT2;
    if (of_class > RITZ_MOST_OF_CLASS) {
        int longs = 0;
        for (int d = 0; d < 3; d++)
            longs += wanted[d] > 2.0 * ACROSS;
        shrink = longs > 0 ? pow(RITZ_MOST_OF_CLASS / of_class, 1.0 / longs) : 1.0;
    }
    for (int d = 0; d < 3; d++) {
        if (wanted[d] > 2.0 * ACROSS)
            wanted[d] = fmax(wanted[d] * shrink, holds(ritz) ? LEAST_HELD : 2.0 * ACROSS);
        ritz->orders[d] = (size_t)fmin(
            ceil(wanted[d]), ritz->round && d > 0 ? POLYNOMIAL_MOST : RITZ_MOST_ORDERS - 2);
    }
    if (holds(ritz))
        save_orders(ritz);
}

/* Whether a product of polynomials is taken: of long sides those within an ellipse. */
static bool is_taken(const struct ritz *ritz, const double share, const unsigned order[3])
{
    double sum = 0.0;
    for (int d = 0; d < 3; d++) {
        size_t lifted = d == 0 ? ritz->lifted : 0, orders = ritz->orders[d] - lifted;
        if (order[d] >= ritz->orders[d])
            return false;
        if (ritz->round && d > 0)
            continue;
        if (orders <= 2 * ACROSS)
            continue;
        double part = order[d] > lifted ? (double)(order[d] - lifted) : 0.0;
        part /= share * (double)orders;
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
    bool plate = !(ritz->mixed && thin == 0), all = ritz->mixed && holds(ritz) == 1;
    for (int d = 0; d < 3; d++)
        plate = plate && (d == thin || n[d] - (d == 0 ? ritz->lifted : 0) > 2 * ACROSS);
    double share = plate && stretches(number, thin) ? STRETCHED : 1.0;
    /* where one face is held both parities of x stand in the classes of the even one */
    if (all && (number & 1))
        return true;
    if (all)
        room *= 2;
    class->order = calloc(room, sizeof *class->order);
    for (int c = 0; class->order && c < 3; c++) {
        class->begin[c] = class->count;
        for (unsigned p = all ? 0 : parity(number, c, 0); p < n[0]; p += all ? 1 : 2)
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

/* The means along x of polynomials that vanish on held faces, by Gauss' rule, which is exact:
 * line[0] of a derivative [i] and the other [j], line[1] of two. False: out of memory. */
static bool make_lines(struct ritz *ritz)
{
    enum { POINTS = RITZ_MOST_ORDERS + 2 };
    double x[POINTS], weight[POINTS], value[RITZ_MOST_ORDERS], slope[RITZ_MOST_ORDERS];
    size_t n = ritz->orders[0], points = n + 2;
    for (int k = 0; k < 2; k++)
        ritz->line[k] = calloc(RITZ_MOST_ORDERS * RITZ_MOST_ORDERS, sizeof **ritz->line);
    if (!ritz->line[0] || !ritz->line[1])
        return false;
    polynomial_gauss(points, x, weight);
    for (size_t k = 0; k < points; k++) {
        polynomial_held(n, ritz->held, 2.0 * x[k] - 1.0, value, slope);
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++) {
                ritz->line[0][i * RITZ_MOST_ORDERS + j] += weight[k] * slope[i] * value[j];
                ritz->line[1][i * RITZ_MOST_ORDERS + j] += weight[k] * slope[i] * slope[j];
            }
    }
    return true;
}

/* Along an axis, over half its side: of a derivative and the other, and of two. */
static double mean_slope(const struct ritz *ritz, int axis, unsigned i, unsigned j)
{
    bool held = axis == 0 && ritz->line[0];
    return held ? ritz->line[0][i * RITZ_MOST_ORDERS + j] : slope_mean(i, j);
}

static double mean_slopes(const struct ritz *ritz, int axis, unsigned i, unsigned j)
{
    bool held = axis == 0 && ritz->line[1];
    return held ? ritz->line[1][i * RITZ_MOST_ORDERS + j] : slopes_mean(i, j);
}

/* Mean over the body of the derivative of one product along axis c and of the other along d. */
static double mean_of(const struct ritz *ritz, const unsigned char a[3], int c,
                      const unsigned char b[3], int d)
{
    double product = 1.0;
    for (int e = 0; e < (ritz->round ? 1 : 3) && product != 0.0; e++) {
        double scale = 2.0 / ritz->side[e];
        if (e == c && e == d)
            product *= scale * scale * mean_slopes(ritz, e, a[e], b[e]);
        else if (e == c)
            product *= scale * mean_slope(ritz, e, a[e], b[e]);
        else if (e == d)
            product *= scale * mean_slope(ritz, e, b[e], a[e]);
        else
            product *= a[e] == b[e] ? 1.0 : 0.0;
    }
    return ritz->round && product != 0.0 ? product * section_mean(ritz, a, c, b, d) : product;
}

int ritz_component(const struct ritz_class *class, size_t i)
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
        int d = ritz_component(class, j);
        for (size_t i = j; i < n; i++) {
            int c = ritz_component(class, i);
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
    for (int axis = 0; good && axis < 3 && holds(ritz) == 0; axis++) {
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
static double find_highest(const struct ritz *ritz)
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
    if (n == 0)
        return true;
    double *k = calloc(n * n, sizeof *k);
    double *vectors = calloc(n * n, sizeof *vectors);
    class->omega = calloc(n, sizeof *class->omega);
    class->factor = calloc(n * (n + 1) / 2, sizeof *class->factor);
    if (k && vectors && class->omega && class->factor && find_rigids(ritz, class)) {
        fill_stiffness(ritz, class, k);
        hold_rigids(class, k, class->factor);
        /* above the rigid motions' rounding, below the lowest bending */
        double bottom = holds(ritz) ? 0.0 : 0.5 * ritz->side[thinnest_axis(ritz->side)];
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

/* Its polynomials are chosen, and the frequency up to which modes are wanted. */
static bool solve(struct ritz *ritz, struct pace *pace)
{
    bool good = !ritz->round || make_section(ritz);
    if (holds(ritz))
        good = make_lines(ritz);
    for (int c = 0; good && c < RITZ_CLASSES; c++)
        good = pace_ask(pace, 0.0) && list_orders(ritz, c) &&
               solve_class(ritz, &ritz->class[c], ritz -> highest);
    for (int k = 0; k < SECTION_MEANS; k++) {
        free(ritz->means[k]);
        ritz->means[k] = NULL;
    }
    for (int k = 0; k < 2; k++) {
        free(ritz->line[k]);
        ritz->line[k] = NULL;
    }
    return good && merge(ritz);
}

/* The free box beside a held one: the held one's polynomials are those of its that vanish on the
 * held faces. Without modes. */
static bool make_free(struct ritz *ritz, struct pace *pace)
{
    struct ritz *made = calloc(1, sizeof *made);
    if (!made)
        return false;
    ritz->free = made;
    made->poisson = ritz->poisson;
    made->mass = ritz->mass;
    made->mixed = ritz->mixed;
    made->lifted = holds(ritz);
    memcpy(made->side, ritz->side, sizeof made->side);
    memcpy(made->orders, ritz->orders, sizeof made->orders);
    made->orders[0] += made->lifted;
    return solve(made, pace);
}

struct ritz *ritz_create(const struct ritz_shape *shape, double poisson, struct pace *pace)
{
    struct ritz *ritz = calloc(1, sizeof *ritz);
    const double *side = shape->side;
    double longest = fmax(side[0], fmax(side[1], side[2]));
    if (!ritz)
        return NULL;
    ritz->round = shape->round;
    memcpy(ritz->held, shape->held, sizeof ritz->held);
    ritz->mixed = holds(ritz) == 1;
    ritz->poisson = poisson;
    ritz->mass = shape->round ? 0.25 * M_PI : 1.0;
    for (int d = 0; d < 3; d++) {
        ritz->side[d] = side[d] / longest;
        ritz->mass *= ritz->side[d];
    }
    choose_orders(ritz);
    ritz->highest = find_highest(ritz);
    if (solve(ritz, pace) && (holds(ritz) == 0 || make_free(ritz, pace)))
        return ritz;
    ritz_free(ritz);
    return NULL;
}

size_t ritz_size(const struct ritz *ritz)
{
    size_t numbers = 0;
    for (int c = 0; c < RITZ_CLASSES; c++) {
        size_t n = ritz->class[c].count;
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
        free(class->order);
        free(class->factor);
        free(class->omega);
        free(class->vectors);
    }
    if (ritz) {
        ritz_free(ritz->free);
        for (int k = 0; k < SECTION_MEANS; k++)
            free(ritz->means[k]);
        for (int k = 0; k < 2; k++)
            free(ritz->line[k]);
        free(ritz->place);
        free(ritz->omega);
        free(ritz->mode);
    }
    free(ritz);
}

void ritz_functions_fill(const struct ritz *ritz, const double point[3], struct ritz_functions *at)
{
    for (int d = 0; d < (ritz->round ? 1 : 3); d++)
        if (d == 0 && holds(ritz))
            polynomial_held(ritz->orders[0], ritz->held, 2.0 * point[0] / ritz->side[0],
                            at->along[0], NULL);
        else
            polynomial_legendre(ritz->orders[d], 2.0 * point[d] / ritz->side[d], at->along[d]);
    if (ritz->round)
        polynomial_zernike(ritz->orders[1], 2.0 * point[1] / ritz->side[1],
                           2.0 * point[2] / ritz->side[2], at->section, NULL, NULL);
}

/* A class' coordinates there, along a direction. */
void ritz_functions_of_class(const struct ritz *ritz, const struct ritz_class *class,
                             const struct ritz_functions *at, const double direction[3],
                             double *functions)
{
    double scale = 1.0 / sqrt(ritz->mass);
    for (size_t i = 0; i < class->count; i++) {
        const unsigned char *order = class->order[i];
        double across = ritz->round ? at->section[section_index(order)]
                                    : at->along[1][order[1]] * at->along[2][order[2]];
        functions[i] =
            scale * direction[ritz_component(class, i)] * at->along[0][order[0]] * across;
    }
}

void ritz_shapes(const struct ritz *ritz, const double point[3], const double direction[3],
                 size_t first, size_t count, double *row)
{
    enum { LARGEST = 4 * RITZ_MOST_OF_CLASS };
    double functions[LARGEST];
    struct ritz_functions at;
    ritz_functions_fill(ritz, point, &at);
    for (int c = 0; c < RITZ_CLASSES; c++) {
        const struct ritz_class *class = &ritz->class[c];
        bool filled = false;
        for (size_t k = 0; k < count; k++) {
            const struct ritz_mode *mode = &ritz->mode[first + k];
            if (mode->class != c)
                continue;
            if (!filled)
                ritz_functions_of_class(ritz, class, &at, direction, functions);
            filled = true;
            const double *vector = class->vectors + mode->number * class->count;
            double sum = 0.0;
            for (size_t i = 0; i < class->count; i++)
                sum += vector[i] * functions[i];
            row[k] = sum;
        }
    }
}
