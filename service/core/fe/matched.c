/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/matched.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fe/boussinesq.h"
#include "numeric/band.h"

/* The correction that turns the point load's field in a half-space into that of a cylinder: the
 * cylinder under minus the half-space's tractions on its side and far face, in balance with its
 * inertia. It is smooth, so that a few elements of high order hold it to five digits. */

enum { ORDER = 6, SIDE = ORDER + 1, LOCAL = 2 * SIDE * SIDE, GAUSS = ORDER + 2, BREAKS_MAX = 40 };

/* Lagrange basis on Gauss-Lobatto nodes and its slopes at Gauss points, on [-1, 1]. */
struct basis {
    double node[SIDE];
    double point[GAUSS], weight[GAUSS];
    double value[GAUSS][SIDE], slope[GAUSS][SIDE];
};

/* Cylinder of radius 1 and its elements, r fastest; E = 1. */
struct cylinder {
    double poisson, length;
    double r[BREAKS_MAX], z[BREAKS_MAX]; /* breaks: r outward from 0, z downward from 0 */
    size_t across, along;                /* elements */
    size_t row;                          /* nodes in a row of constant z */
    struct basis basis;
    struct band matrix;
    double *load;
};

/* P_n and its slope by recurrence */
static void legendre(size_t n, double x, double *value, double *slope)
{
    double before = 1.0, here = x;
    for (size_t k = 2; k <= n; k++) {
        double next = ((2.0 * (double)k - 1.0) * x * here - ((double)k - 1.0) * before) / (double)k;
        before = here;
        here = next;
    }
    *value = here;
    *slope = (double)n * (x * here - before) / (x * x - 1.0);
}

static void gauss_points(struct basis *basis)
{
    for (size_t i = 0; i < GAUSS; i++) {
        double x = -cos(M_PI * ((double)i + 0.75) / (GAUSS + 0.5));
        double value, slope;
        for (int k = 0; k < 20; k++) {
            legendre(GAUSS, x, &value, &slope);
            x -= value / slope;
        }
        legendre(GAUSS, x, &value, &slope);
        basis->point[i] = x;
        basis->weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
}

/* roots of P_ORDER' and the ends; P'' from Legendre's equation */
static void lobatto_nodes(struct basis *basis)
{
    basis->node[0] = -1.0;
    basis->node[ORDER] = 1.0;
    for (size_t i = 1; i < ORDER; i++) {
        double x = -cos(M_PI * (double)i / ORDER);
        for (int k = 0; k < 20; k++) {
            double value, slope;
            legendre(ORDER, x, &value, &slope);
            double second = (2.0 * x * slope - ORDER * (ORDER + 1.0) * value) / (1.0 - x * x);
            x -= slope / second;
        }
        basis->node[i] = x;
    }
}

static void basis_make(struct basis *basis)
{
    gauss_points(basis);
    lobatto_nodes(basis);
    for (size_t g = 0; g < GAUSS; g++)
        for (size_t i = 0; i < SIDE; i++) {
            double value = 1.0, sum = 0.0;
            for (size_t j = 0; j < SIDE; j++) {
                if (j == i)
                    continue;
                value *= (basis->point[g] - basis->node[j]) / (basis->node[i] - basis->node[j]);
                sum += 1.0 / (basis->point[g] - basis->node[j]);
            }
            basis->value[g][i] = value;
            basis->slope[g][i] = value * sum;
        }
}

/* Elements as long as the smaller of radius and length near the load, twice as long each next one.
 */
static size_t breaks_make(double end, double first, double *breaks)
{
    size_t n = 0;
    double step = first;
    breaks[0] = 0.0;
    while (breaks[n] < end && n + 1 < BREAKS_MAX) {
        n++;
        breaks[n] = breaks[n - 1] + step;
        if (breaks[n] > end - 0.6 * step)
            breaks[n] = end;
        step *= 2.0;
    }
    return n;
}

static size_t freedom(const struct cylinder *cylinder, size_t er, size_t ez, size_t i, size_t j)
{
    return 2 * ((ez * ORDER + j) * cylinder->row + er * ORDER + i);
}

/* A Gauss point of an element: place, weight of volume, shape values and slopes. */
struct place {
    double r, z, volume;
    double value[SIDE * SIDE], slope_r[SIDE * SIDE], slope_z[SIDE * SIDE];
};

static void place_make(const struct cylinder *cylinder, size_t er, size_t ez, size_t gauss,
                       struct place *place)
{
    const struct basis *b = &cylinder->basis;
    size_t g = gauss % GAUSS, h = gauss / GAUSS;
    double half_r = 0.5 * (cylinder->r[er + 1] - cylinder->r[er]);
    double half_z = 0.5 * (cylinder->z[ez + 1] - cylinder->z[ez]);
    place->r = cylinder->r[er] + half_r * (1.0 + b->point[g]);
    place->z = -(cylinder->z[ez] + half_z * (1.0 + b->point[h]));
    place->volume = 2.0 * M_PI * place->r * half_r * half_z * b->weight[g] * b->weight[h];
    for (size_t j = 0; j < SIDE; j++)
        for (size_t i = 0; i < SIDE; i++) {
            place->value[j * SIDE + i] = b->value[g][i] * b->value[h][j];
            place->slope_r[j * SIDE + i] = b->slope[g][i] / half_r * b->value[h][j];
            place->slope_z[j * SIDE + i] = -b->value[g][i] * b->slope[h][j] / half_z;
        }
}

/* upper blocks of an element's stiffness at a point: lambda div div + 2 mu strain strain */
static void add_point(const struct place *p, double lambda, double mu,
                      double stiffness[LOCAL][LOCAL])
{
    for (size_t a = 0; a < SIDE * SIDE; a++) {
        /* u_r = N strains by rr = N,r, tt = N/r and gamma = N,z, div u = N,r + N/r; u_z = N by
         * zz = div u = N,z and gamma = N,r */
        double hoop = p->value[a] / p->r;
        double div_r = p->slope_r[a] + hoop;
        for (size_t b = 0; b <= a; b++) {
            double other = p->value[b] / p->r;
            double other_r = p->slope_r[b] + other;
            double shear = p->slope_z[a] * p->slope_z[b];
            double along = p->slope_r[a] * p->slope_r[b];
            double *rr = &stiffness[2 * a][2 * b];
            double *zz = &stiffness[2 * a + 1][2 * b + 1];
            *rr += p->volume *
                   (lambda * div_r * other_r + mu * (2.0 * along + 2.0 * hoop * other + shear));
            *zz += p->volume * ((lambda + 2.0 * mu) * shear + mu * along);
            stiffness[2 * a][2 * b + 1] +=
                p->volume * (lambda * div_r * p->slope_z[b] + mu * p->slope_z[a] * p->slope_r[b]);
            stiffness[2 * a + 1][2 * b] +=
                p->volume * (lambda * p->slope_z[a] * other_r + mu * p->slope_r[a] * p->slope_z[b]);
        }
    }
}

/* u_r = 0 on the axis; u_z = 0 where the axis ends: the loads are in balance, so that it carries
 * nothing */
static bool is_fixed(const struct cylinder *cylinder, size_t freedom_index)
{
    size_t node = freedom_index / 2;
    size_t last = cylinder->row * cylinder->along * ORDER;
    return node % cylinder->row == 0 && (freedom_index % 2 == 0 || node == last);
}

static void add_element(struct cylinder *cylinder, size_t er, size_t ez)
{
    double nu = cylinder->poisson;
    double mu = 0.5 / (1.0 + nu);
    double lambda = nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
    double per_volume = 1.0 / (M_PI * cylinder->length);
    double stiffness[LOCAL][LOCAL];
    memset(stiffness, 0, sizeof stiffness);
    for (size_t g = 0; g < GAUSS * GAUSS; g++) {
        struct place place;
        place_make(cylinder, er, ez, g, &place);
        add_point(&place, lambda, mu, stiffness);
        /* the load of 1 towards -z accelerates the body: its inertia pulls towards +z */
        for (size_t a = 0; a < SIDE * SIDE; a++)
            cylinder->load[freedom(cylinder, er, ez, a % SIDE, a / SIDE) + 1] +=
                place.volume * per_volume * place.value[a];
    }
    /* the lower triangle, rows of fixed freedoms without their neighbours */
    for (size_t a = 0; a < LOCAL; a++)
        for (size_t b = 0; b < LOCAL && b / 2 <= a / 2; b++) {
            size_t i = freedom(cylinder, er, ez, a / 2 % SIDE, a / 2 / SIDE) + a % 2;
            size_t j = freedom(cylinder, er, ez, b / 2 % SIDE, b / 2 / SIDE) + b % 2;
            bool fixed = is_fixed(cylinder, i) || is_fixed(cylinder, j);
            if (i < j || (fixed && i != j))
                continue;
            *band_entry(&cylinder->matrix, i, j) += stiffness[a][b];
        }
}

/* minus the half-space's tractions on the side (element row ez) */
static void load_side(struct cylinder *cylinder, size_t ez)
{
    const struct basis *b = &cylinder->basis;
    double half = 0.5 * (cylinder->z[ez + 1] - cylinder->z[ez]);
    for (size_t h = 0; h < GAUSS; h++) {
        double stress[STRESS_COMPONENTS];
        double z = -(cylinder->z[ez] + half * (1.0 + b->point[h]));
        boussinesq_stress(cylinder->poisson, 1.0, z, stress);
        for (size_t j = 0; j < SIDE; j++) {
            size_t f = freedom(cylinder, cylinder->across - 1, ez, ORDER, j);
            double area = 2.0 * M_PI * half * b->weight[h] * b->value[h][j];
            cylinder->load[f] -= area * stress[0];
            cylinder->load[f + 1] -= area * stress[3];
        }
    }
}

/* and on the far face, with the outward normal -z */
static void load_far(struct cylinder *cylinder, size_t er)
{
    const struct basis *b = &cylinder->basis;
    double half = 0.5 * (cylinder->r[er + 1] - cylinder->r[er]);
    for (size_t g = 0; g < GAUSS; g++) {
        double stress[STRESS_COMPONENTS];
        double r = cylinder->r[er] + half * (1.0 + b->point[g]);
        boussinesq_stress(cylinder->poisson, r, -cylinder->length, stress);
        for (size_t i = 0; i < SIDE; i++) {
            size_t f = freedom(cylinder, er, cylinder->along - 1, i, ORDER);
            double area = 2.0 * M_PI * r * half * b->weight[g] * b->value[g][i];
            cylinder->load[f] += area * stress[3];
            cylinder->load[f + 1] += area * stress[1];
        }
    }
}

/* Mean of the half-space's u_z over the cylinder: u_z = g(angle) / distance, so that the integral
 * over the distance is closed. Over the angle: to the far face as it is, to the side by the
 * logarithm of tan(angle / 2), in which it is smooth for the longest rods too. */
static double mean_half_space(const struct cylinder *cylinder)
{
    enum { PIECES = 12 };
    const struct basis *b = &cylinder->basis;
    double corner = atan2(1.0, cylinder->length);
    double sum = 0.0;
    for (size_t i = 0; i < PIECES * GAUSS; i++) {
        double place = ((double)(i / GAUSS) + 0.5 + 0.5 * b->point[i % GAUSS]) / PIECES;
        double weight = 0.5 * M_PI * b->weight[i % GAUSS] / PIECES;
        /* int u_z dV = pi int g(angle) sin(angle) reach^2 d angle, first over the far face */
        double low = log(tan(0.5 * corner));
        double angle = place * corner;
        double u[2];
        double reach = cylinder->length / cos(angle);
        boussinesq_displacement(1.0, cylinder->poisson, sin(angle), -cos(angle), u);
        sum += weight * corner * u[1] * sin(angle) * reach * reach;
        /* d angle = sin(angle) d log tan(angle / 2), reach = 1 / sin(angle) */
        angle = 2.0 * atan(exp((1.0 - place) * low));
        boussinesq_displacement(1.0, cylinder->poisson, sin(angle), -cos(angle), u);
        sum -= weight * low * u[1];
    }
    return sum / (M_PI * cylinder->length);
}

/* u_z of the correction on the axis at the load less its mean */
static double pole_above_mean(const struct cylinder *cylinder)
{
    double sum = 0.0;
    for (size_t ez = 0; ez < cylinder->along; ez++)
        for (size_t er = 0; er < cylinder->across; er++)
            for (size_t g = 0; g < GAUSS * GAUSS; g++) {
                struct place place;
                place_make(cylinder, er, ez, g, &place);
                for (size_t a = 0; a < SIDE * SIDE; a++)
                    sum += place.volume * place.value[a] *
                           cylinder->load[freedom(cylinder, er, ez, a % SIDE, a / SIDE) + 1];
            }
    return cylinder->load[1] - sum / (M_PI * cylinder->length);
}

static double solve(struct cylinder *cylinder)
{
    for (size_t ez = 0; ez < cylinder->along; ez++) {
        for (size_t er = 0; er < cylinder->across; er++)
            add_element(cylinder, er, ez);
        load_side(cylinder, ez);
    }
    for (size_t er = 0; er < cylinder->across; er++)
        load_far(cylinder, er);
    for (size_t i = 0; i < cylinder->matrix.n; i++)
        if (is_fixed(cylinder, i))
            cylinder->load[i] = 0.0;
    if (!band_factor(&cylinder->matrix))
        return NAN;
    band_forward(&cylinder->matrix, 0, cylinder->matrix.n, cylinder->load);
    band_backward(&cylinder->matrix, 0, cylinder->matrix.n, cylinder->load);
    /* the load presses towards -z */
    return -pole_above_mean(cylinder) + mean_half_space(cylinder);
}

bool matched_cylinder(double poisson, double slenderness, double *compliance)
{
    struct cylinder cylinder = {.poisson = poisson, .length = slenderness};
    double first = 0.5 * fmin(1.0, slenderness);
    basis_make(&cylinder.basis);
    cylinder.across = breaks_make(1.0, first, cylinder.r);
    cylinder.along = breaks_make(slenderness, first, cylinder.z);
    cylinder.row = cylinder.across * ORDER + 1;
    size_t n = 2 * cylinder.row * (cylinder.along * ORDER + 1);
    size_t width = 2 * (ORDER * cylinder.row + ORDER) + 1;
    cylinder.matrix = (struct band){n, width, calloc(n * (width + 1), sizeof(double))};
    cylinder.load = calloc(n, sizeof(double));
    bool room = cylinder.matrix.values && cylinder.load;
    if (room)
        *compliance = solve(&cylinder);
    free(cylinder.matrix.values);
    free(cylinder.load);
    return room;
}

/* Radial displacement at the pole of a unit sphere under the surface stress sigma_rr = P_n(cos
 * theta) without shear, times the shear modulus. With the harmonic f = r^n P_n two fields are
 * regular: grad f and r^2 grad f + alpha r f (Love, Theory of Elasticity, art. 172); the sum
 * without shear on r = 1 is wanted. `lame` is lambda over the shear modulus. */
static double pole_response(double lame, double n)
{
    if (n == 0.0) /* uniform: 1 / (3 bulk) */
        return 1.0 / (3.0 * lame + 2.0);
    if (n == 1.0) {
        /* The resultant accelerates the sphere: u = p (r^2 e_z - 2 z r) with the body force
         * -(6 lambda + 4 mu) p balances it without shear on r = 1; u_z is -p at the pole and p/5 in
         * the mean. */
        return 1.2 / (6.0 * lame + 4.0);
    }
    double alpha = -2.0 * (n * lame + 3.0 * n + 1.0) / ((n + 3.0) * lame + n + 5.0);
    /* shear of the first is 2 (n - 1), of the second 2 n + alpha */
    double first = -0.5 * (2.0 * n + alpha) / (n - 1.0);
    double stress = lame * (2.0 * n + alpha * (n + 3.0)) + 2.0 * (n + alpha) * (n + 1.0) +
                    2.0 * n * (n - 1.0) * first;
    return (n * first + n + alpha) / stress;
}

/* transform of Hertz's pressure, 1 at 0: 3 (sin t - t cos t) / t^3 */
static double hertz_transform(double t)
{
    if (t < 0.05)
        return 1.0 - t * t / 10.0 + t * t * t * t / 280.0;
    return 3.0 * (sin(t) - t * cos(t)) / (t * t * t);
}

double matched_sphere(double poisson, double patch)
{
    /* A load of 1 spread as Hertz's pressure has the surface stress sum (2n + 1) / (4 pi) h_n P_n
     * with h_n the transform at (n + 1/2) patch; displacement is averaged with the same pressure.
     * Of each term the half-space's is taken off; their sum over n + 1/2 is its integral (midpoint
     * rule of a smooth even function). The rest falls off like 1/n, whence the logarithm. */
    double lame = 2.0 * poisson / (1.0 - 2.0 * poisson);
    double half_space = (1.0 - poisson * poisson) / M_PI;
    double sum = 0.0;
    for (double n = 0.0; (n + 0.5) * patch < 40.0; n += 1.0) {
        double transform = hertz_transform((n + 0.5) * patch);
        /* E = 2 (1 + nu) mu */
        double term =
            2.0 * (1.0 + poisson) * (2.0 * n + 1.0) / (4.0 * M_PI) * pole_response(lame, n);
        sum += (term - half_space) * transform * transform;
    }
    return sum;
}

double matched_unit(const struct body *body)
{
    double radius = body_solid(body).radius;
    return radius > 0.0 ? 1.0 / (body->material.young * radius) : 0.0;
}

bool matched_share(const struct body *body, double patch, double *share)
{
    struct solid solid = body_solid(body);
    double poisson = body->material.poisson;
    double slenderness = solid.length / solid.radius;
    double held = body_is_flexible(body) ? slenderness / (3.0 * M_PI) : 0.0;
    switch (solid.form) {
    case SOLID_HALF_SPACE:
        *share = 0.0;
        return true;
    case SOLID_BALL:
        *share = matched_sphere(poisson, patch);
        return true;
    case SOLID_CYLINDER:
        if (solid.approximate || isfinite(solid.tip_radius))
            break;
        if (!matched_cylinder(poisson, slenderness, share))
            return false;
        *share -= held;
        return true;
    default:
        break;
    }
    *share = NAN;
    return true;
}

bool matched_compliance(const struct body *body, double patch, double *compliance)
{
    if (!matched_share(body, patch / body_solid(body).radius, compliance))
        return false;
    *compliance *= matched_unit(body);
    return true;
}
