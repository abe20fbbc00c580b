/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/tools/reduce/factor.c. */
#include <string.h>

#include "check.h"
#include "reduce/factor.h"
#include "shapes/solid_shapes.h"

static const struct material STEEL = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0};

/* A chain of 50 equal masses between walls: K = tridiagonal (-1 2 -1), M = 1, eigenvalues
 * 4 sin^2(j pi/102). */
enum { CHAIN = 50 };
static void chain(struct matrices *matrices)
{
    struct sparse_entry stiffness[2 * CHAIN], mass[CHAIN];
    size_t count = 0;
    for (uint32_t i = 0; i < CHAIN; i++) {
        mass[i] = (struct sparse_entry){i, i, 1.0};
        stiffness[count++] = (struct sparse_entry){i, i, 2.0};
        if (i > 0)
            stiffness[count++] = (struct sparse_entry){i - 1, i, -1.0};
    }
    *matrices = (struct matrices){0};
    assert_true(sparse_from_entries(&matrices->stiffness, CHAIN, count, stiffness, false));
    assert_true(sparse_from_entries(&matrices->mass, CHAIN, CHAIN, mass, false));
}

static void test_counts_eigenvalues(void **state)
{
    (void)state;
    struct matrices matrices;
    struct factor *factor;
    struct fault fault;
    chain(&matrices);
    assert_int_equal(factor_analyse(&matrices, FACTOR_INDEFINITE, NULL, &factor, &fault),
                     PERCUSS_OK);
    /* one order of unknowns serves every shift */
    for (size_t j = 1; j < CHAIN; j++) {
        double between = 4.0 * pow(sin(((double)j + 0.5) * M_PI / (2.0 * CHAIN + 2.0)), 2.0);
        assert_int_equal(factor_compute(factor, -between, &fault), PERCUSS_OK);
        assert_int_equal(factor_negatives(factor), j);
    }
    factor_free(factor);
    matrices_free(&matrices);
}

/* Unit forces at the first and the last mass: displacements fall linearly to the other wall. */
static void test_solves(void **state)
{
    (void)state;
    struct matrices matrices;
    struct factor *factor;
    struct fault fault;
    double b[2 * CHAIN] = {1.0};
    b[2 * CHAIN - 1] = 1.0;
    chain(&matrices);
    assert_int_equal(factor_analyse(&matrices, FACTOR_POSITIVE, NULL, &factor, &fault), PERCUSS_OK);
    assert_true(factor_cost(factor).memory > 0.0);
    assert_int_equal(factor_compute(factor, 0.0, &fault), PERCUSS_OK);
    assert_int_equal(factor_solve(factor, 2, b, &fault), PERCUSS_OK);
    for (size_t i = 0; i < CHAIN; i++) {
        near(b[i], (double)(CHAIN - i) / (CHAIN + 1.0), 1e-13);
        near(b[CHAIN + i], (double)(i + 1) / (CHAIN + 1.0), 1e-13);
    }
    /* another one takes its order of unknowns, and does not need it any more */
    struct factor *like;
    double again[CHAIN] = {1.0};
    assert_int_equal(factor_analyse(&matrices, FACTOR_INDEFINITE, factor, &like, &fault),
                     PERCUSS_OK);
    factor_free(factor);
    assert_int_equal(factor_compute(like, 0.0, &fault), PERCUSS_OK);
    assert_int_equal(factor_solve(like, 1, again, &fault), PERCUSS_OK);
    for (size_t i = 0; i < CHAIN; i++)
        near(again[i], b[i], 1e-13);
    factor_free(like);
    matrices_free(&matrices);
}

/* The same chain stretched beyond its first eigenvalue is not positive definite. */
static void test_refuses_what_is_not_positive(void **state)
{
    (void)state;
    struct matrices matrices;
    struct factor *factor;
    struct fault fault;
    chain(&matrices);
    assert_int_equal(factor_analyse(&matrices, FACTOR_POSITIVE, NULL, &factor, &fault), PERCUSS_OK);
    assert_int_equal(factor_compute(factor, -0.01, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "negative eigenvalues"));
    factor_free(factor);
    matrices_free(&matrices);
}

/* A bar without lateral contraction, held at one end and pulled evenly at the other: the field x,
 * of which the forces are K times it. Their sum is E A times the strain. */
static void test_held_bar(void **state)
{
    (void)state;
    struct material cork = STEEL;
    struct solid_mesh mesh;
    struct matrices matrices;
    struct factor *factor;
    struct fault fault;
    cork.poisson = 0.0;
    solid_shape_block(ELEMENT_HEX20, (double[3]){1.0, 0.1, 0.1}, (size_t[3]){10, 1, 1}, &cork,
                      &mesh);
    assert_int_equal(matrices_make(&mesh, &matrices, &fault), PERCUSS_OK);
    size_t n = 3 * mesh.node_count;
    double *x = calloc(n, sizeof *x), *b = calloc(n, sizeof *b);
    for (size_t i = 0; i < mesh.node_count; i++)
        x[3 * i] = mesh.points[i][0];
    sparse_multiply(&matrices.stiffness, 1, x, b);
    assert_int_equal(matrices_hold(&matrices, &mesh.set[0], &fault), PERCUSS_OK);
    assert_int_equal(factor_analyse(&matrices, FACTOR_POSITIVE, NULL, &factor, &fault), PERCUSS_OK);
    assert_int_equal(factor_compute(factor, 0.0, &fault), PERCUSS_OK);
    double force = 0.0;
    for (size_t i = 0; i < mesh.set[1].count; i++)
        force += b[3 * mesh.set[1].nodes[i]];
    near_relative(force, 210e9 * 0.01, 1e-10);
    assert_int_equal(factor_solve(factor, 1, b, &fault), PERCUSS_OK);
    for (size_t i = 0; i < n; i++)
        near(b[i], x[i], 1e-11);
    free(x);
    free(b);
    factor_free(factor);
    matrices_free(&matrices);
    solid_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_counts_eigenvalues),
        cmocka_unit_test(test_solves),
        cmocka_unit_test(test_refuses_what_is_not_positive),
        cmocka_unit_test(test_held_bar),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
