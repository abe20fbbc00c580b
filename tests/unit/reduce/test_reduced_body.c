/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/tools/reduce/reduced_body.c. */
#include <string.h>

#include "model/mesh_surface.h"
#include "model/modal_basis.h"
#include "model/ritz.h"
#include "model/vector.h"
#include "reduce/reduced_body.h"
#include "unit/reduce/solve_mesh.h"

static const struct material STEEL = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0};

/* The surface of conforming elements encloses what they fill: the integrals are of polynomials and
 * both exact, for straight and for curved elements. */
static void test_enclosed_volume(void **state)
{
    (void)state;
    static const enum element_type types[] = {ELEMENT_TET10, ELEMENT_HEX20, ELEMENT_HEX27,
                                              ELEMENT_WEDGE15};
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

/* Along the surface, where the file says nothing of that, its modes and the normal's flexibility
 * tell the compliance within the uncertainty that the load has, against the block of Ritz's method;
 * between directions the modes' sum alone does, to 0.1 over E and the thickness. */
static void compare_along(const struct body *body, const struct ritz *ritz, const double size[3],
                          const double spot[2])
{
    double unit = 1.0 / (STEEL.young * size[0]);
    struct site site = {.point = {spot[0], spot[1], 0.5 * size[2]}, .outward = {0.0, 0.0, 1.0}};
    const double at[3] = {site.point[0] / size[0], site.point[1] / size[0],
                          site.point[2] / size[0]};
    struct mesh_place place;
    struct family_load loads[3];
    double tensor[6];
    assert_int_equal(mesh_surface_find(body->mesh, site.point, 0.0, &place, 1), 1);
    assert_true(ritz_tensor(ritz, 2, 1, at, tensor));
    site.spot = (struct face_spot){.on_mesh = true,
                                   .facet = place.face,
                                   .u = place.u,
                                   .v = place.v,
                                   .flexibility = unit * tensor[2]};
    for (int d = 0; d < 3; d++) {
        const double direction[3] = {d == 0, d == 1, d == 2 ? -1.0 : 0.0};
        struct site_load load = site_load_make(body, &site, direction, d != 2);
        loads[d] = load.family[0];
        assert_true(loads[d].acts);
        double all = modal_compliance(body, 0, &loads[d], &loads[d]);
        measured("compliance", all, unit * tensor[d], d == 2 ? 1e-9 * unit : loads[d].mesh.unknown);
    }
    /* a hundredth of the contact's of a radius of 0.1 mm */
    assert_true(loads[0].mesh.unknown < 0.01 * 0.55 / (STEEL.young * 1e-4));
    double left = 0.1 / (STEEL.young * size[2]);
    measured("x, y", modal_compliance(body, 0, &loads[0], &loads[1]), unit * tensor[3], left);
    measured("y, -z", modal_compliance(body, 0, &loads[1], &loads[2]), -unit * tensor[4], left);
    measured("x, -z", modal_compliance(body, 0, &loads[0], &loads[2]), -unit * tensor[5], left);
}

/* With tensors in its faces it has them, whatever modes they go without, and scales them as bodies
 * do: 1/(E L). */
static void compare_tensors(struct mesh_body *mesh, const struct body *body)
{
    static const double tensor[6] = {3e-9, 5e-9, 2e-9, 1e-9, -2e-9, 0.5e-9};
    static const int ROW[6] = {0, 1, 2, 0, 1, 2}, COLUMN[6] = {0, 1, 2, 1, 2, 0};
    struct site site = {.point = {0.02, 0.008, 0.01}, .outward = {0.0, 0.0, 1.0}};
    struct mesh_place place;
    struct family_load loads[3];
    struct body twice = *body;
    twice.scale = 2.0;
    twice.material.young *= 3.0;
    assert_int_equal(mesh_surface_find(mesh, site.point, 0.0, &place, 1), 1);
    struct mesh_body_face *face = &mesh->faces[place.face];
    mesh->all_ways = true;
    for (int i = 0; i < face->count; i++) {
        face->flexibility[i] = tensor[2];
        for (int k = 0; k < 6; k++)
            face->tensor[i][k] = (float)tensor[k];
    }
    for (int variant = 0; variant < 2; variant++) {
        const struct body *of = variant ? &twice : body;
        double unit = variant ? 1.0 / 6.0 : 1.0, at[3];
        struct face faces[BODY_MOST_FACES];
        scale3(of->scale, site.point, at);
        assert_true(of->kind->faces(of, at, faces) > 0);
        struct site there = site;
        memcpy(there.point, at, sizeof at);
        there.spot = faces[0].spot;
        mesh->removed = 3 * (size_t)variant;
        for (int d = 0; d < 3; d++) {
            const double direction[3] = {d == 0, d == 1, d == 2 ? -1.0 : 0.0};
            struct site_load load = site_load_make(of, &there, direction, d != 2);
            loads[d] = load.family[0];
            assert_true(loads[d].mesh.all_ways);
        }
        assert_true(loads[0].mesh.unknown == 0.0); /* where it is not bent */
        struct modal_family *modes = modal_family_create(of, 0, 3);
        assert_non_null(modes);
        for (int k = 0; k < 6; k++) {
            int i = ROW[k], j = COLUMN[k];
            double sign = (i == 2) == (j == 2) ? 1.0 : -1.0, expected = sign * unit * tensor[k];
            for (size_t m = 0; m < mesh->removed; m++)
                expected += modal_participation(of, modes, m, &loads[i]) *
                            modal_participation(of, modes, m, &loads[j]) /
                            (modes->omega[m] * modes->omega[m]);
            /* in float */
            near(modal_compliance(of, 0, &loads[i], &loads[j]), expected, 1e-6 * tensor[1]);
        }
        modal_family_free(modes);
    }
}

static void test_block_along(void **state)
{
    (void)state;
    static const double size[3] = {0.1, 0.04, 0.02}, spots[][2] = {{0.0, 0.0}, {0.02, 0.008}};
    struct solid_mesh mesh;
    struct surface surface;
    struct solved solved;
    struct mesh_body *made;
    struct fault fault = {""};
    solid_shape_block(ELEMENT_HEX20, size, (size_t[3]){14, 6, 4}, &STEEL, &mesh);
    solve_mesh(&mesh, 0, INFINITY, 30, &solved);
    assert_int_equal(surface_make(&mesh, &surface, &fault), PERCUSS_OK);
    assert_int_equal(surface_fit(&mesh, &surface, &fault), PERCUSS_OK);
    struct reduced_parts parts = {.mesh = &mesh,
                                  .surface = &surface,
                                  .bulk = &solved.bulk,
                                  .modes = &solved.modes,
                                  .source = "a test",
                                  .supports = ""};
    assert_int_equal(reduced_body_make(&parts, &made, &fault), PERCUSS_OK);
    assert_true(mesh_surface_prepare(made));
    const struct body body = {.kind = &mesh_kind, .mesh = made, .material = STEEL, .scale = 1.0};
    const struct ritz_shape shape = {.side = {size[0], size[1], size[2]}};
    struct ritz *ritz = ritz_create(&shape, STEEL.poisson, NULL);
    assert_non_null(ritz);
    for (size_t p = 0; p < COUNT(spots); p++)
        compare_along(&body, ritz, size, spots[p]);
    compare_tensors(made, &body);
    ritz_free(ritz);
    mesh_body_free(made);
    surface_free(&surface);
    solved_free(&solved);
    solid_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_enclosed_volume),
        cmocka_unit_test(test_block),
        cmocka_unit_test(test_block_along),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
