/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/quad.c: constant strain, rigid motion, refusals, and no locking: a thick tube
 * at nu = 0.4999 and at its plastic limit load. */
#include <string.h>

#include "check.h"
#include "fe/quad.h"
#include "numeric/linear.h"

static const double ring_r[4] = {1.0, 1.4, 1.5, 0.9};
static const double ring_z[4] = {0.0, 0.1, 0.6, 0.5};

static void has_constant_strain(void **state)
{
    (void)state;
    struct quad quad;
    assert_true(quad_make(ring_r, ring_z, &quad));
    /* u_r = 0.3 r, u_z = 0.7 z + 0.2: hoop and radial strain 0.3, no shear */
    double u[8], strain[4], volume = 0.0;
    for (int i = 0; i < 4; i++) {
        u[2 * i] = 0.3 * ring_r[i];
        u[2 * i + 1] = 0.7 * ring_z[i] + 0.2;
    }
    for (int p = 0; p < QUAD_POINTS; p++) {
        quad_strain(&quad, p, u, strain);
        double expected[4] = {0.3, 0.7, 0.3, 0.0};
        for (int c = 0; c < 4; c++)
            assert_true(fabs(strain[c] - expected[c]) < 1e-14);
        volume += quad.volume[p];
    }
    /* Pappus: two triangles */
    double a = 0.5 * ((1.4 - 1.0) * 0.6 - 0.5 * 0.1) * (1.0 + 1.4 + 1.5) / 3.0;
    double b = 0.5 * (0.5 * 0.5 - (0.9 - 1.0) * 0.6) * (1.0 + 1.5 + 0.9) / 3.0;
    assert_true(fabs(volume / (2.0 * M_PI * (a + b)) - 1.0) < 1e-13);
}

static void refuses_folded_elements(void **state)
{
    (void)state;
    struct quad quad;
    /* clockwise; a corner that turns inward */
    const double r[4] = {1.0, 1.0, 2.0, 2.0}, z[4] = {0.0, 1.0, 1.0, 0.0};
    assert_false(quad_make(r, z, &quad));
    const double folded[4] = {1.0, 2.0, 0.2, 1.0};
    const double height[4] = {0.0, 0.0, -0.4, 1.0};
    assert_false(quad_make(folded, height, &quad));
}

/* A long tube 1 <= r <= 2 in plane strain under inner pressure: `n` elements, free in r alone. */
enum { TUBE = 16 };

static double tube_r(size_t i)
{
    return 1.0 + (double)i / TUBE;
}

/* one Newton step at an inner pressure or, `driven`, an inner displacement; returns the unbalance
 */
static double tube_step(const struct plastic_law *law, struct plastic_state before[TUBE][4],
                        struct plastic_state after[TUBE][4], double *u, double pressure,
                        double driven)
{
    double matrix[(TUBE + 1) * (TUBE + 1)] = {0.0}, force[TUBE + 1] = {0.0};
    for (size_t e = 0; e < TUBE; e++) {
        struct quad quad;
        double r[4] = {tube_r(e), tube_r(e + 1), tube_r(e + 1), tube_r(e)};
        double z[4] = {0.0, 0.0, 1.0, 1.0};
        double local[8] = {u[e], 0.0, u[e + 1], 0.0, u[e + 1], 0.0, u[e], 0.0};
        double f[8] = {0.0}, k[64] = {0.0};
        quad_make(r, z, &quad);
        for (int p = 0; p < QUAD_POINTS; p++) {
            double strain[4], stress[4], moduli[16];
            quad_strain(&quad, p, local, strain);
            plasticity_return(law, &before[e][p], strain, &after[e][p], stress, moduli);
            quad_add_force(&quad, p, stress, f);
            quad_add_stiffness(&quad, p, moduli, k);
        }
        const size_t node[4] = {e, e + 1, e + 1, e};
        for (int i = 0; i < 4; i++) {
            force[node[i]] -= f[2 * i];
            for (int j = 0; j < 4; j++)
                matrix[node[i] * (TUBE + 1) + node[j]] += k[16 * i + 2 * j];
        }
    }
    force[0] += pressure * 2.0 * M_PI;
    if (driven > 0.0) {
        for (size_t j = 0; j <= TUBE; j++)
            matrix[j] = j == 0;
        force[0] = driven - u[0];
    }
    double worst = 0.0;
    for (size_t i = 0; i <= TUBE; i++)
        worst = fmax(worst, fabs(force[i]));
    assert_true(linear_solve(TUBE + 1, matrix, force));
    for (size_t i = 0; i <= TUBE; i++)
        u[i] += force[i];
    return worst;
}

static void does_not_lock_when_incompressible(void **state)
{
    (void)state;
    struct material rubber = {"rubber", 1.0, 0.4999, 1.0, INFINITY, 0.0};
    struct plastic_law law = plastic_law_make(&rubber);
    struct plastic_state states[TUBE][4] = {0}, after[TUBE][4];
    double u[TUBE + 1] = {0.0};
    tube_step(&law, states, after, u, 1.0, 0.0);
    /* Lame: u = (1 + nu) p / (E (b^2 - a^2)) ((1 - 2 nu) r + b^2 / r) at a = 1, b = 2 */
    double exact = 1.4999 / 3.0 * (0.0002 + 4.0);
    assert_true(fabs(u[0] / exact - 1.0) < 2e-3);
}

static void reaches_the_limit_load(void **state)
{
    (void)state;
    struct material metal = {"metal", 1000.0, 0.3, 1.0, 1.0, 0.0};
    struct plastic_law law = plastic_law_make(&metal);
    struct plastic_state states[TUBE][4] = {0}, after[TUBE][4];
    double u[TUBE + 1] = {0.0};
    for (int step = 1; step <= 40; step++) {
        for (int i = 0; i < 12; i++)
            tube_step(&law, states, after, u, 0.0, step * 2e-4);
        memcpy(states, after, sizeof states);
    }
    /* pressure from balance of half the tube: the hoop stress summed over the thickness. In plane
     * strain the limit is 2/sqrt(3) ln(b/a) of the yield stress. */
    double pressure = 0.0;
    for (size_t e = 0; e < TUBE; e++) {
        struct quad quad;
        double r[4] = {tube_r(e), tube_r(e + 1), tube_r(e + 1), tube_r(e)};
        double z[4] = {0.0, 0.0, 1.0, 1.0};
        double local[8] = {u[e], 0.0, u[e + 1], 0.0, u[e + 1], 0.0, u[e], 0.0};
        quad_make(r, z, &quad);
        for (int p = 0; p < QUAD_POINTS; p++) {
            double strain[4], stress[4];
            struct plastic_state end;
            quad_strain(&quad, p, local, strain);
            plasticity_return(&law, &states[e][p], strain, &end, stress, NULL);
            pressure += 0.25 / TUBE * stress[2];
        }
    }
    double exact = 2.0 / sqrt(3.0) * log(2.0);
    /* with locking the pressure would grow without limit; 16 elements leave h^2 */
    assert_true(fabs(pressure / exact - 1.0) < 3e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(has_constant_strain),
        cmocka_unit_test(refuses_folded_elements),
        cmocka_unit_test(does_not_lock_when_incompressible),
        cmocka_unit_test(reaches_the_limit_load),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
