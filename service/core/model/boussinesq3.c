/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/boussinesq3.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "model/vector.h"

static const int ROW[6] = {0, 1, 2, 0, 1, 2};
static const int COLUMN[6] = {0, 1, 2, 1, 2, 0};

/* adds `scale` times gradient and second derivatives (NULL: not wanted) of ln(R + z), z = x.e */
static void add_logarithm(double scale, const double x[3], const double e[3], double gradient[3],
                          double second[6])
{
    double distance = norm3(x);
    double sum = distance + dot3(x, e);
    double slope[3]; /* of the logarithm */
    for (int i = 0; i < 3; i++) {
        slope[i] = (x[i] / distance + e[i]) / sum;
        gradient[i] += scale * slope[i];
    }
    if (!second)
        return;
    double along = 1.0 / (distance * sum), round = along / (distance * distance);
    for (int k = 0; k < 6; k++) {
        int i = ROW[k], j = COLUMN[k];
        second[k] += scale * ((i == j ? along : 0.0) - round * x[i] * x[j] - slope[i] * slope[j]);
    }
}

/* the same of ln(R + z) - ln(R' + z'), x being seen from the point */
static void logarithms(const struct boussinesq3 *load, const double x[3], double gradient[3],
                       double second[6])
{
    memset(gradient, 0, 3 * sizeof *gradient);
    if (second)
        memset(second, 0, 6 * sizeof *second);
    if (isinf(load->reach)) {
        add_logarithm(1.0, x, load->inward, gradient, second);
        return;
    }
    double from_end[3] = {x[0], x[1], x[2]};
    add_scaled3(load->reach, load->inward, from_end);
    if (dot3(from_end, load->inward) > 0.0) {
        add_logarithm(1.0, x, load->inward, gradient, second);
        add_logarithm(-1.0, from_end, load->inward, gradient, second);
    } else {
        /* R + z = (distance from the axis)^2 / (R - z), and the distance cancels */
        double outward[3];
        scale3(-1.0, load->inward, outward);
        add_logarithm(-1.0, x, outward, gradient, second);
        add_logarithm(1.0, from_end, outward, gradient, second);
    }
}

void boussinesq3_field(const struct boussinesq3 *load, const double x[3], double displacement[3],
                       double stress[6])
{
    const double *e = load->inward;
    double poisson = load->poisson, side = 1.0 - 2.0 * poisson;
    double r[3];
    sub3(x, load->point, r);
    double z = dot3(r, e), square = dot3(r, r);
    double inverse = 1.0 / sqrt(square), cube = inverse / square;
    double gradient[3], second[6];
    logarithms(load, r, gradient, stress ? second : NULL);

    if (displacement) {
        double scale = (1.0 + poisson) / (2.0 * M_PI * load->young);
        for (int i = 0; i < 3; i++)
            displacement[i] = scale * (z * r[i] * cube + (3.0 - 4.0 * poisson) * e[i] * inverse -
                                       side * gradient[i]);
    }

    /* the field of nu = 1/2 has -3 z x x / R^5; the rest by Hooke's law */
    if (stress) {
        double push = -3.0 * z * cube / square;
        for (int k = 0; k < 6; k++) {
            int i = ROW[k], j = COLUMN[k];
            double rest =
                (i == j ? z * cube : 0.0) - (r[i] * e[j] + r[j] * e[i]) * cube - second[k];
            stress[k] = (push * r[i] * r[j] + side * rest) / (2.0 * M_PI);
        }
    }
}

/* adds `scale` times gradient and second derivatives (NULL: not wanted) of t.x/s, s = R + z */
static void add_share(double scale, const double x[3], const double e[3], const double t[3],
                      double gradient[3], double second[6])
{
    double distance = norm3(x), sum = distance + dot3(x, e), share = dot3(t, x) / sum, slope[3];
    for (int i = 0; i < 3; i++) {
        slope[i] = (x[i] / distance + e[i]) / sum; /* of ln s */
        gradient[i] += scale * (t[i] / sum - share * slope[i]);
    }
    for (int k = 0; second && k < 6; k++) {
        int i = ROW[k], j = COLUMN[k];
        double bend = ((i == j) - x[i] * x[j] / (distance * distance)) / (distance * sum);
        second[k] += scale * (share * (2.0 * slope[i] * slope[j] - bend) -
                              (t[i] * slope[j] + slope[i] * t[j]) / sum);
    }
}

/* the same of t.grad ln s = t.x g, g = 1/(R s) */
static void add_log_slope(double scale, const double x[3], const double e[3], const double t[3],
                          double gradient[3], double second[6])
{
    double square = dot3(x, x), distance = sqrt(square), sum = distance + dot3(x, e);
    double g = 1.0 / (distance * sum), lever = dot3(t, x), slope[3], fall[3];
    for (int i = 0; i < 3; i++) {
        slope[i] = (x[i] / distance + e[i]) / sum; /* of ln s */
        fall[i] = -g * (x[i] / square + slope[i]); /* of g */
        gradient[i] += scale * (t[i] * g + lever * fall[i]);
    }
    for (int k = 0; second && k < 6; k++) {
        int i = ROW[k], j = COLUMN[k];
        double pair = x[i] * x[j] / square, same = i == j;
        double bend =
            fall[i] * fall[j] / g - g * ((same - 2.0 * pair) / square +
                                         (same - pair) / (distance * sum) - slope[i] * slope[j]);
        second[k] += scale * (t[i] * fall[j] + t[j] * fall[i] + lever * bend);
    }
}

/* x seen from the end of the reach */
static void seen_from_end(const struct boussinesq3 *load, const double x[3], double from_end[3])
{
    sub3(x, load->point, from_end);
    add_scaled3(load->reach, load->inward, from_end);
}

/* The potential of Cerruti's field: t.x/s, less, with a reach L, t.x'/s' + L t.grad ln s'. Both
 * are singular alike on the line beyond; there R + z = (distance from the axis)^2 / (R - z), and
 * the distance cancels. */
static void cerruti_potential(const struct boussinesq3 *load, const double t[3], const double x[3],
                              double gradient[3], double second[6])
{
    double r[3], from_end[3], outward[3];
    const double *e = load->inward;
    sub3(x, load->point, r);
    memset(gradient, 0, 3 * sizeof *gradient);
    if (second)
        memset(second, 0, 6 * sizeof *second);
    if (isinf(load->reach)) {
        add_share(1.0, r, e, t, gradient, second);
        return;
    }
    seen_from_end(load, x, from_end);
    bool below = dot3(from_end, e) > 0.0;
    scale3(below ? 1.0 : -1.0, e, outward);
    add_share(1.0, r, outward, t, gradient, second);
    add_share(-1.0, from_end, outward, t, gradient, second);
    add_log_slope(below ? -load->reach : load->reach, from_end, outward, t, gradient, second);
}

/* What the reach adds along t besides, so that it is in equilibrium by itself: 1/R' + L z'/R'^3;
 * and its gradient (NULL: not wanted). */
static double cerruti_balance(const struct boussinesq3 *load, const double x[3], double gradient[3])
{
    double from_end[3];
    if (gradient)
        memset(gradient, 0, 3 * sizeof *gradient);
    if (isinf(load->reach))
        return 0.0;
    seen_from_end(load, x, from_end);
    double inverse = 1.0 / norm3(from_end), cube = inverse * inverse * inverse;
    double part = load->reach * dot3(from_end, load->inward);
    for (int i = 0; gradient && i < 3; i++)
        gradient[i] = load->reach * cube * load->inward[i] -
                      (1.0 + 3.0 * part * inverse * inverse) * cube * from_end[i];
    return inverse + part * cube;
}

/* stress += the potential's: second - e e.second - e.second e, and t grad b + grad b t */
static void add_potential_stress(const struct boussinesq3 *load, const double t[3],
                                 const double second[6], const double balance[3], double stress[6])
{
    const double *e = load->inward;
    double bent[3], scale = (1.0 - 2.0 * load->poisson) / (2.0 * M_PI);
    boussinesq3_traction(second, e, bent);
    for (int k = 0; k < 6; k++) {
        int i = ROW[k], j = COLUMN[k];
        stress[k] += scale * (second[k] - e[i] * bent[j] - e[j] * bent[i] + t[i] * balance[j] +
                              t[j] * balance[i]);
    }
}

void cerruti3_field(const struct boussinesq3 *load, const double along[3], const double x[3],
                    double displacement[3], double stress[6])
{
    const double *e = load->inward;
    double poisson = load->poisson, side = 1.0 - 2.0 * poisson;
    double r[3], gradient[3], second[6], slope[3];
    sub3(x, load->point, r);
    cerruti_potential(load, along, x, gradient, stress ? second : NULL);
    double balance = cerruti_balance(load, x, stress ? slope : NULL);
    double inverse = 1.0 / norm3(r), cube = inverse * inverse * inverse, lever = dot3(along, r);

    if (displacement) {
        double scale = (1.0 + poisson) / (2.0 * M_PI * load->young), depth = dot3(e, gradient);
        for (int i = 0; i < 3; i++)
            displacement[i] =
                scale * (lever * r[i] * cube + along[i] * inverse +
                         side * (gradient[i] - 2.0 * depth * e[i] + 2.0 * balance * along[i]));
    }

    /* Hooke's law; the dilatation is -2 (1 - 2 nu) x/R^3 */
    if (stress) {
        for (int k = 0; k < 6; k++) {
            int i = ROW[k], j = COLUMN[k];
            stress[k] = ((i == j ? lever * cube * side : 0.0) -
                         3.0 * lever * r[i] * r[j] * cube * inverse * inverse) /
                        (2.0 * M_PI);
        }
        add_potential_stress(load, along, second, slope, stress);
    }
}

void cerruti3_added_stress(const struct boussinesq3 *load, const double along[3], const double x[3],
                           double stress[6])
{
    double from_end[3], gradient[3] = {0.0}, second[6] = {0.0}, slope[3];
    memset(stress, 0, 6 * sizeof *stress);
    if (isinf(load->reach))
        return;
    seen_from_end(load, x, from_end);
    add_share(-1.0, from_end, load->inward, along, gradient, second);
    add_log_slope(-load->reach, from_end, load->inward, along, gradient, second);
    cerruti_balance(load, x, slope);
    add_potential_stress(load, along, second, slope, stress);
}

double cerruti3_added_displacement(const struct boussinesq3 *load)
{
    return 3.0 * boussinesq3_added_displacement(load);
}

/* Adds `even` times the mean curvature alike in all directions of the surface, and `bent` times
 * what the curvature has beside its mean. */
static void add_surface_tensor(const double n[3], const double curvature[9], double even,
                               double bent, double tensor[6])
{
    double mean = 0.5 * (curvature[0] + curvature[4] + curvature[8]);
    for (int k = 0; k < 6; k++) {
        int i = ROW[k], j = COLUMN[k];
        double flat = mean * ((i == j) - n[i] * n[j]);
        tensor[k] += even * flat + bent * (curvature[3 * i + j] - flat);
    }
}

void cerruti3_add_slope(double young, double poisson, const double normal[3],
                        const double curvature[9], double factor, double tensor[6])
{
    double unit = factor * (1.0 + poisson) / (2.0 * M_PI * young);
    add_surface_tensor(normal, curvature, unit * (1.5 + poisson * (2.0 * poisson - 1.0)),
                       unit * (0.25 + poisson * (1.5 - poisson)), tensor);
}

/* Means of ln(a/r) over pairs of points of a contact: of a traction like that of a contact that
 * sticks, (1 - r^2)^(-1/2), 3/2 - 2 ln 2, and of Hertz's, 7/4 - 2 ln 2. */
static const double PAIRS_STUCK = 1.5 - 2.0 * M_LN2, PAIRS_SLID = 1.75 - 2.0 * M_LN2;

/* A traction's part exp(i n angle)/r and a displacement's exp(-i n angle)/r about a point at the
 * distance r, integrated over a circle of the radius 1, are 2 pi (ln(1/r) - gamma - digamma((n +
 * 1)/2)): 2 ln 2 for n = 0, 2 ln 2 - 2 for n = 2, where the integral of both about one point has
 * ln(1/r) alone. Of S the part of n = 0 is S0 = (1 + nu)/(2 pi E) (1 - nu/2) (3/2 H (1 - n n^T) +
 * (1/4 + nu) (k - H (1 - n n^T))), all else is of n = 2. */
void cerruti3_add_contact(double young, double poisson, const double normal[3],
                          const double curvature[9], double tensor[6])
{
    const double first = 2.0 * M_LN2, second = first - 2.0;
    double unit = (first - second) * (1.0 + poisson) / (2.0 * M_PI * young) * (1.0 - 0.5 * poisson);
    cerruti3_add_slope(young, poisson, normal, curvature, second + 0.5 * (PAIRS_STUCK + PAIRS_SLID),
                       tensor);
    add_surface_tensor(normal, curvature, 1.5 * unit, (0.25 + poisson) * unit, tensor);
}

double cerruti3_contact_doubt(double young, double poisson, double curvature, double mean)
{
    const double none[3] = {0.0, 0.0, 1.0};
    const double bent[9] = {curvature, 0.0, 0.0, 0.0, 2.0 * mean - curvature};
    double slope[6] = {0.0};
    double tilt = (1.0 + poisson) * (1.0 - 2.0 * poisson) / (4.0 * M_PI * young);
    cerruti3_add_slope(young, poisson, none, bent, 1.0, slope);
    return 0.5 * (PAIRS_SLID - PAIRS_STUCK) * fabs(slope[0]) + tilt * fabs(curvature);
}

void boussinesq3_added_stress(const struct boussinesq3 *load, const double x[3], double stress[6])
{
    double from_end[3], gradient[3] = {0.0}, second[6] = {0.0};
    if (isfinite(load->reach)) {
        seen_from_end(load, x, from_end);
        add_logarithm(1.0, from_end, load->inward, gradient, second);
    }
    for (int k = 0; k < 6; k++)
        stress[k] = (1.0 - 2.0 * load->poisson) / (2.0 * M_PI) * second[k];
}

double boussinesq3_added_displacement(const struct boussinesq3 *load)
{
    if (isinf(load->reach))
        return 0.0;
    double scale = (1.0 + load->poisson) / (2.0 * M_PI * load->young);
    return scale * (1.0 - 2.0 * load->poisson) / load->reach;
}
