/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/bar_waves.c, twist: the section's constants, modes against Vlasov's
 * equation, static compliances that the modal sums approach, and d'Alembert's waves. */
#include "check.h"
#include "model/bar.h"
#include "model/bar_waves.h"
#include "model/modal_basis.h"

static struct body strip(double width, double height, enum support left, enum support right)
{
    struct body body = {
        .id = "strip",
        .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0},
        .kind = &beam_kind,
        .theory = THEORY_EULER_BERNOULLI,
        .width = width,
        .height = height,
        .length = 0.3,
        .tip_radius = INFINITY,
        .supports = {left, right},
    };
    assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
    return body;
}

static const enum support ENDS[][2] = {{SUPPORT_FREE, SUPPORT_FREE},
                                       {SUPPORT_CLAMPED, SUPPORT_FREE},
                                       {SUPPORT_FREE, SUPPORT_PINNED},
                                       {SUPPORT_PINNED, SUPPORT_CLAMPED}};

/* J/(a b^3) of Timoshenko and Goodier, table in section 109, which has three digits; the circle's
 * is its polar moment. */
static void constants_of_the_handbook(void **state)
{
    (void)state;
    static const double rows[][2] = {{1.0, 0.1406}, {1.5, 0.196}, {2.0, 0.229},
                                     {3.0, 0.263},  {5.0, 0.291}, {10.0, 0.312}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double b = 0.004, a = b * rows[i][0];
        struct body flat = strip(a, b, SUPPORT_FREE, SUPPORT_FREE);
        struct body high = strip(b, a, SUPPORT_FREE, SUPPORT_FREE);
        near(torsion_constant(&flat) / (a * b * b * b), rows[i][1], 6e-4);
        near(torsion_constant(&high), torsion_constant(&flat), 1e-14 * torsion_constant(&flat));
    }
    /* a square to ten digits: 0.1405770150 (the series summed directly) */
    struct body square = strip(1.0, 1.0, SUPPORT_FREE, SUPPORT_FREE);
    double sum = 0.0;
    for (int n = 9999; n > 0; n -= 2)
        sum += tanh(0.5 * n * M_PI) / pow(n, 5.0);
    near(torsion_constant(&square), (1.0 - 192.0 / pow(M_PI, 5.0) * sum) / 3.0, 1e-14);
    struct body round = square;
    round.radius = 0.01;
    near(torsion_constant(&round), 0.5 * M_PI * 1e-8, 1e-22);
}

/* The shape's own equation and ends by finite differences, independent of how the frequency was
 * found; unit modal mass; the supports' own conditions. */
static double slope(const struct body *body, size_t k, double omega, double x, int order)
{
    /* central differences of fourth order */
    static const double weights[5][7] = {
        {0, 0, 0, 1, 0, 0, 0},
        {-1 / 60., 3 / 20., -3 / 4., 0, 3 / 4., -3 / 20., 1 / 60.},
        {1 / 90., -3 / 20., 3 / 2., -49 / 18., 3 / 2., -3 / 20., 1 / 90.},
        {1 / 8., -1, 13 / 8., 0, -13 / 8., 1, -1 / 8.},
        {-1 / 6., 2, -13 / 2., 28 / 3., -13 / 2., 2, -1 / 6.}};
    const double h = 1e-3;
    double sum = 0.0;
    for (int i = 0; i < 7; i++)
        sum += weights[order][i] * torsion_shape(body, k, omega, x + (i - 3) * h);
    return sum / pow(h, order);
}

static void modes_solve_vlasovs_equation(void **state)
{
    (void)state;
    for (int s = 0; s < 4; s++) {
        struct body body = strip(0.04, 0.004, ENDS[s][0], ENDS[s][1]);
        double gj = 70e9 / 2.66 * torsion_constant(&body), inertia = body.inertia[0] / 0.3;
        double gamma = torsion_warping_constant(&body), last = 0.0;
        for (size_t k = 0; k < 8; k++) {
            double omega = torsion_frequency(&body, k), w2 = omega * omega, mass = 0.0;
            assert_true(omega > last);
            last = omega;
            for (double x = -0.14; x < 0.141; x += 0.07) {
                double t2 = slope(&body, k, omega, x, 2), t4 = slope(&body, k, omega, x, 4);
                double t0 = slope(&body, k, omega, x, 0);
                double inner = gj * t2 - 70e9 * gamma * t4;
                double outer = -w2 * (inertia * t0 - 2700.0 * gamma * t2);
                /* differences of fourth order: (beta h)^4 of the size, beta up to 90 */
                near(inner, outer, 1e-3 * w2 * sqrt(inertia));
            }
            for (int end = 0; end < 2; end++) {
                double x = end ? 0.15 : -0.15, size = sqrt(2.0 / body.inertia[0]);
                double t1 = slope(&body, k, omega, x, 1), t3 = slope(&body, k, omega, x, 3);
                double bimoment = slope(&body, k, omega, x, 2);
                double torque = 70e9 * gamma * t3 - (gj - 2700.0 * gamma * w2) * t1;
                double beta = 100.0;
                near(bimoment, 0.0, 1e-3 * size * beta * beta);
                if (ENDS[s][end] == SUPPORT_FREE)
                    near(torque, 0.0, 1e-3 * gj * size * beta);
                else
                    near(torsion_shape(&body, k, omega, x), 0.0, 1e-12 * size);
            }
            /* Simpson with 600 intervals: (beta h)^4/180 */
            for (int i = 0; i <= 600; i++) {
                double x = -0.15 + 0.3 * i / 600.0, weight = i % 600 ? i % 2 ? 4 : 2 : 1;
                double t0 = slope(&body, k, omega, x, 0), t1 = slope(&body, k, omega, x, 1);
                mass += weight * 0.3 / 1800.0 * (inertia * t0 * t0 + 2700.0 * gamma * t1 * t1);
            }
            near(mass, 1.0, 1e-5);
        }
    }
}

/* A round bar has no warping: omega = n pi c/L or (n - 1/2) pi c/L, c = sqrt(G/rho). */
static void a_round_bar_has_even_frequencies(void **state)
{
    (void)state;
    for (int s = 0; s < 4; s++) {
        struct body body = strip(0.04, 0.004, ENDS[s][0], ENDS[s][1]);
        body.radius = 0.01;
        body.width = body.height = 0.0;
        assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
        bool one_held = s == 1 || s == 2;
        struct modal_family *modes = modal_family_create(&body, BAR_TWIST, 20);
        assert_non_null(modes);
        for (size_t k = 0; k < 20; k++) {
            double number = (double)k + (one_held ? 0.5 : 1.0);
            double expected = number * M_PI * sqrt(70e9 / 2.66 / 2700.0) / 0.3;
            near(modes->omega[k], expected, 1e-14 * expected);
            double a = torsion_shape(&body, k, expected, 0.037);
            double b = torsion_shape(&body, k, expected, -0.037);
            if (!one_held)
                near(a, modes->odd[k] ? -b : b, 1e-11 * (fabs(a) + 1.0));
        }
        modal_family_free(modes);
    }
}

/* 0.000134 a^6 of a square; nearly a^3 b^3/144 of a thin strip; a narrow one is the same turned. */
static void warping_constants(void **state)
{
    (void)state;
    struct body square = strip(1.0, 1.0, SUPPORT_FREE, SUPPORT_FREE);
    near(torsion_warping_constant(&square), 1.34e-4, 5e-7);
    struct body thin = strip(1.0, 0.01, SUPPORT_FREE, SUPPORT_FREE);
    struct body turned = strip(0.01, 1.0, SUPPORT_FREE, SUPPORT_FREE);
    double gamma = torsion_warping_constant(&thin);
    near(gamma, 1e-6 / 144.0, 0.01 * 1e-6 / 144.0);
    near(torsion_warping_constant(&turned), gamma, 1e-14 * gamma);
}

static struct site_load beside(const struct body *body, double x, double y)
{
    struct site site = {
        .face = SITE_BEAM_SIDE, .point = {x, y, 0.5 * body->height}, .outward = {0.0, 0.0, 1.0}};
    return site_load_make(body, &site, (double[]){0.0, 0.0, -1.0}, false);
}

static void blows_beside_the_axis_twist(void **state)
{
    (void)state;
    struct body body = strip(0.04, 0.004, SUPPORT_FREE, SUPPORT_FREE);
    struct site_load load = beside(&body, 0.05, 0.005);
    assert_true(load.family[BAR_TWIST].acts && load.family[BAR_BENDING_Z].acts);
    near(load.family[BAR_TWIST].bar.moment, -0.005, 1e-18);
    assert_false(beside(&body, 0.05, 0.0).family[BAR_TWIST].acts);
    struct body round = {
        .id = "round", .material = body.material, .kind = &beam_kind, .tip_radius = INFINITY};
    round.radius = 0.01;
    round.length = 0.3;
    assert_int_equal(body_complete(&round, NULL), PERCUSS_OK);
    /* a normal 3 degrees askew: no friction, no torque on a round section */
    struct site site = {.face = SITE_BEAM_SIDE, .point = {0.0, 0.0, 0.01}};
    load = site_load_make(&round, &site, (double[]){0.0, 0.0523, -0.9986}, false);
    assert_false(load.family[BAR_TWIST].acts);
}

/* The exact compliance is the sum over all modes; N of them leave 1/N. */
static void compliance_completes_the_modal_sum(void **state)
{
    (void)state;
    const size_t count = 2000;
    for (int s = 0; s < 4; s++) {
        struct body body = strip(0.04, 0.004, ENDS[s][0], ENDS[s][1]);
        struct modal_family *modes = modal_family_create(&body, BAR_TWIST, count);
        static const double sites[] = {-0.15, -0.06, 0.0, 0.11, 0.15};
        double scale = torsion_compliance(&body, 0.03, 0.03);
        assert_non_null(modes);
        for (int pair = 0; pair < 25; pair++) {
            struct family_load i = beside(&body, sites[pair / 5], 0.005).family[BAR_TWIST];
            struct family_load j = beside(&body, sites[pair % 5], -0.012).family[BAR_TWIST];
            double sum = 0.0;
            for (size_t k = count; k-- > 0;)
                sum += modal_participation(&body, modes, k, &i) *
                       modal_participation(&body, modes, k, &j) /
                       (modes->omega[k] * modes->omega[k]);
            /* 2/(pi^2 N) of L/(GJ), which is some ten times the scale; 60e-6 of torques */
            near(sum, modal_compliance(&body, BAR_TWIST, &i, &j), 1e-3 * scale * 60e-6);
        }
        modal_family_free(modes);
    }
}

/* A torque that sets in turns the section of a round bar like that of an endless one, c t/(2GJ),
 * until the waves come back from the ends: rigid rotation and all modes together are d'Alembert's
 * solution. */
static void a_step_of_torque_travels_as_waves(void **state)
{
    (void)state;
    const size_t count = 20000;
    for (int s = 0; s < 4; s++) {
        struct body body = strip(0.04, 0.004, ENDS[s][0], ENDS[s][1]);
        body.radius = 0.01;
        body.width = body.height = 0.0;
        assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
        const double x = 0.03, stiffness = 70e9 / 2.66 * torsion_constant(&body);
        double inertia = body.inertia[0];
        double c = sqrt(stiffness * 0.3 / inertia);
        for (int i = 1; i <= 8; i++) {
            double t = i / 8.0 * 2.0 * 0.12 / c; /* there and back to the nearer end */
            double turn = s == 0 ? 0.5 * t * t / inertia : 0.0;
            for (size_t k = count; k-- > 0;) {
                double omega = torsion_frequency(&body, k);
                double shape = torsion_shape(&body, k, omega, x);
                turn += shape * shape * (1.0 - cos(omega * t)) / (omega * omega);
            }
            /* the modes left out: 2 L/(pi^2 N GJ) */
            near(turn, 0.5 * c * t / stiffness, 2.1 * 0.3 / (M_PI * M_PI * count * stiffness));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constants_of_the_handbook),
        cmocka_unit_test(warping_constants),
        cmocka_unit_test(modes_solve_vlasovs_equation),
        cmocka_unit_test(a_round_bar_has_even_frequencies),
        cmocka_unit_test(blows_beside_the_axis_twist),
        cmocka_unit_test(compliance_completes_the_modal_sum),
        cmocka_unit_test(a_step_of_torque_travels_as_waves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
