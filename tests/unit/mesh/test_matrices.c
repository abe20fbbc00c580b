/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/mesh/matrices.c and sparse.c. */
#include <string.h>

#include "check.h"
#include "mesh/element.h"
#include "mesh/matrices.h"
#include "shapes/solid_shapes.h"

static const struct material STEEL = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0};

/* Of linear fields u = A x on any mesh: no strain energy in rigid motion, V/2 sigma:eps otherwise;
 * kinetic energy of a translation m/2. */
static void check_energies(enum element_type type)
{
    struct solid_mesh mesh;
    struct matrices matrices;
    struct fault fault;
    static const double spin[3][3] = {{0.0, -1.0, 0.5}, {1.0, 0.0, -2.0}, {-0.5, 2.0, 0.0}};
    static const double strain[3][3] = {{1.0, 0.2, 0.0}, {0.2, -0.5, 0.3}, {0.0, 0.3, 0.1}};
    solid_shape_block(type, (double[3]){1.0, 2.0, 0.5}, (size_t[3]){2, 3, 2}, &STEEL, &mesh);
    assert_int_equal(matrices_make(&mesh, &matrices, &fault), PERCUSS_OK);
    size_t n = 3 * mesh.node_count;
    double *turned = calloc(n, sizeof *turned), *strained = calloc(n, sizeof *strained);
    double *moved = calloc(n, sizeof *moved), *forces = calloc(2 * n, sizeof *forces);
    for (size_t i = 0; i < mesh.node_count; i++)
        for (size_t k = 0; k < 3; k++) {
            moved[3 * i + k] = k == 1 ? 1.0 : 0.0;
            for (size_t j = 0; j < 3; j++) {
                turned[3 * i + k] += spin[k][j] * mesh.points[i][j];
                strained[3 * i + k] += (strain[k][j] + spin[k][j]) * mesh.points[i][j];
            }
        }
    double mu = material_shear_modulus(&STEEL), lambda = 2.0 * mu * 0.3 / 0.4, squares = 0.0;
    for (int i = 0; i < 9; i++)
        squares += strain[i / 3][i % 3] * strain[i / 3][i % 3];
    double energy = lambda * 0.6 * 0.6 + 2.0 * mu * squares;
    near_relative(sparse_product(&matrices.stiffness, strained, strained), energy, 1e-12);
    near_scaled(sparse_product(&matrices.stiffness, turned, turned), 0.0, energy, 1e-12);
    near_scaled(sparse_product(&matrices.stiffness, turned, strained), 0.0, energy, 1e-12);
    near_relative(sparse_product(&matrices.mass, moved, moved), 7800.0, 1e-13);
    /* the product of two vectors at once and that by sums agree */
    memcpy(forces, strained, n * sizeof *forces);
    double *both = calloc(2 * n, sizeof *both);
    memcpy(both, turned, n * sizeof *both);
    memcpy(both + n, strained, n * sizeof *both);
    sparse_multiply(&matrices.stiffness, 2, both, forces);
    double work = 0.0;
    for (size_t i = 0; i < n; i++)
        work += forces[n + i] * strained[i];
    near_relative(work, energy, 1e-12);
    /* many at once are the same to the last bit as each by itself */
    enum { MANY = 11 };
    double *many = calloc(2 * MANY * n, sizeof *many);
    for (size_t i = 0; i < MANY * n; i++)
        many[i] = (double)(i % 7) * strained[i % n] + turned[i % n];
    sparse_multiply(&matrices.stiffness, MANY, many, many + MANY * n);
    for (size_t c = 0; c < MANY; c++) {
        sparse_multiply(&matrices.stiffness, 1, many + c * n, forces);
        assert_memory_equal(forces, many + (MANY + c) * n, n * sizeof *forces);
    }
    free(many);
    free(turned);
    free(strained);
    free(moved);
    free(forces);
    free(both);
    matrices_free(&matrices);
    solid_mesh_free(&mesh);
}

static void test_energies(void **state)
{
    (void)state;
    check_energies(ELEMENT_TET10);
    check_energies(ELEMENT_HEX20);
    check_energies(ELEMENT_HEX27);
    check_energies(ELEMENT_WEDGE15);
}

/* Two materials: the mass is the sum of theirs. */
static void test_parts(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct matrices matrices;
    struct fault fault;
    solid_shape_block(ELEMENT_HEX20, (double[3]){1.0, 1.0, 1.0}, (size_t[3]){4, 1, 1}, &STEEL,
                      &mesh);
    mesh.part = realloc(mesh.part, 2 * sizeof *mesh.part);
    mesh.part[1] = mesh.part[0];
    mesh.part[1].material.density = 1000.0;
    mesh.part_count = 2;
    mesh.parts[2] = 1;
    assert_int_equal(matrices_make(&mesh, &matrices, &fault), PERCUSS_OK);
    double *moved = calloc(3 * mesh.node_count, sizeof *moved);
    for (size_t i = 0; i < mesh.node_count; i++)
        moved[3 * i] = 1.0;
    near_relative(sparse_product(&matrices.mass, moved, moved), 0.75 * 7800.0 + 250.0, 1e-13);
    free(moved);
    matrices_free(&matrices);
    solid_mesh_free(&mesh);
}

/* What is held has its own stiffness and no mass, and touches nothing. */
static void test_held(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct matrices matrices;
    struct fault fault;
    solid_shape_block(ELEMENT_HEX20, (double[3]){1.0, 1.0, 1.0}, (size_t[3]){2, 1, 1}, &STEEL,
                      &mesh);
    assert_int_equal(matrices_make(&mesh, &matrices, &fault), PERCUSS_OK);
    assert_int_equal(mesh.set[0].count, 8);
    assert_int_equal(matrices_hold(&matrices, &mesh.set[0], &fault), PERCUSS_OK);
    size_t n = 3 * mesh.node_count;
    double *x = calloc(2 * n, sizeof *x);
    for (size_t i = 0; i < n; i++)
        x[i] = 1.0;
    sparse_multiply(&matrices.mass, 1, x, x + n);
    for (size_t i = 0; i < mesh.set[0].count; i++) {
        size_t dof = 3 * mesh.set[0].nodes[i] + 1, at = matrices.stiffness.start[dof];
        assert_int_equal(matrices.stiffness.start[dof + 1], at + 1);
        assert_true(matrices.stiffness.value[at] > 0.0);
        assert_true(matrices.held[dof]);
        near(x[n + dof], 0.0, 0.0);
    }
    free(x);
    matrices_free(&matrices);
    solid_mesh_free(&mesh);
}

/* [2 1; 1 3] from entries in any order, the corner in two pieces. */
static void test_entries(void **state)
{
    (void)state;
    static const struct sparse_entry entries[] = {
        {1, 1, 3.0}, {1, 0, 1.0}, {0, 1, 1.0}, {0, 0, 1.5}, {0, 0, 0.5}};
    struct sparse matrix;
    double y[2];
    assert_true(sparse_from_entries(&matrix, 2, COUNT(entries), entries, true));
    sparse_multiply(&matrix, 1, (double[2]){1.0, 10.0}, y);
    near(y[0], 12.0, 0.0);
    near(y[1], 31.0, 0.0);
    sparse_free(&matrix);
}

/* A node that no element has makes the matrices singular: said by its number in the file. */
static void test_node_without_element(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct matrices matrices;
    struct fault fault;
    solid_shape_block(ELEMENT_HEX20, (double[3]){1.0, 1.0, 1.0}, (size_t[3]){2, 1, 1}, &STEEL,
                      &mesh);
    mesh.element_count = 1;
    assert_int_equal(matrices_make(&mesh, &matrices, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "belongs to no element"));
    solid_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_energies),
        cmocka_unit_test(test_parts),
        cmocka_unit_test(test_held),
        cmocka_unit_test(test_entries),
        cmocka_unit_test(test_node_without_element),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
