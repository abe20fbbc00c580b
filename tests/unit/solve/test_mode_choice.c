/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/mode_choice.c: which modes of a mesh are left out, that the answer
 * does not notice, and where the body is expected to come back. */
#include "bodies/made_mesh.h"
#include "model/bar.h"
#include "model/mesh_surface.h"
#include "solve/mode_choice.h"
#include "unit/solve/search_lab.h"

enum { MODES = 40 };

/* A search whose lab has the mesh of a bar under "mesh". */
struct meshed {
    struct search *search;
    struct mesh_body *surface;
};

static struct meshed meshed_create(const struct body_kind *kind)
{
    struct meshed meshed = {.search = search_create()};
    const struct body *bar =
        lab_add(meshed.search->lab, "bar", make_bar(kind, ALUMINIUM, 0.010, 1.0));
    struct made_mesh wanted = {
        .bar = bar, .modes = MODES, .removed = 12, .around = 16, .along = 40};
    meshed.surface = made_mesh_bar(&wanted);
    assert_non_null(meshed.surface);
    assert_true(mesh_surface_prepare(meshed.surface));
    struct body mesh = make_body(&mesh_kind, ALUMINIUM);
    mesh.mesh = meshed.surface;
    mesh.scale = 1.0;
    lab_add(meshed.search->lab, "mesh", mesh);
    return meshed;
}

static void meshed_free(struct meshed *meshed)
{
    search_free(meshed->search);
    mesh_body_free(meshed->surface);
}

/* On the side, at an angle about the axis from one plane of bending. */
static struct solve_request on_side(double about)
{
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("mesh", 0.15, 0.010, about), 0.2);
    request.options.tolerance = 1e-3;
    request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
    return request;
}

/* All of the file's modes that the scene asked for take part, or those of one plane of bending and
 * so many others. */
enum { EVERY = -1 };
static void assert_one_plane(const struct meshed *meshed, const struct attempt *attempt, int others)
{
    size_t offered = attempt->assembly->offered[1], bending = 0;
    assert_in_range(offered, 2 * MODES, 3 * MODES);
    struct modal_family *own =
        modal_family_create(body_set_find(&meshed->search->lab->set, "bar"), BAR_BENDING_Z, MODES);
    assert_non_null(own);
    while (bending < MODES && own->omega[bending] <= meshed->surface->omega[offered - 1])
        bending++;
    modal_family_free(own);
    assert_int_equal(attempt->assembly->modes[1],
                     others == EVERY ? offered : bending + (size_t)others);
}

/* Where both planes bend, those along the bar are too few to leave out: less than a quarter. */
static void what_bends_in_the_other_plane_stays_out(void **state)
{
    (void)state;
    struct meshed meshed = meshed_create(&beam_kind);
    const struct solve_request plane = on_side(0.0), both = on_side(0.5);
    search_begin(meshed.search, &plane);
    struct attempt attempt = search_attempt(meshed.search, 1000, 1e-9);
    assert_one_plane(&meshed, &attempt, 0);
    /* those that stay are the group's own, in order */
    const struct prepared_group *source = attempt.assembly->sources[0];
    for (size_t k = 0; k < source->set->count; k++)
        assert_true(source->set->omega[k] == meshed.surface->omega[source->mode[k]]);
    search_begin(meshed.search, &both);
    attempt = search_attempt(meshed.search, 1000, 1e-9);
    assert_one_plane(&meshed, &attempt, EVERY);
    meshed_free(&meshed);
}

/* A hundred-thousandth of a turn off the plane: left out at 1e-3, taking part at 1e-9. The bound is
 * 1e-7 of the energy, here over 2 e = 1.4; three sub-impacts amplify it at most a thousandfold. */
static void the_answer_does_not_notice(void **state)
{
    (void)state;
    struct meshed meshed = meshed_create(&beam_kind);
    const struct solve_request beside = on_side(1e-5);
    search_begin(meshed.search, &beside);
    struct problem *problem = (struct problem *)meshed.search->context.problem;
    const struct attempt few = search_attempt(meshed.search, 1000, 1e-9);
    problem->tolerance = 1e-9;
    const struct attempt all = search_attempt(meshed.search, 1000, 1e-9);
    assert_one_plane(&meshed, &few, 0);
    assert_one_plane(&meshed, &all, EVERY);
    measured("e", search_error(meshed.search, &few, &all), 0.0, 1e-7);
    assert_false(assembly_same_modes(few.assembly, all.assembly));
    meshed_free(&meshed);
}

/* Vibration across the blow goes on as it was, and its energy is in the books. */
static void modes_that_vibrate_stay(void **state)
{
    (void)state;
    struct meshed meshed = meshed_create(&beam_kind);
    struct solve_request request = on_side(0.0);
    struct body_state *ringing = calloc(1, sizeof *ringing + 8 * sizeof *ringing->coordinates);
    assert_non_null(ringing);
    ringing->count[0] = 4;
    for (size_t k = 0; k < 8; k++)
        ringing->coordinates[k] = k % 2 ? 0.0 : 1e-6;
    request.bodies[1].state = ringing;
    search_begin(meshed.search, &request);
    const struct attempt attempt = search_attempt(meshed.search, 1000, 1e-9);
    /* two of the lowest four bend across */
    assert_one_plane(&meshed, &attempt, 2);
    const struct scene_group *group = &attempt.assembly->groups[0];
    double vibration = 0.0;
    for (size_t k = 0; k < 4; k++) {
        assert_int_equal(attempt.assembly->sources[0]->mode[k], k);
        assert_true(group->q[k] == 1e-6);
        vibration += 0.5e-12 * group->set->omega[k] * group->set->omega[k];
    }
    /* with the approach, v^2/(2 W) */
    const struct problem *problem = meshed.search->context.problem;
    double approach = 0.5 * problem->gap_rate[0] * problem->gap_rate[0] / problem->w[0];
    measured_relative("energy", attempt.outcome.energy.available, approach + vibration, 1e-12);
    free(ringing);
    meshed_free(&meshed);
}

/* A bar hit on its end gives way once, hit on its side it swings back. */
static void a_beam_s_mesh_comes_back(void **state)
{
    (void)state;
    struct meshed rod = meshed_create(&rod_kind), beam = meshed_create(&beam_kind);
    const struct solve_request on_end = search_on_rod("mesh", 1e-3), side = on_side(0.0);
    assert_false(refinement_expects_sequence(search_begin(rod.search, &on_end)->problem));
    assert_true(refinement_expects_sequence(search_begin(beam.search, &side)->problem));
    assert_false(refinement_expects_sequence(search_begin(beam.search, &on_end)->problem));
    meshed_free(&rod);
    meshed_free(&beam);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_bends_in_the_other_plane_stays_out),
        cmocka_unit_test(the_answer_does_not_notice),
        cmocka_unit_test(modes_that_vibrate_stay),
        cmocka_unit_test(a_beam_s_mesh_comes_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
