/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/beam_statics.c: closed forms, exact digits, and the modal sum, which the
 * compliance must complete. */
#include "unit/model/beam_cases.h"

/* 1 m, r 10 mm, 70 GPa, 0.33, 2700 kg/m^3, Cowper. */
static struct beam_plane aluminium_beam(enum support left, enum support right)
{
    double area = M_PI * 1e-4, second_moment = M_PI / 4.0 * 1e-8;
    double shear = beam_shear_cowper_circle(0.33) * 70e9 / 2.66 * area;

    return (struct beam_plane){1.0,           70e9 * second_moment,   shear,
                               2700.0 * area, 2700.0 * second_moment, {left, right}};
}

static double direct(const struct beam_plane *plane, double x)
{
    struct beam_load load = {.x = x, .force = 1.0};

    return beam_compliance(plane, &load, &load);
}

static void test_free_beam_of_the_contract(void **state)
{
    (void)state;
    struct beam_plane plane = aluminium_beam(SUPPORT_FREE, SUPPORT_FREE);
    double centre = 1.0 / (320.0 * plane.bending_stiffness) + 1.0 / (12.0 * plane.shear_stiffness);

    near(direct(&plane, 0.0), 5.695448e-6, 0.51e-12);
    near(direct(&plane, -0.19), 2.324630e-6, 0.51e-12);
    near(direct(&plane, 0.19), 2.324630e-6, 0.51e-12);
    near(direct(&plane, 0.5), 1.733983e-5, 0.51e-11);
    near(direct(&plane, -0.5), 1.733983e-5, 0.51e-11);
    near(direct(&plane, 0.0), centre, 4e-16 * centre);
}

/* Elementary cases of any textbook, with the shear's share. */
static void test_textbook_cases(void **state)
{
    (void)state;
    struct beam_plane plane = {2.0, 5.0, 7.0, 1.0, 0.1, {SUPPORT_CLAMPED, SUPPORT_FREE}};
    double bending = 8.0 / 5.0, shear = 2.0 / 7.0; /* L^3/EI, L/kGA */
    struct beam_load moment = {.x = 1.0, .moment = 1.0};

    near(direct(&plane, 1.0), bending / 3.0 + shear, 1e-15);
    near(beam_compliance(&plane, &moment, &moment), 2.0 / 5.0, 1e-15);
    plane.supports[0] = SUPPORT_PINNED;
    plane.supports[1] = SUPPORT_PINNED;
    near(direct(&plane, 0.0), bending / 48.0 + shear / 4.0, 1e-15);
    near(direct(&plane, -1.0), 0.0, 1e-30);
    plane.supports[0] = SUPPORT_CLAMPED;
    plane.supports[1] = SUPPORT_CLAMPED;
    near(direct(&plane, 0.0), bending / 192.0 + shear / 4.0, 1e-15);
    plane.shear_stiffness = INFINITY;
    plane.supports[1] = SUPPORT_PINNED;
    near(direct(&plane, 0.0), 7.0 * bending / 768.0, 1e-15);
}

/* Displacements by integrating the four equilibrium equations exactly, with the end conditions and
 * orthogonality to the rigid motions solved for (mpmath, 40 digits): of the load (-3/16; 1; 1/4) on
 * (1/4; -1/2; 1), and of (1/2; 1; 1/2) on itself. */
static void test_reference_digits(void **state)
{
    (void)state;
    static const struct {
        enum support supports[2];
        double mutual, end;
    } rows[] = {
        {{SUPPORT_FREE, SUPPORT_FREE}, -0.015594352480971351, 0.16704040803763795},
        {{SUPPORT_FREE, SUPPORT_PINNED}, -0.012234081659658045, 0.072852687521878879},
        {{SUPPORT_FREE, SUPPORT_CLAMPED}, -0.089611235119047619, 0.0},
        {{SUPPORT_PINNED, SUPPORT_FREE}, -0.039683615482148508, 0.24643467099470664},
        {{SUPPORT_PINNED, SUPPORT_PINNED}, -0.057658604213169643, 0.095238095238095238},
        {{SUPPORT_PINNED, SUPPORT_CLAMPED}, -0.025540229820069813, 0.0},
        {{SUPPORT_CLAMPED, SUPPORT_FREE}, 0.080551874069940476, 1.130952380952381},
        {{SUPPORT_CLAMPED, SUPPORT_PINNED}, -0.032374021552857899, 0.0859375},
        {{SUPPORT_CLAMPED, SUPPORT_CLAMPED}, -0.015806016467866443, 0.0},
    };
    const struct beam_load i = {.x = -0.1875, .force = 1.0, .moment = 0.25};
    const struct beam_load j = {.x = 0.25, .force = -0.5, .moment = 1.0};
    const struct beam_load end = {.x = 0.5, .force = 1.0, .moment = 0.5};

    for (size_t k = 0; k < COUNT(rows); k++) {
        struct beam_plane plane = supported(&stubby, rows[k].supports[0], rows[k].supports[1]);
        near(beam_compliance(&plane, &i, &j), rows[k].mutual, 2e-15 * fabs(rows[k].mutual));
        near(beam_compliance(&plane, &j, &i), rows[k].mutual, 2e-15 * fabs(rows[k].mutual));
        near(beam_compliance(&plane, &end, &end), rows[k].end, 2e-15 * rows[k].end + 1e-30);
    }
}

static void test_load_beside_a_clamp(void **state)
{
    (void)state;
    /* x = 0.499 from mpmath as above; the support takes nearly all of it */
    struct beam_plane plane = supported(&slim, SUPPORT_CLAMPED, SUPPORT_CLAMPED);

    near(direct(&plane, 0.499), 3.323343330000008e-10, 1e-12 * 3.3e-10);
    near(direct(&plane, -0.499), 3.323343330000008e-10, 1e-12 * 3.3e-10);
}

/* By the rotations at both ends of the window, which must be on the beam. */
static double work(const struct beam_plane *plane, const struct beam_mode *mode,
                   const struct beam_load *load)
{
    double w, psi, unused;
    double from = fmax(load->x - 0.5 * load->window, -0.5 * plane->length);
    double to = fmin(load->x + 0.5 * load->window, 0.5 * plane->length);

    beam_mode_at(plane, mode, load->x, &w, &psi);
    double sum = load->force * w + load->moment * psi;
    if (load->curvature != 0.0) {
        double first, last;
        beam_mode_at(plane, mode, from, &unused, &first);
        beam_mode_at(plane, mode, to, &unused, &last);
        sum += load->curvature * (last - first) / (to - from);
    }
    /* the mode's own way to it */
    near(beam_mode_on(plane, mode, load), sum, 1e-9 * (1.0 + fabs(sum)));
    return sum;
}

static double modal_sum(const struct beam_plane *plane, const struct beam_mode *modes, size_t count,
                        const struct beam_load *i, const struct beam_load *j)
{
    double sum = 0.0;

    for (size_t k = count; k-- > 0;)
        sum += work(plane, &modes[k], i) * work(plane, &modes[k], j) /
               (modes[k].omega * modes[k].omega);
    return sum;
}

/* (Absolute 1e-15: a pinned point moves by rounding times the rotation there.) The terms fall like
 * 1/k^2 at least (a force on a shear beam, a moment), so that the sums of n and 2n terms give the
 * limit but for the oscillation of the terms, which a short window makes slower. */
static void test_modal_sum_tends_to_it(void **state)
{
    (void)state;
    static const struct beam_load loads[] = {
        {.x = -0.19, .force = 1.0},
        {.x = 0.27, .force = -0.4, .moment = 1.0},
        {.x = 0.5, .force = 1.0},
        {.x = -0.5, .force = 1.0, .moment = 0.2},
        {.x = 0.1, .moment = 1.0},
        {.x = 0.0, .force = 1.0},
        {.x = 0.12, .force = 1.0, .curvature = 0.01, .window = 0.06},
        {.x = -0.48, .force = 0.5, .curvature = -0.02, .window = 0.1},
    };
    const size_t count = 1500;

    for (int c = 0; c < 18; c++) {
        struct beam_plane plane =
            supported(c < 9 ? &stubby : &slim, (enum support)(c / 3 % 3), (enum support)(c % 3));
        struct beam_mode *modes = solve(&plane, 2 * count);
        for (size_t i = 0; i < COUNT(loads); i++) {
            for (size_t j = 0; j <= i; j++) {
                double exact = beam_compliance(&plane, &loads[i], &loads[j]);
                double half = modal_sum(&plane, modes, count, &loads[i], &loads[j]);
                double full = modal_sum(&plane, modes, 2 * count, &loads[i], &loads[j]);
                double size = sqrt(beam_compliance(&plane, &loads[i], &loads[i]) *
                                   beam_compliance(&plane, &loads[j], &loads[j]));
                bool bends = loads[i].curvature != 0.0 || loads[j].curvature != 0.0;
                near(2.0 * full - half, exact, (bends ? 2e-4 : 1e-5) * size + 1e-15);
            }
        }
        free(modes);
    }
}

/* What it is for: the small difference to the sum of some modes is that of all others. */
static void test_residual_flexibility_of_a_truncated_basis(void **state)
{
    (void)state;
    static const double sites[] = {0.0, -0.19, 0.5};
    struct beam_plane plane = aluminium_beam(SUPPORT_FREE, SUPPORT_FREE);
    const size_t kept = 60, many = 20000;
    struct beam_mode *modes = solve(&plane, 2 * many);

    for (size_t i = 0; i < COUNT(sites); i++) {
        struct beam_load load = {.x = sites[i], .force = 1.0};
        double exact = beam_compliance(&plane, &load, &load);
        double residual = exact - modal_sum(&plane, modes, kept, &load, &load);
        double half = modal_sum(&plane, modes + kept, many - kept, &load, &load);
        double full = modal_sum(&plane, modes + kept, 2 * many - kept, &load, &load);
        assert_true(residual > 0.0 && residual < 0.01 * exact);
        near(2.0 * full - half, residual, 1e-6 * residual);
    }
    free(modes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_free_beam_of_the_contract),
        cmocka_unit_test(test_textbook_cases),
        cmocka_unit_test(test_reference_digits),
        cmocka_unit_test(test_load_beside_a_clamp),
        cmocka_unit_test(test_modal_sum_tends_to_it),
        cmocka_unit_test(test_residual_flexibility_of_a_truncated_basis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
