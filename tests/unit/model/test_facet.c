/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Of model/facet.h: polynomials that shape functions must reproduce, and feet on surfaces whose
 * nearest points are known. */
#include "check.h"
#include "model/facet.h"
#include "model/vector.h"

static const int COUNTS[] = {6, 8, 9};

/* a face whose nodes are images of their local coordinates */
static void make(int count, void (*map)(double, double, double[3]), double points[9][3])
{
    for (int i = 0; i < count; i++) {
        double u, v;
        facet_node(count, i, &u, &v);
        map(u, v, points[i]);
    }
}

/* second-order functions are reproduced with their derivatives, by rounding */
static void reproduces_parabolas(void **state)
{
    (void)state;
    for (size_t c = 0; c < COUNT(COUNTS); c++) {
        int count = COUNTS[c];
        double u = 0.3, v = 0.45, n[9], du[9], dv[9], sum[3] = {0};
        facet_shape(count, u, v, n, du, dv);
        for (int i = 0; i < count; i++) {
            double a, b;
            facet_node(count, i, &a, &b);
            double f = 1.0 + 2.0 * a - b + 3.0 * a * a + 0.5 * a * b - 2.0 * b * b;
            sum[0] += n[i] * f;
            sum[1] += du[i] * f;
            sum[2] += dv[i] * f;
        }
        near(sum[0], 1.0 + 2.0 * u - v + 3.0 * u * u + 0.5 * u * v - 2.0 * v * v, 1e-14);
        near(sum[1], 2.0 + 6.0 * u + 0.5 * v, 1e-14);
        near(sum[2], -1.0 + 0.5 * u - 4.0 * v, 1e-14);
    }
}

/* a node's own function is 1 there, the others are 0 */
static void interpolates(void **state)
{
    (void)state;
    for (size_t c = 0; c < COUNT(COUNTS); c++)
        for (int i = 0; i < COUNTS[c]; i++) {
            double u, v, n[9];
            facet_node(COUNTS[c], i, &u, &v);
            facet_shape(COUNTS[c], u, v, n, NULL, NULL);
            for (int j = 0; j < COUNTS[c]; j++)
                near(n[j], i == j ? 1.0 : 0.0, 1e-15);
        }
}

static void askew_plane(double u, double v, double x[3])
{
    x[0] = 2.0 * u + 0.3 * v + 0.1 * u * u;
    x[1] = 0.2 * u + 1.5 * v - 0.1 * u * v;
    x[2] = 0.25;
}

/* over a plane with mid nodes out of the middle the foot is straight below */
static void finds_the_foot_on_a_plane(void **state)
{
    (void)state;
    for (size_t c = 0; c < COUNT(COUNTS); c++) {
        double points[9][3], x[3], area[3];
        make(COUNTS[c], askew_plane, points);
        facet_place(COUNTS[c], points, 0.2, 0.35, x, area);
        near(area[0], 0.0, 1e-15);
        near(area[1], 0.0, 1e-15);
        assert_true(area[2] > 0.0);
        double p[3] = {x[0], x[1], 1.25};
        struct facet_foot foot = facet_closest(COUNTS[c], points, p);
        near(foot.u, 0.2, 1e-12);
        near(foot.v, 0.35, 1e-12);
        near(foot.distance, 1.0, 1e-14);
        assert_false(foot.at_rim);
    }
}

/* beside a plane it is on the rim, at a corner beyond a corner */
static void stays_on_the_face(void **state)
{
    (void)state;
    for (size_t c = 0; c < COUNT(COUNTS); c++) {
        double points[9][3];
        make(COUNTS[c], askew_plane, points);
        double p[3] = {points[1][0] + 3.0, points[1][1] - 3.0, 0.25};
        struct facet_foot foot = facet_closest(COUNTS[c], points, p);
        assert_true(foot.at_rim);
        near(foot.point[0], points[1][0], 1e-14);
        near(foot.point[1], points[1][1], 1e-14);
        near(foot.distance, hypot(3.0, 3.0), 1e-14);
    }
}

static void cap(double u, double v, double x[3])
{
    /* a piece of a sphere of radius 1, some 6 degrees from its middle to an edge */
    double scale = 1.0 / sqrt(1.0 + 0.01 * (u * u + v * v));
    x[0] = 0.1 * u * scale;
    x[1] = 0.1 * v * scale;
    x[2] = scale;
}

/* near and far, outside and inside of a cap: the foot of a radius. Faces of second order are off
 * the sphere by about the fourth power of the angle (.14 to a corner): 4e-4 */
static void finds_the_foot_on_a_cap(void **state)
{
    (void)state;
    static const double HEIGHTS[] = {0.6, 0.9, 0.999, 1.001, 1.2, 3.0, 30.0};
    for (size_t c = 0; c < COUNT(COUNTS); c++)
        for (size_t h = 0; h < COUNT(HEIGHTS); h++) {
            double points[9][3], direction[3], p[3];
            make(COUNTS[c], cap, points);
            cap(0.25, 0.3, direction);
            scale3(HEIGHTS[h], direction, p);
            struct facet_foot foot = facet_closest(COUNTS[c], points, p);
            assert_false(foot.at_rim);
            near(foot.distance, fabs(HEIGHTS[h] - 1.0), 4e-4);

            /* what it is to be nearest: the way there is along the normal */
            double area[3], way[3], tangential[3];
            facet_place(COUNTS[c], points, foot.u, foot.v, NULL, area);
            sub3(p, foot.point, way);
            cross3(way, area, tangential);
            near(norm3(tangential) / (norm3(area) * norm3(p)), 0.0, 1e-12);
        }
}

/* no point of a grid on the face is nearer than the foot, wherever the point is */
static void nothing_is_nearer(void **state)
{
    (void)state;
    enum { GRID = 40 };
    for (size_t c = 0; c < COUNT(COUNTS); c++) {
        int count = COUNTS[c];
        double points[9][3];
        make(count, cap, points);
        for (int k = 0; k < 200; k++) {
            /* quasi-random points of a box about the face */
            double p[3] = {fmod(k * 0.7548776662, 1.0) - 0.5, fmod(k * 0.5698402910, 1.0) - 0.5,
                           0.6 + 0.9 * fmod(k * 0.6180339887, 1.0)};
            struct facet_foot foot = facet_closest(count, points, p);
            for (int i = 0; i <= GRID; i++)
                for (int j = 0; j <= GRID; j++) {
                    double u = (double)i / GRID, v = (double)j / GRID, x[3];
                    if (count == 6)
                        v *= 1.0 - u;
                    else
                        u = 2.0 * u - 1.0, v = 2.0 * v - 1.0;
                    facet_place(count, points, u, v, x, NULL);
                    sub3(x, p, x);
                    assert_true(norm3(x) >= foot.distance - 1e-12);
                }
        }
    }
}

/* nothing on the face is lower, and of a plane the bound is its lowest corner */
static void nothing_is_lower(void **state)
{
    (void)state;
    enum { GRID = 20 };
    uint64_t seed = 4;
    for (int trial = 0; trial < 60; trial++) {
        int count = COUNTS[trial % 3];
        double h[9], plane[9], least = INFINITY;
        for (int i = 0; i < count; i++) {
            double u, v;
            facet_node(count, i, &u, &v);
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            h[i] = (double)(seed >> 11) * 0x1p-53;
            plane[i] = 1.0 + 0.5 * u - 0.25 * v;
        }
        for (int i = 0; i <= GRID; i++)
            for (int j = 0; j <= GRID; j++) {
                double u = (double)i / GRID, v = (double)j / GRID, n[9], sum = 0.0;
                if (count == 6)
                    v *= 1.0 - u;
                else
                    u = 2.0 * u - 1.0, v = 2.0 * v - 1.0;
                facet_shape(count, u, v, n, NULL, NULL);
                for (int k = 0; k < count; k++)
                    sum += n[k] * h[k];
                least = fmin(least, sum);
            }
        assert_true(facet_lowest(count, h) <= least + 1e-14);
        near(facet_lowest(count, plane), count == 6 ? 0.75 : 0.25, 1e-15);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reproduces_parabolas),      cmocka_unit_test(interpolates),
        cmocka_unit_test(finds_the_foot_on_a_plane), cmocka_unit_test(stays_on_the_face),
        cmocka_unit_test(finds_the_foot_on_a_cap),   cmocka_unit_test(nothing_is_nearer),
        cmocka_unit_test(nothing_is_lower),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
