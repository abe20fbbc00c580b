/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors tests/reference/spatial/refined.c: bricks fill the body, neighbours fit, what
 * hangs follows a quadratic field exactly. */
#include "check.h"
#include "spatial/refined.h"

/* a cube of 4 x 4 x 4 bricks below the contact: its map is linear */
static void cube_map(const struct shape *shape, size_t block, const double at[3], double place[3])
{
    (void)block;
    place[0] = shape->length * at[0];
    place[1] = shape->length * at[1];
    place[2] = shape->length * (at[2] - 1.0);
}

static const struct shape cube = {
    .blocks = 1, .count = {{4, 4, 4}}, .map = cube_map, .brick = {0.25, 0.25, 0.25}, .length = 1.0};

/* weights and masters give every field that is quadratic along each direction */
static double field(const double *p)
{
    return 1.0 + p[0] - 2.0 * p[1] * p[1] + p[0] * p[0] * p[2] * p[2] + p[0] * p[1] * p[2];
}

static void halves_near_the_contact(void **state)
{
    (void)state;
    struct refined mesh;
    struct fault fault;
    assert_int_equal(refined_create(&cube, 3, &mesh, &fault), PERCUSS_OK);
    /* at each level the 2 x 2 x 2 next to the contact become 4 x 4 x 4 */
    assert_int_equal(mesh.brick_count, 64 + 3 * 56);
    double volume = 0.0;
    for (size_t b = 0; b < mesh.brick_count; b++)
        volume += pow(0.25 / (double)(1u << mesh.bricks[b].level), 3.0);
    near(volume, 1.0, 1e-15);
    /* what hangs, and on what in the end */
    size_t hanging = 0;
    for (size_t n = 0; n < mesh.node_count; n++) {
        double sum = 0.0, weight = 0.0;
        for (size_t i = mesh.first[n]; i < mesh.first[n + 1]; i++) {
            size_t master = mesh.masters[i];
            assert_true(mesh.first[master] == mesh.first[master + 1]);
            sum += mesh.weights[i] * field(mesh.points[master]);
            weight += mesh.weights[i];
        }
        if (mesh.first[n] == mesh.first[n + 1])
            continue;
        hanging++;
        near(weight, 1.0, 1e-14);
        near(sum, field(mesh.points[n]), 1e-14);
    }
    /* three faces of 2 x 2 coarse bricks a level, 16 nodes hang on each: shared edges count once:
     * of a face of 9 x 9 nodes 5 x 5 are the coarse ones' own; the three faces share edges */
    size_t face = 81 - 25, edge = 9 - 5;
    assert_int_equal(hanging, 3 * (3 * face - 3 * edge));
    /* the face's finest bricks: 4 x 4, 9 x 9 nodes */
    assert_int_equal(mesh.touching, 81);
    refined_free(&mesh);
}

static void covers_the_core(void **state)
{
    (void)state;
    struct shape shape = cube;
    shape.core[0] = 0.2;
    shape.core[1] = 0.1;
    shape.core[2] = 0.05;
    struct refined mesh;
    struct fault fault;
    assert_int_equal(refined_create(&shape, 4, &mesh, &fault), PERCUSS_OK);
    for (size_t b = 0; b < mesh.brick_count; b++) {
        /* any brick that reaches into the core is of the finest */
        bool inside = true;
        for (int c = 0; c < 3; c++) {
            double least = INFINITY;
            for (int n = 0; n < BRICK_NODES; n++)
                least = fmin(least, fabs(mesh.points[mesh.bricks[b].nodes[n]][c]));
            inside = inside && least < shape.core[c];
        }
        assert_true(!inside || mesh.bricks[b].level == 4);
    }
    refined_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(halves_near_the_contact),
        cmocka_unit_test(covers_the_core),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
