/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/ritz.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/watch.h"
#include "model/boussinesq3.h"
#include "model/ritz_basis.h"
#include "model/vector.h"
#include "numeric/linear.h"

/* One class: its products, stiffness and modes. */
struct ritz_class {
    struct ritz_terms terms;
    double *factor;   /* Cholesky's of the stiffness matrix with the rigid motions held */
    size_t rigids;    /* rigid motions of the class */
    double *rigid[3]; /* [count], orthonormal */
    size_t modes;
    double *omega, *vectors; /* [modes], [modes][count] */
};

struct ritz {
    struct ritz_basis basis; /* of density 1: its volume is the mass */
    double poisson;
    struct ritz *free; /* of a held box: factors of the same polynomials with those that do not
                        * vanish on its held faces */
    struct ritz_class class[RITZ_CLASSES];
    double highest; /* frequency up to which there are modes */
    size_t count;
    double *omega; /* [count] */
    struct ritz_mode {
        unsigned char class;
        unsigned number;
    } * mode; /* [count] */
};

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

/* Flexibility: the half-space under the load, and the effect of the other faces. */

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

/* Over [-half, half], fine at `place` for variations over `scale`. */
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

/* A unit force along the inward normal of a face, and the sums over the other five. */
struct push {
    const struct ritz *ritz;
    int axis, side; /* the face */
    struct boussinesq3 load;
    bool inside;      /* the point is within the cut, where `surface` is not summed */
    double surface;   /* of the half-space's traction times its displacement */
    double motion[3]; /* of the half-space's field times the density, along the outward normal and
                       * in the two rotations that the force takes part in */
    double *force;    /* [component][order along x][y][z]: minus its traction on the products */
};

/* A field in equilibrium with minus the inertia of a rigid motion; it leaves the loaded face free
 * and does not move the loaded point. It turns the integral of the half-space's field over the body
 * into ones over the other faces (Betti). Coordinates: x along `other`, z along the outward normal
 * from the middle; other = the axis itself: along the normal. */
static void reciprocal(const struct push *push, int other, const double at[3], double u[3],
                       double stress[6])
{
    const struct ritz *ritz = push->ritz;
    double poisson = ritz->poisson, mu = 0.5 / (1.0 + poisson);
    double lambda = poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), stiff = lambda + 2.0 * mu;
    double top = 0.5 * ritz->basis.side[push->axis], z = push->side * at[push->axis],
           below = z - top;
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

/* Adds one point of a face to the sums, and gives its weighted traction. */
static void push_add_point(struct push *push, const double at[3], const double outward[3],
                           double weight, double traction[3])
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

/* One face, its sums with all products. `rows`: [3][RITZ_MOST_ORDERS] of one line of points. */
static bool push_add_face(struct push *push, int axis, int side)
{
    const struct ritz *ritz = push->ritz;
    int across = (axis + 1) % 3, along = (axis + 2) % 3;
    const double *half = ritz->basis.side, *place = push->load.point;
    double distance = fabs(0.5 * side * half[axis] - place[axis]);
    size_t n[3] = {ritz->basis.orders[axis], ritz->basis.orders[across], ritz->basis.orders[along]};
    struct rule *rules = calloc(2, sizeof *rules);
    double *products = calloc(3 * RITZ_MOST_ORDERS * RITZ_MOST_ORDERS, sizeof *products);
    if (rules && products) {
        make_rule(0.5 * half[across], place[across], distance, &rules[0]);
        make_rule(0.5 * half[along], place[along], distance, &rules[1]);
    }
    double at[3], outward[3] = {0.0}, traction[3], table[RITZ_MOST_ORDERS];
    outward[axis] = side;
    at[axis] = 0.5 * side * half[axis];
    for (size_t i = 0; rules && products && i < rules[0].count; i++) {
        double line[3][RITZ_MOST_ORDERS] = {{0.0}};
        at[across] = rules[0].x[i];
        /* along one line, then across */
        for (size_t j = 0; j < rules[1].count; j++) {
            at[along] = rules[1].x[j];
            push_add_point(push, at, outward, rules[0].weight[i] * rules[1].weight[j], traction);
            polynomial_legendre(n[2], 2.0 * at[along] / half[along], table);
            for (int c = 0; c < 3; c++)
                for (size_t q = 0; q < n[2]; q++)
                    line[c][q] += traction[c] * table[q];
        }
        polynomial_legendre(n[1], 2.0 * at[across] / half[across], table);
        for (int c = 0; c < 3; c++)
            for (size_t p = 0; p < n[1]; p++)
                for (size_t q = 0; q < n[2]; q++)
                    products[(c * RITZ_MOST_ORDERS + p) * RITZ_MOST_ORDERS + q] +=
                        table[p] * line[c][q];
    }
    /* times those of the face's own place */
    polynomial_legendre(n[0], side, table);
    double scale = -1.0 / sqrt(ritz->basis.volume);
    size_t order[3];
    const size_t *all = ritz->basis.orders;
    for (int c = 0; rules && products && c < 3; c++)
        for (order[0] = 0; order[0] < all[0]; order[0]++)
            for (order[1] = 0; order[1] < all[1]; order[1]++)
                for (order[2] = 0; order[2] < all[2]; order[2]++)
                    push->force[((c * all[0] + order[0]) * all[1] + order[1]) * all[2] +
                                order[2]] +=
                        scale * table[order[axis]] *
                        products[(c * RITZ_MOST_ORDERS + order[across]) * RITZ_MOST_ORDERS +
                                 order[along]];
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
    const size_t *all = ritz->basis.orders;
    struct ritz_functions functions;
    double traction[3], scale = -1.0 / sqrt(ritz->basis.volume);
    push_add_point(push, at, outward, weight, traction);
    ritz_functions_fill(&ritz->basis, at, &functions);
    for (size_t c = 0; c < 3; c++)
        for (size_t p = 0; p < all[0]; p++) {
            double line = scale * traction[c] * functions.along[0][p];
            for (size_t q = 0; q < all[1]; q++)
                for (size_t r = 0; q + r < all[1]; r++)
                    push->force[((c * all[0] + p) * all[1] + q) * all[2] + r] +=
                        line * functions.section[q * POLYNOMIAL_MOST + r];
        }
}

/* Radii from 0 on, fine for variations over `scale`, with an end of a panel at `cut`. */
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
    double radius = 0.5 * push->ritz->basis.side[1], x = 0.5 * side * push->ritz->basis.side[0];
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
    double radius = 0.5 * ritz->basis.side[1], own = atan2(place[2], place[1]);
    double distance = radius - hypot(place[1], place[2]);
    make_rule(0.5 * ritz->basis.side[0], place[0], distance, &rules[0]);
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
    double radius = 0.5 * ritz->basis.side[1], half = M_PI * radius, x0 = push->load.point[0];
    double ahead = 0.5 * ritz->basis.side[0] - x0, behind = 0.5 * ritz->basis.side[0] + x0;
    const double corner[9] = {
        0.0,       atan2(half, ahead),         0.5 * M_PI, M_PI - atan2(half, behind),
        M_PI,      M_PI + atan2(half, behind), 1.5 * M_PI, 2.0 * M_PI - atan2(half, ahead),
        2.0 * M_PI};
    double cut = RITZ_CUT * ritz->basis.side[1];
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

/* The forces on a class' coordinates. */
static void push_gather(const struct push *push, const struct ritz_class *class, double *f)
{
    const size_t *all = push->ritz->basis.orders;
    for (size_t i = 0; i < class->terms.count; i++) {
        const unsigned char *order = class->terms.order[i];
        size_t c = (size_t)ritz_component(&class->terms, i);
        f[i] = push->force[((c * all[0] + order[0]) * all[1] + order[1]) * all[2] + order[2]];
    }
}

/* f K^-1 f of a class, without its rigid motions. Room for as much again behind f. */
static double energy_of(const struct ritz_class *class, double *f)
{
    size_t n = class->terms.count;
    double *solved = f + n, sum = 0.0;
    if (n == 0)
        return 0.0;
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
    return ritz->basis.side[axis] * ritz->basis.side[axis] /
           (ritz->basis.round && axis > 0 ? 16.0 : 12.0);
}

/* Where and how the load acts; of a cylinder's side turned to z = 0. */
static void place_load(struct push *push, int axis, const double point[3])
{
    const struct ritz *ritz = push->ritz;
    push->load = (struct boussinesq3){.young = 1.0, .poisson = ritz->poisson, .reach = INFINITY};
    push->load.inward[push->axis] = -push->side;
    double *at = push->load.point;
    memcpy(at, point, sizeof push->load.point);
    at[push->axis] = 0.5 * push->side * ritz->basis.side[push->axis];
    if (axis == RITZ_ROUND)
        at[2] = 0.0;
    /* beyond the edge the edge's own place */
    double off = hypot(at[1], at[2]), most = 0.5 * ritz->basis.side[1];
    if (ritz->basis.round && axis == 0 && off > most) {
        at[1] *= most / off;
        at[2] *= most / off;
    }
}

static double *class_room(const struct ritz *ritz)
{
    size_t largest = 0;
    for (int c = 0; c < RITZ_CLASSES; c++)
        largest = ritz->class[c].terms.count > largest ? ritz->class[c].terms.count : largest;
    return calloc(2 * largest + 1, sizeof(double));
}

/* As for meshes (reduce/flexibility.h): f_d K^-1 f_d - (t_B, u_B) - 2 p gamma of the rigid motions.
 */
static double of_free(const struct ritz *ritz, int axis, int side, const double point[3])
{
    const size_t *n = ritz->basis.orders;
    bool on_side = axis == RITZ_ROUND;
    struct push push = {.ritz = ritz, .axis = on_side ? 1 : axis, .side = on_side ? 1 : side};
    place_load(&push, axis, point);
    /* the other faces */
    push.force = calloc(3 * n[0] * n[1] * n[2], sizeof *push.force);
    bool good = push.force != NULL;
    for (int face = 0; good && !ritz->basis.round && face < 6; face++)
        if (face / 2 != axis || (face % 2 ? 1 : -1) != side)
            good = push_add_face(&push, face / 2, face % 2 ? 1 : -1);
    if (good && ritz->basis.round)
        good = add_round(&push, on_side);
    /* rigid motions: the force is -1 along the outward normal z, x along it in the rotation */
    double sum = -push.surface + 2.0 * push.motion[0] / ritz->basis.volume;
    for (int i = 1; i < 3; i++) {
        int other = (push.axis + i) % 3;
        double inertia =
            ritz->basis.volume * (mean_square(ritz, other) + mean_square(ritz, push.axis));
        sum -= 2.0 * push.load.point[other] * push.motion[i] / inertia;
    }
    /* and the elastic ones */
    double *f = class_room(ritz);
    for (int c = 0; good && f && c < RITZ_CLASSES; c++) {
        push_gather(&push, &ritz->class[c], f);
        sum += energy_of(&ritz->class[c], f);
    }
    good = good && f;
    free(push.force);
    free(f);
    return good ? sum : NAN;
}

/* Compliance of a point by the polynomials alone: it grows with their number, equally in all bases
 * that resolve as much there. */
static double by_polynomials(const struct ritz *ritz, const struct boussinesq3 *load)
{
    struct ritz_functions functions;
    double *f = class_room(ritz), sum = 0.0;
    ritz_functions_fill(&ritz->basis, load->point, &functions);
    for (int c = 0; f && c < RITZ_CLASSES; c++) {
        ritz_functions_along(&ritz->basis, &ritz->class[c].terms, &functions, load->inward, f);
        sum += energy_of(&ritz->class[c], f);
    }
    free(f);
    return f ? sum : NAN;
}

/* Held box: the flexibility of the free one and the change by holding it, which is smooth away from
 * the held face: from polynomials that are all those of the free box that vanish there. */
double ritz_flexibility(const struct ritz *ritz, int axis, int side, const double point[3])
{
    if (!ritz->free)
        return of_free(ritz, axis, side, point);
    struct push push = {.ritz = ritz, .axis = axis, .side = side};
    place_load(&push, axis, point);
    return of_free(ritz->free, axis, side, point) + by_polynomials(ritz, &push.load) -
           by_polynomials(ritz->free, &push.load);
}

/* (1 + nu)(1 - 2 nu)^2/(2 pi) of the mean curvature, 1/(2 R). */
double ritz_slope(const struct ritz *ritz)
{
    double side = 1.0 - 2.0 * ritz->poisson;
    return (1.0 + ritz->poisson) * side * side / (2.0 * M_PI * ritz->basis.side[1]);
}

/* Of a plate hit in its middle the flexibility lacks 0.11 exp(-4 (s - 1))/(E h) with s polynomials
 * for each thickness h along its sides, s = 0.5 ... 2; polynomials are denser near the ends. */
static double lacking(const struct ritz *ritz, int axis, const double point[3], double distance)
{
    static const double ONE = 0.11, FALL = 4.0, MOST = 1.2;
    double least = INFINITY;
    for (int i = 1; i < 3; i++) {
        int d = (axis + i) % 3;
        double x = 2.0 * point[d] / ritz->basis.side[d];
        if (ritz->basis.round && axis == 0)
            x = 2.0 * hypot(point[1], point[2]) / ritz->basis.side[1];
        double spacing =
            ritz->basis.side[d] * sqrt(fmax(1.0 - x * x, 1e-4)) / (double)ritz->basis.orders[d];
        least = fmin(least, distance / spacing);
    }
    return fmin(ONE * exp(FALL * (1.0 - least)), MOST) / distance;
}

/* Uncertainty beside a held face, and where the mirror image of the load is held: polynomials that
 * are finer by half show 0.003 to 0.01 over the distance, which the infinite stress at the edges of
 * held faces leaves. */
static double beside_held(const struct ritz *ritz, const double point[3])
{
    static const double HELD = 0.02;
    double sum = 0.0;
    for (int end = 0; end < 2; end++) {
        double distance = 0.5 * ritz->basis.side[0] + (end ? -point[0] : point[0]);
        if (ritz->basis.held[end])
            sum += HELD / fmax(distance, 1e-3 * ritz->basis.side[0]);
    }
    return sum;
}

struct ritz_unresolved ritz_unresolved_at(const struct ritz *ritz, int axis, int side,
                                          const double point[3])
{
    static const double DOUBT = 0.3, DOUBT_HELD = 0.5;
    int along = axis == RITZ_ROUND ? 1 : axis;
    const double turned[3] = {point[0], 0.5 * ritz->basis.side[1], 0.0};
    const double *at = axis == RITZ_ROUND ? turned : point;
    struct ritz_unresolved unresolved = {lacking(ritz, along, at, ritz->basis.side[along]), 0.0};
    unresolved.doubt = (ritz->free ? DOUBT_HELD : DOUBT) * unresolved.lacks;
    /* the opposite face is held: it is stiffer, not softer */
    if (ritz->free && axis == 0 && ritz->basis.held[side < 0]) {
        unresolved.doubt = unresolved.lacks;
        unresolved.lacks = 0.0;
    }
    unresolved.doubt += beside_held(ritz, at);
    for (int i = 1; i < 3; i++) {
        int d = (along + i) % 3;
        double off = ritz->basis.round && axis == 0 ? hypot(point[1], point[2]) : fabs(at[d]);
        double near = fmax(0.5 * ritz->basis.side[d] - off, 1e-3 * ritz->basis.side[d]);
        /* of a circle the rim counts once, of its side the ends */
        if (ritz->basis.round && d == 2)
            continue;
        unresolved.doubt += lacking(ritz, along, at, near);
    }
    return unresolved;
}
