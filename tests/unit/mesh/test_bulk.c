/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/mesh/bulk.c. */
#include "check.h"
#include "mesh/bulk.h"
#include "shapes/solid_shapes.h"

static const struct material STEEL = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0};

/* Closed forms of a block; straight elements are exact but for rounding. */
static void test_block(void **state)
{
    (void)state;
    static const double size[3] = {0.1, 0.04, 0.02};
    static const enum element_type types[] = {ELEMENT_TET10, ELEMENT_HEX20, ELEMENT_HEX27,
                                              ELEMENT_WEDGE15};
    for (size_t t = 0; t < COUNT(types); t++) {
        struct solid_mesh mesh;
        struct bulk bulk;
        solid_shape_block(types[t], size, (size_t[3]){4, 2, 1}, &STEEL, &mesh);
        bulk_of(&mesh, &bulk);
        near_relative(bulk.volume, 8e-5, 1e-14);
        near_relative(bulk.mass, 0.624, 1e-14);
        for (int i = 0; i < 3; i++) {
            double y = size[(i + 1) % 3], z = size[(i + 2) % 3];
            near_relative(bulk.centre[i], 0.5 * size[i], 1e-13);
            near_relative(bulk.inertia[4 * i], 0.624 * (y * y + z * z) / 12.0, 1e-12);
            near_scaled(bulk.inertia[3 * i + (i + 1) % 3], 0.0, 0.624e-2, 1e-14);
        }
        near(bulk.smallest_det, 1.0, 1e-12);
        solid_mesh_free(&mesh);
    }
}

/* The left third of a block is of one material, the rest of another: each part by itself, and their
 * sum. */
static void test_parts(void **state)
{
    (void)state;
    static const double size[3] = {0.3, 0.04, 0.02};
    struct solid_mesh mesh;
    struct bulk bulk, left, right;
    struct mesh_part part[2] = {{.material = STEEL}, {.material = STEEL}}, *one;
    part[1].material.density = 2700.0;
    solid_shape_block(ELEMENT_HEX20, size, (size_t[3]){3, 1, 1}, &STEEL, &mesh);
    one = mesh.part;
    mesh.part = part;
    mesh.part_count = 2;
    for (size_t e = 0; e < mesh.element_count; e++)
        mesh.parts[e] = mesh.points[mesh.nodes[mesh.first[e]]][0] < 0.05 ? 0 : 1;
    bulk_of_part(&mesh, 0, &left);
    bulk_of_part(&mesh, 1, &right);
    bulk_of(&mesh, &bulk);
    assert_int_equal(left.element_count, 1);
    assert_int_equal(right.element_count, 2);
    near_relative(left.volume, 8e-5, 1e-13);
    near_relative(left.mass, 0.624, 1e-13);
    near_relative(left.centre[0], 0.05, 1e-13);
    near_relative(right.volume, 1.6e-4, 1e-13);
    near_relative(right.mass, 0.432, 1e-13);
    near_relative(right.centre[0], 0.2, 1e-13);
    near_relative(right.inertia[0], 0.432 * (16e-4 + 4e-4) / 12.0, 1e-12);
    near_relative(bulk.mass, left.mass + right.mass, 1e-14);
    mesh.part = one;
    mesh.part_count = 1;
    solid_mesh_free(&mesh);
}

/* Parabolas through nodes that are spaced by an angle a enclose a^4/30 less than the circle: a is
 * pi/16 between the nodes of 16 elements around; the next term is of a^6. */
static void test_cylinder(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct bulk bulk;
    solid_shape_cylinder(ELEMENT_HEX20, (double[2]){0.01, 0.05}, (size_t[3]){2, 2, 5}, &STEEL,
                         &mesh);
    bulk_of(&mesh, &bulk);
    double volume = M_PI * 1e-4 * 0.05;
    double missing = pow(M_PI / 16.0, 4.0) / 30.0;
    near_relative(bulk.volume, volume * (1.0 - missing), 0.1 * missing);
    near_relative(bulk.inertia[0], 0.5 * 1e-4 * 7800.0 * volume * (1.0 - 2.0 * missing),
                  0.2 * missing);
    near(bulk.centre[0], 0.025, 1e-15);
    near(bulk.centre[1], 0.0, 1e-15);
    assert_true(bulk.smallest_det > 0.3);
    solid_mesh_free(&mesh);
}

/* A mid node pushed past its corner folds the element. */
static void test_folded_element(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct bulk bulk;
    solid_shape_block(ELEMENT_TET10, (double[3]){1.0, 1.0, 1.0}, (size_t[3]){1, 1, 1}, &STEEL,
                      &mesh);
    size_t *nodes = mesh.nodes + mesh.first[7];
    for (int k = 0; k < 3; k++)
        mesh.points[nodes[4]][k] =
            mesh.points[nodes[0]][k] + 0.1 * (mesh.points[nodes[1]][k] - mesh.points[nodes[0]][k]);
    bulk_of(&mesh, &bulk);
    double volume;
    assert_true(bulk.smallest_det < 0.0);
    near(bulk_element_det(&mesh, bulk.smallest_at, &volume), bulk.smallest_det, 1e-12);
    solid_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_block),
        cmocka_unit_test(test_parts),
        cmocka_unit_test(test_cylinder),
        cmocka_unit_test(test_folded_element),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
