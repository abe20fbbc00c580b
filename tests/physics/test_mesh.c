/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies that were reduced from meshes: a round bar whose surface, modes and flexibility are given
 * as a mesh's must answer as the built-in bar does, on every path that a request takes. */
#include "fe/matched.h"
#include "physics/ensemble_lab.h"
#include "physics/mesh_twins.h"

/* Shapes in the file are floats, 6e-8 of them: participations squared hold twice that. */
static const double FLOATS = 4e-7;

/* Hit on an end. */
static void a_rod_s_mesh_answers_as_the_rod(void **state)
{
    (void)state;
    static struct solve_result result;
    static const double speeds[] = {0.05, 0.1, 0.3, 0.5};
    struct twins twins = make_twins(make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0), MODES, 0.0);
    struct spot spot = end_spot("", 1.0);
    for (size_t i = 0; i < COUNT(speeds); i++) {
        double e = answer(&twins, &spot, "bar", speeds[i], PERCUSS_COMPLIANCE_HALF_SPACE, &result);
        measured("half-space",
                 answer(&twins, &spot, "mesh", speeds[i], PERCUSS_COMPLIANCE_HALF_SPACE, &result),
                 e, FLOATS);
    }
    twins_free(&twins);
    /* with what a rod's matched compliance adds as the surface's own flexibility */
    struct body rod = make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0);
    struct fault fault;
    double matched;
    assert_int_equal(body_complete(&rod, &fault), PERCUSS_OK);
    assert_true(matched_compliance(&rod, 1e-4, &matched));
    twins = make_twins(rod, MODES, matched);
    for (size_t i = 0; i < COUNT(speeds); i++) {
        double e = answer(&twins, &spot, "bar", speeds[i], PERCUSS_COMPLIANCE_MATCHED, &result);
        measured("matched, by default",
                 answer(&twins, &spot, "mesh", speeds[i], PERCUSS_COMPLIANCE_DEFAULT, &result), e,
                 FLOATS);
        assert_int_equal(result.compliance, PERCUSS_COMPLIANCE_MATCHED);
        assert_string_equal(result.bodies[1].theory, "mesh");
        assert_false(result.bodies[1].rigid);
    }
    twins_free(&twins);
}

/* Hit on the side, at its middle and elsewhere; 40 faces along it: nodes every 12.5 mm. */
static void a_beam_s_mesh_answers_as_the_beam(void **state)
{
    (void)state;
    static struct solve_result result;
    struct twins twins = make_twins(make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0), MODES, 0.0);
    const double places[] = {0.0, 0.15, -0.3};
    for (size_t i = 0; i < COUNT(places); i++) {
        struct spot spot = side_spot("", places[i], 0.010, i == 1 ? M_PI_4 : 0.0);
        double e = answer(&twins, &spot, "bar", 0.2, PERCUSS_COMPLIANCE_HALF_SPACE, &result);
        unsigned count = (unsigned)result.contacts[0].sub_impact_count;
        double first = result.contacts[0].sub_impacts[0].impulse;
        double other = answer(&twins, &spot, "mesh", 0.2, PERCUSS_COMPLIANCE_HALF_SPACE, &result);
        /* sequences amplify: sub-impacts that follow multiply a change by five to twenty */
        measured("e", other, e, 20.0 * FLOATS);
        measured_relative("first impulse", result.contacts[0].sub_impacts[0].impulse, first,
                          FLOATS);
        assert_int_equal(result.contacts[0].sub_impact_count, count);
    }
    twins_free(&twins);
}

/* Whatever the pose, the method and the model. */
static void all_paths_are_taken(void **state)
{
    (void)state;
    static struct solve_result result;
    struct twins twins = make_twins(make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0), MODES, 0.0);
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("mesh", 0.15, 0.010, 0.0), 0.1);
    request.options.tolerance = 1e-6;
    request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE; /* as a beam's */
    lab_solve(twins.lab, &request, &result);
    double e = result.contacts[0].restitution;
    /* another frame */
    double q[4];
    uint64_t seed = 7;
    struct solve_request moved = request;
    random_rotation(&seed, q);
    move_scene(&moved, q, (double[3]){1.0, -2.0, 0.5}, (double[3]){0.1, 0.2, 0.3});
    lab_solve(twins.lab, &moved, &result);
    measured("elsewhere", result.contacts[0].restitution, e, 1e-8);
    /* CVODE */
    moved = request;
    moved.options.method = PERCUSS_METHOD_CVODE;
    lab_solve(twins.lab, &moved, &result);
    measured("CVODE", result.contacts[0].restitution, e, 1e-5);
    /* a token: as the beam's own */
    struct solve_request beam =
        strike(sphere_spot("ball", 0.015), side_spot("bar", 0.15, 0.010, 0.0), 0.1);
    beam.options = request.options;
    double again[2];
    for (int i = 0; i < 2; i++) {
        struct solve_request *one = i == 0 ? &request : &beam;
        lab_solve(twins.lab, one, &result);
        assert_non_null(result.bodies[1].state_after);
        struct body_state *kept = malloc(body_state_size(result.bodies[1].state_after));
        memcpy(kept, result.bodies[1].state_after, body_state_size(result.bodies[1].state_after));
        struct solve_request next = *one;
        next.bodies[1].state = kept;
        next.bodies[1].elapsed = 0.003;
        lab_solve(twins.lab, &next, &result);
        again[i] = result.contacts[0].restitution;
        free(kept);
    }
    measured("ringing", again[0], again[1], 1e-4);
    twins_free(&twins);
}

/* Moduli, densities and sizes without a new reduction. */
static void parameters_scale_it(void **state)
{
    (void)state;
    static struct solve_result result;
    struct twins twins = make_twins(make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0), MODES, 0.0);
    struct body other = *twins.bar;
    other.material.young = 90e9;
    other.material.density = 3300.0;
    other.radius *= 1.5;
    other.length *= 1.5;
    lab_add(twins.lab, "other", other);
    struct spot spot = end_spot("", 1.5);
    double e = answer(&twins, &spot, "other", 0.3, PERCUSS_COMPLIANCE_HALF_SPACE, &result);
    struct body scaled = *twins.mesh;
    scaled.material.young = 90e9;
    scaled.material.density = 3300.0;
    scaled.scale = 1.5;
    const struct body *mesh = lab_add(twins.lab, "scaled", scaled);
    near_relative(mesh->mass, lab_add(twins.lab, "other", other)->mass, 1e-14);
    near_relative(mesh->inertia[1], twins.lab->bodies[3].inertia[1], 1e-14);
    measured("of another size",
             answer(&twins, &spot, "scaled", 0.3, PERCUSS_COMPLIANCE_HALF_SPACE, &result), e,
             FLOATS);
    /* but not Poisson's ratio */
    struct body_variation variation = {PERCUSS_PARAMETER_POISSON, 0.3};
    struct body varied;
    struct fault fault = {""};
    assert_int_equal(body_vary(mesh, &variation, 1, &varied, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "poisson: 0.3: must be 0.33"));
    twins_free(&twins);
}

/* Few modes: the answer says that they do not suffice, and by how much at least. */
static void the_end_of_the_file_is_said(void **state)
{
    (void)state;
    static struct solve_result result;
    struct twins many = make_twins(make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0), 200, 0.0);
    struct spot spot = end_spot("", 1.0);
    double e = answer(&many, &spot, "mesh", 0.3, PERCUSS_COMPLIANCE_HALF_SPACE, &result);
    assert_true(result.tolerance_met);
    twins_free(&many);
    for (size_t modes = REMOVED; modes <= 48; modes *= 2) {
        struct twins few = make_twins(make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0), modes, 0.0);
        double rough = answer(&few, &spot, "mesh", 0.3, PERCUSS_COMPLIANCE_HALF_SPACE, &result);
        measured("e within its error", rough, e,
                 result.restitution_modes + result.restitution_time + FLOATS);
        if (modes == REMOVED) {
            assert_false(result.tolerance_met);
            assert_non_null(strstr(result.warnings[0], "modes in the body's file are too few"));
        }
        twins_free(&few);
    }
}

/* Flexibility so far below the half-space's that all modes leave too negative a spring: fewer take
 * part, and the error says what that costs. */
static void a_stiff_contact_takes_fewer_modes(void **state)
{
    (void)state;
    static struct solve_result result;
    double stiff = -3.2 / (70e9 * 0.010);
    struct twins twins = make_twins(make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0), MODES, stiff);
    lab_add(twins.lab, "free", *twins.mesh);
    struct spot spot = end_spot("", 1.0);
    double gentle = answer(&twins, &spot, "free", 0.02, PERCUSS_COMPLIANCE_DEFAULT, &result);
    size_t all = result.bodies[1].modes;
    double fast = answer(&twins, &spot, "free", 3.0, PERCUSS_COMPLIANCE_DEFAULT, &result);
    assert_true(all == MODES && result.bodies[1].modes < MODES && result.bodies[1].modes > 6);
    assert_true(gentle > fast && fast > 0.0);
    assert_false(result.tolerance_met);
    assert_non_null(strstr(result.warnings[0], "more modes of the mesh would leave too negative"));
    twins_free(&twins);
}

/* Two contacts on one body: what one does to the other. */
static void contacts_on_one_body_feel_each_other(void **state)
{
    (void)state;
    static struct solve_result result;
    struct twins twins = make_twins(make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0), MODES, 0.0);
    lab_add(twins.lab, "second", make_sphere(STEEL, 0.015));
    double e[2][2];
    for (int i = 0; i < 2; i++) {
        struct solve_request request = strike(sphere_spot("ball", 0.015),
                                              side_spot(i ? "mesh" : "bar", 0.15, 0.010, 0.0), 0.1);
        request.options.tolerance = 1e-6;
        request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
        /* the other ball, 0.35 m along the beam */
        request.body_count = 3;
        request.bodies[2] = request.bodies[0];
        snprintf(request.bodies[2].id, sizeof request.bodies[2].id, "second");
        double axis[3], rotation[9];
        rotation_matrix(request.bodies[1].orientation, rotation);
        rotate3(rotation, (double[3]){-0.35, 0.0, 0.0}, axis);
        add_scaled3(1.0, axis, request.bodies[2].position);
        request.contact_count = 2;
        request.contacts[1] = request.contacts[0];
        request.contacts[1].a = 2;
        add_scaled3(1.0, axis, request.contacts[1].point);
        lab_solve(twins.lab, &request, &result);
        e[i][0] = result.contacts[0].impulse;
        e[i][1] = result.contacts[1].impulse;
    }
    /* the modes' sum stands for the static compliance between them: what is left is that of modes
     * from the 60th on, and sequences amplify */
    measured_relative("first contact", e[1][0], e[0][0], 1e-4);
    measured_relative("second contact", e[1][1], e[0][1], 1e-4);
    twins_free(&twins);
}

/* Two of them across each other, each in its turn below. */
static void meshes_hit_each_other(void **state)
{
    (void)state;
    static struct solve_result result;
    struct twins twins = make_twins(make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0), MODES, 0.0);
    double e[3];
    struct body copies[2] = {*twins.bar, *twins.mesh};
    lab_add(twins.lab, "bar 2", copies[0]);
    lab_add(twins.lab, "mesh 2", copies[1]);
    const char *ids[3][2] = {{"bar", "bar 2"}, {"mesh", "mesh 2"}, {"bar", "mesh"}};
    for (int i = 0; i < 3; i++) {
        struct spot above = side_spot(ids[i][0], 0.15, 0.010, 0.0);
        above.roll = M_PI_2;
        struct solve_request request = strike(above, side_spot(ids[i][1], 0.0, 0.010, 0.0), 0.1);
        request.options.tolerance = 1e-6;
        request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
        lab_solve(twins.lab, &request, &result);
        e[i] = result.contacts[0].restitution;
    }
    /* sequences amplify what floats leave */
    measured("both meshes", e[1], e[0], 20.0 * FLOATS);
    measured("a beam on a mesh", e[2], e[0], 20.0 * FLOATS);
    twins_free(&twins);
}

static void a_rigid_mesh_is_a_rigid_body(void **state)
{
    (void)state;
    static struct solve_result result;
    struct twins twins = make_twins(make_bar(&rod_kind, ALUMINIUM, 0.010, 0.04), 20, 0.0);
    struct body rigid = *twins.mesh;
    rigid.rigid = true;
    lab_add(twins.lab, "rigid", rigid);
    struct spot spot = end_spot("", 0.04);
    near(answer(&twins, &spot, "rigid", 0.3, PERCUSS_COMPLIANCE_HALF_SPACE, &result), 1.0, 1e-9);
    assert_true(result.bodies[1].rigid);
    assert_string_equal(result.bodies[1].theory, "rigid");
    twins_free(&twins);
}

/* Means over uncertain moduli: the same samples of the rod and of its mesh. */
static void ensembles_vary_it(void **state)
{
    (void)state;
    static struct ensemble_lab e;
    struct twins twins = make_twins(make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0), MODES, 0.0);
    double mean[2];
    memset(&e, 0, sizeof e);
    e.lab = twins.lab;
    e.spec = (struct ensemble_spec){.catalogue = &twins.lab->set,
                                    .request = &e.request,
                                    .input_count = 2,
                                    .inputs = e.inputs,
                                    .samples = 40,
                                    .seed = 3};
    e.inputs[0] = uncertain(INPUT_YOUNG, 1, DISTRIBUTION_IS_UNIFORM, 65e9, 75e9);
    e.inputs[1] = uncertain(INPUT_DENSITY, 1, DISTRIBUTION_IS_UNIFORM, 2600.0, 2800.0);
    for (int i = 0; i < 2; i++) {
        e.request = strike(sphere_spot("ball", 0.015), end_spot(i ? "mesh" : "bar", 1.0), 0.3);
        e.request.options.tolerance = 1e-5;
        e.request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
        ensemble_lab_run(&e, false);
        double sum = 0.0;
        for (uint64_t s = 0; s < e.ensemble.count; s++)
            sum += e.samples[s].restitution;
        mean[i] = sum / (double)e.ensemble.count;
        ensemble_lab_clear(&e);
    }
    measured("mean", mean[1], mean[0], 1e-5);
    /* its size: the place that is hit stays */
    static struct solve_result result;
    struct body half = *twins.mesh;
    half.scale = 0.5;
    lab_add(twins.lab, "half", half);
    struct spot spot = end_spot("", 0.5);
    double expected = answer(&twins, &spot, "half", 0.3, PERCUSS_COMPLIANCE_HALF_SPACE, &result);
    e.spec.input_count = 1;
    e.inputs[0] = uncertain(INPUT_SCALE, 1, DISTRIBUTION_IS_CONSTANT, 0.5, NAN);
    e.spec.samples = 1;
    ensemble_lab_run(&e, false);
    measured("of half its size", e.samples[0].restitution, expected, 1e-5);
    ensemble_lab_clear(&e);
    twins_free(&twins);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rod_s_mesh_answers_as_the_rod),
        cmocka_unit_test(a_beam_s_mesh_answers_as_the_beam),
        cmocka_unit_test(all_paths_are_taken),
        cmocka_unit_test(parameters_scale_it),
        cmocka_unit_test(the_end_of_the_file_is_said),
        cmocka_unit_test(a_stiff_contact_takes_fewer_modes),
        cmocka_unit_test(contacts_on_one_body_feel_each_other),
        cmocka_unit_test(meshes_hit_each_other),
        cmocka_unit_test(a_rigid_mesh_is_a_rigid_body),
        cmocka_unit_test(ensembles_vary_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
