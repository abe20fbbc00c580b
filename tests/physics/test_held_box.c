/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Blocks that are held at an end or both (service/core/model/ritz.h): against meshes of finite elements
 * and beams; what supports leave of W; states, groups, both methods; who cannot be hit. */
#include "physics/support.h"

static struct solve_result result;

static const struct material plate_glass = {"plate glass", 70e9, 0.22, 2500.0, INFINITY, 0.0};

static struct body make_block(struct material material, const double size[3], enum support low,
                              enum support high)
{
    struct body block = make_body(&block_kind, material);
    memcpy(block.size, size, sizeof block.size);
    block.supports[0] = low;
    block.supports[1] = high;
    return block;
}

static struct body steel_plate(enum support high)
{
    return make_block(STEEL, (double[3]){0.06, 0.04, 0.006}, SUPPORT_CLAMPED, high);
}

static struct spot top(const char *id, double x, double y, double height)
{
    return (struct spot){id, {x, y, 0.5 * height}, {0.0, 0.0, 1.0}, 0.0};
}

static bool says(const char *words)
{
    for (size_t i = 0; i < result.warning_count; i++)
        if (strstr(result.warnings[i], words))
            return true;
    return false;
}

struct blow {
    double x, y, ball, speed, known;
};

/* The total covers the reference, too, but for its own error. */
static void answers(const struct body *block, const struct blow *blows, size_t count,
                    double allowed)
{
    struct lab *lab = lab_create();
    lab_add(lab, "block", *block);
    for (size_t i = 0; i < count; i++) {
        const struct blow *blow = &blows[i];
        lab_add(lab, "ball", make_sphere(STEEL, blow->ball));
        struct solve_request request =
            strike(sphere_spot("ball", blow->ball), top("block", blow->x, blow->y, block->size[2]),
                   blow->speed);
        lab_solve(lab, &request, &result);
        measured("restitution", result.contacts[0].restitution, blow->known, allowed);
        assert_true(fabs(result.contacts[0].restitution - blow->known) <=
                    result.restitution_total + allowed / 3.0);
        assert_string_equal(result.bodies[1].theory, "ritz");
    }
    lab_free(lab);
}

/* percuss-reduce's meshes of elements of twenty nodes that are finer towards the held faces (2400
 * of the plate held once, 2560 held twice, 1408 of the strip), 90 and 150 modes and their own
 * flexibility: with 840 elements the first three are at .83048, .67720, .50213. CalculiX has the
 * first ten frequencies of that mesh to the six digits that are printed. */
static void as_meshes(void **state)
{
    (void)state;
    struct body once = steel_plate(SUPPORT_FREE), twice = steel_plate(SUPPORT_CLAMPED);
    struct body strip =
        make_block(plate_glass, (double[3]){0.12, 0.04, 0.004}, SUPPORT_CLAMPED, SUPPORT_FREE);
    static const struct blow of_once[] = {
        {0.0, 0.0, 0.005, 0.5, 0.83045},     {0.024, 0.0, 0.005, 0.5, 0.67709},
        {0.024, 0.014, 0.005, 0.5, 0.50199}, {-0.015, 0.0, 0.005, 0.5, 0.91038},
        {-0.024, 0.0, 0.005, 0.5, 0.98931},  {-0.027, 0.0, 0.005, 0.5, 0.99816},
        {0.024, 0.0, 0.005, 0.05, 0.74936},  {0.0, 0.0, 0.012, 0.3, 0.51278},
        {0.024, 0.014, 0.012, 0.3, 0.86247},
    };
    static const struct blow of_twice[] = {
        {0.0, 0.0, 0.005, 0.5, 0.83541},
        {0.015, 0.010, 0.005, 0.5, 0.87484},
        {0.024, 0.0, 0.005, 0.5, 0.98931},
        {0.0, 0.0, 0.005, 0.05, 0.90015},
    };
    static const struct blow of_strip[] = {
        {0.0, 0.0, 0.004, 0.5, 0.54676},     {0.048, 0.0, 0.004, 0.5, 0.48833},
        {0.048, 0.014, 0.004, 0.5, 0.27798}, {-0.03, 0.0, 0.004, 0.5, 0.54777},
        {-0.054, 0.0, 0.004, 0.5, 0.96204},
    };
    answers(&once, of_once, COUNT(of_once), 6e-4);
    answers(&twice, of_twice, COUNT(of_twice), 6e-4);
    answers(&strip, of_strip, COUNT(of_strip), 1e-3);
}

/* A square bar of twenty thicknesses held at the one end as a block and as a beam: a theory of
 * beams takes its clamp for stiffer or softer than it is. A mesh (896 elements, 120 modes) has
 * .54095, .78631, .66825 to 1e-3. */
static void as_a_beam(void **state)
{
    (void)state;
    struct body beam = make_body(&beam_kind, ALUMINIUM);
    double b = 0.008, length = 0.16;
    struct body block =
        make_block(ALUMINIUM, (double[3]){length, b, b}, SUPPORT_CLAMPED, SUPPORT_FREE);
    beam.width = beam.height = b;
    beam.length = length;
    beam.supports[0] = SUPPORT_CLAMPED;
    static const struct blow blows[] = {{0.0, 0.0, 0.008, 0.1, 0.54095},
                                        {0.06, 0.0, 0.008, 0.1, 0.78631},
                                        {-0.06, 0.0, 0.008, 0.1, 0.66825}};
    answers(&block, blows, COUNT(blows), 1.2e-3);
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.008));
    lab_add(lab, "beam", beam);
    for (size_t i = 0; i < COUNT(blows); i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.008), top("beam", blows[i].x, 0.0, b), 0.1);
        lab_solve(lab, &request, &result);
        assert_string_equal(result.bodies[1].theory, "timoshenko");
        measured("as a beam", result.contacts[0].restitution, blows[i].known, 7e-3);
        /* near the clamp its error holds that; without its part for clamps it was .0006 */
        if (i == 2)
            assert_true(result.restitution_total > 4e-3 &&
                        fabs(result.contacts[0].restitution - blows[i].known) <=
                            result.restitution_total + 2e-3);
    }
    lab_free(lab);
}

/* A strip with clamped ends is a block, to the bit; with pinned ones a beam that warns. */
static void held_strips(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.004));
    struct body strip = make_body(&beam_kind, plate_glass);
    strip.length = 0.12;
    strip.width = 0.04;
    strip.height = 0.004;
    strip.supports[0] = SUPPORT_CLAMPED;
    struct body pinned = strip;
    pinned.supports[0] = SUPPORT_PINNED;
    lab_add(lab, "block",
            make_block(plate_glass, (double[3]){0.12, 0.04, 0.004}, SUPPORT_CLAMPED, SUPPORT_FREE));
    lab_add(lab, "strip", strip);
    lab_add(lab, "pinned", pinned);
    const char *const ids[] = {"block", "strip", "pinned"};
    double e[3], total[3];
    for (int i = 0; i < 3; i++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.004), top(ids[i], 0.03, 0.0, 0.004), 0.5);
        lab_solve(lab, &request, &result);
        e[i] = result.contacts[0].restitution;
        total[i] = result.restitution_total;
        assert_true(says("times as broad as deep") == (i == 2));
        assert_string_equal(result.bodies[1].theory, i == 2 ? "timoshenko" : "ritz");
    }
    assert_true(e[1] == e[0] && total[1] == total[0] && e[2] != e[0]);
    lab_free(lab);
}

/* Nothing of the block's mass is in W, and it stays where it is, even hit in the hardest place: a
 * compact one vibrates as well, as it moves in no other way. */
static void supports_rule_w(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    const struct body *ball = lab_add(lab, "ball", make_sphere(STEEL, 0.010));
    lab_add(lab, "cube",
            make_block(STEEL, (double[3]){0.05, 0.05, 0.05}, SUPPORT_FREE, SUPPORT_CLAMPED));
    struct solve_request request =
        strike(sphere_spot("ball", 0.010), top("cube", 0.0, 0.0, 0.05), 0.2);
    lab_solve(lab, &request, &result);
    measured_relative("W", result.contacts[0].inverse_effective_mass, 1.0 / ball->mass, 1e-13);
    assert_true(norm3(result.bodies[1].velocity) == 0.0);
    assert_string_equal(result.bodies[1].theory, "ritz");
    double e = result.contacts[0].restitution;
    assert_true(e < 1.0 && e > 0.99);
    assert_true(fabs(result.energy.closure) < 1e-4 * result.energy.available);
    lab_free(lab);
}

/* A hit on a held face is refused, on the free one answered. */
static void held_faces(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.005));
    lab_add(lab, "block", steel_plate(SUPPORT_FREE));
    for (int side = -1; side <= 1; side += 2) {
        const struct spot end = {"block", {0.03 * side, 0.0, 0.0}, {side, 0.0, 0.0}, 0.0};
        struct solve_request request = strike(sphere_spot("ball", 0.005), end, 0.2);
        enum percuss_status status = solve(lab->workspace, &lab->means, &request, &result);
        assert_int_equal(status, side < 0 ? PERCUSS_UNSUPPORTED_GEOMETRY : PERCUSS_OK);
        if (side < 0)
            assert_non_null(strstr(result.fault.text, "this end is held by a support"));
    }
    /* mesh: at half a metre a second .95600 */
    struct solve_request request =
        strike(sphere_spot("ball", 0.005),
               (struct spot){"block", {0.03, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.0}, 0.5);
    lab_solve(lab, &request, &result);
    measured("on its end", result.contacts[0].restitution, 0.95600, 3e-4);
    lab_free(lab);
}

/* A blow after a blow: what the first one left as vibration is there, and energy closes; by CVODE
 * the same. */
static void blows_in_a_row(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.005));
    lab_add(lab, "block", steel_plate(SUPPORT_FREE));
    struct solve_request request =
        strike(sphere_spot("ball", 0.005), top("block", 0.020, 0.005, 0.006), 0.2);
    request.options.tolerance = 1e-6;
    struct body_state *before = NULL;
    double left = 0.0, approach = 0.0;
    for (int i = 0; i < 3; i++) {
        request.bodies[1].state = before;
        request.bodies[1].elapsed = 1e-3;
        lab_solve(lab, &request, &result);
        const struct body_state *after = result.bodies[1].state_after;
        assert_non_null(after);
        approach = i == 0 ? result.energy.available : approach;
        near(result.energy.available - approach, left, 1e-9 * approach);
        assert_true(fabs(result.energy.closure) < 1e-6 * result.energy.available);
        left = result.bodies[1].vibration;
        double e = result.contacts[0].restitution;
        struct body_state *kept = malloc(body_state_size(after));
        assert_non_null(kept);
        memcpy(kept, after, body_state_size(after));
        request.options.method = PERCUSS_METHOD_CVODE;
        lab_solve(lab, &request, &result);
        near(result.contacts[0].restitution, e, 1e-5);
        request.options.method = PERCUSS_METHOD_MODAL;
        free(before);
        before = kept;
    }
    free(before);
    lab_free(lab);
}

/* Two balls at once, mirror images about the plane y = 0: the same. */
static void groups(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.005));
    lab_add(lab, "block", steel_plate(SUPPORT_FREE));
    struct solve_request request =
        strike(sphere_spot("ball", 0.005), top("block", 0.020, 0.010, 0.006), 0.3);
    struct solve_body bodies[3];
    struct solve_contact contacts[2];
    memcpy(bodies, request.bodies, 2 * sizeof *bodies);
    contacts[0] = contacts[1] = request.contacts[0];
    bodies[2] = bodies[0];
    bodies[2].position[1] -= 0.020;
    contacts[1].a = 2;
    contacts[1].point[1] -= 0.020;
    struct solve_request both = request;
    memcpy(both.bodies, bodies, sizeof bodies);
    memcpy(both.contacts, contacts, sizeof contacts);
    both.body_count = 3;
    both.contact_count = 2;
    lab_solve(lab, &both, &result);
    near(result.contacts[0].restitution, result.contacts[1].restitution, 1e-9);
    assert_true(result.contacts[0].restitution > 0.2 && result.contacts[0].restitution < 0.99);
    assert_true(fabs(result.energy.closure) < 1e-3 * result.energy.available);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_meshes),   cmocka_unit_test(as_a_beam),
        cmocka_unit_test(held_strips), cmocka_unit_test(supports_rule_w),
        cmocka_unit_test(held_faces),  cmocka_unit_test(blows_in_a_row),
        cmocka_unit_test(groups),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
