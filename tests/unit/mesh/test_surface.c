/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Of mesh/surface.h: faces, their orientation by the divergence theorem, patches, nearest places.
 */
#include "mesh/surface.h"
#include "model/vector.h"
#include "unit/mesh/blocks.h"

static const enum element_type TYPES[] = {ELEMENT_TET10, ELEMENT_HEX20, ELEMENT_HEX27};

static void stretch(const double cube[3], double point[3])
{
    point[0] = 2.0 * cube[0];
    point[1] = cube[1];
    point[2] = 0.5 * cube[2];
}

/* a sixth of a thick ring: radius 1 to 2, height 1 */
static void ring(const double cube[3], double point[3])
{
    double r = 1.0 + cube[0], angle = M_PI / 3.0 * cube[1];
    point[0] = r * cos(angle);
    point[1] = r * sin(angle);
    point[2] = cube[2];
}

/* volume and area of what the faces enclose: points of a product rule of three a direction (exact
 * for planes and parabolas) on quadrilaterals, of degree 4 on triangles (Dunavant) */
static void measure(const struct solid_mesh *mesh, const struct surface *surface, double *volume,
                    double *area)
{
    static const double GAUSS[3] = {-0.77459666924148338, 0.0, 0.77459666924148338};
    static const double WEIGHT[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    static const double A[2] = {0.44594849091596489, 0.091576213509770743};
    static const double B[2] = {0.22338158967801146 / 2.0, 0.10995174365532187 / 2.0};
    *volume = *area = 0.0;
    for (size_t f = 0; f < surface->face_count; f++) {
        const struct surface_face *face = &surface->faces[f];
        double points[FACE_MOST_NODES][3], x[3], normal[3];
        surface_face_points(mesh, face, points);
        for (int i = 0; i < (face->count == 6 ? 6 : 9); i++) {
            double u = GAUSS[i % 3], v = GAUSS[i / 3], weight = WEIGHT[i % 3] * WEIGHT[i / 3];
            if (face->count == 6) {
                double a = A[i / 3], places[3][2] = {{a, a}, {1 - 2 * a, a}, {a, 1 - 2 * a}};
                u = places[i % 3][0];
                v = places[i % 3][1];
                weight = B[i / 3];
            }
            facet_place(face->count, (const double(*)[3])points, u, v, x, normal);
            *volume += weight * dot3(x, normal) / 3.0;
            *area += weight * norm3(normal);
        }
    }
}

static void encloses_the_body(void **state)
{
    (void)state;
    for (size_t t = 0; t < COUNT(TYPES); t++) {
        struct solid_mesh mesh = block_make(&(struct block){TYPES[t], {4, 3, 2}, stretch, false});
        struct surface surface;
        struct fault fault;
        assert_int_equal(surface_make(&mesh, &surface, &fault), PERCUSS_OK);
        size_t cells = 2 * (4 * 3 + 3 * 2 + 2 * 4);
        assert_int_equal(surface.face_count, TYPES[t] == ELEMENT_TET10 ? 2 * cells : cells);
        assert_int_equal(surface.patch_count, 6);
        double volume, area;
        measure(&mesh, &surface, &volume, &area);
        near(volume, 1.0, 1e-13);
        near(area, 2.0 * (2.0 + 0.5 + 1.0), 1e-13);
        surface_free(&surface);
        solid_mesh_free(&mesh);
    }
}

/* the round sides of a ring turn by 20 degrees from face to face and are one patch each; its
 * volume is that of the arc within the fourth power of the angle of an element */
static void follows_round_sides(void **state)
{
    (void)state;
    for (size_t t = 0; t < COUNT(TYPES); t++) {
        struct solid_mesh mesh = block_make(&(struct block){TYPES[t], {2, 3, 2}, ring, false});
        struct surface surface;
        struct fault fault;
        assert_int_equal(surface_make(&mesh, &surface, &fault), PERCUSS_OK);
        assert_int_equal(surface.patch_count, 6);
        double volume, area;
        measure(&mesh, &surface, &volume, &area);
        near_relative(volume, M_PI / 6.0 * 3.0, 1e-4);

        /* the nearest place to a point inside the outer side, and its normal */
        double p[3] = {1.9 * cos(0.5), 1.9 * sin(0.5), 0.4};
        struct surface_place place = surface_near(&mesh, &surface, p);
        near(place.foot.distance, 0.1, 1e-3);
        near(place.normal[0], cos(0.5), 1e-3);
        near(place.normal[1], sin(0.5), 1e-3);
        surface_free(&surface);
        solid_mesh_free(&mesh);
    }
}

/* an element that is there three times, and one whose mid node is its own */
static void refuses_what_is_no_body(void **state)
{
    (void)state;
    struct fault fault;
    struct surface surface;
    struct solid_mesh mesh = block_make(&(struct block){ELEMENT_HEX20, {3, 1, 1}, stretch, false});
    memcpy(mesh.nodes + 20, mesh.nodes, 20 * sizeof *mesh.nodes);
    memcpy(mesh.nodes + 40, mesh.nodes, 20 * sizeof *mesh.nodes);
    assert_int_equal(surface_make(&mesh, &surface, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "elements 1, 2 and 3 share one face"));
    solid_mesh_free(&mesh);

    mesh = block_make(&(struct block){ELEMENT_HEX20, {2, 1, 1}, stretch, false});
    mesh.nodes[11] = mesh.nodes[9];
    assert_int_equal(surface_make(&mesh, &surface, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "elements 1 and 2 share the corners of a face but not"));
    mesh.element_count = 0;
    assert_int_equal(surface_make(&mesh, &surface, &fault), PERCUSS_BAD_REQUEST);
    solid_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(encloses_the_body),
        cmocka_unit_test(follows_round_sides),
        cmocka_unit_test(refuses_what_is_no_body),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
