/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/tools/reduce/reduced_body.c. */
#include <string.h>

#include "reduce/reduced_body.h"
#include "unit/reduce/solve_mesh.h"

static const struct material STEEL = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0};

/* The surface of conforming elements encloses what they fill: the integrals are of polynomials and
 * both exact, for straight and for curved elements. */
static void test_enclosed_volume(void **state)
{
    (void)state;
    static const enum element_type types[] = {ELEMENT_TET10, ELEMENT_HEX20, ELEMENT_HEX27};
    for (size_t t = 0; t < COUNT(types); t++) {
        struct solid_mesh mesh;
        struct surface surface;
        struct bulk bulk;
        struct fault fault;
        solid_shape_cylinder(types[t], (double[2]){0.01, 0.03}, (size_t[3]){1, 1, 2}, &STEEL,
                             &mesh);
        assert_int_equal(surface_make(&mesh, &surface, &fault), PERCUSS_OK);
        bulk_of(&mesh, &bulk);
        measured_relative("volume", reduced_body_enclosed(&mesh, &surface), bulk.volume, 1e-12);
        surface_free(&surface);
        solid_mesh_free(&mesh);
    }
}

/* A block: it is whole, its shapes are those of its nodes, and its name follows from what it is. */
static void test_block(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct surface surface;
    struct solved solved;
    struct mesh_body *body, *again, *lighter, *foreign;
    struct fault fault = {""};
    solid_shape_block(ELEMENT_HEX20, (double[3]){0.1, 0.05, 0.02}, (size_t[3]){6, 3, 2}, &STEEL,
                      &mesh);
    solve_mesh(&mesh, 0, INFINITY, 5, &solved);
    assert_int_equal(surface_make(&mesh, &surface, &fault), PERCUSS_OK);
    assert_int_equal(surface_fit(&mesh, &surface, &fault), PERCUSS_OK);
    struct reduced_parts parts = {.mesh = &mesh,
                                  .surface = &surface,
                                  .bulk = &solved.bulk,
                                  .modes = &solved.modes,
                                  .source = "a test",
                                  .supports = ""};
    assert_int_equal(reduced_body_make(&parts, &body, &fault), PERCUSS_OK);
    assert_int_equal(mesh_body_check(body, &fault), PERCUSS_OK);
    assert_int_equal(body->face_count, 2 * (6 * 3 + 6 * 2 + 3 * 2));
    assert_int_equal(body->mode_count, 5);
    /* inside are the middle nodes of edges and corners between cells alone */
    assert_true(body->node_count < mesh.node_count);
    const struct mesh_body_face *face = &body->faces[7];
    for (size_t i = 0; i < face->count; i++) {
        size_t node = surface.faces[7].nodes[i];
        for (size_t k = 0; k < 3; k++) {
            near(body->points[face->nodes[i]][k], mesh.points[node][k] - body->centre[k], 1e-15);
            /* single precision */
            double shape = solved.modes.shapes[3 * solved.modes.n + 3 * node + k];
            near(body->shapes[(3 * face->nodes[i] + k) * 5 + 3], shape, 1e-7 * fabs(shape));
        }
        assert_true(isnan(face->flexibility[i]));
    }
    /* the same again, with matrices of somebody else's, and of another density */
    assert_int_equal(reduced_body_make(&parts, &again, &fault), PERCUSS_OK);
    parts.foreign = &solved.matrices;
    assert_int_equal(reduced_body_make(&parts, &foreign, &fault), PERCUSS_OK);
    parts.foreign = NULL;
    mesh.part[0].material.density *= 0.5;
    assert_int_equal(reduced_body_make(&parts, &lighter, &fault), PERCUSS_OK);
    assert_string_equal(body->hash, again->hash);
    assert_string_not_equal(body->hash, foreign->hash);
    assert_string_not_equal(body->hash, lighter->hash);
    mesh_body_free(body);
    mesh_body_free(again);
    mesh_body_free(foreign);
    mesh_body_free(lighter);
    surface_free(&surface);
    solved_free(&solved);
    solid_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_enclosed_volume),
        cmocka_unit_test(test_block),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
