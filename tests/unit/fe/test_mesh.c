/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/mesh.c: volumes, positive elements, boundary lists, matching
 * contact nodes, refusals. */
#include <string.h>

#include "check.h"
#include "fe/mesh.h"

static const struct mesh_grade grade = {
    .size = 5e-5, .core = 12, .growth = 1.08, .matched = 1.5e-3, .coarse = 2e-3};

static double cross(const struct mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    return (mesh->r[b] - mesh->r[a]) * (mesh->z[c] - mesh->z[a]) -
           (mesh->r[c] - mesh->r[a]) * (mesh->z[b] - mesh->z[a]);
}

/* volume of the solid of revolution: triangles by Pappus */
static double volume(const struct mesh *mesh)
{
    double sum = 0.0;
    for (size_t e = 0; e < mesh->elements; e++) {
        const uint32_t *q = mesh->quads[e];
        const double *r = mesh->r;
        sum += cross(mesh, q[0], q[1], q[2]) * (r[q[0]] + r[q[1]] + r[q[2]]) +
               cross(mesh, q[0], q[2], q[3]) * (r[q[0]] + r[q[2]] + r[q[3]]);
    }
    return sum * M_PI / 3.0;
}

/* smallest sine of a corner; all corners must turn left */
static double worst_corner(const struct mesh *mesh)
{
    double worst = 1.0;
    for (size_t e = 0; e < mesh->elements; e++) {
        const uint32_t *q = mesh->quads[e];
        for (size_t i = 0; i < 4; i++) {
            uint32_t a = q[i], b = q[(i + 1) % 4], c = q[(i + 3) % 4];
            double lengths = hypot(mesh->r[b] - mesh->r[a], mesh->z[b] - mesh->z[a]) *
                             hypot(mesh->r[c] - mesh->r[a], mesh->z[c] - mesh->z[a]);
            worst = fmin(worst, cross(mesh, a, b, c) / lengths);
        }
    }
    return worst;
}

/* an inner edge belongs to two elements, the outline's edges to one: Euler's formula for a disc */
static void is_one_piece(const struct mesh *mesh)
{
    size_t outline = 0;
    for (size_t e = 0; e < mesh->elements; e++)
        for (size_t i = 0; i < 4; i++) {
            uint32_t a = mesh->quads[e][i], b = mesh->quads[e][(i + 1) % 4];
            size_t twins = 0;
            for (size_t f = 0; f < mesh->elements; f++)
                for (size_t j = 0; j < 4; j++)
                    twins += mesh->quads[f][j] == b && mesh->quads[f][(j + 1) % 4] == a;
            assert_true(twins <= 1);
            outline += twins == 0;
        }
    /* nodes - edges + elements = 1 with edges = (4 elements + outline) / 2 */
    assert_int_equal(2 * mesh->nodes + 2 * mesh->elements, 4 * mesh->elements + outline + 2);
}

static void check(const struct mesh *mesh, double expected, double relative, double corner)
{
    double got = volume(mesh);
    if (!(fabs(got / expected - 1.0) <= relative))
        fail_msg("volume %.12g is not %.12g", got, expected);
    if (!(worst_corner(mesh) > corner))
        fail_msg("a corner with the sine %g", worst_corner(mesh));
    is_one_piece(mesh);
    for (size_t i = 0; i < mesh->axis.count; i++)
        assert_true(mesh->r[mesh->axis.index[i]] == 0.0);
    for (size_t i = 1; i < mesh->contact.count; i++)
        assert_true(mesh->r[mesh->contact.index[i]] > mesh->r[mesh->contact.index[i - 1]]);
    assert_true(mesh->r[0] == 0.0 && mesh->z[0] == 0.0);
}

static void fills_a_sphere(void **state)
{
    (void)state;
    struct mesh mesh;
    double radius = 0.015;
    assert_int_equal(mesh_sphere(radius, &grade, &mesh, NULL), PERCUSS_OK);
    /* chords of angle h lose h^2 / 4 of the volume; h = pi/48 and larger ones among the rings */
    check(&mesh, 4.0 / 3.0 * M_PI * pow(radius, 3.0), 2e-3, 0.3);
    for (size_t i = 0; i < mesh.contact.count; i++) {
        uint32_t n = mesh.contact.index[i];
        assert_true(fabs(hypot(mesh.r[n], mesh.z[n] + radius) / radius - 1.0) < 1e-14);
    }
    assert_int_equal(mesh.far.count, 1);
    assert_true(fabs(mesh.z[mesh.far.index[0]] + 2.0 * radius) < 1e-15);
    mesh_free(&mesh);
}

static void fills_rods_and_cylinders(void **state)
{
    (void)state;
    static const double lengths[] = {0.005, 0.010, 0.0148, 0.0152, 0.053, 0.2};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        struct mesh mesh;
        assert_int_equal(mesh_cylinder(0.010, lengths[i], &grade, &mesh, NULL), PERCUSS_OK);
        check(&mesh, M_PI * 1e-4 * lengths[i], 1e-12, 0.3);
        assert_int_equal(mesh.far.count, grade.core + 1);
        for (size_t k = 0; k < mesh.far.count; k++)
            assert_true(fabs(mesh.z[mesh.far.index[k]] + lengths[i]) < 1e-14);
        assert_true(fabs(mesh.r[mesh.contact.index[mesh.contact.count - 1]] - 0.010) < 1e-15);
        mesh_free(&mesh);
    }
}

static void fills_a_half_ball(void **state)
{
    (void)state;
    struct mesh mesh;
    struct mesh_grade fine = {.size = 1e-6, .core = 12, .growth = 1.07, .matched = 1e-4};
    assert_int_equal(mesh_half_space(0.02, &fine, &mesh, NULL), PERCUSS_OK);
    double chord = 0.25 * M_PI / (double)fine.core;
    check(&mesh, 2.0 / 3.0 * M_PI * pow(0.02, 3.0) * (1.0 - 0.25 * chord * chord), 1e-5, 0.5);
    assert_int_equal(mesh.far.count, 2 * fine.core + 1);
    /* narrow band */
    for (size_t e = 0; e < mesh.elements; e++)
        for (size_t i = 0; i < 4; i++)
            for (size_t j = 0; j < 4; j++)
                assert_true(mesh.quads[e][i] <= mesh.quads[e][j] + 2 * fine.core + 3);
    mesh_free(&mesh);
}

static void contact_nodes_match(void **state)
{
    (void)state;
    struct mesh meshes[3];
    assert_int_equal(mesh_sphere(0.015, &grade, &meshes[0], NULL), PERCUSS_OK);
    assert_int_equal(mesh_cylinder(0.010, 0.1, &grade, &meshes[1], NULL), PERCUSS_OK);
    assert_int_equal(mesh_half_space(0.03, &grade, &meshes[2], NULL), PERCUSS_OK);
    size_t matched = 0;
    for (size_t i = 0; i < meshes[0].contact.count; i++) {
        double r = meshes[0].r[meshes[0].contact.index[i]];
        if (r > grade.matched)
            break;
        matched++;
        for (size_t k = 1; k < 3; k++)
            assert_true(fabs(meshes[k].r[meshes[k].contact.index[i]] - r) <= 1e-15);
    }
    assert_true(matched > 20);
    for (size_t k = 0; k < 3; k++)
        mesh_free(&meshes[k]);
}

static void refuses_what_does_not_fit(void **state)
{
    (void)state;
    struct fault fault;
    struct mesh mesh;
    struct mesh_grade bad = grade;
    bad.size = 0.0;
    assert_int_equal(mesh_sphere(0.015, &bad, &mesh, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "mesh size: 0"));
    bad = grade;
    bad.size = 1e-3;
    assert_int_equal(mesh_sphere(0.015, &bad, &mesh, &fault), PERCUSS_BAD_REQUEST);
    bad = grade;
    bad.growth = 0.9;
    assert_int_equal(mesh_half_space(0.1, &bad, &mesh, &fault), PERCUSS_BAD_REQUEST);
    bad = grade;
    bad.core = 1;
    assert_int_equal(mesh_half_space(0.1, &bad, &mesh, &fault), PERCUSS_BAD_REQUEST);
    bad = grade;
    bad.matched = 0.011;
    assert_int_equal(mesh_cylinder(0.010, 0.1, &bad, &mesh, &fault), PERCUSS_BAD_REQUEST);
    assert_null(mesh.r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fills_a_sphere),
        cmocka_unit_test(fills_rods_and_cylinders),
        cmocka_unit_test(fills_a_half_ball),
        cmocka_unit_test(contact_nodes_match),
        cmocka_unit_test(refuses_what_does_not_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
