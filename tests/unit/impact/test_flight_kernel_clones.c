/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/flight_kernel.c: the vector unit chosen at start gives the bits of
 * the baseline. */
#include <string.h>

#include "check.h"

/* The source once more, under other names and for the baseline only. */
#define PERCUSS_ONE_KERNEL
#define flight_kernel_bounds      baseline_bounds
#define flight_kernel_derivatives baseline_derivatives
#define flight_kernel_terms       baseline_terms
#define flight_kernel_turn        baseline_turn
#define flight_kernel_table       baseline_table
#define flight_kernel_step        baseline_step
#define flight_kernel_loss        baseline_loss
#define flight_table              baseline_flight_table
#define FLIGHT_TURN_ANGLE         BASELINE_TURN_ANGLE
#include "impact/flight_kernel.c"
#undef flight_kernel_bounds
#undef flight_kernel_derivatives
#undef flight_kernel_terms
#undef flight_kernel_turn
#undef flight_kernel_table
#undef flight_table
#undef flight_kernel_step
#undef flight_kernel_loss

void flight_kernel_bounds(const struct flight_modes *modes, double *reach, double *bend);
void flight_kernel_derivatives(const struct flight_modes *modes, double sums[SCAN_TERMS]);
void flight_kernel_terms(const struct flight_modes *modes, double length, double sums[ROOT_TERMS]);
void flight_kernel_turn(const struct flight_modes *modes, double time, double *q, double *v);
void flight_kernel_table(const struct flight_modes *modes, double time, double *table);
void flight_kernel_step(const double *table, const struct flight_modes *modes, double *q,
                        double *v);
double flight_kernel_loss(const struct flight_modes *modes, double time);

enum { LONGEST = 64 };

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-52 - 1.0;
}

static void same(const double *a, const double *b, size_t count)
{
    assert_memory_equal(a, b, count * sizeof *a);
}

static void every_vector_unit_gives_the_same_bits(void **state)
{
    (void)state;
    uint64_t seed = 9;
    for (size_t count = 1; count <= LONGEST; count++) {
        _Alignas(32) double phi[LONGEST] = {0.0}, q[LONGEST] = {0.0}, v[LONGEST] = {0.0};
        _Alignas(32) double omega[LONGEST] = {0.0}, damping[LONGEST] = {0.0}, end[4][LONGEST];
        double bounds[4][LONGEST / LANES + 1], sums[2][ROOT_TERMS];
        for (size_t k = 0; k < count; k++) {
            omega[k] = 50.0 * (double)(k + 1) * (double)(k + 1);
            damping[k] = 0.01 + 0.009 * uniform(&seed);
            phi[k] = uniform(&seed);
            q[k] = uniform(&seed);
            v[k] = uniform(&seed);
        }
        for (int damped = 0; damped < 2; damped++) {
            size_t n = (count + LANES - 1) / LANES * LANES;
            struct flight_modes modes = {n, damped ? damping : NULL, omega, phi, q, v};
            flight_kernel_bounds(&modes, bounds[0], bounds[1]);
            baseline_bounds(&modes, bounds[2], bounds[3]);
            same(bounds[0], bounds[2], n / LANES + 1);
            same(bounds[1], bounds[3], n / LANES + 1);
            memset(sums, 0, sizeof sums);
            flight_kernel_derivatives(&modes, sums[0]);
            baseline_derivatives(&modes, sums[1]);
            same(sums[0], sums[1], SCAN_TERMS);
            flight_kernel_terms(&modes, 1e-5, sums[0]);
            baseline_terms(&modes, 1e-5, sums[1]);
            same(sums[0], sums[1], ROOT_TERMS);
            flight_kernel_turn(&modes, 0.7, end[0], end[1]);
            baseline_turn(&modes, 0.7, end[2], end[3]);
            same(end[0], end[2], n);
            same(end[1], end[3], n);
            _Alignas(32) double tables[2][TURN_TERMS * LONGEST];
            flight_kernel_table(&modes, 0.3, tables[0]);
            baseline_table(&modes, 0.3, tables[1]);
            same(tables[0], tables[1], TURN_TERMS * n);
            flight_kernel_step(tables[0], &modes, end[0], end[1]);
            baseline_step(tables[0], &modes, end[2], end[3]);
            same(end[0], end[2], n);
            same(end[1], end[3], n);
            if (!damped)
                continue;
            double losses[2] = {flight_kernel_loss(&modes, 0.7), baseline_loss(&modes, 0.7)};
            same(&losses[0], &losses[1], 1);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_vector_unit_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
