/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/beam.c: mass normalisation, limits, symmetry, no
 * overflow. The digits are checked in test_beam_digits.c, the completeness of the roots in
 * test_beam_roots.c. */
#include "unit/model/beam_cases.h"

/* Integral of rhoA w_i w_j + rhoI psi_i psi_j over the length, by four Gauss points on each of many
 * parts: far more than the waves need. */
static double mass_product(const struct beam_plane *plane, const struct beam_mode *i,
                           const struct beam_mode *j)
{
    static const double node[2] = {0.33998104358485626480, 0.86113631159405257522};
    static const double weight[2] = {0.65214515486254614263, 0.34785484513745385737};
    const int parts = 1000;
    double sum = 0.0;

    for (int k = 0; k < 4 * parts; k++) {
        double offset = k % 2 ? node[k / 2 % 2] : -node[k / 2 % 2];
        double x = plane->length * ((k / 4 + 0.5 + 0.5 * offset) / parts - 0.5);
        double w[2], psi[2];
        beam_mode_at(plane, i, x, &w[0], &psi[0]);
        beam_mode_at(plane, j, x, &w[1], &psi[1]);
        sum += weight[k / 2 % 2] *
               (plane->line_mass * w[0] * w[1] + plane->line_inertia * psi[0] * psi[1]);
    }
    return sum * 0.5 * plane->length / parts;
}

static void test_modes_are_orthonormal_in_the_mass(void **state)
{
    (void)state;
    static const size_t chosen[] = {0, 1, 2, 5, 6, 9, 30, 31, 32, 60};
    const struct beam_plane *planes[] = {&slim, &slender, &stubby, &block};

    for (int i = 0; i < 36; i++) {
        struct beam_plane plane =
            supported(planes[i / 9], (enum support)(i / 3 % 3), (enum support)(i % 3));
        plane.length = 0.7; /* dimensions must not cancel by accident */
        plane.line_mass = 3.1;
        struct beam_mode *modes = solve(&plane, 61);
        for (size_t j = 0; j < COUNT(chosen); j++) {
            for (size_t k = 0; k <= j; k++)
                near(mass_product(&plane, &modes[chosen[j]], &modes[chosen[k]]), j == k, 2e-12);
        }
        free(modes);
    }
}

static struct beam_mode mode_of_radius(double r, enum support left, enum support right, size_t k,
                                       struct beam_plane *plane)
{
    struct beam_mode modes[20];

    *plane = (struct beam_plane){1.0, 1.0, 1.0 / (3.0 * r * r), 1.0, r * r, {left, right}};
    beam_modes(plane, k + 1, modes);
    return modes[k];
}

/* At the cut-off the first wave changes its nature; nothing else may. The radius of gyration is
 * moved until the mode stands at its beam's cut-off, and looked at on the way there. */
static void test_normalisation_at_the_cutoff(void **state)
{
    (void)state;
    for (int i = 0; i < 9; i++) {
        for (size_t k = 2; k < 20; k++) {
            double low = 0.01, high = 0.6, alpha = INFINITY;
            for (int step = 0; step < 60; step++) {
                double r = 0.5 * (low + high);
                struct beam_plane plane;
                struct beam_mode mode =
                    mode_of_radius(r, (enum support)(i / 3), (enum support)(i % 3), k, &plane);
                alpha = fmin(alpha, mode.alpha);
                if (mode.alpha < 1.5 && step % 3 == 0)
                    near(mass_product(&plane, &mode, &mode), 1.0, 2e-13);
                *(mode.above_cutoff ? &high : &low) = r;
            }
            assert_true(alpha < 1e-5);
        }
    }
}

/* All sections turn alike and nothing deflects. */
static void test_pure_shear_mode_of_the_pinned_beam(void **state)
{
    (void)state;
    struct beam_plane plane = supported(&stubby, SUPPORT_PINNED, SUPPORT_PINNED);
    struct beam_mode modes[10];
    double cutoff = sqrt(plane.shear_stiffness / plane.line_inertia);
    size_t k = 0;

    beam_modes(&plane, COUNT(modes), modes);
    while (k < COUNT(modes) && fabs(modes[k].omega - cutoff) > 1e-14 * cutoff)
        k++;
    assert_true(k < COUNT(modes));
    for (int i = -4; i <= 4; i++) {
        double w, psi;
        beam_mode_at(&plane, &modes[k], 0.125 * i, &w, &psi);
        near(w, 0.0, 1e-14);
        near(psi, 1.0 / sqrt(plane.line_inertia), 1e-14 / sqrt(plane.line_inertia));
    }
}

/* b^4 r^2 q^2 - b^2 (1 + z (r^2 + q^2)) + z^2 = 0 with z = k^2 pi^2 for a whole k: what is left of
 * it for the k nearest to a root z, per middle term. */
static double closed_form_residual(double b2, double r2, double q2, double sign)
{
    double z = 0.5 * b2 * (r2 + q2) + sign * sqrt(pow(0.5 * b2 * (r2 - q2), 2.0) + b2);
    double whole = pow(round(sqrt(fmax(z, 0.0)) / M_PI) * M_PI, 2.0);
    double middle = b2 * (1.0 + whole * (r2 + q2));

    return fabs(b2 * b2 * r2 * q2 - middle + whole * whole) / middle;
}

static void test_closed_form_of_the_pinned_beam(void **state)
{
    (void)state;
    struct beam_plane plane = {0.4, 30.0, 2e5, 1.7, 1e-3, {SUPPORT_PINNED, SUPPORT_PINNED}};
    double square = plane.length * plane.length;
    double r2 = plane.line_inertia / (plane.line_mass * square);
    double q2 = plane.bending_stiffness / (plane.shear_stiffness * square);
    struct beam_mode *modes = solve(&plane, 300);

    for (size_t k = 0; k < 300; k++) {
        double b2 = modes[k].omega * modes[k].omega * plane.line_mass * square * square /
                    plane.bending_stiffness;
        near(fmin(closed_form_residual(b2, r2, q2, 1.0), closed_form_residual(b2, r2, q2, -1.0)),
             0.0, 1e-14);
    }
    free(modes);
}

static void test_high_modes_stay_finite_and_ascend(void **state)
{
    (void)state;
    const struct beam_plane *planes[] = {&slim, &slender, &stubby, &block};
    const size_t count = 3000;

    for (int i = 0; i < 36; i++) {
        struct beam_plane plane =
            supported(planes[i / 9], (enum support)(i / 3 % 3), (enum support)(i % 3));
        struct beam_mode *modes = solve(&plane, count);
        for (size_t k = 0; k < count; k++) {
            assert_true(k == 0 || modes[k].omega >= modes[k - 1].omega);
            for (int j = -3; j <= 3; j++) {
                double w, psi;
                beam_mode_at(&plane, &modes[k], j / 6.0, &w, &psi);
                /* no more than the end of a free Euler-Bernoulli beam */
                assert_true(fabs(w) < 2.0 + 1e-9);
                assert_true(isfinite(psi));
            }
        }
        free(modes);
    }
}

/* A free Euler-Bernoulli beam's end moves by exactly 2/sqrt(M) in every mode. */
static void test_end_value_of_the_free_beam(void **state)
{
    (void)state;
    struct beam_mode *modes = solve(&slim, 2000);

    for (size_t k = 0; k < 2000; k++) {
        double w, psi;
        beam_mode_at(&slim, &modes[k], 0.5, &w, &psi);
        near(w, 2.0, 1e-12);
        beam_mode_at(&slim, &modes[k], -0.5, &w, &psi);
        near(w, k % 2 ? -2.0 : 2.0, 1e-12);
    }
    free(modes);
}

static void test_turned_round_beam_has_the_same_modes(void **state)
{
    (void)state;
    struct beam_plane plane = supported(&stubby, SUPPORT_CLAMPED, SUPPORT_FREE);
    struct beam_plane turned = supported(&stubby, SUPPORT_FREE, SUPPORT_CLAMPED);
    struct beam_mode *modes = solve(&plane, 40), *others = solve(&turned, 40);

    for (size_t k = 0; k < 40; k++) {
        double w[2], psi[2], end, slope;
        assert_true(modes[k].omega == others[k].omega);
        beam_mode_at(&plane, &modes[k], 0.31, &w[0], &psi[0]);
        beam_mode_at(&turned, &others[k], -0.31, &w[1], &psi[1]);
        near(fabs(w[1]), fabs(w[0]), 1e-14);
        near(psi[1] * w[0], -psi[0] * w[1], 1e-13 * modes[k].beta);
        /* the sign convention: the right end up, or its moment positive where it is clamped */
        beam_mode_at(&plane, &modes[k], 0.5, &end, &slope);
        assert_true(end > 0.0);
        beam_mode_at(&turned, &others[k], 0.499999, &end, &slope);
        assert_true(slope < 0.0);
    }
    free(modes);
    free(others);
}

static void test_euler_bernoulli_slope_is_the_derivative(void **state)
{
    (void)state;
    const double h = 1e-6;

    for (int i = 0; i < 9; i++) {
        struct beam_plane plane = supported(&slim, (enum support)(i / 3), (enum support)(i % 3));
        struct beam_mode modes[5];
        beam_modes(&plane, COUNT(modes), modes);
        for (size_t k = 0; k < COUNT(modes); k++) {
            double w[2], psi, unused;
            beam_mode_at(&plane, &modes[k], 0.2 + h, &w[1], &unused);
            beam_mode_at(&plane, &modes[k], 0.2 - h, &w[0], &unused);
            beam_mode_at(&plane, &modes[k], 0.2, &unused, &psi);
            near((w[1] - w[0]) / (2.0 * h), psi, 1e-8);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_modes_are_orthonormal_in_the_mass),
        cmocka_unit_test(test_normalisation_at_the_cutoff),
        cmocka_unit_test(test_pure_shear_mode_of_the_pinned_beam),
        cmocka_unit_test(test_closed_form_of_the_pinned_beam),
        cmocka_unit_test(test_high_modes_stay_finite_and_ascend),
        cmocka_unit_test(test_end_value_of_the_free_beam),
        cmocka_unit_test(test_turned_round_beam_has_the_same_modes),
        cmocka_unit_test(test_euler_bernoulli_slope_is_the_derivative),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
