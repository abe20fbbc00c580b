/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/ritz.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "model/boussinesq3.h"
#include "model/vector.h"
#include "numeric/linear.h"

/* Thinner boxes would take polynomials of higher degree than are numerically good. */
static const double THINNEST = 1.0 / 200.0;
/* Polynomials along a side: so many and so many more for each thickness in it. Of a plate of 10 the
 * flexibility in its middle is good to 0.002/(E h), of a cube to 2e-5/(E L). */
static const double LEAST = 7.0, MORE = 1.6;
/* The most of a class, for which those along the longer sides are taken off in proportion. */
enum { CLASSES = 8, MOST_OF_CLASS = 1400, MOST_ORDERS = 64 };
/* Across a thin body, and along the shorter sides of a compact one. */
enum { ACROSS = 6, ACROSS_THIN = 5, COMPACT = 8 };
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
    double asked[3], poisson; /* as asked for */
    double side[3], mass;
    size_t orders[3];
    struct ritz_class class[CLASSES];
    size_t count;
    double *omega; /* [count] */
    struct ritz_mode {
        unsigned char class;
        unsigned number;
    } * mode; /* [count] */
};

/* Legendre's, of mean square 1 over [-1, 1]. */
static void fill_polynomials(size_t count, double x, double *value)
{
    double before = 0.0, now = 1.0;
    for (size_t n = 0; n < count; n++) {
        value[n] = sqrt(2.0 * (double)n + 1.0) * now;
        double next = ((2.0 * (double)n + 1.0) * x * now - (double)n * before) / ((double)n + 1.0);
        before = now;
        now = next;
    }
}

bool ritz_reaches(const double sides[3])
{
    double longest = fmax(sides[0], fmax(sides[1], sides[2]));
    return fmin(sides[0], fmin(sides[1], sides[2])) >= THINNEST * longest;
}

bool ritz_is_of(const struct ritz *ritz, const double sides[3], double poisson)
{
    return ritz->poisson == poisson && memcmp(ritz->asked, sides, sizeof ritz->asked) == 0;
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
    double of_class = 3.0 / 8.0 * wanted[0] * wanted[1] * wanted[2];
    if (of_class > MOST_OF_CLASS) {
        int longs = 0;
        for (int d = 0; d < 3; d++)
            longs += wanted[d] > 2.0 * ACROSS;
        shrink = longs > 0 ? pow(MOST_OF_CLASS / of_class, 1.0 / longs) : 1.0;
    }
    for (int d = 0; d < 3; d++) {
        if (wanted[d] > 2.0 * ACROSS)
            wanted[d] = fmax(wanted[d] * shrink, 2.0 * ACROSS);
        ritz->orders[d] = (size_t)fmin(ceil(wanted[d]), MOST_ORDERS);
    }
}

/* Whether a product of polynomials is taken: of long sides those within an ellipse. */
static bool is_taken(const struct ritz *ritz, const double share, const unsigned order[3])
{
    double sum = 0.0;
    for (int d = 0; d < 3; d++) {
        if (order[d] >= ritz->orders[d])
            return false;
        if (ritz->orders[d] <= 2 * ACROSS)
            continue;
        double part = order[d] / (share * (double)ritz->orders[d]);
        sum += part * part;
    }
    return sum < 1.0;
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

/* Mean over the box of the derivative of one product along axis c and of the other along d. */
static double mean_of(const struct ritz *ritz, const unsigned char a[3], int c,
                      const unsigned char b[3], int d)
{
    double product = 1.0;
    for (int e = 0; e < 3 && product != 0.0; e++) {
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
    return product;
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
            good = add_rigid(class, i, -ritz->side[c], j, ritz->side[b]);
    }
    return good;
}

/* Up to the frequency whose slowest waves the polynomials resolve: 1/omega^2 = 1/(bending k^2)^2 +
 * 1/(c_R k)^2 of waves along each side, c_R being Rayleigh's speed. */
static double highest(const struct ritz *ritz)
{
    double shear = sqrt(0.5 / (1.0 + ritz->poisson));
    double surface = shear * (0.87 + 1.12 * ritz->poisson) / (1.0 + ritz->poisson);
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
        if (linear_packed_factor(n, class->factor))
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

struct ritz *ritz_create(const double sides[3], double poisson)
{
    struct ritz *ritz = calloc(1, sizeof *ritz);
    double longest = fmax(sides[0], fmax(sides[1], sides[2]));
    if (!ritz)
        return NULL;
    ritz->poisson = poisson;
    ritz->mass = 1.0;
    for (int d = 0; d < 3; d++) {
        ritz->asked[d] = sides[d];
        ritz->side[d] = sides[d] / longest;
        ritz->mass *= ritz->side[d];
    }
    choose_orders(ritz);
    bool good = true;
    for (int c = 0; good && c < CLASSES; c++)
        good = list_orders(ritz, c) && solve_class(ritz, &ritz->class[c], highest(ritz));
    if (good && merge(ritz))
        return ritz;
    ritz_free(ritz);
    return NULL;
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
        free(ritz->omega);
        free(ritz->mode);
    }
    free(ritz);
}

/* A class' coordinates at a point, along a direction. */
static void fill_functions(const struct ritz *ritz, const struct ritz_class *class,
                           const double table[3][MOST_ORDERS], const double direction[3],
                           double *functions)
{
    double scale = 1.0 / sqrt(ritz->mass);
    for (size_t i = 0; i < class->count; i++) {
        const unsigned char *order = class->order[i];
        functions[i] = scale * direction[component_of(class, i)] * table[0][order[0]] *
                       table[1][order[1]] * table[2][order[2]];
    }
}

void ritz_shapes(const struct ritz *ritz, const double point[3], const double direction[3],
                 size_t first, size_t count, double *row)
{
    enum { LARGEST = 4 * MOST_OF_CLASS };
    double table[3][MOST_ORDERS], functions[LARGEST];
    for (int d = 0; d < 3; d++)
        fill_polynomials(ritz->orders[d], 2.0 * point[d] / ritz->side[d], table[d]);
    for (int c = 0; c < CLASSES; c++) {
        const struct ritz_class *class = &ritz->class[c];
        bool filled = false;
        for (size_t k = 0; k < count; k++) {
            const struct ritz_mode *mode = &ritz->mode[first + k];
            if (mode->class != c)
                continue;
            if (!filled)
                fill_functions(ritz, class, table, direction, functions);
            filled = true;
            const double *vector = class->vectors + mode->number * class->count;
            double sum = 0.0;
            for (size_t i = 0; i < class->count; i++)
                sum += vector[i] * functions[i];
            row[k] = sum;
        }
    }
}

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

/* A unit force along the inward normal of a face, and what is summed up over the other five. */
struct push {
    const struct ritz *ritz;
    int axis, side; /* the face */
    struct boussinesq3 load;
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
    push->surface += weight * dot3(traction, u);
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
            fill_polynomials(n[2], 2.0 * at[along] / half[along], table);
            for (int c = 0; c < 3; c++)
                for (size_t q = 0; q < n[2]; q++)
                    line[c][q] += traction[c] * table[q];
        }
        fill_polynomials(n[1], 2.0 * at[across] / half[across], table);
        for (int c = 0; c < 3; c++)
            for (size_t p = 0; p < n[1]; p++)
                for (size_t q = 0; q < n[2]; q++)
                    products[(c * MOST_ORDERS + p) * MOST_ORDERS + q] += table[p] * line[c][q];
    }
    /* times those of the face's own place */
    fill_polynomials(n[0], side, table);
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

/* MESH.md: f_d K^-1 f_d - (t_B, u_B) - 2 p gamma of the rigid motions. */
double ritz_flexibility(const struct ritz *ritz, int axis, int side, const double point[3])
{
    const size_t *n = ritz->orders;
    struct push push = {.ritz = ritz, .axis = axis, .side = side};
    push.load = (struct boussinesq3){.young = 1.0, .poisson = ritz->poisson, .reach = INFINITY};
    push.load.inward[axis] = -side;
    memcpy(push.load.point, point, sizeof push.load.point);
    push.load.point[axis] = 0.5 * side * ritz->side[axis];
    push.force = calloc(3 * n[0] * n[1] * n[2], sizeof *push.force);
    bool good = push.force != NULL;
    size_t largest = 0;
    for (int face = 0; good && face < 6; face++)
        if (face / 2 != axis || (face % 2 ? 1 : -1) != side)
            good = add_face(&push, face / 2, face % 2 ? 1 : -1);
    for (int c = 0; c < CLASSES; c++)
        largest = ritz->class[c].count > largest ? ritz->class[c].count : largest;
    double *f = calloc(2 * largest + 1, sizeof *f);
    /* rigid motions: the force is -1 along the outward normal z, x along it in the rotation */
    double sum = -push.surface + 2.0 * push.motion[0] / ritz->mass;
    for (int i = 1; i < 3; i++) {
        int other = (axis + i) % 3;
        double square = ritz->side[other] * ritz->side[other] + ritz->side[axis] * ritz->side[axis];
        sum -= 2.0 * point[other] * push.motion[i] / (ritz->mass * square / 12.0);
    }
    for (int c = 0; good && f && c < CLASSES; c++)
        sum += energy_of(&push, &ritz->class[c], f);
    if (!f)
        good = false;
    free(push.force);
    free(f);
    return good ? sum : NAN;
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
        double spacing = ritz->side[d] * sqrt(fmax(1.0 - x * x, 1e-4)) / (double)ritz->orders[d];
        least = fmin(least, distance / spacing);
    }
    return fmin(ONE * exp(FALL * (1.0 - least)), MOST) / distance;
}

struct ritz_unresolved ritz_unresolved_at(const struct ritz *ritz, int axis, const double point[3])
{
    static const double DOUBT = 0.3;
    struct ritz_unresolved unresolved = {lacking(ritz, axis, point, ritz->side[axis]), 0.0};
    unresolved.doubt = DOUBT * unresolved.lacks;
    for (int i = 1; i < 3; i++) {
        int d = (axis + i) % 3;
        double near = fmax(0.5 * ritz->side[d] - fabs(point[d]), 1e-3 * ritz->side[d]);
        unresolved.doubt += lacking(ritz, axis, point, near);
    }
    return unresolved;
}
