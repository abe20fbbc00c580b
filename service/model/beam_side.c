/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The side of a bent bar: how its section deforms, and how the place that is hit gives way beside
 * that. */
#include "model/beam.h"

#include <math.h>

/* The mean of psi' is taken over so much of the section's longer side: with that the modes of
 * meshes move their sides as beam_side_load says to 1 % up to waves of 1.8 heights
 * (docs/accuracy.md). */
static const double WINDOW = 0.7;

/* What remains of the static compliance under a point force on a mesh of the bar (its half-space
 * taken off), times E and the depth of the section h: it depends neither on the length nor on the
 * place along it, but within half a depth of an end. A fit to 660 solutions for breadths of 0.4 to
 * 2.5 depths and Poisson's ratios of 0 to 0.48, with eta the distance from the axis over half the
 * breadth, up to 0.85, s = breadth/depth:
 *
 *     local = A(s, nu) + B(s, nu) eta^2 + C(s, nu) 2 eta^2/(1 - eta^2),
 *
 * the last being that of the two edges: off by 0.036 on the axis, by 0.07 up to eta 0.7 and 0.16
 * beyond, by less than 0.14 h/breadth where that is more. `physics/mesh/test_beam_sides` solves
 * anew. Rows: powers of s from -1 up; columns: powers of nu. */
static const double CENTRE[4][3] = {
    {0.171, -0.449, 1.231}, {-1.877, 0.416, -0.463}, {0.742, -0.297, 0.0}, {-0.087, 0.129, 0.0}};
static const double ASIDE[3][3] = {
    {0.824, 1.301, 0.0}, {-2.236, -1.403, 0.0}, {0.294, -0.157, 0.0}};
static const double EDGES[2][3] = {{0.324, 0.191, -0.079}, {0.098, -0.146, 0.721}};
static const double BREADTH[2] = {0.4, 2.5};
static const double FARTHEST = 0.85;
/* Sections more than so many times as broad as deep bend across their breadth more than along it:
 * plates, whose sides nothing here describes. From the first to the second the terms are let go. */
static const double STRIP[2] = {3.0, 5.0};
/* The same of a round section, h its diameter and a contact of a tenth of its radius; off by 0.02.
 */
static const double ROUND[3] = {-0.720, -1.43, 1.65};

static double polynomial(const double factors[3], double nu)
{
    return factors[0] + nu * (factors[1] + nu * factors[2]);
}

/* Of the rows of a table. */
static double at_breadth(size_t rows, const double table[][3], double s, double nu)
{
    double sum = 0.0, power = 1.0 / s;

    for (size_t i = 0; i < rows; i++, power *= s)
        sum += power * polynomial(table[i], nu);
    return sum;
}

/* How much of them a section keeps for bending along its depth. */
static double kept(double depth, double breadth)
{
    return fmax(0.0, fmin((STRIP[1] - breadth / depth) / (STRIP[1] - STRIP[0]), 1.0));
}

static double larger_side(const struct body *body)
{
    return body->radius > 0.0 ? 2.0 * body->radius : fmax(body->width, body->height);
}

/* A held section keeps its outline: from half the window away on it is free to deform. */
static double freed(const struct body *body, double x, double window)
{
    double share = 1.0;
    for (int end = 0; end < 2; end++)
        if (body->supports[end] != SUPPORT_FREE)
            share = fmin(share, (0.5 * body->span + (end == 0 ? x : -x)) / (0.5 * window));
    return fmax(share, 0.0);
}

struct beam_load beam_side_load(const struct body *body, int plane, const double point[3],
                                const double direction[3])
{
    double along = point[1 + plane], across = point[2 - plane];
    double mean = (body->second_moment[plane] - body->second_moment[1 - plane]) / body->area;
    double nu = body->theory == THEORY_TIMOSHENKO ? body->material.poisson : 0.0;
    double window = WINDOW * larger_side(body);
    nu *= freed(body, point[0], window);
    if (body->radius == 0.0)
        nu *= plane == 1 ? kept(body->height, body->width) : kept(body->width, body->height);

    return (struct beam_load){
        .curvature = nu * (0.5 * (along * along - across * across - mean) * direction[1 + plane] +
                           along * across * direction[2 - plane]),
        .window = window,
    };
}

double beam_side_compliance(const struct body *body, const double point[3], const double outward[3])
{
    double nu = fmax(body->material.poisson, 0.0), young = body->material.young;

    if (body->radius > 0.0)
        return polynomial(ROUND, nu) / (young * 2.0 * body->radius);
    bool on_top = fabs(outward[2]) > fabs(outward[1]);
    double depth = on_top ? body->height : body->width;
    double breadth = on_top ? body->width : body->height;
    double s = fmax(BREADTH[0], fmin(breadth / depth, BREADTH[1]));
    double eta = fmin(2.0 * fabs(on_top ? point[1] : point[2]) / breadth, FARTHEST);
    double square = eta * eta;
    double local = at_breadth(4, CENTRE, s, nu) + at_breadth(3, ASIDE, s, nu) * square +
                   at_breadth(2, EDGES, s, nu) * 2.0 * square / (1.0 - square);

    return kept(depth, breadth) * local / (young * depth);
}
