/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* model/mesh_surface: the nearest place against all faces one by one, and what a cylinder is like
 * there; a mesh's rigid motion with products of inertia. */
#include "model/mesh_surface.h"

#include <string.h>

#include "bodies/made_mesh.h"
#include "check.h"
#include "model/facet.h"
#include "model/rigid.h"
#include "model/vector.h"

static const double RADIUS = 0.01, LENGTH = 0.08;

static struct mesh_body *make_cylinder(void)
{
    struct body rod = {.id = "rod",
                       .kind = &rod_kind,
                       .radius = RADIUS,
                       .length = LENGTH,
                       .tip_radius = INFINITY,
                       .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0}};
    struct fault fault;
    assert_int_equal(body_complete(&rod, &fault), PERCUSS_OK);
    struct mesh_body *body = made_mesh_bar(
        &(struct made_mesh){.bar = &rod, .modes = 4, .removed = 2, .around = 24, .along = 16});
    assert_true(body && mesh_surface_prepare(body));
    return body;
}

static double random_between(uint64_t *seed, double low, double high)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*seed >> 11) * 0x1p-53;
}

static double nearest_of_all(const struct mesh_body *body, const double p[3])
{
    double nearest = INFINITY;
    for (size_t f = 0; f < body->face_count; f++) {
        double points[FACET_MOST_NODES][3];
        for (int i = 0; i < body->faces[f].count; i++)
            memcpy(points[i], body->points[body->faces[f].nodes[i]], sizeof points[i]);
        struct facet_foot foot = facet_closest(body->faces[f].count, (const double(*)[3])points, p);
        nearest = fmin(nearest, foot.distance);
    }
    return nearest;
}

static void finds_the_nearest_place(void **state)
{
    (void)state;
    struct mesh_body *body = make_cylinder();
    uint64_t seed = 5;
    for (int i = 0; i < 400; i++) {
        struct mesh_place places[6];
        double p[3];
        /* near the surface, far away and inside */
        double reach = i % 2 ? 2.0 : 1.02;
        for (int k = 0; k < 3; k++)
            p[k] = random_between(&seed, -reach, reach) * (k ? RADIUS : 0.5 * LENGTH);
        assert_true(mesh_surface_find(body, p, 0.0, places, 1) == 1);
        /* to what Newton's steps leave */
        near(places[0].distance, nearest_of_all(body, p), 1e-9 * RADIUS);
    }
    mesh_body_free(body);
}

/* On nodes and beside them, where faces meet, and on the axis, which is as far from all round it.
 */
static void finds_places_where_faces_meet(void **state)
{
    (void)state;
    struct mesh_body *body = make_cylinder();
    uint64_t seed = 11;
    for (size_t i = 0; i < body->node_count; i += 3) {
        struct mesh_place places[6];
        double p[3];
        for (int beside = 0; beside < 2; beside++) {
            for (int k = 0; k < 3; k++)
                p[k] = body->points[i][k] + beside * random_between(&seed, -0.05, 0.05) * RADIUS;
            assert_true(mesh_surface_find(body, p, 0.0, places, 1) == 1);
            near(places[0].distance, beside ? nearest_of_all(body, p) : 0.0, 1e-9 * RADIUS);
        }
    }
    for (int i = 0; i < 20; i++) {
        struct mesh_place place;
        const double p[3] = {(i - 9.5) * 0.05 * LENGTH, 0.0, 0.0};
        assert_true(mesh_surface_find(body, p, 0.0, &place, 1) == 1);
        near(place.distance, nearest_of_all(body, p), 1e-9 * RADIUS);
    }
    mesh_body_free(body);
}

static void knows_a_cylinder(void **state)
{
    (void)state;
    struct mesh_body *body = make_cylinder();
    uint64_t seed = 9;
    /* faces of nine nodes lie within (turn/2)^4/8 radii or so of the circle: 4e-5 for 15 degrees,
     * and the sum of their areas within twice that */
    near_relative(body->area, 2.0 * M_PI * RADIUS * (LENGTH + RADIUS), 1e-4);
    for (int i = 0; i < 100; i++) {
        struct mesh_place place;
        double turn = random_between(&seed, 0.0, 2.0 * M_PI);
        double x = random_between(&seed, -0.45, 0.45) * LENGTH;
        const double n[3] = {0.0, cos(turn), sin(turn)};
        const double p[3] = {x, RADIUS * n[1], RADIUS * n[2]};
        assert_int_equal(mesh_surface_find(body, p, 0.0, &place, 1), 1);
        assert_true(place.distance <= 4e-5 * RADIUS);
        /* longer along than across */
        near_relative(mesh_surface_face_size(body, place.face), LENGTH / 16.0, 1e-12);
        near(place.to_rim, 0.5 * LENGTH - fabs(x), 1e-4 * RADIUS);
        struct mesh_spot spot = mesh_surface_at(body, place.face, place.u, place.v);
        /* normals are interpolated with their squares: to the third power of half the turn */
        near(dot3(spot.normal, n), 1.0, 1e-7);
        near(spot.normal[0], 0.0, 1e-9);
        /* 1/r across, none along, none along the normal */
        const double t[3] = {0.0, -n[2], n[1]};
        double image[3];
        rotate3(spot.curvature, t, image);
        near_relative(dot3(image, t), 1.0 / RADIUS, 2e-3);
        rotate3(spot.curvature, spot.normal, image);
        near(norm3(image), 0.0, 1e-9 / RADIUS);
        near(spot.curvature[0], 0.0, 1e-9 / RADIUS);
    }
    mesh_body_free(body);
}

static void finds_both_sides_of_an_edge(void **state)
{
    (void)state;
    struct mesh_body *body = make_cylinder();
    struct mesh_place places[6];
    const double p[3] = {0.5 * LENGTH, 0.0, 0.95 * RADIUS};
    assert_int_equal(mesh_surface_find(body, p, 0.1 * RADIUS, places, 6), 2);
    assert_int_equal(body->faces[places[0].face].patch, 2);
    assert_int_equal(body->faces[places[1].face].patch, 0);
    /* rims are two chords of each edge: 1 - cos(3.75 degrees) radii within the circle */
    near(places[0].to_rim, 0.05 * RADIUS, 2.2e-3 * RADIUS);
    near(places[1].distance, 0.05 * RADIUS, 1e-4 * RADIUS);
    assert_int_equal(mesh_surface_find(body, p, 0.01 * RADIUS, places, 6), 1);
    mesh_body_free(body);
}

/* The same body in a turned frame: W and what an impulse does turn with it. */
static void products_of_inertia_turn(void **state)
{
    (void)state;
    struct mesh_body *mesh = make_cylinder();
    const double principal[3] = {2e-5, 5e-5, 6e-5};
    const double q[4] = {0.5, 0.5, -0.1, 0.7};
    double unit[4], r[9], size = sqrt(0.25 + 0.25 + 0.01 + 0.49);
    for (int i = 0; i < 4; i++)
        unit[i] = q[i] / size;
    rotation_matrix(unit, r);
    struct body body[2] = {{.kind = &mesh_kind, .mesh = mesh, .scale = 1.0}};
    body[0].material = mesh->materials[0];
    body[1] = body[0];
    for (int turned = 0; turned < 2; turned++) {
        for (int i = 0; i < 9; i++) {
            mesh->inertia[i] = !turned && i % 4 == 0 ? principal[i / 4] : 0.0;
            for (int k = 0; turned && k < 3; k++) /* R J R^T */
                mesh->inertia[i] += r[i / 3 * 3 + k] * principal[k] * r[i % 3 * 3 + k];
        }
        assert_int_equal(body_complete(&body[turned], NULL), PERCUSS_OK);
    }
    const double p[3] = {0.01, -0.02, 0.03}, n[3] = {0.6, 0.0, 0.8}, m[3] = {0.0, 1.0, 0.0};
    const double o[3] = {-0.02, 0.005, 0.0};
    double tp[3], tn[3], tm[3], to[3];
    rotate3(r, p, tp);
    rotate3(r, n, tn);
    rotate3(r, m, tm);
    rotate3(r, o, to);
    near_relative(rigid_inverse_mass(&body[1], tp, tn, to, tm),
                  rigid_inverse_mass(&body[0], p, n, o, m), 1e-12);
    double v[2][3] = {{0.0}}, w[2][3] = {{0.0}}, turn[3];
    rigid_apply_impulse(&body[0], p, n, v[0], w[0]);
    rigid_apply_impulse(&body[1], tp, tn, v[1], w[1]);
    rotate3(r, w[0], turn);
    for (int k = 0; k < 3; k++)
        near(w[1][k], turn[k], 1e-12 * norm3(turn));
    /* and none where it is held */
    mesh->supported = true;
    near(rigid_inverse_mass(&body[1], tp, tn, tp, tn), 0.0, 0.0);
    mesh_body_free(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_the_nearest_place),  cmocka_unit_test(finds_places_where_faces_meet),
        cmocka_unit_test(knows_a_cylinder),         cmocka_unit_test(finds_both_sides_of_an_edge),
        cmocka_unit_test(products_of_inertia_turn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
