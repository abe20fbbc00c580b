/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Of mesh/surface_fit.c: shells whose normals and curvatures are known in closed form. */
#include "mesh/surface.h"
#include "model/vector.h"
#include "unit/mesh/blocks.h"

static const enum element_type TYPES[] = {ELEMENT_TET10, ELEMENT_HEX20, ELEMENT_HEX27};

/* the outer side of a shell, of radius 10, and whether a point is away from its edges */
struct side {
    void (*map)(const double cube[3], double point[3]);
    bool (*is)(const double x[3], double normal[3], double tensor[9]);
    bool (*inside)(const double x[3]);
};

/* all lengths in mm here: the cylinder of MESH has a radius of 10 */
static void cylinder(const double cube[3], double point[3])
{
    double r = 6.0 + 4.0 * cube[0], angle = 2.4 * cube[1];
    point[0] = r * cos(angle);
    point[1] = r * sin(angle);
    point[2] = 48.0 * cube[2];
}

/* a piece of a ball of radius 10, +-.7 rad about the x axis */
static void ball(const double cube[3], double point[3])
{
    double r = 6.0 + 4.0 * cube[0], u = tan(1.4 * (cube[1] - 0.5)), v = tan(1.4 * (cube[2] - 0.5));
    double scale = r / sqrt(1.0 + u * u + v * v);
    point[0] = scale;
    point[1] = scale * u;
    point[2] = scale * v;
}

/* a bend of a tube: circle of radius 30, tube of radius 10 */
static void torus(const double cube[3], double point[3])
{
    double r = 6.0 + 4.0 * cube[0], tube = 2.4 * cube[1], way = 1.2 * cube[2];
    double out = 30.0 + r * cos(tube);
    point[0] = out * cos(way);
    point[1] = out * sin(way);
    point[2] = -r * sin(tube);
}

static void plate(const double cube[3], double point[3])
{
    double x = 60.0 * cube[0], y = 40.0 * cube[1], z = 3.0 * cube[2];
    point[0] = 0.6 * x - 0.8 * z;
    point[1] = y;
    point[2] = 0.8 * x + 0.6 * z;
}

/* normal and curvature tensor of the outer side at a point of it; false: another side */
static bool cylinder_is(const double x[3], double normal[3], double tensor[9])
{
    double r = hypot(x[0], x[1]);
    memcpy(normal, (double[]){x[0] / r, x[1] / r, 0.0}, 3 * sizeof *normal);
    double t[3] = {-x[1] / r, x[0] / r, 0.0};
    for (int i = 0; i < 9; i++)
        tensor[i] = t[i / 3] * t[i % 3] / r;
    return fabs(r - 10.0) < 1e-9;
}

static bool ball_is(const double x[3], double normal[3], double tensor[9])
{
    double r = norm3(x);
    scale3(1.0 / r, x, normal);
    for (int i = 0; i < 9; i++)
        tensor[i] = ((i % 4 == 0) - normal[i / 3] * normal[i % 3]) / r;
    return fabs(r - 10.0) < 1e-9;
}

static bool torus_is(const double x[3], double normal[3], double tensor[9])
{
    double out = hypot(x[0], x[1]), axis[3] = {30.0 * x[0] / out, 30.0 * x[1] / out, 0.0};
    sub3(x, axis, normal);
    double r = norm3(normal);
    scale3(1.0 / r, normal, normal);
    double along[3] = {-x[1] / out, x[0] / out, 0.0}, around[3];
    cross3(along, normal, around);
    double in_plane = (out - 30.0) / r;
    for (int i = 0; i < 9; i++)
        tensor[i] =
            around[i / 3] * around[i % 3] / r + along[i / 3] * along[i % 3] * in_plane / out;
    return fabs(r - 10.0) < 1e-9;
}

static bool cylinder_inside(const double x[3])
{
    return x[2] > 12.0 && x[2] < 36.0 && fabs(atan2(x[1], x[0]) - 1.25) < 0.5;
}

static bool ball_inside(const double x[3])
{
    return fabs(atan2(x[1], x[0])) < 0.3 && fabs(atan2(x[2], x[0])) < 0.3;
}

static bool torus_inside(const double x[3])
{
    double out = hypot(x[0], x[1]) - 30.0, tube = atan2(-x[2], out);
    return fabs(tube - 1.25) < 0.5 && fabs(atan2(x[1], x[0]) - 0.7) < 0.35;
}

static const struct side CYLINDER = {cylinder, cylinder_is, cylinder_inside};
static const struct side BALL = {ball, ball_is, ball_inside};
static const struct side TORUS = {torus, torus_is, torus_inside};

struct worst {
    double angle, curvature, missed; /* rad; times 10 mm; angle beyond the doubt, rad */
};

/* how far fits at the nodes of one side are off, corners and mid nodes */
static struct worst worst_of(const struct solid_mesh *mesh, const struct surface *surface,
                             const struct side *side, bool inner)
{
    struct worst worst = {0};
    for (size_t f = 0; f < surface->face_count; f++) {
        const struct surface_face *face = &surface->faces[f];
        double normal[3], tensor[9], cross[3];
        bool on = true;
        for (int i = 0; i < (face->count == 6 ? 3 : 4); i++)
            on = on && side->is(mesh->points[face->nodes[i]], normal, tensor);
        for (int i = 0; i < face->count && on; i++) {
            const double *x = mesh->points[face->nodes[i]];
            const struct surface_point *point = &surface->points[f][i];
            if (side->inside(x) != inner)
                continue;
            side->is(x, normal, tensor);
            cross3(normal, point->normal, cross);
            double angle = atan2(norm3(cross), dot3(normal, point->normal));
            worst.angle = fmax(worst.angle, angle);
            worst.missed = fmax(worst.missed, angle - point->doubt);
            for (int k = 0; k < 9; k++)
                worst.curvature =
                    fmax(worst.curvature, 10.0 * fabs(point->curvature[k] - tensor[k]));
        }
    }
    return worst;
}

static const double DEGREE = M_PI / 180.0;

/* fits `side` of a mesh and holds the worst normal (degrees) and curvature of its inner and its
 * outer nodes against what is allowed */
static void fits(const struct side *side, const struct block *block, const double allowed[4])
{
    struct solid_mesh mesh = block_make(block);
    struct surface surface;
    struct fault fault;
    assert_int_equal(surface_make(&mesh, &surface, &fault), PERCUSS_OK);
    assert_int_equal(surface_fit(&mesh, &surface, &fault), PERCUSS_OK);
    struct worst inner = worst_of(&mesh, &surface, side, true);
    struct worst rim = worst_of(&mesh, &surface, side, false);
    measured("inner normal", inner.angle, 0.0, allowed[0] * DEGREE);
    measured("inner curvature", inner.curvature, 0.0, allowed[1]);
    measured("normal at edges", rim.angle, 0.0, allowed[2] * DEGREE);
    measured("curvature at edges", rim.curvature, 0.0, allowed[3]);
    /* where it is far off, the doubt says so */
    measured("missed by the doubt", fmax(inner.missed, rim.missed), 0.0, 1.2 * DEGREE);
    if (block->straight)
        assert_true(surface.straight > 0.9 * surface.edges && surface.edges > 0);
    else
        assert_true(surface.straight <= 0.01 * surface.edges);
    surface_free(&surface);
    solid_mesh_free(&mesh);
}

/* The errors of interpolation fall with the third to fifth power of edge over radius (.6, then .3);
 * what is allowed is half as much again as was measured. At the edges all samples are on one side.
 */
static void fits_true_surfaces(void **state)
{
    (void)state;
    for (size_t t = 0; t < COUNT(TYPES); t++) {
        fits(&CYLINDER, &(struct block){TYPES[t], {1, 4, 8}, CYLINDER.map, false},
             (double[]){0.02, 0.05, 5.5, 0.8});
        fits(&CYLINDER, &(struct block){TYPES[t], {1, 8, 16}, CYLINDER.map, false},
             (double[]){0.005, 0.006, 0.6, 0.2});
        fits(&BALL, &(struct block){TYPES[t], {1, 4, 4}, BALL.map, false},
             (double[]){0.02, 0.01, 1.0, 0.2});
        fits(&TORUS, &(struct block){TYPES[t], {1, 4, 8}, TORUS.map, false},
             (double[]){0.3, 0.05, 5.5, 0.8});
        fits(&TORUS, &(struct block){TYPES[t], {1, 8, 16}, TORUS.map, false},
             (double[]){0.01, 0.006, 0.6, 0.2});
    }
}

/* only corners are on the surface: as meshes of true elements with twice the edge */
static void fits_straight_sided_meshes(void **state)
{
    (void)state;
    for (size_t t = 0; t < COUNT(TYPES); t++) {
        fits(&CYLINDER, &(struct block){TYPES[t], {1, 8, 16}, CYLINDER.map, true},
             (double[]){0.05, 0.05, 5.5, 0.8});
        fits(&CYLINDER, &(struct block){TYPES[t], {1, 16, 32}, CYLINDER.map, true},
             (double[]){0.005, 0.018, 0.9, 0.25});
        fits(&TORUS, &(struct block){TYPES[t], {1, 8, 16}, TORUS.map, true},
             (double[]){0.3, 0.08, 5.5, 0.9});
    }
}

/* nothing but rounding on planes, mid nodes in the middle or not */
static void plates_are_flat(void **state)
{
    (void)state;
    static const double WAYS[3][3] = {{0.6, 0.0, 0.8}, {0.0, 1.0, 0.0}, {-0.8, 0.0, 0.6}};
    for (size_t t = 0; t < COUNT(TYPES); t++) {
        struct solid_mesh mesh = block_make(&(struct block){TYPES[t], {9, 7, 1}, plate, false});
        struct surface surface;
        struct fault fault;
        assert_int_equal(surface_make(&mesh, &surface, &fault), PERCUSS_OK);
        assert_int_equal(surface.patch_count, 6);
        assert_int_equal(surface_fit(&mesh, &surface, &fault), PERCUSS_OK);
        for (size_t f = 0; f < surface.face_count; f++)
            for (int i = 0; i < surface.faces[f].count; i++) {
                const struct surface_point *point = &surface.points[f][i];
                double most = 0.0, bent = 0.0;
                for (int k = 0; k < 3; k++)
                    most = fmax(most, fabs(dot3(point->normal, WAYS[k])));
                for (int k = 0; k < 9; k++)
                    bent = fmax(bent, fabs(point->curvature[k]));
                assert_true(most > 1.0 - 1e-12 && bent < 1e-10 && point->doubt < 1e-10);
            }
        assert_int_equal(surface.straight, 0);
        surface_free(&surface);
        solid_mesh_free(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fits_true_surfaces),
        cmocka_unit_test(fits_straight_sided_meshes),
        cmocka_unit_test(plates_are_flat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
