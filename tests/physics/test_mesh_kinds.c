/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Meshes that are held, and of two materials, against the built-in bodies. */
#include "bodies/made_mesh.h"
#include "model/mesh_surface.h"
#include "physics/support.h"

static struct mesh_body *make_mesh(const struct body *bar, size_t modes)
{
    struct mesh_body *mesh = made_mesh_bar(
        &(struct made_mesh){.bar = bar, .modes = modes, .removed = 10, .around = 16, .along = 40});
    assert_non_null(mesh);
    assert_true(mesh_surface_prepare(mesh));
    return mesh;
}

static struct body body_of(const struct mesh_body *mesh)
{
    struct body body = make_body(&mesh_kind, mesh->materials[0]);
    body.mesh = mesh;
    return body;
}

/* Nodes held at both ends: no rigid motion, modes of the pinned beam. */
static void a_held_mesh_answers_as_the_held_beam(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    struct body beam =
        make_supported(make_bar(&beam_kind, ALUMINIUM, 0.010, 0.5), SUPPORT_PINNED, SUPPORT_PINNED);
    beam.modes = 50;
    struct mesh_body *mesh = make_mesh(lab_add(lab, "beam", beam), 50);
    lab_add(lab, "mesh", body_of(mesh));
    double e[2], w[2];
    for (int i = 0; i < 2; i++) {
        struct solve_request request = strike(sphere_spot("ball", 0.015),
                                              side_spot(i ? "mesh" : "beam", 0.1, 0.010, 0.0), 0.1);
        request.options.tolerance = 1e-6;
        request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
        lab_solve(lab, &request, &result);
        e[i] = result.contacts[0].restitution;
        w[i] = result.contacts[0].inverse_effective_mass;
        assert_true(result.bodies[1].velocity[2] == 0.0);
    }
    near_relative(w[1], w[0], 1e-15);
    /* what floats leave of the shapes, through sub-impacts */
    measured("e", e[1], e[0], 1e-5);
    lab_free(lab);
    mesh_body_free(mesh);
}

/* The face that is hit gives the contact its material; moduli follow the first one's. */
static void a_face_is_of_its_own_material(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    struct body rod = make_bar(&rod_kind, ALUMINIUM, 0.010, 0.06);
    struct mesh_body *mesh = make_mesh(lab_add(lab, "rod", rod), 20);
    /* one end of steel */
    mesh->material_count = 2;
    mesh->materials = realloc(mesh->materials, 2 * sizeof *mesh->materials);
    assert_non_null(mesh->materials);
    mesh->materials[1] = STEEL;
    for (size_t f = 0; f < mesh->face_count; f++)
        mesh->faces[f].material = mesh->faces[f].patch == 2;
    struct body body = body_of(mesh);
    body.rigid = true;
    lab_add(lab, "mesh", body);
    body.material.young *= 1.1;
    lab_add(lab, "stiffer", body);
    /* a cylinder of the same mass and of that material */
    struct body cylinder = make_bar(&cylinder_kind, STEEL, 0.010, 0.06);
    cylinder.material.density = ALUMINIUM.density;
    lab_add(lab, "cylinder", cylinder);
    cylinder.material.young *= 1.1;
    lab_add(lab, "stiffer cylinder", cylinder);
    const char *pairs[][2] = {{"mesh", "cylinder"}, {"stiffer", "stiffer cylinder"}};
    for (size_t i = 0; i < COUNT(pairs); i++) {
        double force[2];
        for (int k = 0; k < 2; k++) {
            struct solve_request request =
                strike(sphere_spot("ball", 0.015), end_spot(pairs[i][k], 0.06), 0.1);
            request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
            lab_solve(lab, &request, &result);
            force[k] = result.contacts[0].sub_impacts[0].peak_force;
        }
        measured_relative("peak force", force[0], force[1], 1e-9);
    }
    lab_free(lab);
    mesh_body_free(mesh);
}

/* A hollow of the end bears a ball that is rounder than itself; with a narrower one the refusal
 * says so, by both radii, of a groove and of a dish. */
static void a_hollow_may_be_too_narrow(void **state)
{
    (void)state;
    static struct solve_result result;
    static const struct {
        float radius[2]; /* m, of the hollow, across and along */
        const char *words;
    } HOLLOWS[] = {
        {{0.02f, 0.02f}, NULL},
        {{0.02f, INFINITY}, NULL},
        {{0.012f, INFINITY},
         "ball does not fit into the hollow of mesh there: its radius of curvature is 0.015 m, the "
         "hollow's 0.012 m; they touch in two places"},
        {{0.014f, 0.012f}, "the hollow's 0.012 m; they touch along a ring"},
        {{0.015f, INFINITY}, "touch in a line"},
    };
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    struct mesh_body *mesh =
        make_mesh(lab_add(lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 0.06)), 20);
    struct body body = body_of(mesh);
    body.rigid = true;
    lab_add(lab, "mesh", body);
    for (size_t i = 0; i < COUNT(HOLLOWS); i++) {
        for (size_t f = 0; f < mesh->face_count; f++)
            for (int n = 0; mesh->faces[f].patch == 2 && n < MESH_BODY_FACE_NODES; n++)
                for (int k = 0; k < 2; k++)
                    mesh->faces[f].curvature[n][1 + k] = -1.0f / HOLLOWS[i].radius[k];
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), end_spot("mesh", 0.06), 0.1);
        enum percuss_status status = solve(lab->workspace, &lab->means, &request, &result);
        assert_int_equal(status, HOLLOWS[i].words ? PERCUSS_UNSUPPORTED_GEOMETRY : PERCUSS_OK);
        if (HOLLOWS[i].words && !strstr(result.fault.text, HOLLOWS[i].words))
            fail_msg("%s", result.fault.text);
    }
    lab_free(lab);
    mesh_body_free(mesh);
}

/* Where the file knows no flexibility a hit is refused, with what helps there: on a wall, near an
 * edge. A rigid body needs none. */
static void unknown_flexibility_is_refused(void **state)
{
    (void)state;
    static struct solve_result result;
    static const struct {
        const char *body;
        double from_middle; /* m; the edge is at 10 mm, elements are some 4 mm */
        const char *words;
    } HITS[] = {{"mesh", 0.001, "its wall is thinner"},
                {"mesh", 0.0085, "too coarse so near to an edge"},
                {"rigid", 0.001, NULL}};
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    struct mesh_body *mesh =
        make_mesh(lab_add(lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 0.06)), 20);
    for (size_t f = 0; f < mesh->face_count; f++)
        for (int n = 0; mesh->faces[f].patch == 2 && n < MESH_BODY_FACE_NODES; n++)
            mesh->faces[f].flexibility[n] = NAN;
    struct body body = body_of(mesh);
    lab_add(lab, "mesh", body);
    body.rigid = true;
    lab_add(lab, "rigid", body);
    for (size_t i = 0; i < COUNT(HITS); i++) {
        struct spot spot = end_spot(HITS[i].body, 0.06);
        spot.point[1] += HITS[i].from_middle;
        struct solve_request request = strike(sphere_spot("ball", 0.015), spot, 0.1);
        enum percuss_status status = solve(lab->workspace, &lab->means, &request, &result);
        assert_int_equal(status, HITS[i].words ? PERCUSS_UNSUPPORTED_GEOMETRY : PERCUSS_OK);
        if (HITS[i].words && !strstr(result.fault.text, HITS[i].words))
            fail_msg("%s", result.fault.text);
    }
    lab_free(lab);
    mesh_body_free(mesh);
}

/* A law that yields: dents on a mesh's face as on the rod's. */
static void a_mesh_yields(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    struct material soft = ALUMINIUM;
    soft.yield = 205e6;
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    struct body rod = make_bar(&rod_kind, soft, 0.010, 1.0);
    rod.modes = 60;
    struct mesh_body *mesh = make_mesh(lab_add(lab, "rod", rod), 60);
    lab_add(lab, "mesh", body_of(mesh));
    double e[2], dent[2];
    for (int i = 0; i < 2; i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), end_spot(i ? "mesh" : "rod", 1.0), 0.3);
        request.options.tolerance = 1e-6;
        request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
        request.options.contact_model = PERCUSS_CONTACT_CLOSED_FORM;
        lab_solve(lab, &request, &result);
        e[i] = result.contacts[0].restitution;
        assert_int_equal(result.bodies[1].state_after->dents, 1);
        dent[i] = body_state_dents(result.bodies[1].state_after)[0].history.dent;
    }
    measured("e", e[1], e[0], 1e-6);
    measured_relative("dent", dent[1], dent[0], 1e-6);
    lab_free(lab);
    mesh_body_free(mesh);
}

/* Two round bars that cross at an angle have relative curvatures of tan^2(angle/2) to one. What a
 * fit leaves of a mesh's curvature along its axis does not tell .01 from a line; a declared one
 * does. */
static void a_line_is_told_by_what_a_mesh_knows(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    struct body beam = make_bar(&beam_kind, ALUMINIUM, 0.010, 0.5);
    struct mesh_body *mesh = make_mesh(lab_add(lab, "beam", beam), 20);
    struct body fitted = body_of(mesh), declared = fitted;
    /* in the mesh's frame and unit as the bar's file has them */
    struct body_site round = {.name = "side", .has_curvature = true, .curvature = {[4] = 100.0}};
    for (int k = 0; k < 3; k++)
        round.point[k] = ((double[3]){0.0, 0.0, 0.010}[k] + mesh->centre[k]) / mesh->unit;
    declared.site_count = 1;
    declared.sites = &round;
    lab_add(lab, "fitted", fitted);
    lab_add(lab, "declared", declared);
    const struct {
        const char *id;
        double angle;
        const char *words; /* NULL: answered */
    } cases[] = {{"fitted", 0.2, "whose ratio a mesh does not know below 0.03"},
                 {"fitted", 0.5, NULL},
                 {"declared", 0.2, NULL}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct spot above = side_spot("beam", 0.0, 0.010, 0.0);
        above.roll = cases[i].angle;
        struct solve_request request = strike(above, side_spot(cases[i].id, 0.0, 0.010, 0.0), 0.1);
        solve(lab->workspace, &lab->means, &request, &result);
        assert_int_equal(result.status, cases[i].words ? PERCUSS_UNSUPPORTED_GEOMETRY : PERCUSS_OK);
        if (cases[i].words && !strstr(result.fault.text, cases[i].words))
            fail_msg("\"%s\" has not \"%s\"", result.fault.text, cases[i].words);
    }
    lab_free(lab);
    mesh_body_free(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_held_mesh_answers_as_the_held_beam),
        cmocka_unit_test(a_face_is_of_its_own_material),
        cmocka_unit_test(a_hollow_may_be_too_narrow),
        cmocka_unit_test(unknown_flexibility_is_refused),
        cmocka_unit_test(a_mesh_yields),
        cmocka_unit_test(a_line_is_told_by_what_a_mesh_knows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
