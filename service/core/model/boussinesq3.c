/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/boussinesq3.h"

#include <math.h>
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

/* gradient and second derivatives of t.x/s, s = R + z; x being seen from the point */
static void cerruti_potential(const double x[3], const double e[3], const double t[3],
                              double gradient[3], double second[3][3])
{
    double distance = norm3(x), sum = distance + dot3(x, e), share = dot3(t, x) / sum, slope[3];
    for (int i = 0; i < 3; i++) {
        slope[i] = (x[i] / distance + e[i]) / sum; /* of ln s */
        gradient[i] = t[i] / sum - share * slope[i];
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double bend = ((i == j) - x[i] * x[j] / (distance * distance)) / (distance * sum);
            second[i][j] = share * (2.0 * slope[i] * slope[j] - bend) -
                           (t[i] * slope[j] + slope[i] * t[j]) / sum;
        }
}

void cerruti3_field(const struct boussinesq3 *load, const double along[3], const double x[3],
                    double displacement[3], double stress[6])
{
    const double *e = load->inward;
    double poisson = load->poisson, side = 1.0 - 2.0 * poisson;
    double r[3], gradient[3], second[3][3], bent[3];
    sub3(x, load->point, r);
    cerruti_potential(r, e, along, gradient, second);
    double inverse = 1.0 / norm3(r), cube = inverse * inverse * inverse, lever = dot3(along, r);

    if (displacement) {
        double scale = (1.0 + poisson) / (2.0 * M_PI * load->young), depth = dot3(e, gradient);
        for (int i = 0; i < 3; i++)
            displacement[i] = scale * (lever * r[i] * cube + along[i] * inverse +
                                       side * (gradient[i] - 2.0 * depth * e[i]));
    }

    /* Hooke's law; the dilatation is -2 (1 - 2 nu) x/R^3 */
    for (int j = 0; j < 3; j++)
        bent[j] = e[0] * second[0][j] + e[1] * second[1][j] + e[2] * second[2][j];
    for (int k = 0; stress && k < 6; k++) {
        int i = ROW[k], j = COLUMN[k];
        double own = (i == j ? lever * cube * side : 0.0) -
                     3.0 * lever * r[i] * r[j] * cube * inverse * inverse;
        stress[k] = (own + side * (second[i][j] - e[i] * bent[j] - e[j] * bent[i])) / (2.0 * M_PI);
    }
}

void boussinesq3_added_stress(const struct boussinesq3 *load, const double x[3], double stress[6])
{
    double from_end[3], gradient[3] = {0.0}, second[6] = {0.0};
    if (isfinite(load->reach)) {
        sub3(x, load->point, from_end);
        add_scaled3(load->reach, load->inward, from_end);
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
