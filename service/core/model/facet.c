/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/facet.h"

#include <math.h>
#include <string.h>

#include "model/vector.h"

/* Newton's steps from the best of a grid of points: quadratic, 4 to 6 suffice */
static const int MOST_STEPS = 30;
/* a step this small in local coordinates moves the point by rounding only */
static const double SMALLEST_STEP = 1e-13;
/* by which a point may lie beyond the edge and count as on the face */
static const double ROUNDING = 1e-12;

/* value, d/du, d/dv, d2/du2, d2/dudv, d2/dv2 of each shape function */
enum { VALUE, U, V, UU, UV, VV, KINDS };

static const double QUAD_NODES[9][2] = {{-1, -1}, {1, -1}, {1, 1},  {-1, 1}, {0, -1},
                                        {1, 0},   {0, 1},  {-1, 0}, {0, 0}};
static const double TRIANGLE_NODES[6][2] = {{0, 0}, {1, 0}, {0, 1}, {.5, 0}, {.5, .5}, {0, .5}};

/* in L0 = 1 - u - v, L1 = u, L2 = v: corners L(2L - 1), mid nodes 4 L L'; the first `kinds` */
static void triangle_shape(double u, double v, int kinds, double d[KINDS][FACET_MOST_NODES])
{
    const double l[3] = {1.0 - u - v, u, v};
    static const double SLOPE[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
    /* the corner, and its derivatives */
    for (int i = 0; i < 3; i++) {
        const double *s = SLOPE[i];
        d[VALUE][i] = l[i] * (2.0 * l[i] - 1.0);
        d[U][i] = (4.0 * l[i] - 1.0) * s[0];
        d[V][i] = (4.0 * l[i] - 1.0) * s[1];

        /* the mid node after it */
        int j = (i + 1) % 3;
        const double *t = SLOPE[j];
        d[VALUE][3 + i] = 4.0 * l[i] * l[j];
        d[U][3 + i] = 4.0 * (s[0] * l[j] + l[i] * t[0]);
        d[V][3 + i] = 4.0 * (s[1] * l[j] + l[i] * t[1]);
        if (kinds < KINDS)
            continue;
        d[UU][i] = 4.0 * s[0] * s[0];
        d[UV][i] = 4.0 * s[0] * s[1];
        d[VV][i] = 4.0 * s[1] * s[1];
        d[UU][3 + i] = 8.0 * s[0] * t[0];
        d[UV][3 + i] = 4.0 * (s[0] * t[1] + s[1] * t[0]);
        d[VV][3 + i] = 8.0 * s[1] * t[1];
    }
}

/* the parabolas that are 1 at -1, 0, 1 and 0 at the others; value and two derivatives */
static void parabolas(double x, double f[3][3])
{
    for (int node = -1; node <= 1; node++) {
        double *g = f[node + 1];
        g[0] = node == 0 ? 1.0 - x * x : 0.5 * x * (x + node);
        g[1] = node == 0 ? -2.0 * x : x + 0.5 * node;
        g[2] = node == 0 ? -2.0 : 1.0;
    }
}

/* products of parabolas, the first `kinds`; without a node in the middle its value is spread over
 * the others, which are there -1/4 (corners) and 1/2 (mid nodes) */
static void quad_shape(int count, double u, double v, int kinds, double d[KINDS][FACET_MOST_NODES])
{
    /* derivatives along u and v of each kind */
    static const int ORDER[KINDS][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
    /* the parabolas of each node */
    static const int ROW[9] = {0, 2, 2, 0, 1, 2, 1, 0, 1}, COLUMN[9] = {0, 0, 2, 2, 0, 1, 2, 1, 1};
    double f[3][3], g[3][3];
    parabolas(u, f);
    parabolas(v, g);
    for (int k = 0; k < kinds; k++) {
        int a = ORDER[k][0], b = ORDER[k][1];
        for (int i = 0; i < 9; i++)
            d[k][i] = f[ROW[i]][a] * g[COLUMN[i]][b];
        for (int i = 0; count == 8 && i < 8; i++)
            d[k][i] += (i < 4 ? -0.25 : 0.5) * d[k][8];
    }
}

/* the first `kinds` of them */
static void shape(int count, double u, double v, int kinds, double d[KINDS][FACET_MOST_NODES])
{
    if (count == 6)
        triangle_shape(u, v, kinds, d);
    else
        quad_shape(count, u, v, kinds, d);
}

void facet_shape(int count, double u, double v, double *n, double *du, double *dv)
{
    double d[KINDS][FACET_MOST_NODES];
    shape(count, u, v, du || dv ? V + 1 : VALUE + 1, d);
    memcpy(n, d[VALUE], (size_t)count * sizeof *n);
    if (du)
        memcpy(du, d[U], (size_t)count * sizeof *du);
    if (dv)
        memcpy(dv, d[V], (size_t)count * sizeof *dv);
}

void facet_node(int count, int node, double *u, double *v)
{
    const double *at = count == 6 ? TRIANGLE_NODES[node] : QUAD_NODES[node];
    *u = at[0];
    *v = at[1];
}

/* sums over the nodes by each kind of shape functions */
static void sum_nodes(int count, const double (*points)[3], int kinds,
                      double d[KINDS][FACET_MOST_NODES], double (*x)[3])
{
    memset(x, 0, (size_t)kinds * sizeof *x);
    for (int k = 0; k < kinds; k++)
        for (int i = 0; i < count; i++)
            add_scaled3(d[k][i], points[i], x[k]);
}

/* the point and its derivatives, x[VALUE] .., the first `kinds` of them */
static void place(int count, const double (*points)[3], double u, double v, int kinds,
                  double (*x)[3])
{
    double d[KINDS][FACET_MOST_NODES];
    shape(count, u, v, kinds, d);
    sum_nodes(count, points, kinds, d, x);
}

void facet_place(int count, const double (*points)[3], double u, double v, double point[3],
                 double area[3])
{
    double x[KINDS][3];
    place(count, points, u, v, area ? V + 1 : VALUE + 1, x);
    if (point)
        memcpy(point, x[VALUE], sizeof x[VALUE]);
    if (area)
        cross3(x[U], x[V], area);
}

void facet_look(int count, const double (*points)[3], double u, double v, double *n,
                double point[3], double area[3])
{
    double d[KINDS][FACET_MOST_NODES], x[V + 1][3];
    shape(count, u, v, V + 1, d);
    sum_nodes(count, points, V + 1, d, x);
    memcpy(n, d[VALUE], (size_t)count * sizeof *n);
    memcpy(point, x[VALUE], sizeof x[VALUE]);
    cross3(x[U], x[V], area);
}

bool facet_is_inside(int count, double u, double v, double margin)
{
    if (count == 6)
        return u >= -margin && v >= -margin && u + v <= 1.0 + margin;
    return fabs(u) <= 1.0 + margin && fabs(v) <= 1.0 + margin;
}

double facet_lowest(int count, const double *h)
{
    int corners = count == 6 ? 3 : 4;
    double edge[4];
    double lowest = INFINITY;
    for (int i = 0; i < corners; i++) {
        edge[i] = facet_control(h[i], h[corners + i], h[(i + 1) % corners]);
        lowest = fmin(lowest, fmin(h[i], edge[i]));
    }
    if (corners == 3)
        return lowest;
    /* without a middle node: interpolated from the others */
    double middle =
        count == 9 ? h[8] : 0.5 * (h[4] + h[5] + h[6] + h[7]) - 0.25 * (h[0] + h[1] + h[2] + h[3]);
    return fmin(lowest, facet_control(edge[0], facet_control(h[7], middle, h[5]), edge[2]));
}

static double distance_at(int count, const double (*points)[3], const double p[3], double u,
                          double v)
{
    double point[3];
    facet_place(count, points, u, v, point, NULL);
    sub3(point, p, point);
    return norm3(point);
}

/* where Newton's method minimises half of |x - p|^2 along `direction` (a way within the face) or,
 * where that is NULL, over both coordinates; starts at and returns in at[2] */
static void descend(int count, const double (*points)[3], const double p[3],
                    const double *direction, double at[2])
{
    for (int step = 0; step < MOST_STEPS; step++) {
        double x[KINDS][3], r[3];
        place(count, points, at[0], at[1], KINDS, x);
        sub3(x[VALUE], p, r);

        /* gradient and second derivatives; those of a saddle without their curved part */
        double g[2] = {dot3(r, x[U]), dot3(r, x[V])};
        double flat[3] = {dot3(x[U], x[U]), dot3(x[U], x[V]), dot3(x[V], x[V])};
        double h[3] = {flat[0] + dot3(r, x[UU]), flat[1] + dot3(r, x[UV]),
                       flat[2] + dot3(r, x[VV])};

        /* the step, not longer than half the face */
        double s[2];
        if (direction) {
            const double *t = direction;
            double slope = g[0] * t[0] + g[1] * t[1];
            double bend = h[0] * t[0] * t[0] + 2.0 * h[1] * t[0] * t[1] + h[2] * t[1] * t[1];
            double least =
                flat[0] * t[0] * t[0] + 2.0 * flat[1] * t[0] * t[1] + flat[2] * t[1] * t[1];
            double length = -slope / (bend > 0.1 * least ? bend : least);
            s[0] = length * t[0];
            s[1] = length * t[1];
        } else {
            double determinant = h[0] * h[2] - h[1] * h[1];
            if (!(h[0] > 0.0 && determinant > 0.01 * (flat[0] * flat[2] - flat[1] * flat[1]))) {
                memcpy(h, flat, sizeof h);
                determinant = h[0] * h[2] - h[1] * h[1];
            }
            s[0] = (h[1] * g[1] - h[2] * g[0]) / determinant;
            s[1] = (h[1] * g[0] - h[0] * g[1]) / determinant;
        }
        double length = hypot(s[0], s[1]), scale = length > 0.5 ? 0.5 / length : 1.0;
        if (!isfinite(length))
            return;
        at[0] += scale * s[0];
        at[1] += scale * s[1];
        /* far outside the face its polynomials mean nothing */
        if (length < SMALLEST_STEP || !facet_is_inside(count, at[0], at[1], 1.0))
            return;
    }
}

static void keep_nearer(int count, const double (*points)[3], const double p[3], const double at[2],
                        struct facet_foot *best)
{
    double distance = distance_at(count, points, p, at[0], at[1]);
    if (distance < best->distance) {
        best->u = at[0];
        best->v = at[1];
        best->distance = distance;
    }
}

/* the nearest point of the edge from one corner to the next: its middle part from the nearest of
 * four places, and its ends */
static void search_edge(int count, const double (*points)[3], const double p[3], int edge,
                        struct facet_foot *best)
{
    /* the edge in local coordinates */
    int corners = count == 6 ? 3 : 4;
    double from[2], to[2], way[2];
    facet_node(count, edge, &from[0], &from[1]);
    facet_node(count, (edge + 1) % corners, &to[0], &to[1]);
    for (int i = 0; i < 2; i++)
        way[i] = to[i] - from[i];

    /* the nearest of four, as a bent edge may have several feet */
    double start = 0.5, nearest = INFINITY;
    for (int i = 1; i < 8; i += 2) {
        double t = i / 8.0;
        double distance = distance_at(count, points, p, from[0] + t * way[0], from[1] + t * way[1]);
        start = distance < nearest ? t : start;
        nearest = fmin(nearest, distance);
    }
    /* downhill from there, along the edge */
    double at[2] = {from[0] + start * way[0], from[1] + start * way[1]};
    descend(count, points, p, way, at);
    double t = ((at[0] - from[0]) * way[0] + (at[1] - from[1]) * way[1]) /
               (way[0] * way[0] + way[1] * way[1]);
    /* a foot inside the edge, and the corner it starts at */
    if (t > 0.0 && t < 1.0)
        keep_nearer(count, points, p, at, best);
    keep_nearer(count, points, p, from, best);
}

/* the nearest of a grid of points in the face, from which the search starts */
static void start_inside(int count, const double (*points)[3], const double p[3], double at[2])
{
    enum { GRID = 4 };
    double nearest = INFINITY;
    for (int i = 0; i < GRID; i++)
        for (int j = 0; j < GRID; j++) {
            double u = (i + 0.5) / GRID, v = (j + 0.5) / GRID;
            if (count == 6)
                v *= 1.0 - u;
            else
                u = 2.0 * u - 1.0, v = 2.0 * v - 1.0;
            double distance = distance_at(count, points, p, u, v);
            if (distance < nearest) {
                nearest = distance;
                at[0] = u;
                at[1] = v;
            }
        }
}

struct facet_foot facet_closest(int count, const double (*points)[3], const double p[3])
{
    struct facet_foot best = {.distance = INFINITY, .at_rim = true};
    double at[2] = {0.0, 0.0};
    start_inside(count, points, p, at);
    double start[2] = {at[0], at[1]};
    descend(count, points, p, NULL, at);

    /* a foot in the face that is no farther than where the search started is it; else the rim */
    if (facet_is_inside(count, at[0], at[1], ROUNDING) &&
        distance_at(count, points, p, at[0], at[1]) <=
            distance_at(count, points, p, start[0], start[1])) {
        keep_nearer(count, points, p, at, &best);
        best.at_rim = !facet_is_inside(count, at[0], at[1], -ROUNDING);
    } else {
        for (int edge = 0; edge < (count == 6 ? 3 : 4); edge++)
            search_edge(count, points, p, edge, &best);
    }
    facet_place(count, points, best.u, best.v, best.point, NULL);
    return best;
}
