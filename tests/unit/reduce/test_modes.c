/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/tools/reduce/modes.c and lanczos.c. */
#include <string.h>

#include "unit/reduce/solve_mesh.h"

static const struct material STEEL = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0};

/* A x - t x with A = (K + s M)^-1 M, t = 1/(w^2 + s), in the norm of M over t. Without rigid
 * motions, of 1/s, which rounding brings in and the search takes out. */
static double residual(struct solved *solved, size_t mode)
{
    size_t n = solved->modes.n;
    struct fault fault;
    const double *shape = solved->modes.shapes + mode * n;
    double *x = calloc(n, sizeof *x), omega = solved->modes.omega[mode];
    double t = 1.0 / (omega * omega + solved->modes.shift);
    sparse_multiply(&solved->matrices.mass, 1, shape, x);
    assert_int_equal(factor_solve(solved->factor, 1, x, &fault), PERCUSS_OK);
    for (size_t i = 0; i < n; i++)
        x[i] -= t * shape[i];
    for (size_t r = 0; r < solved->rigid_count; r++) {
        const double *rigid = solved->rigid + r * n;
        double part = sparse_product(&solved->matrices.mass, rigid, x);
        for (size_t i = 0; i < n; i++)
            x[i] -= part * rigid[i];
    }
    double norm = sqrt(sparse_product(&solved->matrices.mass, x, x)) / t;
    free(x);
    return norm;
}

/* A square bar has each bending frequency twice: both copies are found, the count is confirmed,
 * every residual is what is promised, and K's energy is the frequency's square. */
static void test_square_bar(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct solved solved;
    solid_shape_block(ELEMENT_HEX20, (double[3]){0.5, 0.02, 0.02}, (size_t[3]){20, 2, 2}, &STEEL,
                      &mesh);
    solve_mesh(&mesh, 0, INFINITY, 40, &solved);
    assert_int_equal(solved.rigid_count, 6);
    assert_int_equal(solved.modes.count, 40);
    assert_true(solved.modes.confirmed >= 40);
    near(solved.modes.doubt, 0.0, 1e-12);
    for (size_t i = 0; i < 6; i += 2)
        near_relative(solved.modes.omega[i + 1], solved.modes.omega[i], 1e-9);
    for (size_t i = 0; i < 40; i++) {
        const double *shape = solved.modes.shapes + i * solved.modes.n;
        assert_true(residual(&solved, i) < 2.0 * 1e-8);
        near_relative(sqrt(sparse_product(&solved.matrices.stiffness, shape, shape)),
                      solved.modes.omega[i], 1e-9);
    }
    solved_free(&solved);
    solid_mesh_free(&mesh);
}

/* A number that ends between the copies of a frequency takes both. */
static void test_copies_stay_together(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct solved solved;
    solid_shape_block(ELEMENT_HEX20, (double[3]){0.5, 0.02, 0.02}, (size_t[3]){20, 2, 2}, &STEEL,
                      &mesh);
    /* bendings lie lowest, in pairs: two and two */
    for (size_t most = 1; most <= 4; most++) {
        solve_mesh(&mesh, 0, INFINITY, most, &solved);
        assert_int_equal(solved.modes.count, most + most % 2);
        assert_true(solved.modes.confirmed >= solved.modes.count);
        solved_free(&solved);
    }
    solid_mesh_free(&mesh);
}

/* The same modes by their number and by a frequency between two of them; same bits each time. */
static void test_by_frequency(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct solved by_number, by_frequency, again;
    solid_shape_block(ELEMENT_TET10, (double[3]){0.1, 0.03, 0.02}, (size_t[3]){4, 1, 1}, &STEEL,
                      &mesh);
    solve_mesh(&mesh, 0, INFINITY, 12, &by_number);
    double hertz = 0.25 / M_PI * (by_number.modes.omega[8] + by_number.modes.omega[9]);
    solve_mesh(&mesh, 0, hertz, 100, &by_frequency);
    solve_mesh(&mesh, 0, hertz, 100, &again);
    assert_int_equal(by_frequency.modes.count, 9);
    assert_int_equal(by_frequency.modes.confirmed, 9);
    for (size_t i = 0; i < 9; i++)
        near_relative(by_frequency.modes.omega[i], by_number.modes.omega[i], 1e-10);
    assert_memory_equal(by_frequency.modes.shapes, again.modes.shapes,
                        9 * again.modes.n * sizeof(double));
    solved_free(&by_number);
    solved_free(&by_frequency);
    solved_free(&again);
    solid_mesh_free(&mesh);
}

/* A second process counts while the first seeks modes; they are the same to the last bit. */
static void test_count_ahead(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct solved alone;
    struct fault fault;
    struct modes modes;
    struct factor *factor = NULL;
    solid_shape_block(ELEMENT_TET10, (double[3]){0.1, 0.03, 0.02}, (size_t[3]){4, 1, 1}, &STEEL,
                      &mesh);
    solve_mesh(&mesh, 0, INFINITY, 12, &alone);
    assert_false(alone.modes.counted_ahead);
    size_t n = alone.matrices.stiffness.n;
    struct modes_task task = {.matrices = &alone.matrices,
                              .rigid = {n, alone.rigid_count, alone.rigid},
                              .scale = alone.scale,
                              .below = INFINITY,
                              .most = 12,
                              .known = SIZE_MAX,
                              .two_factors = true,
                              .processes = 2};
    assert_int_equal(modes_find(&task, &modes, &factor, &fault), PERCUSS_OK);
    assert_true(modes.counted_ahead);
    assert_int_equal(modes.confirmed, alone.modes.confirmed);
    /* below a frequency of its own, between the same two modes */
    assert_true(modes.omega[modes.confirmed - 1] < modes.confirmed_below &&
                modes.confirmed_below < modes.omega[modes.confirmed]);
    assert_int_equal(modes.count, alone.modes.count);
    assert_memory_equal(modes.shapes, alone.modes.shapes, modes.count * n * sizeof(double));
    modes_free(&modes);
    factor_free(factor);
    solved_free(&alone);
    solid_mesh_free(&mesh);
}

/* One factor serves modes and statics, also where memory holds only one at a time. Where the first
 * frequency was guessed far too high it is made anew, and where the guess is not as bad, not. */
static void test_guessed_scale(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct solved solved;
    struct fault fault;
    solid_shape_block(ELEMENT_TET10, (double[3]){0.1, 0.03, 0.02}, (size_t[3]){4, 1, 1}, &STEEL,
                      &mesh);
    solve_mesh(&mesh, 0, INFINITY, 12, &solved);
    double first = solved.modes.omega[0] * solved.modes.omega[0];
    near_relative(solved.modes.shift, 1e-3 * solved.scale, 1e-12);
    assert_true(solved.scale > 0.3 * first && solved.scale < 3.0 * first);
    for (int guess = 0; guess < 4; guess++) {
        struct modes modes;
        struct factor *factor = NULL;
        struct modes_task task = {.matrices = &solved.matrices,
                                  .rigid = {solved.modes.n, 6, solved.rigid},
                                  .scale = first * (guess / 2 ? 1e4 : 10.0),
                                  .below = INFINITY,
                                  .most = 12,
                                  .known = SIZE_MAX,
                                  .two_factors = guess % 2};
        assert_int_equal(modes_find(&task, &modes, &factor, &fault), PERCUSS_OK);
        for (size_t i = 0; i < 12; i++)
            near_relative(modes.omega[i], solved.modes.omega[i], 1e-10);
        near_relative(modes.shift, guess / 2 ? 1e-3 * first : 1e-2 * first, 1e-9);
        /* the factor is of that shift: (K + s M) x = (w^2 + s) M x */
        double *x = calloc(modes.n, sizeof *x), t = 1.0 / (first + modes.shift);
        sparse_multiply(&solved.matrices.mass, 1, modes.shapes, x);
        assert_int_equal(factor_solve(factor, 1, x, &fault), PERCUSS_OK);
        near_relative(sqrt(sparse_product(&solved.matrices.mass, x, x)), t, 1e-7);
        free(x);
        factor_free(factor);
        modes_free(&modes);
    }
    solved_free(&solved);
    solid_mesh_free(&mesh);
}

/* A bar without lateral contraction held at one end: its longitudinal frequencies are (2k - 1) c/4L
 * in three dimensions too. Held at a corner alone it can turn about it. */
static void test_supports(void **state)
{
    (void)state;
    struct material cork = STEEL;
    struct solid_mesh mesh;
    struct solved solved;
    cork.poisson = 0.0;
    solid_shape_block(ELEMENT_HEX20, (double[3]){0.2, 0.1, 0.1}, (size_t[3]){8, 2, 2}, &cork,
                      &mesh);
    solve_mesh(&mesh, 1, INFINITY, 12, &solved);
    assert_int_equal(solved.rigid_count, 0);
    double expected = 0.5 * M_PI * sqrt(210e9 / 7800.0) / 0.2, nearest = INFINITY;
    for (size_t i = 0; i < 12; i++)
        nearest = fmin(nearest, fabs(solved.modes.omega[i] / expected - 1.0));
    /* quadratic elements of length h give (k h)^4/1440 too much at wave number k */
    double excess = pow(2.0 * M_PI / 32.0, 4.0) / 1440.0;
    near(nearest, excess, 0.05 * excess);
    for (size_t i = 0; i < mesh.set[0].count; i++)
        near(solved.modes.shapes[3 * mesh.set[0].nodes[i]], 0.0, 0.0);
    solved_free(&solved);
    mesh.set[0].count = 1;
    solve_mesh(&mesh, 1, INFINITY, 4, &solved);
    assert_int_equal(solved.rigid_count, 3);
    solved_free(&solved);
    solid_mesh_free(&mesh);
}

/* All modes of one element but a few, and more than it has. */
static void test_one_element(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct solved solved;
    struct fault fault;
    solid_shape_block(ELEMENT_HEX20, (double[3]){0.1, 0.1, 0.1}, (size_t[3]){1, 1, 1}, &STEEL,
                      &mesh);
    solve_mesh(&mesh, 0, INFINITY, 50, &solved);
    near(solved.modes.doubt, 0.0, 1e-12);
    struct modes modes;
    struct factor *factor = NULL;
    struct modes_task task = {.matrices = &solved.matrices,
                              .rigid = {60, 6, solved.rigid},
                              .scale = solved.scale,
                              .below = INFINITY,
                              .most = 51,
                              .known = SIZE_MAX};
    assert_int_equal(modes_find(&task, &modes, &factor, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "at most 50"));
    solved_free(&solved);
    solid_mesh_free(&mesh);
}

/* A stiffness of a few degrees of freedom alone: all others move without any, and more of them than
 * are found. With a large shift rounding hides all modes, and the search ends. */
static void test_missing_stiffness(void **state)
{
    (void)state;
    enum { STIFF = 20 };
    struct solid_mesh mesh;
    struct solved solved;
    struct fault fault;
    solid_shape_block(ELEMENT_HEX20, (double[3]){0.1, 0.05, 0.05}, (size_t[3]){2, 1, 1}, &STEEL,
                      &mesh);
    solve_mesh(&mesh, 0, INFINITY, 4, &solved);
    struct sparse *stiffness = &solved.matrices.stiffness;
    for (size_t i = 0; i < stiffness->start[stiffness->n]; i++)
        if (stiffness->column[i] >= STIFF)
            stiffness->value[i] = 0.0;
    struct modes modes;
    struct factor *factor = NULL;
    struct modes_task task = {.matrices = &solved.matrices,
                              .rigid = {solved.modes.n, 0, NULL},
                              .scale = solved.scale,
                              .below = INFINITY,
                              .most = 20,
                              .known = SIZE_MAX};
    assert_int_equal(modes_find(&task, &modes, &factor, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "where there are 76: are stiffness and mass whole"));
    assert_null(factor);
    task.scale *= 1e3;
    assert_int_equal(modes_find(&task, &modes, &factor, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "24 modes: all 96 vectors that there are do not hold them"));
    assert_null(factor);
    solved_free(&solved);
    solid_mesh_free(&mesh);
}

static bool objects(void *context, double done)
{
    *(double *)context = done;
    return done < 0.5;
}

static void test_can_be_stopped(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct solved solved;
    struct fault fault;
    double told = 0.0;
    solid_shape_block(ELEMENT_HEX20, (double[3]){0.1, 0.1, 0.1}, (size_t[3]){2, 2, 2}, &STEEL,
                      &mesh);
    solve_mesh(&mesh, 0, INFINITY, 10, &solved);
    struct modes modes;
    struct factor *factor = NULL;
    struct watch watch = {objects, &told};
    struct modes_task task = {.matrices = &solved.matrices,
                              .rigid = {solved.modes.n, 6, solved.rigid},
                              .scale = solved.scale,
                              .below = INFINITY,
                              .most = 20,
                              .known = SIZE_MAX,
                              .watch = &watch};
    assert_int_equal(modes_find(&task, &modes, &factor, &fault), PERCUSS_TIMEOUT);
    assert_true(told >= 0.5 && told < 1.0);
    assert_null(factor);
    solved_free(&solved);
    solid_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_square_bar),     cmocka_unit_test(test_copies_stay_together),
        cmocka_unit_test(test_by_frequency),   cmocka_unit_test(test_supports),
        cmocka_unit_test(test_one_element),    cmocka_unit_test(test_missing_stiffness),
        cmocka_unit_test(test_can_be_stopped), cmocka_unit_test(test_guessed_scale),
        cmocka_unit_test(test_count_ahead),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
