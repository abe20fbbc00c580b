/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/boussinesq3.c, boussinesq3_fields.c: the axisymmetric field of
 * fe/boussinesq.c in another frame; stress from displacement by Hooke's law, in equilibrium, with
 * and without a reach. */
#include <string.h>

#include "check.h"
#include "fe/boussinesq.h"
#include "model/boussinesq3.h"
#include "model/vector.h"

/* a load in general position */
static const struct boussinesq3 LOAD = {
    {0.3, -0.2, 0.1}, {2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0}, 70.0, 0.33, INFINITY};
static const double ALONG[3] = {1.0 / 3.0, -2.0 / 3.0, -2.0 / 3.0}; /* in the surface */

/* depths and distances from the axis; negative depths are what a concave body has */
static const double PLACES[][2] = {{0.3, 0.7}, {1.1, 0.2}, {0.0, 1.3}, {-0.4, 0.8}, {-0.9, 0.5}};

static void place(double depth, double aside, double x[3])
{
    for (int i = 0; i < 3; i++)
        x[i] = LOAD.point[i] + depth * LOAD.inward[i] + aside * ALONG[i];
}

static void is_the_axisymmetric_field_turned(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        double depth = PLACES[i][0], aside = PLACES[i][1];
        double x[3], u[3], s[6], expected[2], stress[4], on_depth[3], on_side[3];
        place(depth, aside, x);
        boussinesq3_field(&LOAD, x, u, s);
        boussinesq_displacement(LOAD.young, LOAD.poisson, aside, -depth, expected);
        boussinesq_stress(LOAD.poisson, aside, -depth, stress);
        /* two ways to write one formula: rounding */
        near(dot3(u, ALONG), expected[0], 1e-14);
        near(-dot3(u, LOAD.inward), expected[1], 1e-14);
        boussinesq3_traction(s, LOAD.inward, on_depth);
        boussinesq3_traction(s, ALONG, on_side);
        near(dot3(on_side, ALONG), stress[0], 1e-13);
        near(dot3(on_depth, LOAD.inward), stress[1], 1e-13);
        near(-dot3(on_depth, ALONG), stress[3], 1e-13);
        near(s[0] + s[1] + s[2], stress[0] + stress[1] + stress[2], 1e-13);
    }
}

/* derivatives by central differences; their error is of the order (step / distance)^2 */
static void stress_follows_displacement_in_equilibrium(void **state)
{
    (void)state;
    static const double STEP = 1e-4;
    static const int INDEX[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int with_reach = 0; with_reach < 2; with_reach++) {
        struct boussinesq3 load = LOAD;
        load.reach = with_reach ? 0.6 : INFINITY;
        for (size_t p = 0; p < COUNT(PLACES); p++) {
            double x[3], s[6], gradient[3][3], force[3] = {0.0, 0.0, 0.0};
            place(PLACES[p][0], PLACES[p][1], x);
            boussinesq3_field(&load, x, NULL, s);
            for (int j = 0; j < 3; j++) {
                double up[3] = {x[0], x[1], x[2]}, down[3] = {x[0], x[1], x[2]};
                double u_up[3], u_down[3], s_up[6], s_down[6];
                up[j] += STEP;
                down[j] -= STEP;
                boussinesq3_field(&load, up, u_up, s_up);
                boussinesq3_field(&load, down, u_down, s_down);
                for (int i = 0; i < 3; i++) {
                    gradient[i][j] = (u_up[i] - u_down[i]) / (2.0 * STEP);
                    force[i] += (s_up[INDEX[i][j]] - s_down[INDEX[i][j]]) / (2.0 * STEP);
                }
            }
            double shear = load.young / (2.0 * (1.0 + load.poisson));
            double lame = 2.0 * shear * load.poisson / (1.0 - 2.0 * load.poisson);
            double dilatation = gradient[0][0] + gradient[1][1] + gradient[2][2];
            for (int i = 0; i < 3; i++)
                for (int j = i; j < 3; j++)
                    near(s[INDEX[i][j]],
                         shear * (gradient[i][j] + gradient[j][i]) +
                             (i == j ? lame * dilatation : 0.0),
                         2e-6);
            near(norm3(force), 0.0, 2e-5);
        }
    }
}

/* Cerruti's: stress from displacement, in equilibrium; free of tractions on the surface but for
 * those of the reach. */
static void check_along(const struct boussinesq3 *load, const double x[3], bool on_surface)
{
    static const double STEP = 1e-4;
    static const int INDEX[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    double shear = load->young / (2.0 * (1.0 + load->poisson));
    double lame = 2.0 * shear * load->poisson / (1.0 - 2.0 * load->poisson);
    double s[6], added[6], gradient[3][3], force[3] = {0.0, 0.0, 0.0}, t[3];
    cerruti3_field(load, ALONG, x, NULL, s);
    for (int j = 0; j < 3; j++) {
        double up[3] = {x[0], x[1], x[2]}, down[3] = {x[0], x[1], x[2]};
        double u_up[3], u_down[3], s_up[6], s_down[6];
        up[j] += STEP;
        down[j] -= STEP;
        cerruti3_field(load, ALONG, up, u_up, s_up);
        cerruti3_field(load, ALONG, down, u_down, s_down);
        for (int i = 0; i < 3; i++) {
            gradient[i][j] = (u_up[i] - u_down[i]) / (2.0 * STEP);
            force[i] += (s_up[INDEX[i][j]] - s_down[INDEX[i][j]]) / (2.0 * STEP);
        }
    }
    double dilatation = gradient[0][0] + gradient[1][1] + gradient[2][2];
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++)
            near(s[INDEX[i][j]],
                 shear * (gradient[i][j] + gradient[j][i]) + (i == j ? lame * dilatation : 0.0),
                 2e-6);
    near(norm3(force), 0.0, 2e-5);
    cerruti3_added_stress(load, ALONG, x, added);
    for (int k = 0; k < 6; k++)
        s[k] -= added[k];
    boussinesq3_traction(s, load->inward, t);
    near(norm3(t), 0.0, on_surface ? 1e-14 : INFINITY);
}

static void along_the_surface(void **state)
{
    (void)state;
    double sum[3] = {0.0}, across[3];
    cross3(LOAD.inward, ALONG, across);
    for (int with_reach = 0; with_reach < 2; with_reach++)
        for (size_t p = 0; p < COUNT(PLACES); p++) {
            struct boussinesq3 load = LOAD;
            double x[3];
            load.reach = with_reach ? 0.6 : INFINITY;
            place(PLACES[p][0], PLACES[p][1], x);
            add_scaled3(0.4, across, x);
            check_along(&load, x, PLACES[p][0] == 0.0);
        }
    /* a hemisphere holds the force of 1 N */
    /* midpoints of 100 x 100 parts: 1e-4 */
    for (int i = 0; i < 100; i++)
        for (int j = 0; j < 100; j++) {
            double down = 0.5 * M_PI * (i + 0.5) / 100.0, about = 2.0 * M_PI * (j + 0.5) / 100.0;
            double outward[3] = {0.0}, x[3], s[6], t[3];
            add_scaled3(cos(down), LOAD.inward, outward);
            add_scaled3(sin(down) * cos(about), ALONG, outward);
            add_scaled3(sin(down) * sin(about), across, outward);
            for (int k = 0; k < 3; k++)
                x[k] = LOAD.point[k] + outward[k];
            cerruti3_field(&LOAD, ALONG, x, NULL, s);
            boussinesq3_traction(s, outward, t);
            add_scaled3(sin(down) * M_PI * M_PI / 10000.0, t, sum);
        }
    near(dot3(sum, ALONG), -1.0, 1e-4);
    near(dot3(sum, LOAD.inward), 0.0, 1e-4);
    near(dot3(sum, across), 0.0, 1e-12);
}

/* on the outward line the field itself is infinite, with a reach it is not beyond it; the load is
 * the same, and the half-space's surface has tractions of 1/reach^2 */
static void reach_ends_the_singular_line(void **state)
{
    (void)state;
    struct boussinesq3 load = LOAD;
    load.reach = 0.5;
    double x[3], u[3], s[6], added[6], near_point[3], own[3], t[3];
    place(-2.0, 1e-7, x);
    boussinesq3_field(&load, x, u, s);
    assert_true(norm3(u) < 0.1 && fabs(s[0]) < 1.0);
    boussinesq3_field(&LOAD, x, NULL, s);
    assert_true(fabs(s[0]) + fabs(s[1]) + fabs(s[2]) > 1e6);

    /* near the point it differs from the half-space's by what is said to be added */
    place(1e-4, 1e-4, x);
    boussinesq3_field(&load, x, near_point, NULL);
    boussinesq3_field(&LOAD, x, own, NULL);
    sub3(near_point, own, near_point);
    /* linear in the distance over the reach: 3e-4 */
    near_relative(dot3(near_point, load.inward), boussinesq3_added_displacement(&load), 1e-3);

    /* the surface is free but for the added part */
    place(0.0, 0.7, x);
    boussinesq3_field(&load, x, NULL, s);
    boussinesq3_added_stress(&load, x, added);
    for (int k = 0; k < 6; k++)
        s[k] -= added[k];
    boussinesq3_traction(s, load.inward, t);
    near(norm3(t), 0.0, 1e-14);

    /* Cerruti's alike; beside the line, which neither form may come too near to */
    place(-2.0, 1e-7, x);
    cerruti3_field(&load, ALONG, x, u, s);
    assert_true(norm3(u) < 0.1 && fabs(s[0]) < 1.0);
    cerruti3_field(&LOAD, ALONG, x, NULL, s);
    assert_true(fabs(s[0]) + fabs(s[1]) + fabs(s[2]) > 1e6);
    place(1e-4, 1e-4, x);
    cerruti3_field(&load, ALONG, x, near_point, NULL);
    cerruti3_field(&LOAD, ALONG, x, own, NULL);
    sub3(near_point, own, near_point);
    near_relative(dot3(near_point, ALONG), cerruti3_added_displacement(&load), 1e-3);
}

/* Three loads at once are those one by one: two ways to write one formula, but for rounding. */
static void three_loads_at_many_points(void **state)
{
    (void)state;
    enum { POINTS = COUNT(PLACES) }; /* one more than go together */
    static const double REACHES[3] = {INFINITY, 0.6, 0.2};
    double x[POINTS][3], areas[POINTS][3], u[POINTS][3][3], t[POINTS][3][3], alone[POINTS][3][3];
    double along[2][3];
    memcpy(along[0], ALONG, sizeof along[0]);
    cross3(LOAD.inward, ALONG, along[1]);
    for (int p = 0; p < POINTS; p++) {
        place(PLACES[p][0], PLACES[p][1], x[p]);
        add_scaled3(0.4 - 0.1 * p, along[1], x[p]);
        for (int k = 0; k < 3; k++)
            areas[p][k] = 0.7 - 0.3 * k + 0.2 * p;
    }
    for (size_t r = 0; r < COUNT(REACHES); r++) {
        struct boussinesq3 load = LOAD;
        load.reach = REACHES[r];
        boussinesq3_fields(&load, along, POINTS, x, areas, u, t);
        boussinesq3_fields(&load, along, POINTS, x, NULL, alone, NULL);
        assert_memory_equal(alone, u, sizeof u);
        for (int p = 0; p < POINTS; p++)
            for (int j = 0; j < 3; j++) {
                double expected[3], stress[6], traction[3];
                if (j == 0)
                    boussinesq3_field(&load, x[p], expected, stress);
                else
                    cerruti3_field(&load, along[j - 1], x[p], expected, stress);
                boussinesq3_traction(stress, areas[p], traction);
                for (int k = 0; k < 3; k++) {
                    near_scaled(u[p][j][k], expected[k], norm3(expected), 1e-13);
                    near_scaled(t[p][j][k], traction[k], norm3(traction), 1e-13);
                }
            }
    }
}

/* The rate of a flexibility along a bent surface, which loses the integral of tractions times
 * displacements from a radius on: of both fields on a ring of 1e-4 of the radii of curvature, to
 * that order. */
static void bent_surfaces_leave_a_logarithm(void **state)
{
    (void)state;
    enum { STEPS = 400 };
    static const double RADIUS = 1e-4, BENT[2][3] = {{1.3, 0.0, 0.0}, {-0.4, 0.9, 0.5}};
    double t[2][3];
    memcpy(t[0], ALONG, sizeof t[0]);
    cross3(LOAD.inward, ALONG, t[1]);
    for (size_t c = 0; c < COUNT(BENT); c++) {
        /* k11, k22, k12; the surface falls by half of k x x */
        const double k[2][2] = {{BENT[c][0], BENT[c][2]}, {BENT[c][2], BENT[c][1]}};
        double sum[2][2] = {{0.0}}, even[2][2] = {{0.0}}, tensor[6] = {0.0}, curvature[9] = {0.0};
        double contact[6] = {0.0}, normal[3];
        scale3(-1.0, LOAD.inward, normal);
        for (int n = 0; n < STEPS; n++) {
            double angle = 2.0 * M_PI * (n + 0.5) / STEPS, area = 2.0 * M_PI * RADIUS / STEPS;
            double y[2] = {RADIUS * cos(angle), RADIUS * sin(angle)}, x[3], outward[3];
            memcpy(x, LOAD.point, sizeof x);
            memcpy(outward, normal, sizeof outward);
            for (int i = 0; i < 2; i++) {
                double slope = k[i][0] * y[0] + k[i][1] * y[1];
                add_scaled3(y[i], t[i], x);
                add_scaled3(0.5 * slope * y[i], LOAD.inward, x);
                add_scaled3(slope, t[i], outward);
            }
            for (int i = 0; i < 2; i++)
                for (int j = 0; j < 2; j++) {
                    double u[3], s[6], traction[3];
                    cerruti3_field(&LOAD, t[i], x, NULL, s);
                    boussinesq3_traction(s, outward, traction);
                    cerruti3_field(&LOAD, t[j], x, u, NULL);
                    sum[i][j] -= RADIUS * area * dot3(traction, u);
                    /* with the displacement's mean over the angle alone */
                    even[i][j] -= area * dot3(traction, t[j]) * (1.0 + LOAD.poisson) *
                                  (1.0 - 0.5 * LOAD.poisson) / (M_PI * LOAD.young);
                }
        }
        for (int i = 0; i < 9; i++)
            for (int a = 0; a < 4; a++)
                curvature[i] += k[a / 2][a % 2] * t[a / 2][i / 3] * t[a % 2][i % 3];
        cerruti3_add_slope(LOAD.young, LOAD.poisson, normal, curvature, 1.0, tensor);
        cerruti3_add_contact(LOAD.young, LOAD.poisson, normal, curvature, contact);
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) {
                double image[3];
                boussinesq3_traction(tensor, t[j], image);
                near_scaled(dot3(t[i], image), sum[i][j], sum[0][0], 2e-3);
                /* a contact's: 2 ln 2 of that mean, 2 ln 2 - 2 of the rest, the mean of pairs */
                double rest = sum[i][j] - even[i][j];
                boussinesq3_traction(contact, t[j], image);
                near_scaled(dot3(t[i], image),
                            2.0 * M_LN2 * even[i][j] + (2.0 * M_LN2 - 2.0) * rest +
                                (1.625 - 2.0 * M_LN2) * sum[i][j],
                            sum[0][0], 3e-3);
            }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_the_axisymmetric_field_turned),
        cmocka_unit_test(stress_follows_displacement_in_equilibrium),
        cmocka_unit_test(along_the_surface),
        cmocka_unit_test(reach_ends_the_singular_line),
        cmocka_unit_test(three_loads_at_many_points),
        cmocka_unit_test(bent_surfaces_leave_a_logarithm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
