/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/dynamics.c: levels, rigid motion, the
 * lowest vibration of a rod, energy over many periods. */
#include <string.h>

#include "check.h"
#include "fe/dynamics.h"

static const double ROD_RADIUS = 0.01, ROD_LENGTH = 0.2, SPHERE_RADIUS = 0.015;
static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
static const struct material aluminium = {"al", 70e9, 0.33, 2700.0, INFINITY, 0.0};

struct pair_of_bodies {
    struct mesh mesh[2];
    struct arena arena;
    struct dynamics dynamics;
    double *before;
};

static int set_up(void **state)
{
    static struct pair_of_bodies pair;
    struct mesh_grade grade = {
        .size = 1.5e-4, .core = 6, .growth = 1.2, .matched = 1.2e-3, .coarse = 2e-3};
    struct fault fault = {""};
    pair = (struct pair_of_bodies){0};
    if (mesh_sphere(SPHERE_RADIUS, &grade, &pair.mesh[0], &fault) != PERCUSS_OK ||
        mesh_cylinder(ROD_RADIUS, ROD_LENGTH, &grade, &pair.mesh[1], &fault) != PERCUSS_OK)
        return -1;
    struct dynamics_body body[2] = {
        {.mesh = &pair.mesh[0],
         .material = steel,
         .mass = steel.density * 4.0 / 3.0 * M_PI * pow(SPHERE_RADIUS, 3),
         .fine = 8},
        {.mesh = &pair.mesh[1],
         .material = aluminium,
         .mass = aluminium.density * M_PI * ROD_RADIUS * ROD_RADIUS * ROD_LENGTH,
         .fine = 8}};
    if (dynamics_create(body, 0.75, &pair.arena, &pair.dynamics, &fault) != PERCUSS_OK)
        return -1;
    pair.before = malloc(2 * pair.dynamics.nodes * sizeof(double));
    *state = &pair;
    return pair.before ? 0 : -1;
}

static int tear_down(void **state)
{
    struct pair_of_bodies *pair = *state;
    mesh_free(&pair->mesh[0]);
    mesh_free(&pair->mesh[1]);
    arena_release(&pair->arena);
    free(pair->before);
    return 0;
}

/* one step of the coarsest level; the energy at its start */
static struct dynamics_energy advance(struct pair_of_bodies *pair)
{
    struct dynamics *dynamics = &pair->dynamics;
    struct dynamics_energy energy = {0};
    memcpy(pair->before, dynamics->v, 2 * dynamics->nodes * sizeof(double));
    for (size_t n = 0; n < dynamics_period(dynamics); n++) {
        dynamics_kick(dynamics, n);
        if (n == 0)
            energy = dynamics_energy(dynamics, pair->before);
        dynamics_drift(dynamics, n);
    }
    return energy;
}

static void advance_silently(struct pair_of_bodies *pair)
{
    for (size_t n = 0; n < dynamics_period(&pair->dynamics); n++) {
        dynamics_kick(&pair->dynamics, n);
        dynamics_drift(&pair->dynamics, n);
    }
}

static void every_element_has_one_place(void **state)
{
    struct pair_of_bodies *pair = *state;
    const struct dynamics *dynamics = &pair->dynamics;
    unsigned char *seen = calloc(dynamics->elements, 1);
    size_t total = 0;
    assert_non_null(seen);
    assert_true(dynamics->levels >= 4);
    for (unsigned k = 0; k < dynamics->levels; k++) {
        const struct dynamics_level *level = &dynamics->level[k];
        assert_true(level->elements > 0);
        for (size_t i = 0; i < level->elastics * FE_LANES; i++) {
            const struct elastic_block *block = &level->elastic[i / FE_LANES];
            uint32_t e = block->element[i % FE_LANES];
            if (e == UINT32_MAX)
                continue;
            assert_true(seen[e]++ == 0 && dynamics->element_level[e] == k);
            total++;
            /* nodes wait for no coarser level than their elements' */
            for (int a = 0; a < 4; a++)
                assert_true(block->node[a][i % FE_LANES] < level->last);
        }
    }
    assert_true(total == dynamics->elements);
    free(seen);
}

/* in flight no forces arise, and the axis stays straight */
static void bodies_fly_without_force(void **state)
{
    struct pair_of_bodies *pair = *state;
    struct dynamics *dynamics = &pair->dynamics;
    dynamics_launch(dynamics, 0, 2.0);
    dynamics_launch(dynamics, 1, -0.5);
    struct dynamics_energy energy = {0};
    for (int i = 0; i < 50; i++)
        energy = advance(pair);
    near_scaled(dynamics_mean(dynamics, 0, dynamics->v), 2.0, 2.0, 1e-12);
    near_scaled(dynamics_mean(dynamics, 1, dynamics->v), -0.5, 0.5, 1e-12);
    double time = 50.0 * (double)dynamics_period(dynamics) * dynamics->step;
    near_scaled(dynamics_mean(dynamics, 0, dynamics->y), 2.0 * time, time, 1e-12);
    near_scaled(energy.kinetic[0], 0.5 * dynamics->mass[0] * 4.0, energy.kinetic[0], 1e-12);
    near_scaled(energy.vibration[0], 0.0, energy.kinetic[0], 1e-12);
    near_scaled(energy.strain[0], 0.0, energy.kinetic[0], 1e-12);
}

/* sum(m cos(pi s / L) x): the share of the rod's lowest vibration */
static double projection(const struct dynamics *dynamics, const double *x)
{
    double sum = 0.0;
    for (size_t i = 0; i < dynamics->body[1].mesh->nodes; i++) {
        uint32_t node = dynamics->number[1][i];
        double shape = cos(M_PI * dynamics->at[node][1] / ROD_LENGTH);
        sum += dynamics->root_mass[node] * shape * x[2 * node + 1];
    }
    return sum;
}

/* Rayleigh-Love: omega = (pi c / L) / sqrt(1 + (nu pi r / L)^2 / 2), good to 1e-5 here (next term
 * of the Pochhammer series); the mesh of 2 mm elements, 100 to a half wave, adds (pi/100)^2/24 =
 * 4e-5. Energy: four periods of leapfrog at 0.75 of the limit; its error oscillates and does not
 * grow. */
static void rod_rings_at_its_lowest_frequency(void **state)
{
    struct pair_of_bodies *pair = *state;
    struct dynamics *dynamics = &pair->dynamics;
    for (size_t i = 0; i < dynamics->body[1].mesh->nodes; i++) {
        uint32_t node = dynamics->number[1][i];
        dynamics->v[2 * node + 1] =
            dynamics->root_mass[node] * cos(M_PI * dynamics->at[node][1] / ROD_LENGTH);
    }
    double slenderness = aluminium.poisson * M_PI * ROD_RADIUS / ROD_LENGTH;
    double expected = 2.0 * ROD_LENGTH * sqrt(aluminium.density / aluminium.young) *
                      sqrt(1.0 + 0.5 * slenderness * slenderness);
    double period = (double)dynamics_period(dynamics) * dynamics->step;
    double first = 0.0, last = 0.0, worst = 0.0, most_strain = 0.0;
    double start = 0.0;
    int crossings = 0;
    for (int i = 0; crossings < 8; i++) {
        double q = projection(dynamics, dynamics->y);
        struct dynamics_energy energy = advance(pair);
        double next = projection(dynamics, dynamics->y);
        double total = energy.kinetic[1] + energy.strain[1];
        start = i == 0 ? total : start;
        worst = fmax(worst, fabs(total / start - 1.0));
        most_strain = fmax(most_strain, energy.strain[1]);
        if (q * next < 0.0) {
            last = ((double)i + q / (q - next)) * period;
            first = crossings++ == 0 ? last : first;
        }
    }
    near_scaled((last - first) / 3.5, expected, expected, 1e-4);
    near_scaled(worst, 0.0, 1.0, 1e-4);
    near_scaled(most_strain, start, start, 1e-2);
}

/* Noise in every vibration there is, to the highest that the meshes can hold: nested steps have no
 * resonance among them, and energy has no trend in 3000 steps of the coarsest level. It starts as
 * kinetic alone, so the velocities' half step hides 4 % that later swing by under 1 %. */
static void noise_does_not_grow(void **state)
{
    struct pair_of_bodies *pair = *state;
    struct dynamics *dynamics = &pair->dynamics;
    uint64_t seed = 1;
    for (size_t i = 0; i < 2 * dynamics->nodes; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        bool fixed = i % 2 == 0 && dynamics->at[i / 2][0] == 0.0;
        double random = (double)(seed >> 33) / (double)(1u << 30) - 1.0;
        dynamics->v[i] = fixed ? 0.0 : random * dynamics->root_mass[i / 2];
    }
    double early[2] = {0.0}, late[2] = {0.0};
    for (int i = 0; i < 3000; i++) {
        struct dynamics_energy energy = {0};
        if (i % 50 == 25)
            energy = advance(pair);
        else
            advance_silently(pair);
        for (int b = 0; b < 2; b++) {
            early[b] += i < 1500 ? energy.kinetic[b] + energy.strain[b] : 0.0;
            late[b] += i < 1500 ? 0.0 : energy.kinetic[b] + energy.strain[b];
        }
    }
    for (int b = 0; b < 2; b++) {
        assert_true(early[b] > 0.0);
        near_scaled(late[b], early[b], early[b], 5e-3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_element_has_one_place, set_up, tear_down),
        cmocka_unit_test_setup_teardown(bodies_fly_without_force, set_up, tear_down),
        cmocka_unit_test_setup_teardown(rod_rings_at_its_lowest_frequency, set_up, tear_down),
        cmocka_unit_test_setup_teardown(noise_does_not_grow, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
