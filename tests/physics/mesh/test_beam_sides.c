/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/beam_statics.c: how a bent bar's side moves in its modes, and how it gives way
 * to a force, against meshes of the bars. */
#include "physics/mesh/side_local.h"
#include "unit/reduce/solve_mesh.h"

/* On the axis and beside it, along the bar, of sections that are round (0), high, square and wide;
 * the fit and a mesh of four elements on the depth leave 0.03 each on the axis. */
static void static_compliance(void **state)
{
    (void)state;
    static const struct {
        double ratio, poisson, slenderness;
        size_t cells[3];
    } bars[] = {
        {0.0, 0.33, 10.0, {41, 2, 2}}, {0.0, 0.1, 10.0, {41, 2, 2}}, {0.5, 0.3, 10.0, {30, 3, 4}},
        {1.0, 0.33, 10.0, {31, 4, 3}}, {1.0, 0.0, 16.0, {41, 4, 3}}, {2.0, 0.4, 12.0, {31, 6, 3}},
    };
    static const struct {
        double along, aside, allowed;
    } places[] = {{0.0, 0.0, 0.05}, {0.3, 0.0, 0.05}, {0.0, 0.4, 0.08}, {-0.2, 0.7, 0.12}};
    for (size_t i = 0; i < COUNT(bars); i++) {
        bool is_round = bars[i].ratio == 0.0;
        struct side_solution side = {
            .bar = side_bar(bars[i].ratio, bars[i].poisson, bars[i].slenderness),
            .count = is_round ? 1 : COUNT(places)};
        for (size_t k = 0; k < side.count; k++) {
            side.along[k] = places[k].along;
            side.aside[k] = places[k].aside;
        }
        side_solve(&side, bars[i].cells);
        for (size_t k = 0; k < side.count; k++)
            measured("E h C of a side", side.fitted[k], side.local[k], places[k].allowed);
    }
}

/* Displacement of a node across, of the shapes of two modes of one frequency together. */
static double across(const struct solved *solved, size_t mode, size_t node, bool twin)
{
    double one = solved->modes.shapes[mode * solved->modes.n + 3 * node + 2];
    double other = twin ? solved->modes.shapes[(mode + 1) * solved->modes.n + 3 * node + 2] : 0.0;
    return hypot(one, other);
}

static size_t node_at(const struct solid_mesh *mesh, double x, double y, double z)
{
    size_t best = 0;
    double least = INFINITY;
    for (size_t i = 0; i < mesh->node_count; i++) {
        const double *p = mesh->points[i];
        double off = hypot(hypot(p[0] - x, p[1] - y), p[2] - z);
        best = off < least ? i : best;
        least = fmin(off, least);
    }
    return best;
}

/* The even modes of bending across the depth, each once: how their middle's top moves on the mesh
 * and by beam_side_load. */
static void compare_tops(double ratio, double aside, size_t most, double allowed)
{
    struct solid_mesh mesh;
    struct solved solved;
    struct beam_mode theory[8];
    struct body bar = side_bar(ratio, 0.33, 10.0);
    struct beam_plane plane = beam_plane_of(&bar, 1);
    const size_t cells[3] = {30, 4, 4};
    double y = 0.5 * aside * bar.width, top = 0.5 * bar.height;
    size_t found = 0;
    beam_modes(&plane, 8, theory);
    side_mesh(&bar, cells, &mesh);
    solve_mesh(&mesh, 0, INFINITY, 24, &solved);
    size_t node = node_at(&mesh, 0.5 * bar.length, 0.5 * bar.width + y, bar.height);
    double x = mesh.points[node][0] - 0.5 * bar.length;
    struct site site = {.face = SITE_BEAM_SIDE, .point = {x, y, top}, .outward = {0.0, 0.0, 1.0}};
    struct beam_load load = beam_side_load(&bar, 1, site.point, site.outward);
    load.x = x;
    load.force = 1.0;
    for (size_t i = 0; i + 1 < solved.modes.count && found < most; i++) {
        /* twins where all planes are alike */
        const struct beam_mode *mode = &theory[2 * found];
        double expected = fabs(beam_mode_on(&plane, mode, &load));
        if (fabs(solved.modes.omega[i] / mode->omega - 1.0) > 0.01)
            continue;
        double moved = across(&solved, i, node, ratio == 1.0);
        /* not another family's mode of that frequency */
        if (moved < 0.5 * expected)
            continue;
        measured_relative("top of a mode", expected, moved, allowed);
        found++;
        i += ratio == 1.0;
    }
    assert_int_equal(found, most);
    solved_free(&solved);
    solid_mesh_free(&mesh);
}

/* Sections that stay plane figures would move 1.2, 4, 7.5 and 10.5 % more than the mesh's first
 * four symmetric modes, on the axis of a square. */
static void modes(void **state)
{
    (void)state;
    compare_tops(1.0, 0.0, 4, 0.008);
    compare_tops(1.0, 0.5, 3, 0.012);
    compare_tops(0.6, 0.0, 3, 0.008);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(static_compliance),
                                       cmocka_unit_test(modes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
