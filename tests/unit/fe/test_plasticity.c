/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/plasticity.c: uniaxial curve, shear, unloading, tangent against
 * differences.
 */
#include <string.h>

#include "check.h"
#include "fe/plasticity.h"

static const struct material hardening = {"hard", 70e9, 0.33, 2700.0, 205e6, 5e9};
static const struct material ideal = {"ideal", 70e9, 0.33, 2700.0, 205e6, 0.0};

/* strains each material point to `axial` in zz with free sides, by Newton on the lateral strain */
static double uniaxial(const struct plastic_law *law, struct plastic_state *state, double axial)
{
    double strain[4] = {-0.33 * axial, axial, -0.33 * axial, 0.0};
    double stress[4], tangent[16];
    struct plastic_state after;
    for (int i = 0; i < 50; i++) {
        plasticity_return(law, state, strain, &after, stress, tangent);
        double step = -stress[0] / (tangent[0] + tangent[2]);
        strain[0] += step;
        strain[2] += step;
    }
    *state = after;
    near_scaled(stress[0], 0.0, law->yield, 1e-9);
    return stress[1];
}

static void follows_the_bilinear_curve(void **unused)
{
    (void)unused;
    struct plastic_law law = plastic_law_make(&hardening);
    struct plastic_state state = {0};
    double first = hardening.yield / hardening.young;
    near_scaled(uniaxial(&law, &state, 0.9 * first), 0.9 * hardening.yield, hardening.yield, 1e-12);
    assert_true(state.accumulated == 0.0);
    for (double strain = 1.5 * first; strain < 6.0 * first; strain += 0.5 * first)
        near_scaled(uniaxial(&law, &state, strain),
                    hardening.yield + hardening.tangent * (strain - first), hardening.yield, 1e-9);
    /* back: elastic by twice the present yield stress, then flow in compression */
    double top = uniaxial(&law, &state, 6.0 * first);
    double before = state.accumulated;
    near_scaled(uniaxial(&law, &state, 6.0 * first - 1.9 * top / hardening.young), -0.9 * top, top,
                1e-9);
    assert_true(state.accumulated == before);
    assert_true(uniaxial(&law, &state, 6.0 * first - 2.5 * top / hardening.young) < -top);
    assert_true(state.accumulated > before);
    near_scaled(state.strain[0] + state.strain[1] + state.strain[2], 0.0, state.accumulated, 1e-12);
}

static void ideal_shear_stays_at_yield(void **unused)
{
    (void)unused;
    struct plastic_law law = plastic_law_make(&ideal);
    struct plastic_state state = {0};
    double stress[4];
    double first = ideal.yield / sqrt(3.0) / law.shear;
    for (double gamma = 0.0; gamma < 5.0 * first; gamma += 0.25 * first) {
        double strain[4] = {0.0, 0.0, 0.0, gamma};
        plasticity_return(&law, &state, strain, &state, stress, NULL);
        near_scaled(stress[3], fmin(gamma * law.shear, ideal.yield / sqrt(3.0)), ideal.yield,
                    1e-12);
    }
    near_scaled(stress_equivalent(stress), ideal.yield, ideal.yield, 1e-12);
}

static void elastic_matches_hooke(void **unused)
{
    (void)unused;
    struct material elastic = ideal;
    elastic.yield = INFINITY;
    struct plastic_law law = plastic_law_make(&elastic);
    struct plastic_state state = {0};
    double strain[4] = {1e-2, -3e-3, 2e-3, 4e-3}, stress[4];
    assert_false(plasticity_return(&law, &state, strain, &state, stress, NULL));
    double lame = elastic.young * elastic.poisson / (1.33 * 0.34);
    for (size_t i = 0; i < 3; i++)
        near_scaled(stress[i], lame * 9e-3 + 2.0 * law.shear * strain[i], lame * 9e-3, 1e-13);
    near_scaled(stress[3], law.shear * 4e-3, lame * 9e-3, 1e-13);
}

/* the consistent tangent is the derivative of the returned stress */
static void tangent_is_the_derivative(void **unused)
{
    (void)unused;
    struct plastic_law law = plastic_law_make(&hardening);
    struct plastic_state before = {0}, after;
    double strain[4] = {4e-3, -6e-3, 1e-3, 5e-3};
    double stress[4], tangent[16];
    plasticity_return(&law, &before, strain, &before, stress, NULL);
    strain[0] += 1e-3;
    strain[3] -= 2e-3;
    strain[1] -= 3e-3;
    assert_true(plasticity_return(&law, &before, strain, &after, stress, tangent));
    for (size_t j = 0; j < 4; j++) {
        double high[4], low[4], moved[4];
        double h = 1e-7;
        memcpy(moved, strain, sizeof moved);
        moved[j] = strain[j] + h;
        plasticity_return(&law, &before, moved, &after, high, NULL);
        moved[j] = strain[j] - h;
        plasticity_return(&law, &before, moved, &after, low, NULL);
        for (size_t i = 0; i < 4; i++) {
            near_scaled(tangent[4 * i + j], (high[i] - low[i]) / (2.0 * h), law.shear, 1e-6);
            near_scaled(tangent[4 * i + j], tangent[4 * j + i], law.shear, 1e-14);
        }
    }
}

/* the increment fulfils its equation, for rates from far below to far above the reference */
static void increments_have_the_stress_of_their_rate(void **unused)
{
    (void)unused;
    static const struct yield_rate stated[] = {{.reference = 40.0, .exponent = 5.0},
                                               {.reference = 6500.0, .exponent = 1.0},
                                               {.reference = 1.0, .coefficient = 0.014},
                                               {.reference = 1.0, .coefficient = 0.5},
                                               {.reference = 1e-9, .exponent = 20.0}};
    struct plastic_law law = plastic_law_make(&hardening);
    double path = 0.01, yield = law.yield + law.hardening * path;
    for (size_t i = 0; i < sizeof stated / sizeof *stated; i++)
        for (double step = 1e-10; step < 1e4; step *= 100.0)
            for (double over = 1e-6; over < 20.0; over *= 7.0) {
                double trial = (1.0 + over) * yield;
                double increment = plasticity_increment(&law, &stated[i], path, trial, step);
                double factor = yield_rate_factor(&stated[i], increment / step);
                near_relative(3.0 * law.shear * increment +
                                  (yield + law.hardening * increment) * factor,
                              trial, 1e-9);
                assert_true(increment >= 0.0);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(follows_the_bilinear_curve),
        cmocka_unit_test(ideal_shear_stays_at_yield),
        cmocka_unit_test(elastic_matches_hooke),
        cmocka_unit_test(tangent_is_the_derivative),
        cmocka_unit_test(increments_have_the_stress_of_their_rate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
