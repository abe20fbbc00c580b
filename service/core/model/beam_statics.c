/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Statics of a beam: its compliance between two loads, the deformation of its section where its
 * side is hit, and the shear factors of its sections. */
#include "model/beam.h"

#include <math.h>

/* Here s = x/length in [-1/2, 1/2], lengths count in `length`, forces in the unit force, moments
 * accordingly; EI = 1 and compliances count in length^3/EI. The tighter support is on the left. */
struct statics {
    double inertia, shear; /* rhoI/(rhoA L^2), EI/(kGA L^2) */
    enum support supports[2];
};

/* Shear V and moment M in equilibrium with a load: V' + force density = 0 and
 * M' + V + moment density = 0, both integrated from the right end. */
struct field {
    double s, force, moment; /* the load */
    double shift, rotation;  /* acceleration w'' = shift + rotation s of the beam as a rigid body */
    double end_force, end_moment; /* the right support's reaction */
};

static double shear_at(const struct field *field, double s)
{
    double below = s < field->s ? 1.0 : 0.0;

    return below * field->force + field->end_force - field->shift * (0.5 - s) -
           0.5 * field->rotation * (0.5 - s) * (0.5 + s);
}

static double moment_at(const struct field *field, double inertia, double s)
{
    double below = s < field->s ? 1.0 : 0.0;
    double rest = 0.5 - s;

    return below * (field->force * (field->s - s) + field->moment) + field->end_moment +
           field->end_force * rest - 0.5 * field->shift * rest * rest -
           field->rotation * rest * (rest * (1.0 + s) / 6.0 + inertia);
}

/* Complementary energy of two fields over a part where both are cubic at most: four Gauss points
 * (Abramowitz & Stegun 25.4.30) are exact for the product's degree of six. */
static double energy_between(const struct statics *statics, const struct field *i,
                             const struct field *j, double from, double to)
{
    static const double node[2] = {0.33998104358485626480, 0.86113631159405257522};
    static const double weight[2] = {0.65214515486254614263, 0.34785484513745385737};
    double centre = 0.5 * (from + to), half = 0.5 * (to - from), sum = 0.0;

    if (!(half > 0.0))
        return 0.0;
    for (int k = 0; k < 4; k++) {
        double s = centre + (k % 2 ? half : -half) * node[k / 2];
        sum +=
            weight[k / 2] * (statics->shear * shear_at(i, s) * shear_at(j, s) +
                             moment_at(i, statics->inertia, s) * moment_at(j, statics->inertia, s));
    }
    return half * sum;
}

static double energy(const struct statics *statics, const struct field *i, const struct field *j)
{
    double first = fmin(i->s, j->s), last = fmax(i->s, j->s);

    return energy_between(statics, i, j, -0.5, first) + energy_between(statics, i, j, first, last) +
           energy_between(statics, i, j, last, 0.5);
}

/* The accelerations of the rigid motions that the supports allow take up the load (d'Alembert). */
static void balance_by_inertia(const struct statics *statics, struct field *field)
{
    double inertia = statics->inertia;

    if (statics->supports[0] == SUPPORT_FREE) {
        field->shift = field->force;
        field->rotation = (field->force * field->s + field->moment) / (1.0 / 12.0 + inertia);
    } else if (statics->supports[0] == SUPPORT_PINNED) {
        field->rotation = (field->force * (field->s + 0.5) + field->moment) / (1.0 / 3.0 + inertia);
        field->shift = 0.5 * field->rotation;
    }
}

/* The right support's reaction: from the moment about a pin on the left; on a beam clamped on the
 * left each redundant state of self-stress gets the share that makes the complementary energy least
 * (Castigliano, Menabrea). The states of two clamps, shear about the middle and pure bending, are
 * orthogonal. */
static void react(const struct statics *statics, struct field *field)
{
    struct field shear = {.end_force = 1.0}, bending = {.end_moment = 1.0};

    if (statics->supports[0] == SUPPORT_PINNED) {
        field->end_force = -(field->force * (field->s + 0.5) + field->moment);
        return;
    }
    if (statics->supports[1] == SUPPORT_CLAMPED) {
        shear.end_moment = -0.5;
        field->end_moment = -energy(statics, field, &bending);
    }
    double lever = 0.5 + shear.end_moment; /* of the state's moment, lever - s */
    double share = -energy(statics, field, &shear) / (statics->shear + 1.0 / 12.0 + lever * lever);
    field->end_force = share;
    field->end_moment += share * shear.end_moment;
}

static struct field field_of(const struct statics *statics, const struct beam_plane *plane,
                             const struct beam_load *load, bool mirrored)
{
    double sign = mirrored ? -1.0 : 1.0;
    struct field field = {
        .s = sign * load->x / plane->length,
        .force = load->force,
        .moment = sign * load->moment / plane->length,
    };

    if (statics->supports[1] != SUPPORT_FREE)
        react(statics, &field);
    else
        balance_by_inertia(statics, &field);
    return field;
}

/* A load as forces and moments at places: the mean of psi' is a difference of rotations. */
static size_t parts_of(const struct beam_plane *plane, const struct beam_load *load,
                       struct beam_load parts[3])
{
    double end = 0.5 * plane->length;
    double from = fmax(load->x - 0.5 * load->window, -end);
    double to = fmin(load->x + 0.5 * load->window, end);

    parts[0] = (struct beam_load){.x = load->x, .force = load->force, .moment = load->moment};
    if (load->curvature == 0.0)
        return 1;
    parts[1] = (struct beam_load){.x = from, .moment = -load->curvature / (to - from)};
    parts[2] = (struct beam_load){.x = to, .moment = load->curvature / (to - from)};
    return 3;
}

double beam_compliance(const struct beam_plane *plane, const struct beam_load *i,
                       const struct beam_load *j)
{
    double square = plane->length * plane->length;
    bool mirrored = plane->supports[0] < plane->supports[1];
    struct statics statics = {
        .inertia = plane->line_inertia / (plane->line_mass * square),
        .shear = plane->bending_stiffness / (plane->shear_stiffness * square),
        .supports = {plane->supports[mirrored], plane->supports[!mirrored]},
    };
    struct beam_load parts[2][3];
    struct field fields[2][3];
    size_t counts[2] = {parts_of(plane, i, parts[0]), parts_of(plane, j, parts[1])};
    double sum = 0.0;

    for (int side = 0; side < 2; side++)
        for (size_t k = 0; k < counts[side]; k++)
            fields[side][k] = field_of(&statics, plane, &parts[side][k], mirrored);
    /* of a load on itself each pair once */
    for (size_t k = 0; k < counts[0]; k++)
        for (size_t l = i == j ? k : 0; l < counts[1]; l++)
            sum += (i == j && l > k ? 2.0 : 1.0) * energy(&statics, &fields[0][k], &fields[1][l]);
    return square * plane->length / plane->bending_stiffness * sum;
}

/* The side of a bent bar: the deformation of its section, and the remaining compliance of the
 * loaded place. */

/* Window of the mean of psi', in longer sides of the section: with it beam_side_load moves a side
 * as the modes of meshes do, to 1 % up to waves of 1.8 heights (docs/lab/accuracy.md). */
static const double WINDOW = 0.7;

/* The remainder of the static compliance under a point force on a mesh of the bar (its half-space
 * taken off), times E and the depth h of the section: it depends neither on the length nor on the
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
/* Sections that are broader than this many depths bend across their breadth more than along it: the
 * fit does not describe plates. The terms fall to zero from the first ratio to the second. */
static const double STRIP[2] = {3.0, 5.0};
/* The same of a round section, h its diameter and a contact of a tenth of its radius; off by 0.02.
 */
static const double ROUND[3] = {-0.720, -1.43, 1.65};

static double poisson_polynomial(const double factors[3], double nu)
{
    return factors[0] + nu * (factors[1] + nu * factors[2]);
}

/* Of the rows of a table. */
static double at_breadth(size_t rows, const double table[][3], double s, double nu)
{
    double sum = 0.0, power = 1.0 / s;

    for (size_t i = 0; i < rows; i++, power *= s)
        sum += power * poisson_polynomial(table[i], nu);
    return sum;
}

/* Factor of these terms for a section: 1 up to the first ratio, 0 from the second. */
static double strip_factor(double depth, double breadth)
{
    return fmax(0.0, fmin((STRIP[1] - breadth / depth) / (STRIP[1] - STRIP[0]), 1.0));
}

static double larger_side(const struct body *body)
{
    return body->radius > 0.0 ? 2.0 * body->radius : fmax(body->width, body->height);
}

/* A held section keeps its outline: 0 there, 1 from half the window away, where it is free to
 * deform. */
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
        nu *= plane == 1 ? strip_factor(body->height, body->width)
                         : strip_factor(body->width, body->height);

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
        return poisson_polynomial(ROUND, nu) / (young * 2.0 * body->radius);
    bool on_top = fabs(outward[2]) > fabs(outward[1]);
    double depth = on_top ? body->height : body->width;
    double breadth = on_top ? body->width : body->height;
    double s = fmax(BREADTH[0], fmin(breadth / depth, BREADTH[1]));
    double eta = fmin(2.0 * fabs(on_top ? point[1] : point[2]) / breadth, BEAM_SIDE_FARTHEST);
    double square = eta * eta;
    double local = at_breadth(4, CENTRE, s, nu) + at_breadth(3, ASIDE, s, nu) * square +
                   at_breadth(2, EDGES, s, nu) * 2.0 * square / (1.0 - square);

    return strip_factor(depth, breadth) * local / (young * depth);
}

/* Shear factors. */

/* Cowper 1966, J. Appl. Mech. 33, 335. */
double beam_shear_cowper_circle(double poisson)
{
    return 6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson);
}

double beam_shear_cowper_rectangle(double poisson)
{
    return 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson);
}

/* Hutchinson 2001, J. Appl. Mech. 68, 87. */
double beam_shear_hutchinson_circle(double poisson)
{
    return 6.0 * (1.0 + poisson) * (1.0 + poisson) /
           (7.0 + 12.0 * poisson + 4.0 * poisson * poisson);
}

/* Sum over n >= 1 of (z - tanh z)/(n pi)^5 with z = n pi/t: the sums of z and of 1 have closed
 * forms (zeta(4), zeta(5)), and 1 - tanh z = 2/(exp(2z) + 1) falls geometrically. */
static double flexure_sum(double t)
{
    static const double zeta5 = 1.03692775514336992633;
    double sum = 1.0 / (90.0 * t) - zeta5 / pow(M_PI, 5.0);

    for (int n = 1; n < 10000; n++) {
        double term = 2.0 / ((exp(2.0 * n * M_PI / t) + 1.0) * pow(n * M_PI, 5.0));
        sum += term;
        if (term < 1e-17 * fabs(sum))
            break;
    }
    return sum;
}

/* k = -2(1+nu)/[9 C4/(4 a^5 b) + nu(1 - b^2/a^2)] for depth 2a and width 2b, with
 * C4 = (4/45) a^3 b (-12a^2 - 15 nu a^2 + 5 nu b^2)
 *      + sum 16 nu^2 b^5 (n pi a - b tanh(n pi a/b))/((n pi)^5 (1+nu)).
 * Written with t = b/a the terms of nu t^2 cancel. */
double beam_shear_hutchinson_rectangle(double poisson, double depth, double breadth)
{
    double t = breadth / depth;
    double warping = 36.0 * poisson * poisson * pow(t, 5.0) * flexure_sum(t) / (1.0 + poisson);

    return 2.0 * (1.0 + poisson) / (2.4 + 2.0 * poisson - warping);
}
