/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/tools/reduce/flexibility.c: against solutions for cylinders and spheres by other
 * methods (fe/matched.h), Ritz's method, bars in closed form, a uniform load, reciprocity. */
#include "fe/matched.h"
#include "model/ritz.h"
#include "unit/mesh/blocks.h"
#include "unit/reduce/flexed.h"
#include "unit/reduce/solve_mesh.h"

static const double RADIUS = 0.01, YOUNG = 73e9;

static struct material metal(double poisson)
{
    return (struct material){"metal", YOUNG, poisson, 2700.0, INFINITY, 0.0};
}

/* square of a circular frequency: c / length */
static double shift_for(double length)
{
    return YOUNG / 2700.0 / (length * length);
}

static void cylinder(struct flexed *flexed, enum element_type type, double poisson, double length,
                     size_t along, bool held)
{
    struct solid_mesh mesh;
    const struct material material = metal(poisson);
    const double size[2] = {RADIUS, length};
    const size_t cells[3] = {2, 2, along};
    solid_shape_cylinder(type, size, cells, &material, &mesh);
    flexed_make(flexed, &mesh, shift_for(length), held);
}

/* in the middle of a face of a cube cut into few wedges: they approach the same value as bricks,
 * which 27-node ones of this size meet to 3e-3, and differ from them by less than that */
static void wedges_are_as_good_as_bricks(void **state)
{
    (void)state;
    static const enum element_type TYPES[2] = {ELEMENT_HEX27, ELEMENT_WEDGE15};
    double values[2];
    for (int i = 0; i < 2; i++) {
        struct solid_mesh mesh;
        struct flexed flexed;
        const struct material material = metal(0.3);
        solid_shape_block(TYPES[i], (double[3]){2.0 * RADIUS, 2.0 * RADIUS, 2.0 * RADIUS},
                          (size_t[3]){2, 2, 2}, &material, &mesh);
        const double *high = mesh.points[0];
        for (size_t n = 0; n < mesh.node_count; n++)
            if (mesh.points[n][0] + mesh.points[n][1] + mesh.points[n][2] >
                high[0] + high[1] + high[2])
                high = mesh.points[n];
        double x = high[0], y = high[1] - RADIUS, z = high[2] - RADIUS;
        flexed_make(&flexed, &mesh, shift_for(2.0 * RADIUS), false);
        struct flexibility_place place = flexed_place(&flexed, x, y, z);
        struct flexibility_answer answer = flexed_solve(&flexed, &place);
        values[i] = answer.value * YOUNG * RADIUS;
        assert_true(answer.imbalance < 3e-7);
        flexed_free(&flexed);
    }
    near(values[1], values[0], 1e-3);
}

/* in the middle of the end of a short cylinder and of a rod, where an axisymmetric solution is
 * known, which elements of 4 mm on a radius of 10 mm meet to 2e-4 */
static void end_is_that_of_the_axisymmetric_solution(void **state)
{
    (void)state;
    static const struct {
        enum element_type type;
        double poisson, slenderness;
        size_t along;
    } CASES[] = {{ELEMENT_HEX27, 0.3, 2.0, 6},
                 {ELEMENT_HEX20, 0.33, 10.0, 24},
                 {ELEMENT_WEDGE15, 0.3, 2.0, 6},
                 {ELEMENT_TET10, 0.0, 3.0, 6}};
    for (size_t i = 0; i < COUNT(CASES); i++) {
        struct flexed flexed;
        double expected;
        cylinder(&flexed, CASES[i].type, CASES[i].poisson, CASES[i].slenderness * RADIUS,
                 CASES[i].along, false);
        assert_true(matched_cylinder(CASES[i].poisson, CASES[i].slenderness, &expected));
        struct flexibility_place place = flexed_place(&flexed, 0.0, 0.0, 0.0);
        struct flexibility_answer answer = flexed_solve(&flexed, &place);
        measured("end of a cylinder, E b C", answer.value * YOUNG * RADIUS, expected, 0.001);
        /* quadrature; refused from 1e-6 on */
        assert_true(answer.imbalance < 3e-7);
        flexed_free(&flexed);
    }
}

static void ball(const double cube[3], double point[3])
{
    double x[3], square[3];
    for (int k = 0; k < 3; k++) {
        x[k] = 2.0 * cube[k] - 1.0;
        square[k] = x[k] * x[k];
    }
    for (int k = 0; k < 3; k++) {
        double a = square[(k + 1) % 3], b = square[(k + 2) % 3];
        point[k] = RADIUS * x[k] * sqrt(fmax(1.0 - 0.5 * (a + b) + a * b / 3.0, 0.0));
    }
}

/* A contact of a hundredth of the radius anywhere on a sphere against the sum of harmonics. The
 * solved field has a logarithm at the place, which elements of a fifth of the radius catch to .005,
 * falling with their size; the curvature of the mesh's faces moves it by .002. */
static void sphere_is_that_of_harmonics(void **state)
{
    (void)state;
    static const double POISSON = 0.3, CONTACT = 0.01;
    static const double WAYS[3][3] = {{0.05, 0.02, 1.0}, {0.3, 0.35, 0.8}, {-0.6, 0.1, 0.2}};
    struct block block = {ELEMENT_HEX27, {8, 8, 8}, ball, false};
    struct solid_mesh mesh = block_make(&block);
    struct flexed flexed;
    mesh.part[0].material = metal(POISSON);
    flexed_make(&flexed, &mesh, shift_for(RADIUS), false);
    for (size_t i = 0; i < COUNT(WAYS); i++) {
        double scale = RADIUS / norm3(WAYS[i]);
        struct flexibility_place place =
            flexed_place(&flexed, scale * WAYS[i][0], scale * WAYS[i][1], scale * WAYS[i][2]);
        struct flexibility_answer answer = flexed_solve(&flexed, &place);
        double curvature = 1.0 / RADIUS;
        double value =
            answer.value + flexibility_of_contact(YOUNG, POISSON, curvature) +
            flexibility_slope(YOUNG, POISSON, curvature) * log(answer.radius / (CONTACT * RADIUS));
        measured("sphere, E R C", value * YOUNG * RADIUS, matched_sphere(POISSON, CONTACT), 0.004);
    }
    flexed_free(&flexed);
}

/* displacement of the far end of a held cylinder under a uniform load of 1 N there */
static double uniform_pull(struct flexed *flexed, double shift)
{
    size_t n = flexed->matrices.stiffness.n;
    double *u = calloc(n, sizeof *u), *force = calloc(n, sizeof *force),
           *image = malloc(n * sizeof *u);
    struct fault fault;
    assert_true(u && force && image);
    const struct surface_rule *rule = flexibility_rule(flexed->flexibility);
    double area = 0.0, end = flexed->mesh.points[flexed->mesh.set[1].nodes[0]][0], mean = 0.0;
    for (size_t f = 0; f < flexed->surface.face_count; f++) {
        const struct surface_face *face = &flexed->surface.faces[f];
        if (fabs(rule->centres[f][0] - end) > 1e-9)
            continue;
        for (size_t i = rule->first[f]; i < rule->first[f + 1]; i++) {
            area += rule->areas[i][0];
            for (size_t k = 0; k < face->count; k++)
                force[3 * face->nodes[k]] +=
                    rule->areas[i][0] * rule->shapes[face->count][i - rule->first[f]][k];
        }
    }
    for (size_t i = 0; i < n; i++)
        force[i] /= area;
    /* (K + s M) u = f + s M u, until nothing changes: 1e-9 */
    for (int step = 0; step < 40; step++) {
        sparse_multiply(&flexed->matrices.mass, 1, u, image);
        for (size_t i = 0; i < n; i++)
            u[i] = force[i] + shift * image[i];
        assert_int_equal(factor_solve(flexed->factor, 1, u, &fault), PERCUSS_OK);
    }
    for (size_t i = 0; i < n; i++)
        mean += force[i] * u[i];
    free(u);
    free(force);
    free(image);
    return mean;
}

/* Held at one end, of one material and of two: far from the end a load in its middle is as good as
 * a uniform one, and what it has more is what a long free rod has more than L / (3 E A). That of a
 * rod of the length L falls like 1/L to its limit. */
static void held_rod_differs_from_a_free_one_by_its_stretch(void **state)
{
    (void)state;
    for (int materials = 1; materials <= 2; materials++) {
        struct flexed flexed;
        struct solid_mesh mesh;
        const struct material material = metal(0.3);
        const double size[2] = {RADIUS, 8.0 * RADIUS};
        const size_t cells[3] = {2, 2, 20};
        double longer, long_rod, shift = 0.1 * shift_for(size[1]);
        solid_shape_cylinder(ELEMENT_HEX20, size, cells, &material, &mesh);
        if (materials == 2) {
            /* the held half is softer, and bulges otherwise */
            mesh.part_count = 2;
            mesh.part = realloc(mesh.part, 2 * sizeof *mesh.part);
            mesh.part[1] = mesh.part[0];
            mesh.part[1].material.young = 0.3 * YOUNG;
            mesh.part[1].material.poisson = 0.4;
            for (size_t e = 0; e < mesh.element_count; e++)
                mesh.parts[e] = mesh.points[mesh.nodes[mesh.first[e] + 6]][0] < 0.51 * size[1];
        }
        flexed_make(&flexed, &mesh, shift, true);
        struct flexibility_place place = flexed_place(&flexed, size[1], 0.0, 0.0);
        struct flexibility_answer answer = flexed_solve(&flexed, &place);
        double stretch = uniform_pull(&flexed, shift);
        assert_true(matched_cylinder(0.3, 96.0, &longer));
        assert_true(matched_cylinder(0.3, 48.0, &long_rod));
        longer -= 96.0 / (3.0 * M_PI);
        long_rod -= 48.0 / (3.0 * M_PI);
        measured("held rod, E b (C - stretch)", (answer.value - stretch) * YOUNG * RADIUS,
                 2.0 * longer - long_rod, 0.001);
        flexed_free(&flexed);
    }
}

/* How far out the singular line goes does not matter, on convex bodies and inside a ring, which
 * crosses it: what is left is how well the mesh takes tractions of the reach's size. */
static void ring(const double cube[3], double point[3])
{
    double r = 0.02 + 0.01 * cube[0], angle = 5.0 * cube[1];
    point[0] = r * cos(angle);
    point[1] = r * sin(angle);
    point[2] = 0.01 * cube[2];
}

/* The tensor with the place's own reach and with another one: along the surface the reach adds
 * three times as much. */
static void compare_reach(struct flexed *flexed, struct flexibility_place place, double reach,
                          double allowed)
{
    place.loads = FLEXIBILITY_LOADS;
    struct flexibility_answer whole = flexed_solve(flexed, &place);
    place.load.reach = reach;
    struct flexibility_answer other = flexed_solve(flexed, &place);
    measured("with a reach", other.value * YOUNG * RADIUS, whole.value * YOUNG * RADIUS, allowed);
    for (int k = 0; k < 6; k++)
        measured("with a reach, all directions", other.tensor[k] * YOUNG * RADIUS,
                 whole.tensor[k] * YOUNG * RADIUS, 3.0 * allowed);
}

static void reach_does_not_matter(void **state)
{
    (void)state;
    struct flexed flexed;
    cylinder(&flexed, ELEMENT_HEX20, 0.3, 3.0 * RADIUS, 8, false);
    struct flexibility_place place = flexed_place(&flexed, 0.015, RADIUS, 0.0);
    assert_true(isinf(place.load.reach));
    compare_reach(&flexed, place, 0.7 * RADIUS, 1e-3);
    flexed_free(&flexed);

    struct block block = {ELEMENT_HEX20, {2, 20, 2}, ring, false};
    struct solid_mesh mesh = block_make(&block);
    mesh.part[0].material = metal(0.3);
    flexed_make(&flexed, &mesh, shift_for(0.2), false);
    place = flexed_place(&flexed, 0.02 * cos(2.5), 0.02 * sin(2.5), 0.005);
    /* half the height where a cone of 45 degrees meets a circle: half its radius */
    near_relative(place.load.reach, 0.01, 0.1);
    compare_reach(&flexed, place, 0.005, 2e-3);
    flexed_free(&flexed);
}

/* Elements a hundred times as long as they are thick: their faces are split across, so that the
 * forces balance to the quadrature's 1e-8 (quarters of such a face left 1e-2). */
static void bar(const double cube[3], double point[3])
{
    for (int k = 0; k < 3; k++)
        point[k] = (k == 0 ? 1.0 : RADIUS) * cube[k];
}

static void slender_elements_balance(void **state)
{
    (void)state;
    struct flexed flexed;
    struct block block = {ELEMENT_HEX20, {1, 1, 2}, bar, false};
    struct solid_mesh mesh = block_make(&block);
    mesh.part[0].material = metal(0.3);
    /* below the first bending */
    flexed_make(&flexed, &mesh, shift_for(100.0), false);
    struct flexibility_place place = flexed_place(&flexed, 0.5, 0.0, 0.003);
    measured("imbalance of slender elements, 1e-8", 1e8 * flexed_solve(&flexed, &place).imbalance,
             0.0, 1.0);
    flexed_free(&flexed);
}

/* What one force does at another's place is what that one does at this: two different fields are
 * split off, and the mesh makes the difference. */
static void responses_are_reciprocal(void **state)
{
    (void)state;
    struct flexed flexed;
    struct fault fault;
    struct flexibility_answer answers[3];
    cylinder(&flexed, ELEMENT_HEX27, 0.3, 3.0 * RADIUS, 9, false);
    struct flexibility_place places[3] = {flexed_place(&flexed, 0.0, 0.0, 0.0),
                                          flexed_place(&flexed, 0.015, RADIUS, 0.0),
                                          flexed_place(&flexed, 0.0, 0.0, 0.3 * RADIUS)};
    assert_int_equal(flexibility_solve(flexed.flexibility, 3, places, answers, &fault), PERCUSS_OK);
    double to = flexibility_response(flexed.flexibility, 0, &places[1]);
    double from = flexibility_response(flexed.flexibility, 1, &places[0]);
    measured("end and side", to * YOUNG * RADIUS, from * YOUNG * RADIUS, 1e-3);

    /* solved alone or together is the same */
    struct flexibility_answer alone = flexed_solve(&flexed, &places[1]);
    near_relative(alone.value, answers[1].value, 1e-9);
    flexed_free(&flexed);
}

/* A mode more that is removed takes phi^2 / w^2 with it, however many there are. The mesh's own
 * mode obeys the field's equations to its discretisation's error: .0001 for elements of 3 mm. */
static void modes_take_their_part(void **state)
{
    (void)state;
    static const size_t COUNTS[] = {4, 12, 24};
    struct flexed flexed;
    struct solved solved;
    cylinder(&flexed, ELEMENT_HEX27, 0.3, 3.0 * RADIUS, 9, false);
    solve_mesh(&flexed.mesh, 0, INFINITY, 24, &solved);
    struct flexibility_place places[2] = {flexed_place(&flexed, 0.0, 0.0, 0.4 * RADIUS),
                                          flexed_place(&flexed, 0.012, RADIUS, 0.0)};
    double whole[2];
    size_t n = flexed.matrices.stiffness.n;
    for (size_t i = 0; i < 2; i++)
        whole[i] = flexed_solve(&flexed, &places[i]).value;
    for (size_t c = 0; c < COUNT(COUNTS); c++) {
        flexibility_free(flexed.flexibility);
        flexed.body.removed = COUNTS[c];
        flexed.body.shapes = solved.modes.shapes;
        flexed.body.omega = solved.modes.omega;
        flexed.flexibility = flexibility_make(&flexed.body);
        assert_non_null(flexed.flexibility);
        for (size_t i = 0; i < 2; i++) {
            double taken = 0.0;
            for (size_t k = 0; k < COUNTS[c]; k++) {
                double p = flexed_shape(&flexed, &places[i], solved.modes.shapes + k * n);
                taken += p * p / (solved.modes.omega[k] * solved.modes.omega[k]);
            }
            measured("without modes, E b C",
                     flexed_solve(&flexed, &places[i]).value * YOUNG * RADIUS,
                     (whole[i] - taken) * YOUNG * RADIUS, 3e-4);
        }
    }
    solved_free(&solved);
    flexed_free(&flexed);
}

/* The tensor at the place nearest to a point, for a contact of the radius `contact`. */
static struct flexibility_place solve_tensor(struct flexed *flexed, const double point[3],
                                             double contact, double tensor[6])
{
    static const int ROW[6] = {0, 1, 2, 0, 1, 2}, COLUMN[6] = {0, 1, 2, 1, 2, 0};
    struct flexibility_place place = flexed_place(flexed, point[0], point[1], point[2]);
    place.loads = FLEXIBILITY_LOADS;
    const struct boussinesq3 *load = &place.load;
    struct flexibility_answer answer = flexed_solve(flexed, &place);
    assert_true(answer.imbalance < 3e-7);
    memcpy(tensor, answer.tensor, sizeof answer.tensor);
    if (place.flat)
        return place;
    const double *bend = place.curvature;
    double narrower = log(answer.radius / contact);
    double more = narrower * flexibility_slope(load->young, load->poisson,
                                               0.5 * (bend[0] + bend[4] + bend[8]));
    cerruti3_add_slope(load->young, load->poisson, load->inward, bend, narrower, tensor);
    for (int k = 0; k < 6; k++)
        tensor[k] += more * load->inward[ROW[k]] * load->inward[COLUMN[k]];
    return place;
}

static const double TURN[9] = {2.0 / 3.0,  -1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0,
                               -1.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};

/* A tensor turned with the body. */
static void turn_tensor(const double tensor[6], double turned[6])
{
    static const int ROW[6] = {0, 1, 2, 0, 1, 2}, COLUMN[6] = {0, 1, 2, 1, 2, 0};
    for (int k = 0; k < 6; k++) {
        double image[3];
        boussinesq3_traction(tensor, TURN + 3 * COLUMN[k], image);
        turned[k] = dot3(TURN + 3 * ROW[k], image);
    }
}

static const double SLAB[3] = {0.06, 0.04, 0.02};

static void turned_slab(const double cube[3], double point[3])
{
    double x[3];
    for (int k = 0; k < 3; k++)
        x[k] = SLAB[k] * (cube[k] - 0.5);
    rotate3(TURN, x, point);
}

/* A block in any attitude: Ritz's method, which is good to 0.05/(E thickness); elements of 7 mm
 * beside an edge 2 mm away leave 0.01. */
static void directions_are_those_of_ritz(void **state)
{
    (void)state;
    static const double POINTS[][3] = {
        {0.0, 0.0, 0.01}, {0.015, 0.008, 0.01}, {-0.012, 0.02, 0.003}, {0.03, 0.01, 0.002}};
    static const int AXES[] = {2, 2, 1, 0};
    const struct ritz_shape shape = {.side = {SLAB[0], SLAB[1], SLAB[2]}};
    struct ritz *ritz = ritz_create(&shape, 0.3, NULL);
    struct block block = {ELEMENT_HEX20, {8, 6, 3}, turned_slab, false};
    struct solid_mesh mesh = block_make(&block);
    struct flexed flexed;
    mesh.part[0].material = metal(0.3);
    flexed_make(&flexed, &mesh, shift_for(SLAB[0]), false);
    for (size_t i = 0; i < COUNT(POINTS); i++) {
        double at[3], point[3], tensor[6], expected[6], turned[6];
        scale3(1.0 / SLAB[0], POINTS[i], at);
        rotate3(TURN, POINTS[i], point);
        assert_true(ritz_tensor(ritz, AXES[i], 1, at, expected));
        turn_tensor(expected, turned);
        solve_tensor(&flexed, point, 0.0, tensor);
        for (int k = 0; k < 6; k++)
            measured("block, E h C", tensor[k] * YOUNG * SLAB[2], turned[k] * SLAB[2] / SLAB[0],
                     0.02);
    }
    flexed_free(&flexed);
    ritz_free(ritz);
}

/* On the side and the end of a cylinder, too, of a contact as narrow as Ritz's. */
static void directions_on_a_cylinder_are_those_of_ritz(void **state)
{
    (void)state;
    static const double LENGTH = 3.0 * 0.01,
                        POINTS[][3] = {{0.011, 0.006, 0.008}, {0.03, 0.003, 0.004}};
    const struct ritz_shape shape = {.side = {LENGTH, 2.0 * RADIUS, 2.0 * RADIUS}, .round = true};
    struct ritz *ritz = ritz_create(&shape, 0.3, NULL);
    struct flexed flexed;
    cylinder(&flexed, ELEMENT_HEX27, 0.3, LENGTH, 9, false);
    for (size_t i = 0; i < COUNT(POINTS); i++) {
        double at[3], tensor[6], expected[6];
        scale3(1.0 / LENGTH, POINTS[i], at);
        at[0] -= 0.5;
        assert_true(ritz_tensor(ritz, i == 0 ? RITZ_ROUND : 0, 1, at, expected));
        solve_tensor(&flexed, POINTS[i], RITZ_CUT * 2.0 * RADIUS, tensor);
        for (int k = 0; k < 6; k++)
            measured("cylinder, E b C", tensor[k] * YOUNG * RADIUS, expected[k] * RADIUS / LENGTH,
                     0.02);
    }
    flexed_free(&flexed);
    ritz_free(ritz);
}

/* A round cantilever that is pushed at four places of its side, evenly apart: differences are a
 * bar's theory alone, as all that is local is alike, and how the held end gives way is of the
 * second degree in the place. The lever arm of a force along the bar bends it, that of one about it
 * twists it. Third differences leave most of the elements' errors: 1e-3 of 8.6. */
static void lever_arms_bend_and_twist(void **state)
{
    (void)state;
    enum { PLACES = 4 };
    static const double APART = 0.015;
    const double second = 0.25 * M_PI * pow(RADIUS, 4.0), ei = YOUNG * second;
    const struct material material = metal(0.3);
    struct flexibility_place place;
    struct flexed flexed;
    struct solid_mesh mesh;
    double sum[3][6] = {{0.0}}; /* first, second, third differences, E R C */
    solid_shape_cylinder(ELEMENT_HEX20, (double[2]){RADIUS, 12.0 * RADIUS}, (size_t[3]){2, 2, 24},
                         &material, &mesh);
    /* of the order of the first eigenvalue */
    flexed_make(&flexed, &mesh, 0.01 * shift_for(12.0 * RADIUS), true);
    for (int i = 0; i < PLACES; i++) {
        static const double WEIGHTS[3][PLACES] = {{-1, 1, 0, 0}, {1, -2, 1, 0}, {-1, 3, -3, 1}};
        double tensor[6];
        place = solve_tensor(&flexed, (double[3]){0.032 + APART * i, 0.003, 0.0095}, 0.1 * RADIUS,
                             tensor);
        for (int d = 0; d < 3; d++)
            for (int k = 0; k < 6; k++)
                sum[d][k] += WEIGHTS[d][i] * tensor[k] * YOUNG * RADIUS;
    }
    double unit = YOUNG * RADIUS, y = place.load.point[1] / RADIUS,
           z = place.load.point[2] / RADIUS;
    double bent = unit * 2.0 * pow(APART, 3.0) / ei, lever = -unit * RADIUS * APART * APART / ei;
    double twist = unit * 1.3 * RADIUS * RADIUS * APART / ei; /* 2 G second = ei/1.3 */
    measured("along", sum[0][0],
             unit * APART * (1.0 / (M_PI * RADIUS * RADIUS * YOUNG) + RADIUS * RADIUS / ei), 1e-3);
    measured("down by a force along", sum[1][5], lever * z, 1e-3);
    measured("aside by a force along", sum[1][3], lever * y, 1e-3);
    measured("down", sum[2][2], bent, 2e-3);
    measured("aside", sum[2][1], bent, 2e-3);
    measured("twist", sum[0][4], -twist * y * z, 1e-3);
    measured("twist, across", sum[0][1] - sum[0][2], twist * (z * z - y * y), 1e-3);
    flexed_free(&flexed);
}

/* A held rod gives way as much with a mass ten times its own on a node as without one: the modes
 * change, the statics do not. Close to the mass the flexibility is said not to be known. */
static void masses_on_nodes_leave_statics_alone(void **state)
{
    (void)state;
    enum { REMOVED = 12 };
    static const size_t CELLS[3] = {2, 2, 9};
    const struct material material = metal(0.3);
    double whole[2], length = 3.0 * RADIUS;
    for (int massive = 0; massive < 2; massive++) {
        struct solid_mesh mesh;
        struct flexed flexed;
        struct solved solved;
        solid_shape_cylinder(ELEMENT_HEX27, (double[2]){RADIUS, length}, CELLS, &material, &mesh);
        if (massive) {
            /* on the rim of the free end */
            mesh.masses = malloc(sizeof *mesh.masses);
            *mesh.masses = (struct mesh_mass){0, 10.0 * 2700.0 * M_PI * RADIUS * RADIUS * length};
            mesh.mass_count = 1;
            for (size_t i = 0; i < mesh.node_count; i++)
                if (mesh.points[i][0] + mesh.points[i][1] >
                    mesh.points[mesh.masses->node][0] + mesh.points[mesh.masses->node][1])
                    mesh.masses->node = i;
        }
        flexed_make(&flexed, &mesh, shift_for(length), true);
        solve_mesh(&flexed.mesh, 1, INFINITY, REMOVED, &solved);
        struct flexibility_place places[2] = {flexed_place(&flexed, length, -0.4 * RADIUS, 0.0),
                                              flexed_place(&flexed, 0.4 * length, RADIUS, 0.0)};
        flexibility_free(flexed.flexibility);
        flexed.body.removed = REMOVED;
        flexed.body.shapes = solved.modes.shapes;
        flexed.body.omega = solved.modes.omega;
        flexed.flexibility = flexibility_make(&flexed.body);
        for (size_t i = 0; i < 2; i++) {
            double value = flexed_solve(&flexed, &places[i]).value * YOUNG * RADIUS;
            for (size_t k = 0; k < REMOVED; k++) {
                double p = flexed_shape(&flexed, &places[i],
                                        solved.modes.shapes + k * flexed.matrices.stiffness.n);
                value += p * p / pow(solved.modes.omega[k], 2.0) * YOUNG * RADIUS;
            }
            if (massive)
                measured("held with a mass, E b C", value, whole[i], 1e-3);
            whole[i] = value;
            assert_false(flexibility_place_massive(&places[i], &flexed.mesh));
        }
        struct flexibility_place beside = flexed_place(&flexed, length, 0.9 * RADIUS, 0.0);
        assert_int_equal(flexibility_place_massive(&beside, &flexed.mesh), massive);
        solved_free(&solved);
        flexed_free(&flexed);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(end_is_that_of_the_axisymmetric_solution),
        cmocka_unit_test(wedges_are_as_good_as_bricks),
        cmocka_unit_test(sphere_is_that_of_harmonics),
        cmocka_unit_test(held_rod_differs_from_a_free_one_by_its_stretch),
        cmocka_unit_test(reach_does_not_matter),
        cmocka_unit_test(slender_elements_balance),
        cmocka_unit_test(responses_are_reciprocal),
        cmocka_unit_test(modes_take_their_part),
        cmocka_unit_test(directions_are_those_of_ritz),
        cmocka_unit_test(directions_on_a_cylinder_are_those_of_ritz),
        cmocka_unit_test(lever_arms_bend_and_twist),
        cmocka_unit_test(masses_on_nodes_leave_statics_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
