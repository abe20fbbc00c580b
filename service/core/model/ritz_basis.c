/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/ritz_basis.h"

#include <math.h>
#include <stdlib.h>

#include "numeric/dense.h"

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

/* Products of polynomials. */

/* Polynomials along a side: LEAST, and MORE for each thickness in it. The flexibility in the middle
 * of a plate of 10 thicknesses is good to 0.002/(E h), of a cube to 2e-5/(E L). */
static const double LEAST = 9.5, MORE = 1.6;
/* Across a thin body, and along the shorter sides of a compact one. */
enum { ACROSS = 6, ACROSS_THIN = 5, COMPACT = 11 };
static const double THIN = 0.12;
/* Where faces are held: the least number along a long side, and the largest class over
 * RITZ_MOST_OF_CLASS; MOST_MIXED where a class has both parities of x. */
static const double LEAST_HELD = 9.0, MOST_HELD = 0.85, MOST_MIXED = 1.5;
/* Share of the polynomials in the stretching classes of plates, which have longer waves. */
static const double STRETCHED = 0.7;

int ritz_basis_thinnest(const struct ritz_basis *basis)
{
    int thin = 0;
    for (int d = 1; d < 3; d++)
        thin = basis->side[d] < basis->side[thin] ? d : thin;
    return thin;
}

/* Parity of a component's polynomials along an axis in a class. */
static unsigned parity(int class, int component, int axis)
{
    return ((unsigned)class >> axis ^ (component == axis ? 1U : 0U)) & 1U;
}

/* Whether the class stretches a plate normal to `axis`: displacements along it are odd. */
static bool stretches(int class, int axis)
{
    return parity(class, axis, axis) == 1;
}

size_t ritz_basis_holds(const struct ritz_basis *basis)
{
    return (size_t)basis->held[0] + (size_t)basis->held[1];
}

/* About how many coordinates a class has. */
static double basis_class_size(const struct ritz_basis *basis)
{
    double product = basis->mixed ? 3.0 / 4.0 : 3.0 / 8.0;
    int longs = 0;
    for (int d = 0; d < 3; d++) {
        product *= (double)basis->orders[d];
        longs += basis->orders[d] > 2 * ACROSS;
    }
    return longs == 2 ? M_PI_4 * product : product;
}

/* A held box stores the factors of a free one besides: polynomials are taken off its longest sides.
 */
static void save_orders(struct ritz_basis *basis)
{
    size_t *n = basis->orders;
    double most = (basis->mixed ? MOST_MIXED : MOST_HELD) * RITZ_MOST_OF_CLASS;
    while (basis_class_size(basis) > most) {
        int longest = 0;
        for (int d = 1; d < 3; d++)
            longest = n[d] > n[longest] ? d : longest;
        n[longest]--;
    }
}

/* Polynomials along each side, which vanish on held faces. */
void ritz_basis_choose_orders(struct ritz_basis *basis)
{
    int thin = ritz_basis_thinnest(basis);
    double least = basis->side[thin];
    double wanted[3], shrink = 1.0, longest = 0.0;
    bool flat = true;
    for (int d = 0; d < 3; d++) {
        wanted[d] = LEAST + MORE * basis->side[d] / least;
        longest = fmax(longest, wanted[d]);
        flat = flat && (d == thin || least < THIN * basis->side[d]);
    }
    double across = longest <= 2.0 * ACROSS ? COMPACT : flat ? ACROSS_THIN : ACROSS;
    for (int d = 0; d < 3; d++)
        if (basis->side[d] < 2.0 * least)
            wanted[d] = fmin(wanted[d], across);
    /* at most RITZ_MOST_OF_CLASS */
    double of_class = (basis->round ? 0.5 : 1.0) * 3.0 / 8.0 * wanted[0] * wanted[1] * wanted[2];
    if (basis->mixed)
        of_class *= M_SQRT2;
    if (of_class > RITZ_MOST_OF_CLASS) {
        int longs = 0;
        for (int d = 0; d < 3; d++)
            longs += wanted[d] > 2.0 * ACROSS;
        shrink = longs > 0 ? pow(RITZ_MOST_OF_CLASS / of_class, 1.0 / longs) : 1.0;
    }
    for (int d = 0; d < 3; d++) {
        if (wanted[d] > 2.0 * ACROSS)
            wanted[d] =
                fmax(wanted[d] * shrink, ritz_basis_holds(basis) ? LEAST_HELD : 2.0 * ACROSS);
        basis->orders[d] = (size_t)fmin(
            ceil(wanted[d]), basis->round && d > 0 ? POLYNOMIAL_MOST : RITZ_MOST_ORDERS - 2);
    }
    if (ritz_basis_holds(basis))
        save_orders(basis);
}

/* Whether the basis has a product of polynomials: along long sides those within an ellipse. */
static bool is_taken(const struct ritz_basis *basis, const double share, const unsigned order[3])
{
    double sum = 0.0;
    for (int d = 0; d < 3; d++) {
        size_t lifted = d == 0 ? basis->lifted : 0, orders = basis->orders[d] - lifted;
        if (order[d] >= basis->orders[d])
            return false;
        if (basis->round && d > 0)
            continue;
        if (orders <= 2 * ACROSS)
            continue;
        double part = order[d] > lifted ? (double)(order[d] - lifted) : 0.0;
        part /= share * (double)orders;
        sum += part * part;
    }
    return sum < 1.0 && (!basis->round || order[1] + order[2] < basis->orders[1]);
}

bool ritz_basis_list(const struct ritz_basis *basis, int number, struct ritz_terms *terms)
{
    const size_t *n = basis->orders;
    size_t room = 3 * (n[0] + 1) * (n[1] + 1) * (n[2] + 1) / 4;
    int thin = ritz_basis_thinnest(basis);
    bool plate = !(basis->mixed && thin == 0), all = basis->mixed && ritz_basis_holds(basis) == 1;
    for (int d = 0; d < 3; d++)
        plate = plate && (d == thin || n[d] - (d == 0 ? basis->lifted : 0) > 2 * ACROSS);
    double share = plate && stretches(number, thin) ? STRETCHED : 1.0;
    /* with one face held, the classes of the even parity of x have both parities */
    if (all && (number & 1))
        return true;
    if (all)
        room *= 2;
    terms->order = calloc(room, sizeof *terms->order);
    for (int c = 0; terms->order && c < 3; c++) {
        terms->begin[c] = terms->count;
        for (unsigned p = all ? 0 : parity(number, c, 0); p < n[0]; p += all ? 1 : 2)
            for (unsigned q = parity(number, c, 1); q < n[1]; q += 2)
                for (unsigned r = parity(number, c, 2); r < n[2]; r += 2) {
                    const unsigned order[3] = {p, q, r};
                    if (!is_taken(basis, share, order))
                        continue;
                    for (int d = 0; d < 3; d++)
                        terms->order[terms->count][d] = (unsigned char)order[d];
                    terms->count++;
                }
    }
    terms->begin[3] = terms->count;
    return terms->order != NULL;
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
static double section_mean(const struct ritz_basis *basis, const unsigned char a[3], int c,
                           const unsigned char b[3], int d)
{
    size_t i = basis->place[section_index(a)], j = basis->place[section_index(b)];
    if (c == 0 && d == 0)
        return i == j ? 1.0 : 0.0;
    double scale = 2.0 / basis->side[1];
    if (c == 0 || (c == 2 && d == 1)) { /* the other way round */
        size_t k = i;
        int e = c;
        i = j;
        j = k;
        c = d;
        d = e;
    }
    int which = d == 0 ? (c == 1 ? Y_NONE : Z_NONE) : c != d ? Y_Z : c == 1 ? Y_Y : Z_Z;
    double mean = basis->means[which][j * basis->places + i];
    return mean * (d == 0 ? scale : scale * scale);
}

/* Values and derivatives along y and z at the points of a rule, times the root of its weight:
 * [3][places][points]. */
static void fill_rows(const struct ritz_basis *basis, size_t radii, size_t angles, double *rows)
{
    size_t n = basis->orders[1], count = 0, points = radii * angles;
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
                        rows[(d * basis->places + basis->place[at]) * points + count] =
                            root * table[d][at];
                    }
        }
}

/* By Gauss' rule in the radius and equal angles, which are exact. False: out of memory. */
static bool make_section(struct ritz_basis *basis)
{
    static const size_t FIRST[SECTION_MEANS] = {1, 2, 1, 2, 1};
    static const size_t SECOND[SECTION_MEANS] = {0, 0, 1, 2, 2};
    size_t n = basis->orders[1], angles = 2 * n + 2, radii = n + 2;
    basis->place = calloc(POLYNOMIAL_MOST * POLYNOMIAL_MOST, sizeof *basis->place);
    for (size_t q = 0; basis->place && q < n; q++)
        for (size_t r = 0; q + r < n; r++)
            basis->place[q * POLYNOMIAL_MOST + r] = basis->places++;
    size_t all = radii * angles * basis->places;
    double *rows = calloc(3 * all + 1, sizeof *rows);
    bool good = basis->place && rows;
    if (good)
        fill_rows(basis, radii, angles, rows);
    for (int k = 0; good && k < SECTION_MEANS; k++) {
        const struct dense a = {radii * angles, basis->places, rows + FIRST[k] * all};
        const struct dense b = {radii * angles, basis->places, rows + SECOND[k] * all};
        basis->means[k] = calloc(basis->places * basis->places, sizeof **basis->means);
        good = basis->means[k] != NULL;
        if (good)
            dense_products(a, b, basis->means[k]);
    }
    free(rows);
    return good;
}

/* The means along x of polynomials that vanish on held faces, by Gauss' rule, which is exact:
 * line[0] of a derivative [i] and the other [j], line[1] of two. False: out of memory. */
static bool make_lines(struct ritz_basis *basis)
{
    enum { POINTS = RITZ_MOST_ORDERS + 2 };
    double x[POINTS], weight[POINTS], value[RITZ_MOST_ORDERS], slope[RITZ_MOST_ORDERS];
    size_t n = basis->orders[0], points = n + 2;
    for (int k = 0; k < 2; k++)
        basis->line[k] = calloc(RITZ_MOST_ORDERS * RITZ_MOST_ORDERS, sizeof **basis->line);
    if (!basis->line[0] || !basis->line[1])
        return false;
    polynomial_gauss(points, x, weight);
    for (size_t k = 0; k < points; k++) {
        polynomial_held(n, basis->held, 2.0 * x[k] - 1.0, value, slope);
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++) {
                basis->line[0][i * RITZ_MOST_ORDERS + j] += weight[k] * slope[i] * value[j];
                basis->line[1][i * RITZ_MOST_ORDERS + j] += weight[k] * slope[i] * slope[j];
            }
    }
    return true;
}

bool ritz_basis_prepare(struct ritz_basis *basis)
{
    bool good = !basis->round || make_section(basis);
    return ritz_basis_holds(basis) ? make_lines(basis) : good;
}

void ritz_basis_drop_means(struct ritz_basis *basis)
{
    for (int k = 0; k < SECTION_MEANS; k++) {
        free(basis->means[k]);
        basis->means[k] = NULL;
    }
    for (int k = 0; k < 2; k++) {
        free(basis->line[k]);
        basis->line[k] = NULL;
    }
}

void ritz_basis_clear(struct ritz_basis *basis)
{
    ritz_basis_drop_means(basis);
    free(basis->place);
}

/* Means along an axis, over half its side: of a derivative and a polynomial, and of two
 * derivatives. */
static double mean_slope(const struct ritz_basis *basis, int axis, unsigned i, unsigned j)
{
    bool held = axis == 0 && basis->line[0];
    return held ? basis->line[0][i * RITZ_MOST_ORDERS + j] : slope_mean(i, j);
}

static double mean_slopes(const struct ritz_basis *basis, int axis, unsigned i, unsigned j)
{
    bool held = axis == 0 && basis->line[1];
    return held ? basis->line[1][i * RITZ_MOST_ORDERS + j] : slopes_mean(i, j);
}

/* Mean over the body of the derivative of one product along axis c and of the other along d. */
static double basis_mean(const struct ritz_basis *basis, const unsigned char a[3], int c,
                         const unsigned char b[3], int d)
{
    double product = 1.0;
    for (int e = 0; e < (basis->round ? 1 : 3) && product != 0.0; e++) {
        double scale = 2.0 / basis->side[e];
        if (e == c && e == d)
            product *= scale * scale * mean_slopes(basis, e, a[e], b[e]);
        else if (e == c)
            product *= scale * mean_slope(basis, e, a[e], b[e]);
        else if (e == d)
            product *= scale * mean_slope(basis, e, b[e], a[e]);
        else
            product *= a[e] == b[e] ? 1.0 : 0.0;
    }
    return basis->round && product != 0.0 ? product * section_mean(basis, a, c, b, d) : product;
}

/* Lower triangle, by columns. */
void ritz_basis_stiffness(const struct ritz_basis *basis, const struct ritz_terms *terms,
                          double poisson, double *k)
{
    double lambda = poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    double mu = 0.5 / (1.0 + poisson);
    size_t n = terms->count;
    for (size_t j = 0; j < n; j++) {
        int d = ritz_component(terms, j);
        for (size_t i = j; i < n; i++) {
            int c = ritz_component(terms, i);
            const unsigned char *a = terms->order[i], *b = terms->order[j];
            double sum =
                lambda * basis_mean(basis, a, c, b, d) + mu * basis_mean(basis, a, d, b, c);
            for (int e = 0; c == d && e < 3; e++)
                sum += mu * basis_mean(basis, a, e, b, e);
            k[j * n + i] = sum;
        }
    }
}

void ritz_functions_fill(const struct ritz_basis *basis, const double point[3],
                         struct ritz_functions *at)
{
    for (int d = 0; d < (basis->round ? 1 : 3); d++)
        if (d == 0 && ritz_basis_holds(basis))
            polynomial_held(basis->orders[0], basis->held, 2.0 * point[0] / basis->side[0],
                            at->along[0], NULL);
        else
            polynomial_legendre(basis->orders[d], 2.0 * point[d] / basis->side[d], at->along[d]);
    if (basis->round)
        polynomial_zernike(basis->orders[1], 2.0 * point[1] / basis->side[1],
                           2.0 * point[2] / basis->side[2], at->section, NULL, NULL);
}

void ritz_functions_along(const struct ritz_basis *basis, const struct ritz_terms *terms,
                          const struct ritz_functions *at, const double direction[3],
                          double *functions)
{
    double scale = 1.0 / sqrt(basis->volume);
    for (size_t i = 0; i < terms->count; i++) {
        const unsigned char *order = terms->order[i];
        double across = basis->round ? at->section[section_index(order)]
                                     : at->along[1][order[1]] * at->along[2][order[2]];
        functions[i] =
            scale * direction[ritz_component(terms, i)] * at->along[0][order[0]] * across;
    }
}
