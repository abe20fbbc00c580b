/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/ritz.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/boussinesq3.h"
#include "model/ritz_parts.h"
#include "model/vector.h"
#include "numeric/linear.h"

/* Static flexibility of a vibration by Ritz's method: the half-space under the load, and the effect
 * of the other faces. */

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

/* Loads at a point of a face: along its inward normal, and along the next axis and the one after.
 * Rigid motions: along the outward normal, about these two axes, along them, about the normal; the
 * first three are those that a normal force takes part in. */
enum { LOADS = 3, MOTIONS = 6 };

/* A unit force at a point of a face, and the sums over the other five. */
struct push {
    const struct ritz *ritz;
    int axis, side; /* the face */
    struct boussinesq3 load;
    bool tensor;            /* all loads and motions are wanted; else the normal one's */
    int which;              /* load */
    bool inside;            /* the point is within the cut, where `surface` is not summed */
    double surface[LOADS];  /* of the half-space's traction times the displacement of a load */
    double motion[MOTIONS]; /* of the half-space's field times the density, in rigid motions */
    double *force; /* [component][order along x][y][z]: minus its traction on the products */
};

/* The half-space's field of a load. */
static void push_field(const struct push *push, int which, const double at[3], double u[3],
                       double stress[6])
{
    double along[3] = {0.0};
    if (which == 0) {
        boussinesq3_field(&push->load, at, u, stress);
        return;
    }
    along[(push->axis + which) % 3] = 1.0;
    cerruti3_field(&push->load, along, at, u, stress);
}

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

/* As above, of the motions along the face and about its normal: u = q(z) (1, 0), q(z) (0, 1), q(z)
 * (-y, x) with q'' = -1/mu. */
static void reciprocal_along(const struct push *push, int motion, const double at[3], double u[3],
                             double stress[6])
{
    const struct ritz *ritz = push->ritz;
    double mu = 0.5 / (1.0 + ritz->poisson), full[3][3] = {{0.0}};
    int n = push->axis, one = (n + 1) % 3, other = (n + 2) % 3;
    double below = push->side * at[n] - 0.5 * ritz->basis.side[n];
    double shape[3] = {0.0};
    shape[one] = motion == 3 ? 1.0 : motion == 5 ? -at[other] : 0.0;
    shape[other] = motion == 4 ? 1.0 : motion == 5 ? at[one] : 0.0;
    for (int i = 0; i < 3; i++) {
        u[i] = -0.5 * below * below / mu * shape[i];
        full[n][i] = full[i][n] = -below * push->side * shape[i];
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
    push_field(push, push->which, at, u, stress);
    boussinesq3_traction(stress, outward, traction);
    push->surface[push->which] += push->inside ? 0.0 : weight * dot3(traction, u);
    for (int other = 0; push->tensor && !push->inside && other < LOADS; other++) {
        double moved[3];
        if (other == push->which)
            continue;
        push_field(push, other, at, moved, NULL);
        push->surface[other] += weight * dot3(traction, moved);
    }
    for (int i = 0; i < (push->tensor ? MOTIONS : 3); i++) {
        double field[3], pulled[3];
        if (i < 3)
            reciprocal(push, (push->axis + i) % 3, at, field, stress);
        else
            reciprocal_along(push, i, at, field, stress);
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
    /* a tangential force takes part in harmonics that must not be mistaken for others */
    if (push->tensor) {
        rules[1].count = 0;
        for (int i = -MOST_PANELS / 2; i < MOST_PANELS / 2; i++)
            add_panel(&rules[1], 2.0 * M_PI * i / MOST_PANELS, 2.0 * M_PI * (i + 1) / MOST_PANELS);
    }
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

/* Takes the rigid motions off forces f, and gives K^-1 f behind them. */
static void solve_forces(const struct ritz_class *class, double *f)
{
    size_t n = class->terms.count;
    double *solved = f + n;
    if (n == 0)
        return;
    for (size_t r = 0; r < class->rigids; r++) {
        double part = 0.0;
        for (size_t i = 0; i < n; i++)
            part += class->rigid[r][i] * f[i];
        for (size_t i = 0; i < n; i++)
            f[i] -= part * class->rigid[r][i];
    }
    memcpy(solved, f, n * sizeof *f);
    linear_packed_solve(n, class->factor, solved);
}

/* f K^-1 f of a class, without its rigid motions. Room for as much again behind f. */
static double energy_of(const struct ritz_class *class, double *f)
{
    size_t n = class->terms.count;
    double sum = 0.0;
    solve_forces(class, f);
    for (size_t i = 0; i < n; i++)
        sum += f[i] * f[n + i];
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

/* A load's sums over all other faces. False: out of memory. */
static bool push_sum(struct push *push, int axis, int side)
{
    const struct ritz *ritz = push->ritz;
    const size_t *n = ritz->basis.orders;
    push->force = calloc(3 * n[0] * n[1] * n[2], sizeof *push->force);
    bool good = push->force != NULL;
    for (int face = 0; good && !ritz->basis.round && face < 6; face++)
        if (face / 2 != axis || (face % 2 ? 1 : -1) != side)
            good = push_add_face(push, face / 2, face % 2 ? 1 : -1);
    if (good && ritz->basis.round)
        good = add_round(push, axis == RITZ_ROUND);
    return good;
}

static struct push push_make(const struct ritz *ritz, int axis, int side, const double point[3])
{
    bool on_side = axis == RITZ_ROUND;
    struct push push = {.ritz = ritz, .axis = on_side ? 1 : axis, .side = on_side ? 1 : side};
    place_load(&push, axis, point);
    return push;
}

/* As for meshes (reduce/flexibility.h): f_d K^-1 f_d - (t_B, u_B) - 2 p gamma of the rigid motions.
 */
static double of_free(const struct ritz *ritz, int axis, int side, const double point[3])
{
    struct push push = push_make(ritz, axis, side, point);
    bool good = push_sum(&push, axis, side);
    /* rigid motions: the force is -1 along the outward normal z, x along it in the rotation */
    double sum = -push.surface[0] + 2.0 * push.motion[0] / ritz->basis.volume;
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

/* The direction of a load. */
static void load_direction(const struct push *push, int which, double direction[3])
{
    memset(direction, 0, 3 * sizeof *direction);
    direction[(push->axis + which) % 3] = which == 0 ? -push->side : 1.0;
}

/* A rigid motion at a point, and the mean of its square. */
static double rigid_motion(const struct push *push, int motion, const double at[3], double moved[3])
{
    int n = push->axis, one = (n + 1) % 3, two = (n + 2) % 3, of = motion == 1 ? one : two;
    const struct ritz *ritz = push->ritz;
    memset(moved, 0, 3 * sizeof *moved);
    if (motion == 0)
        moved[n] = push->side;
    else if (motion == 3 || motion == 4)
        moved[motion == 3 ? one : two] = 1.0;
    else if (motion == 5) {
        moved[one] = -at[two];
        moved[two] = at[one];
        return mean_square(ritz, one) + mean_square(ritz, two);
    } else {
        moved[of] = push->side * at[n];
        moved[n] = -push->side * at[of];
        return mean_square(ritz, of) + mean_square(ritz, n);
    }
    return 1.0;
}

/* f_i K^-1 f_j of a class added to the matrix; `solved`: room of each load. */
static void add_energies(const struct ritz_class *class, double *const solved[LOADS],
                         double sum[LOADS][LOADS])
{
    size_t n = class->terms.count;
    for (int i = 0; i < LOADS; i++)
        solve_forces(class, solved[i]);
    for (int i = 0; i < LOADS; i++)
        for (int j = 0; j < LOADS; j++)
            for (size_t k = 0; k < n; k++)
                sum[i][j] += solved[i][k] * solved[j][n + k];
}

/* The same as of_free between all loads of a place: f_i K^-1 f_j - (t_i, u_j) - p_i gamma_j - p_j
 * gamma_i, where a rotation's reciprocal field moves the loaded point by top^3/(3 mu) along the
 * face. */
static bool tensor_of_free(const struct ritz *ritz, int axis, int side, const double point[3],
                           double sum[LOADS][LOADS])
{
    struct push push[LOADS];
    double *room[LOADS], part[LOADS][MOTIONS];
    bool good = true;
    for (int i = 0; i < LOADS; i++) {
        push[i] = push_make(ritz, axis, side, point);
        push[i].tensor = true;
        push[i].which = i;
        room[i] = class_room(ritz);
        good = push_sum(&push[i], axis, side) && room[i] && good;
        double top = 0.5 * ritz->basis.side[push[i].axis], direction[3], moved[3];
        if (i > 0)
            push[i].motion[i] += top * top * top / 3.0 * 2.0 * (1.0 + ritz->poisson);
        load_direction(&push[i], i, direction);
        for (int m = 0; m < MOTIONS; m++) {
            double square = rigid_motion(&push[i], m, push[i].load.point, moved);
            part[i][m] = dot3(direction, moved) / (square * ritz->basis.volume);
        }
    }
    for (int i = 0; i < LOADS; i++)
        for (int j = 0; j < LOADS; j++) {
            sum[i][j] = -0.5 * (push[i].surface[j] + push[j].surface[i]);
            for (int m = 0; m < MOTIONS; m++)
                sum[i][j] -= part[i][m] * push[j].motion[m] + part[j][m] * push[i].motion[m];
        }
    for (int c = 0; good && c < RITZ_CLASSES; c++) {
        for (int i = 0; i < LOADS; i++)
            push_gather(&push[i], &ritz->class[c], room[i]);
        add_energies(&ritz->class[c], room, sum);
    }
    for (int i = 0; i < LOADS; i++) {
        free(push[i].force);
        free(room[i]);
    }
    return good;
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
    struct push push = push_make(ritz, axis, side, point);
    return of_free(ritz->free, axis, side, point) + by_polynomials(ritz, &push.load) -
           by_polynomials(ritz->free, &push.load);
}

/* The same by the polynomials alone, times `sign`, added. */
static bool add_polynomials(const struct ritz *ritz, const struct push *push, double sign,
                            double sum[LOADS][LOADS])
{
    struct ritz_functions functions;
    double *room[LOADS], direction[3], own[LOADS][LOADS] = {{0.0}};
    bool good = true;
    ritz_functions_fill(&ritz->basis, push->load.point, &functions);
    for (int i = 0; i < LOADS; i++) {
        room[i] = class_room(ritz);
        good = good && room[i];
    }
    for (int c = 0; good && c < RITZ_CLASSES; c++) {
        for (int i = 0; i < LOADS; i++) {
            load_direction(push, i, direction);
            ritz_functions_along(&ritz->basis, &ritz->class[c].terms, &functions, direction,
                                 room[i]);
        }
        add_energies(&ritz->class[c], room, own);
    }
    for (int i = 0; i < LOADS; i++)
        free(room[i]);
    for (int i = 0; i < LOADS * LOADS; i++)
        sum[i / LOADS][i % LOADS] += sign * own[i / LOADS][i % LOADS];
    return good;
}

bool ritz_tensor(const struct ritz *ritz, int axis, int side, const double point[3],
                 double tensor[6])
{
    static const int ROW[6] = {0, 1, 2, 0, 1, 2}, COLUMN[6] = {0, 1, 2, 1, 2, 0};
    const struct push push = push_make(ritz, axis, side, point);
    double sum[LOADS][LOADS], off = hypot(point[1], point[2]);
    bool good = tensor_of_free(ritz->free ? ritz->free : ritz, axis, side, point, sum);
    if (good && ritz->free)
        good =
            add_polynomials(ritz, &push, 1.0, sum) && add_polynomials(ritz->free, &push, -1.0, sum);
    memset(tensor, 0, 6 * sizeof *tensor);
    double direction[LOADS][3];
    for (int i = 0; i < LOADS; i++) {
        double *d = direction[i];
        load_direction(&push, i, d);
        /* a cylinder's side was turned to z = 0 */
        if (axis == RITZ_ROUND && off > 0.0) {
            const double y = d[1], z = d[2];
            d[1] = (point[1] * y - point[2] * z) / off;
            d[2] = (point[2] * y + point[1] * z) / off;
        }
    }
    for (int k = 0; good && k < 6; k++)
        for (int i = 0; i < LOADS; i++)
            for (int j = 0; j < LOADS; j++)
                tensor[k] += sum[i][j] * direction[i][ROW[k]] * direction[j][COLUMN[k]];
    return good;
}

/* (1 + nu)(1 - 2 nu)^2/(2 pi) of the mean curvature, 1/(2 R). */
double ritz_slope(const struct ritz *ritz)
{
    double side = 1.0 - 2.0 * ritz->poisson;
    return (1.0 + ritz->poisson) * side * side / (2.0 * M_PI * ritz->basis.side[1]);
}

void ritz_tensor_narrow(const struct ritz *ritz, const double point[3], double logarithm,
                        double tensor[6])
{
    double off = hypot(point[1], point[2]), bend = 2.0 / ritz->basis.side[1];
    const double normal[3] = {0.0, point[1] / off, point[2] / off};
    const double about[3] = {0.0, -normal[2], normal[1]};
    double curvature[9];
    for (int i = 0; i < 9; i++)
        curvature[i] = bend * about[i / 3] * about[i % 3];
    cerruti3_add_slope(1.0, ritz->poisson, normal, curvature, logarithm, tensor);
    cerruti3_add_contact(1.0, ritz->poisson, normal, curvature, tensor);
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
