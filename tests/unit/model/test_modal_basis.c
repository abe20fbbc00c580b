/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/modal_basis.c and bar_waves.c: which families a load
 * drives, frequencies and participations of rods in closed form, and compliances that the modal
 * sums approach. */
#include "check.h"
#include "model/bar.h"

static struct body bar(const struct body_kind *kind, enum support left, enum support right)
{
    struct body body = {
        .id = "bar",
        .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0},
        .kind = kind,
        .radius = 0.01,
        .length = 1.0,
        .tip_radius = INFINITY,
        .supports = {left, right},
    };
    assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
    return body;
}

static struct site site(enum site_face face, double x, double y, double z)
{
    return (struct site){.face = face, .point = {x, y, z}};
}

static void loads_drive_what_they_should(void **state)
{
    (void)state;
    const struct body rod = bar(&rod_kind, SUPPORT_FREE, SUPPORT_FREE);
    const struct body beam = bar(&beam_kind, SUPPORT_FREE, SUPPORT_FREE);
    const struct body ball = {.kind = &sphere_kind, .radius = 1.0};
    struct site end = site(SITE_END, 0.5, 0.0, 0.0), side = site(SITE_BEAM_SIDE, 0.2, 0.0, 0.01);
    struct site beside = site(SITE_END, -0.5, 0.003, 0.0);
    const double along[3] = {-1.0, 0.0, 0.0}, down[3] = {0.0, 0.0, -1.0};
    struct site_load load = site_load_make(&rod, &end, along, false);
    assert_true(load.family[BAR_LONGITUDINAL].acts && !load.family[BAR_BENDING_Y].acts);
    assert_true(load.family[BAR_LONGITUDINAL].bar.force == -1.0);
    assert_true(load.family[BAR_LONGITUDINAL].bar.x == 0.5);
    load = site_load_make(&beam, &side, down, false);
    assert_true(!load.family[BAR_LONGITUDINAL].acts && !load.family[BAR_BENDING_Y].acts);
    assert_true(load.family[BAR_BENDING_Z].acts);
    near(load.family[BAR_BENDING_Z].bar.x, 0.2, 0.0);
    near(load.family[BAR_BENDING_Z].bar.force, -1.0, 0.0);
    near(load.family[BAR_BENDING_Z].bar.moment, 0.0, 0.0);
    /* beside the axis a hit on the end bends too: psi moves a point at y by -y psi */
    load = site_load_make(&beam, &beside, (double[]){1.0, 0.0, 0.0}, false);
    assert_true(load.family[BAR_LONGITUDINAL].acts && load.family[BAR_BENDING_Y].acts);
    assert_false(load.family[BAR_BENDING_Z].acts);
    near(load.family[BAR_BENDING_Y].bar.moment, -0.003, 0.0);
    near(load.family[BAR_BENDING_Y].bar.x, -0.5, 0.0);
    assert_true(load.family[BAR_LONGITUDINAL].bar.x == -0.5);
    /* rounding of the pose drives nothing */
    load = site_load_make(&beam, &side, (double[]){1e-10, 1e-10, 1.0}, false);
    assert_true(!load.family[BAR_LONGITUDINAL].acts && !load.family[BAR_BENDING_Y].acts);
    load = site_load_make(&ball, &end, along, false);
    for (size_t f = 0; f < BODY_MOST_FAMILIES; f++)
        assert_false(load.family[f].acts);
}

/* omega_k = k pi c/L and sqrt(2/M), signs (-1)^k at the far end; held at one end (k - 1/2). */
static void rods_have_closed_forms(void **state)
{
    (void)state;
    double c = sqrt(70e9 / 2700.0);
    for (int held = 0; held < 2; held++) {
        struct body rod = bar(&rod_kind, held ? SUPPORT_CLAMPED : SUPPORT_FREE, SUPPORT_FREE);
        struct modal_family *modes = modal_family_create(&rod, BAR_LONGITUDINAL, 50);
        struct family_load right = {.acts = true, .bar = {.x = 0.5, .force = 1.0}};
        struct family_load left = {.acts = true, .bar = {.x = -0.5, .force = 1.0}};
        assert_non_null(modes);
        for (size_t k = 0; k < 50; k++) {
            double number = (double)k + (held ? 0.5 : 1.0);
            near(modes->omega[k], number * M_PI * c, 1e-15 * modes->omega[k]);
            double at_right = modal_participation(&rod, modes, k, &right);
            near(fabs(at_right), sqrt(2.0 / rod.mass), 1e-15);
            if (!held) {
                /* even modes move both ends alike */
                double at_left = modal_participation(&rod, modes, k, &left);
                near(at_left, k % 2 ? at_right : -at_right, 1e-15);
            }
        }
        modal_family_free(modes);
    }
    modal_family_free(NULL);
}

/* Rayleigh-Love: omega/sqrt(1 + (nu k r_p)^2), r_p^2 = r^2/2. */
static void lateral_inertia_slows_waves(void **state)
{
    (void)state;
    struct body rod = bar(&rod_kind, SUPPORT_FREE, SUPPORT_FREE);
    rod.lateral_inertia = true;
    struct modal_family *modes = modal_family_create(&rod, BAR_LONGITUDINAL, 200);
    assert_non_null(modes);
    double c = sqrt(70e9 / 2700.0);
    for (size_t k = 0; k < 200; k++) {
        double wave = (double)(k + 1) * M_PI;
        double share = 0.33 * 0.33 * wave * wave * 0.5e-4;
        near(modes->omega[k], wave * c / sqrt(1.0 + share), 1e-13 * wave * c);
        struct family_load load = {.acts = true, .bar = {.x = 0.5, .force = 1.0}};
        double phi = modal_participation(&rod, modes, k, &load);
        near(phi * phi, 2.0 / (rod.mass * (1.0 + share)), 1e-13 / rod.mass);
    }
    modal_family_free(modes);
}

/* Sum of phi_i phi_j/omega^2 over N modes; the rest falls like 1/N. */
static double modal_sum(const struct body *body, size_t family, size_t count,
                        const struct family_load *i, const struct family_load *j)
{
    struct modal_family *modes = modal_family_create(body, family, count);
    double sum = 0.0;
    assert_non_null(modes);
    for (size_t k = count; k-- > 0;)
        sum += modal_participation(body, modes, k, i) * modal_participation(body, modes, k, j) /
               (modes->omega[k] * modes->omega[k]);
    modal_family_free(modes);
    return sum;
}

static void compliances_complete_the_modal_sums(void **state)
{
    (void)state;
    static const enum support ends[][2] = {{SUPPORT_FREE, SUPPORT_FREE},
                                           {SUPPORT_CLAMPED, SUPPORT_FREE},
                                           {SUPPORT_FREE, SUPPORT_CLAMPED}};
    for (int s = 0; s < 3; s++) {
        for (int love = 0; love < 2; love++) {
            struct body rod = bar(&rod_kind, ends[s][0], ends[s][1]);
            rod.lateral_inertia = love;
            double end = ends[s][1] == SUPPORT_FREE ? 0.5 : -0.5;
            struct family_load i = {.acts = true, .bar = {.x = end, .force = 0.9}};
            struct family_load j = {.acts = true, .bar = {.x = end, .force = -0.7}};
            double exact = modal_compliance(&rod, BAR_LONGITUDINAL, &i, &j);
            /* the terms left out: 2 L/(EA pi^2) sum 1/k^2 = 1/N of it */
            near(modal_sum(&rod, BAR_LONGITUDINAL, 4000, &i, &j), exact, 3e-4 * fabs(exact));
            if (s == 0) {
                j.bar.x = -end;
                /* alternating terms: 1/N^2 */
                exact = modal_compliance(&rod, BAR_LONGITUDINAL, &i, &j);
                near(modal_sum(&rod, BAR_LONGITUDINAL, 4000, &i, &j), exact, 1e-6 * fabs(exact));
            }
        }
    }
}

/* The notes' compliances of the paper's beam at two sites, with Cowper's shear factor, and the
 * rod's L/(3EA). */
static void compliances_of_the_notes(void **state)
{
    (void)state;
    static const double rows[][2] = {{0.0, 5.695448e-6}, {0.31 - 0.5, 2.324630e-6}};
    struct body beam = bar(&beam_kind, SUPPORT_FREE, SUPPORT_FREE);
    const struct body rod = bar(&rod_kind, SUPPORT_FREE, SUPPORT_FREE);
    beam.shear_rule = SHEAR_COWPER;
    assert_int_equal(body_complete(&beam, NULL), PERCUSS_OK);
    for (int i = 0; i < 2; i++) {
        struct family_load load = {.acts = true, .bar = {.x = rows[i][0], .force = 1.0}};
        near(modal_compliance(&beam, BAR_BENDING_Z, &load, &load), rows[i][1], 6e-13);
        load.acts = false;
        near(modal_compliance(&beam, BAR_BENDING_Z, &load, &load), 0.0, 0.0);
    }
    struct family_load end = {.acts = true, .bar = {.x = 0.5, .force = 1.0}};
    near(modal_compliance(&rod, BAR_LONGITUDINAL, &end, &end), 1.0 / (3.0 * 70e9 * M_PI * 1e-4),
         1e-20);
}

/* Rectangular sections bend in two different planes; even and odd shapes are told apart. */
static void planes_and_parities(void **state)
{
    (void)state;
    struct body flat = bar(&beam_kind, SUPPORT_FREE, SUPPORT_FREE);
    flat.radius = 0.0;
    flat.width = 0.04;
    flat.height = 0.01;
    flat.shear_rule = SHEAR_COWPER; /* else its vibration is a block's */
    assert_int_equal(body_complete(&flat, NULL), PERCUSS_OK);
    struct modal_family *wide = modal_family_create(&flat, BAR_BENDING_Y, 6);
    struct modal_family *thin = modal_family_create(&flat, BAR_BENDING_Z, 6);
    assert_true(wide && thin);
    /* Euler-Bernoulli's ratio of 4, less a few percent of shear in the stiffer plane */
    near(wide->omega[0] / thin->omega[0], 4.0, 0.05);
    struct family_load centre = {.acts = true, .bar = {.force = 1.0}};
    for (size_t k = 0; k < 6; k++) {
        assert_int_equal(thin->odd[k], k % 2);
        double phi = modal_participation(&flat, thin, k, &centre);
        if (k % 2)
            assert_true(phi == 0.0);
        else
            assert_true(fabs(phi) > 0.1);
    }
    struct beam_plane plane = beam_plane_of(&flat, 0);
    near(plane.bending_stiffness, 70e9 * 0.01 * 0.04 * 0.04 * 0.04 / 12.0, 1e-6);
    near(plane.line_mass, 2700.0 * 4e-4, 1e-15);
    modal_family_free(wide);
    modal_family_free(thin);
    flat.supports[0] = SUPPORT_PINNED;
    thin = modal_family_create(&flat, BAR_BENDING_Z, 6);
    assert_non_null(thin);
    for (size_t k = 0; k < 6; k++)
        assert_int_equal(thin->odd[k], 0); /* no symmetry, no parity */
    modal_family_free(thin);
}

/* By parts and at once: the same bits, whatever the supports. */
static void families_grow(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 8, 9, 40};
    const struct family_load load = {.acts = true, .bar = {.x = 0.3, .force = 1.0, .moment = 0.2}};
    for (int i = 0; i < 9; i++) {
        struct body beam = bar(&beam_kind, (enum support)(i / 3), (enum support)(i % 3));
        for (size_t f = 0; f < beam.kind->family_count; f++) {
            struct modal_family *all = modal_family_create(&beam, f, counts[3]);
            struct modal_family *some = modal_family_create(&beam, f, counts[0]);
            assert_true(all && some);
            for (int n = 1; n < 4; n++) {
                struct modal_family *more = modal_family_grow(&beam, some, counts[n]);
                assert_non_null(more);
                assert_int_equal(more->count, counts[n]);
                modal_family_free(some);
                some = more;
            }
            for (size_t k = 0; k < counts[3]; k++) {
                assert_true(some->omega[k] == all->omega[k] && some->odd[k] == all->odd[k]);
                assert_true(modal_participation(&beam, some, k, &load) ==
                            modal_participation(&beam, all, k, &load));
            }
            modal_family_free(some);
            modal_family_free(all);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loads_drive_what_they_should),
        cmocka_unit_test(rods_have_closed_forms),
        cmocka_unit_test(lateral_inertia_slows_waves),
        cmocka_unit_test(compliances_complete_the_modal_sums),
        cmocka_unit_test(compliances_of_the_notes),
        cmocka_unit_test(planes_and_parities),
        cmocka_unit_test(families_grow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
