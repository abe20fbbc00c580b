/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The paper's round bars, 1 m long and 20 mm thick, as meshes: their frequencies against theories
 * of bars that are good to the figures allowed here. */
#include "model/beam.h"
#include "unit/reduce/solve_mesh.h"

static const double RADIUS = 0.01, LENGTH = 1.0;

/* Parabolas through a rim's nodes spaced by an angle a enclose a^4/30 less than the circle: a mesh
 * wider by half of that has the bar's area and second moments. `cells`: see solid_shape_cylinder.
 */
static void make_bar(const struct material *material, const size_t cells[3],
                     struct solid_mesh *mesh)
{
    double wider = 1.0 + pow(M_PI / 8.0 / (double)cells[0], 4.0) / 60.0;
    solid_shape_cylinder(ELEMENT_HEX20, (double[2]){wider * RADIUS, LENGTH}, cells, material, mesh);
}

/* The node in the middle of the end. */
static size_t end_node(const struct solid_mesh *mesh)
{
    for (size_t i = 0; i < mesh->set[0].count; i++) {
        const double *point = mesh->points[mesh->set[0].nodes[i]];
        if (hypot(point[1], point[2]) < 1e-9)
            return mesh->set[0].nodes[i];
    }
    fail();
    return 0;
}

/* Longitudinal modes against Rayleigh and Love: w = k c/sqrt(1 + nu^2 k^2 r^2/2), good to the
 * fourth power of k r nu; and of the mesh (k h)^4/1440. */
static void test_rod(void **state)
{
    (void)state;
    static const struct material dural = {"dural", 73e9, 0.33, 2770.0, INFINITY, 0.0};
    struct solid_mesh mesh;
    struct solved solved;
    make_bar(&dural, (size_t[3]){2, 1, 60}, &mesh);
    solve_mesh(&mesh, 0, 27000.0, 300, &solved);
    size_t node = end_node(&mesh), found = 0;
    double wave = M_PI / LENGTH, speed = sqrt(73e9 / 2770.0);
    for (size_t i = 0; i < solved.modes.count; i++) {
        const double *motion = solved.modes.shapes + i * solved.modes.n + 3 * node;
        /* a longitudinal mode moves the end by sqrt(2/m) */
        if (fabs(motion[0]) < 0.5 * sqrt(2.0 / solved.bulk.mass))
            continue;
        double k = wave * (double)++found, thick = 0.33 * k * RADIUS;
        double love = k * speed / sqrt(1.0 + 0.5 * thick * thick);
        /* measured: 1.8e-9 in the first, 1.6e-5 in the tenth */
        double allowed = 1e-8 + 2e-5 * pow(0.1 * (double)found, 4.0);
        measured_relative("longitudinal frequency", solved.modes.omega[i], love, allowed);
    }
    assert_int_equal(found, 10);
    solved_free(&solved);
    solid_mesh_free(&mesh);
}

static const struct material ALUMINIUM = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0};
enum { MODES = 40 };

/* Timoshenko's with a shear factor. */
static void timoshenko(double shear_factor, struct beam_mode *modes)
{
    double area = M_PI * RADIUS * RADIUS, second = 0.25 * area * RADIUS * RADIUS;
    struct beam_plane plane = {LENGTH,
                               ALUMINIUM.young * second,
                               shear_factor * material_shear_modulus(&ALUMINIUM) * area,
                               ALUMINIUM.density * area,
                               ALUMINIUM.density * second,
                               {SUPPORT_FREE, SUPPORT_FREE}};
    beam_modes(&plane, MODES, modes);
}

/* Bending modes of the mesh, two of each frequency, against Timoshenko with Hutchinson's factor. At
 * the end they move across by sqrt(4/m) at least. Returns how many; the last is `last`. */
static size_t compare_bending(const size_t cells[3], double hertz, size_t most, double allowed,
                              double *last)
{
    struct beam_mode theory[MODES];
    struct solid_mesh mesh;
    struct solved solved;
    size_t found = 0;
    timoshenko(beam_shear_hutchinson_circle(ALUMINIUM.poisson), theory);
    make_bar(&ALUMINIUM, cells, &mesh);
    solve_mesh(&mesh, 0, hertz, most, &solved);
    size_t node = end_node(&mesh);
    for (size_t i = 0; i < solved.modes.count; i++) {
        const double *motion = solved.modes.shapes + i * solved.modes.n + 3 * node;
        if (hypot(motion[1], motion[2]) < 0.5 * sqrt(2.0 / solved.bulk.mass))
            continue;
        assert_true(found / 2 < MODES);
        *last = solved.modes.omega[i];
        measured_relative("bending frequency", *last, theory[found++ / 2].omega, allowed);
    }
    solved_free(&solved);
    solid_mesh_free(&mesh);
    return found;
}

/* Three dimensions confirm Hutchinson's factor to 2e-5 in the first two modes. A quick mesh is
 * itself 4e-5 and 6e-5 too stiff; PERCUSS_FINE=1 takes a minute for one that is not. */
static void test_first_modes_of_the_beam(void **state)
{
    (void)state;
    bool fine = getenv("PERCUSS_FINE") != NULL;
    double last;
    size_t cells[3] = {fine ? 3 : 2, fine ? 2 : 1, fine ? 80 : 60};
    assert_int_equal(compare_bending(cells, INFINITY, 4, fine ? 2e-5 : 7e-5, &last), 4);
}

/* And to 1e-3 up to 29 kHz, where Cowper's is a hundredth off. The theory is 6e-4 too low there, as
 * 260 layers say and the dispersion of waves in a round bar (Pochhammer, Chree; 5.7e-4). A quick
 * mesh's coarse section is 4e-4 too stiff, and its 130 layers, eleven for the shortest wave, a few
 * 1e-4; PERCUSS_FINE=1 takes a minute and 1.7 GB for one that is not. */
static void test_beam_up_to_29_kilohertz(void **state)
{
    (void)state;
    bool fine = getenv("PERCUSS_FINE") != NULL;
    struct beam_mode cowper[MODES];
    double last;
    size_t cells[3] = {fine ? 2 : 1, fine ? 2 : 1, fine ? 200 : 130};
    size_t found = compare_bending(cells, fine ? 29500.0 : 29000.0, 200, fine ? 1e-3 : 2e-3, &last);
    assert_true(found >= 40 && found % 2 == 0);
    timoshenko(beam_shear_cowper_circle(ALUMINIUM.poisson), cowper);
    assert_true(cowper[found / 2 - 1].omega < 0.993 * last);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rod),
        cmocka_unit_test(test_first_modes_of_the_beam),
        cmocka_unit_test(test_beam_up_to_29_kilohertz),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
