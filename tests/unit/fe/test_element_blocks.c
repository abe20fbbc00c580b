/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/element_blocks.c: fours of elements against one element
 * with the scalar radial return of fe/plasticity.c. */
#include <string.h>

#include "check.h"
#include "fe/element_blocks.h"

enum { NODES = 10, EMPTY = NODES };

static const struct material metal = {"metal", 70e9, 0.33, 2700.0, 205e6, 3e9};

/* a row of four skewed elements of differing size: bottom nodes 0 ... 4, top nodes 5 ... 9 */
static double at[NODES][2];
static double scale[NODES];

static void set_row(void)
{
    for (int i = 0; i < NODES; i++) {
        at[i][0] = 1e-3 * (i % 5 + 0.1 * (i / 5) + 0.03 * (i % 5) * (i % 5));
        at[i][1] = 1e-3 * (i / 5 + 0.05 * (i % 3));
        scale[i] = 1.0 / sqrt(1e-6 * (1 + i));
    }
}

static void corners(int e, uint32_t node[4])
{
    node[0] = (uint32_t)e;
    node[1] = (uint32_t)e + 1;
    node[2] = (uint32_t)e + 6;
    node[3] = (uint32_t)e + 5;
}

static void element_of(int e, struct quad *quad, uint32_t node[4], double s[4])
{
    double r[4], z[4];
    corners(e, node);
    for (int a = 0; a < 4; a++) {
        r[a] = at[node[a]][0];
        z[a] = at[node[a]][1];
        s[a] = scale[node[a]];
    }
    assert_true(quad_make(r, z, quad));
}

/* three elements and an empty lane, as at the end of a level */
static void fill(struct elastic_block *elastic, struct plastic_block *plastic)
{
    set_row();
    memset(elastic, 0, sizeof *elastic);
    memset(plastic, 0, sizeof *plastic);
    for (int lane = 0; lane < FE_LANES; lane++) {
        uint32_t node[4] = {EMPTY, EMPTY, EMPTY, EMPTY};
        elastic->element[lane] = plastic->element[lane] = lane < 3 ? (uint32_t)lane : UINT32_MAX;
        if (lane < 3) {
            struct quad quad;
            double s[4];
            element_of(lane, &quad, node, s);
            elastic_block_put(elastic, (size_t)lane, &quad, &metal, s);
            plastic_block_put(plastic, (size_t)lane, &quad, &metal, s);
        }
        for (int a = 0; a < 4; a++)
            elastic->node[a][lane] = plastic->node[a][lane] = node[a];
    }
}

/* smooth displacements with a strain of about `size` */
static void deform(double size, double y[2 * (NODES + 1)])
{
    memset(y, 0, 2 * (NODES + 1) * sizeof *y);
    for (int i = 0; i < NODES; i++) {
        double r = at[i][0];
        double z = at[i][1];
        y[2 * i] = size * (0.4 * r + 0.3 * z * r / 1e-3) / scale[i];
        y[2 * i + 1] = size * (-z + 0.5 * r * r / 1e-3) / scale[i];
    }
}

/* mass-weighted forces by the scalar way; states[e][p] are updated */
static void scalar_forces(const double *y, struct plastic_state states[3][4], double *force)
{
    struct plastic_law law = plastic_law_make(&metal);
    memset(force, 0, 2 * (NODES + 1) * sizeof *force);
    for (int e = 0; e < 3; e++) {
        struct quad quad;
        uint32_t node[4];
        double s[4];
        element_of(e, &quad, node, s);
        for (int p = 0; p < 4; p++) {
            double u[8], strain[4], stress[4], f[8] = {0.0};
            for (int i = 0; i < 8; i++)
                u[i] = y[2 * node[i / 2] + i % 2] * s[i / 2];
            quad_strain(&quad, p, u, strain);
            plasticity_return(&law, &states[e][p], strain, &states[e][p], stress, NULL);
            quad_add_force(&quad, p, stress, f);
            for (int i = 0; i < 8; i++)
                force[2 * node[i / 2] + i % 2] += f[i] * s[i / 2];
        }
    }
}

static void compare(const double *v, const double *force, double step)
{
    double largest = 0.0;
    for (int i = 0; i < 2 * NODES; i++)
        largest = fmax(largest, step * fabs(force[i]));
    assert_true(largest > 0.0);
    for (int i = 0; i < 2 * NODES; i++)
        near_scaled(v[i], -step * force[i], largest, 1e-12);
}

static void elastic_fours_are_stiffness_times_displacement(void **unused)
{
    (void)unused;
    static struct elastic_block elastic;
    static struct plastic_block plastic;
    struct plastic_state states[3][4] = {{{{0.0}, 0.0}}};
    _Alignas(32) double y[2 * (NODES + 1)], v[2 * (NODES + 1)] = {0.0};
    double force[2 * (NODES + 1)], energy[FE_LANES], stored = 0.0, lost = 0.0;
    fill(&elastic, &plastic);
    deform(1e-4, y); /* far below yield */
    scalar_forces(y, states, force);
    elastic_blocks_kick(&elastic, 1, y, v, 0.5);
    compare(v, force, 0.5);
    memset(v, 0, sizeof v);
    plastic_blocks_kick(&plastic, 1, y, v, 0.5);
    compare(v, force, 0.5);
    /* half of force times displacement, by both kinds of block */
    double work = 0.0;
    for (int i = 0; i < 2 * NODES; i++)
        work += 0.5 * force[i] * y[i];
    elastic_block_energy(&elastic, y, energy);
    plastic_block_energy(&plastic, y, &stored, &lost);
    near_scaled(energy[0] + energy[1] + energy[2], work, work, 1e-12);
    near_scaled(stored, work, work, 1e-12);
    assert_true(energy[3] == 0.0 && lost == 0.0);
}

/* the energy below which nothing yields: just inside it the stresses are below yield */
static void the_limit_excludes_yield(void **unused)
{
    (void)unused;
    static struct elastic_block elastic;
    static struct plastic_block plastic;
    _Alignas(32) double y[2 * (NODES + 1)];
    double energy[FE_LANES];
    fill(&elastic, &plastic);
    deform(1e-4, y);
    elastic_block_energy(&elastic, y, energy);
    for (int lane = 0; lane < 3; lane++) {
        struct quad quad;
        uint32_t node[4];
        double s[4], u[8];
        double factor = sqrt(elastic.limit[lane] / energy[lane]);
        element_of(lane, &quad, node, s);
        for (int i = 0; i < 8; i++)
            u[i] = factor * y[2 * node[i / 2] + i % 2] * s[i / 2];
        double mises = quad_mises(&quad, &metal, u);
        assert_true(mises <= metal.yield && mises > 0.1 * metal.yield);
    }
}

/* load beyond yield, on, and back: forces and histories of the scalar return at every stage */
static void plastic_fours_flow_like_one_point(void **unused)
{
    (void)unused;
    static struct elastic_block elastic;
    static struct plastic_block plastic;
    struct plastic_state states[3][4] = {{{{0.0}, 0.0}}};
    static const double stage[] = {4e-3, 9e-3, 7e-3, -5e-3};
    _Alignas(32) double y[2 * (NODES + 1)], v[2 * (NODES + 1)];
    double force[2 * (NODES + 1)], stored = 0.0, lost = 0.0, expected = 0.0;
    fill(&elastic, &plastic);
    struct plastic_law law = plastic_law_make(&metal);
    for (size_t i = 0; i < sizeof stage / sizeof *stage; i++) {
        deform(stage[i], y);
        scalar_forces(y, states, force);
        memset(v, 0, sizeof v);
        plastic_blocks_kick(&plastic, 1, y, v, 2.0);
        compare(v, force, 2.0);
    }
    for (int e = 0; e < 3; e++)
        for (int p = 0; p < 4; p++) {
            double path = states[e][p].accumulated;
            assert_true(path > 0.0);
            near_scaled(plastic.accumulated[p][e], path, path, 1e-11);
            expected += plastic.weight[p][e] * path * (law.yield + 0.5 * law.hardening * path);
        }
    plastic_block_energy(&plastic, y, &stored, &lost);
    near_scaled(lost, expected, expected, 1e-11);
}

/* Pulls the row at a rate until `end`, its volume kept; the last forces (times -step) are v.
 * Returns the work of all steps, each by the forces at its end. */
static double pull(struct plastic_block *plastic, double rate, double step, double end, double *v)
{
    _Alignas(32) double y[2 * (NODES + 1)] = {0.0};
    double work = 0.0;
    for (double strain = 0.0; strain < end; strain += rate * step) {
        double more[2 * NODES];
        memset(v, 0, 2 * (NODES + 1) * sizeof *v);
        for (int n = 0; n < NODES; n++) {
            more[2 * n] = -0.5 * rate * step * at[n][0] / scale[n];
            more[2 * n + 1] = rate * step * at[n][1] / scale[n];
        }
        for (int i = 0; i < 2 * NODES; i++)
            y[i] += more[i];
        plastic_blocks_kick(plastic, 1, y, v, step);
        for (int i = 0; i < 2 * NODES; i++)
            work -= v[i] / step * more[i];
    }
    return work;
}

/* Forces of the row under the deviator of a uniaxial stress. Returns its volume. */
static double pulled_forces(double stress, double *force)
{
    const double deviator[4] = {-stress / 3.0, 2.0 / 3.0 * stress, -stress / 3.0, 0.0};
    double volume = 0.0;
    for (int e = 0; e < 3; e++) {
        struct quad quad;
        uint32_t node[4];
        double s[4], f[8] = {0.0};
        element_of(e, &quad, node, s);
        for (int p = 0; p < 4; p++) {
            quad_add_force(&quad, p, deviator, f);
            volume += quad.volume[p];
        }
        for (int n = 0; n < 8; n++)
            force[2 * node[n / 2] + n % 2] += f[n] * s[n / 2];
    }
    return volume;
}

/* A bar of these elements that is pulled at a constant rate: once it flows, its equivalent stress
 * is the yield stress of that rate, to which its forces and its work belong. */
static void a_pulled_bar_has_the_stress_of_its_rate(void **unused)
{
    (void)unused;
    static const struct yield_rate stated[] = {{.reference = 40.0, .exponent = 5.0},
                                               {.reference = 1.0, .coefficient = 0.05}};
    static struct elastic_block elastic;
    static struct plastic_block plastic;
    const double rate = 300.0, step = 1e-7, end = 0.021; /* 700 steps */
    struct plastic_law law = plastic_law_make(&metal);
    for (size_t i = 0; i < sizeof stated / sizeof *stated; i++) {
        _Alignas(32) double v[2 * (NODES + 1)];
        double force[2 * (NODES + 1)] = {0.0};
        fill(&elastic, &plastic);
        plastic.rate = stated[i];
        double work = pull(&plastic, rate, step, end - 0.5 * rate * step, v);
        /* of the strain's rate the elastic part has what hardens: 1 / (1 + H factor / 3 G) flows */
        double factor = 1.0;
        for (int round = 0; round < 20; round++)
            factor = yield_rate_factor(&stated[i],
                                       rate / (1.0 + law.hardening * factor / (3.0 * law.shear)));
        double path = plastic.accumulated[0][0];
        double stress = (law.yield + law.hardening * path) * factor;
        near_relative(path, end - stress / (3.0 * law.shear), 1e-6);
        double volume = pulled_forces(stress, force), largest = 0.0;
        for (int n = 0; n < 2 * NODES; n++)
            largest = fmax(largest, fabs(force[n]));
        for (int n = 0; n < 2 * NODES; n++)
            near_scaled(v[n] / step, -force[n], largest, 1e-6);
        /* all work has gone into flow or is stored, as shear alone; a step's is taken at its end */
        double lost = 0.0, unused_energy = 0.0;
        _Alignas(32) double still[2 * (NODES + 1)] = {0.0};
        plastic_block_energy(&plastic, still, &unused_energy, &lost);
        near_relative(lost + volume * stress * stress / (6.0 * law.shear), work, 1e-3);
        assert_true(lost > 1.1 * volume * path * (law.yield + 0.5 * law.hardening * path));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_fours_are_stiffness_times_displacement),
        cmocka_unit_test(the_limit_excludes_yield),
        cmocka_unit_test(plastic_fours_flow_like_one_point),
        cmocka_unit_test(a_pulled_bar_has_the_stress_of_its_rate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
