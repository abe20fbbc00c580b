/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/modal_basis.c, loads along the surface: they work on the displacement
 * of the loaded point, their compliances are those of closed forms and complete the modal sums, on
 * any supports. */
#include <string.h>

#include "check.h"
#include "model/bar.h"
#include "model/bar_waves.h"
#include "model/modal_basis.h"
#include "model/rigid.h"
#include "model/vector.h"

enum { ROWS = 3 }; /* normal, along the axis, across it */

static const double X[3] = {1.0, 0.0, 0.0}, Y[3] = {0.0, 1.0, 0.0}, Z[3] = {0.0, 0.0, 1.0};

/* The paper's beam, or one of another section. */
static struct body bar(const struct body_kind *kind, double width, double height, double tip,
                       enum support left, enum support right)
{
    struct body body = {
        .id = "bar",
        .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0},
        .kind = kind,
        .radius = width > 0.0 ? 0.0 : 0.01,
        .width = width,
        .height = height,
        .length = 1.0,
        .tip_radius = tip,
        .shear_rule = kind == &beam_kind ? SHEAR_COWPER : SHEAR_ABSENT,
        .supports = {left, right},
    };
    assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
    return body;
}

static struct body plain_beam(enum support left, enum support right)
{
    return bar(&beam_kind, 0.0, 0.0, INFINITY, left, right);
}

static struct site place(enum site_face face, double x, double y, double z)
{
    return (struct site){.face = face, .point = {x, y, z}};
}

static void nothing_acts(const struct body *body, const struct site *site)
{
    for (int d = 0; d < 3; d++) {
        const double direction[3] = {d == 0, d == 1, d == 2};
        struct site_load load = site_load_make(body, site, direction, true);
        for (size_t f = 0; f < BODY_MOST_FAMILIES; f++)
            assert_false(load.family[f].acts);
    }
}

static void bodies_without_such_loads(void **state)
{
    (void)state;
    struct body ball = {.kind = &sphere_kind, .radius = 0.1};
    struct body wall = {.kind = &half_space_kind};
    struct body rod = bar(&rod_kind, 0.0, 0.0, INFINITY, SUPPORT_FREE, SUPPORT_FREE);
    struct body block = {.kind = &block_kind, .size = {0.1, 0.1, 0.1}};
    struct site site = place(SITE_ROUND, 0.0, 0.0, 0.1), end = place(SITE_END, 0.5, 0.0, 0.0);
    nothing_acts(&ball, &site);
    nothing_acts(&wall, &site);
    nothing_acts(&block, &site);
    /* a rod does not bend */
    for (int d = 1; d < 3; d++) {
        struct site_load load = site_load_make(&rod, &end, d == 1 ? Y : Z, true);
        for (size_t f = 0; f < BODY_MOST_FAMILIES; f++)
            assert_false(load.family[f].acts);
    }
}

static void parts_of_a_load(void **state)
{
    (void)state;
    struct body beam = plain_beam(SUPPORT_FREE, SUPPORT_FREE);
    struct site top = place(SITE_BEAM_SIDE, 0.2, 0.0, 0.01);
    struct site_load load = site_load_make(&beam, &top, X, true);
    const struct family_load *family = load.family;
    assert_true(family[BAR_LONGITUDINAL].acts && family[BAR_BENDING_Z].acts);
    assert_false(family[BAR_BENDING_Y].acts || family[BAR_TWIST].acts);
    near(family[BAR_LONGITUDINAL].bar.x, 0.2, 0.0);
    near(family[BAR_LONGITUDINAL].bar.force, 1.0, 0.0);
    near(family[BAR_BENDING_Z].bar.force, 0.0, 0.0);
    near(family[BAR_BENDING_Z].bar.moment, -0.01, 0.0);
    /* across: twist, and the other plane */
    load = site_load_make(&beam, &top, Y, true);
    assert_true(family[BAR_BENDING_Y].acts && family[BAR_TWIST].acts);
    assert_false(family[BAR_LONGITUDINAL].acts || family[BAR_BENDING_Z].acts);
    near(family[BAR_BENDING_Y].bar.force, 1.0, 0.0);
    near(family[BAR_TWIST].bar.moment, -0.01, 0.0);
    near(family[BAR_TWIST].bar.x, 0.2, 0.0);
    /* rounding of the pose drives nothing */
    load = site_load_make(&beam, &top, (double[]){1.0, 1e-10, 1e-10}, true);
    assert_false(family[BAR_BENDING_Y].acts || family[BAR_TWIST].acts);
    /* a normal force on the side drives neither waves along the axis nor twist */
    load = site_load_make(&beam, &top, (double[]){0.02, 0.02, 1.0}, false);
    assert_false(family[BAR_LONGITUDINAL].acts || family[BAR_TWIST].acts);
}

/* Displacement of a point of the body in mode k, from the theory of each family: the section under
 * the point moves by w and turns by psi, or turns about the axis, or moves along it. The section's
 * own deformation (beam_side_load) is left to the caller's choice of points. */
static void moved(const struct body *body, const struct modal_family *modes, size_t k, double at,
                  double end, const double point[3], double u[3])
{
    double w, psi, twist, lever = point[0] - at;
    memset(u, 0, 3 * sizeof *u);
    if (modes->family == BAR_LONGITUDINAL) {
        u[0] = cos((double)(k + 1) * M_PI * (end / body->span + 0.5)) * sqrt(2.0 / body->mass);
    } else if (modes->family == BAR_TWIST) {
        twist = torsion_shape(body, k, modes->omega[k], end);
        u[1] = -twist * point[2];
        u[2] = twist * point[1];
    } else {
        int plane = modes->family == BAR_BENDING_Z;
        struct beam_plane bent = beam_plane_of(body, plane);
        struct beam_mode mode =
            beam_mode_of(&bent, (const struct beam_unit_mode *)modes->shapes + k);
        beam_mode_at(&bent, &mode, at, &w, &psi);
        u[0] = -psi * point[1 + plane];
        u[1 + plane] = w + psi * lever;
    }
}

/* A participation is the work of the force on the displacement of its point: on flat ends and caps
 * of round, square and flat free beams in any direction, on sides along the axis. */
static void participations_are_displacements(void **state)
{
    (void)state;
    static const double sections[][3] = {{0.0, 0.0, INFINITY},
                                         {0.0, 0.0, 0.01},
                                         {0.0, 0.0, 0.03},
                                         {0.02, 0.02, INFINITY},
                                         {0.02, 0.01, INFINITY}};
    static const double t[][3] = {{0.6, 0.8, 0.0}, {0.0, -0.6, 0.8}, {0.48, -0.6, 0.64}};
    for (size_t s = 0; s < COUNT(sections); s++) {
        struct body beam = bar(&beam_kind, sections[s][0], sections[s][1], sections[s][2],
                               SUPPORT_FREE, SUPPORT_FREE);
        double tip = beam.tip_radius, y = 0.003, z = -0.004;
        double back = isfinite(tip) ? tip - sqrt(tip * tip - 25e-6) : 0.0;
        struct site end = place(SITE_END, 0.5 - back, y, z),
                    side = place(SITE_BEAM_SIDE, 0.31, y, z);
        for (size_t f = 0; f < beam.kind->family_count; f++) {
            struct modal_family *modes = modal_family_create(&beam, f, 12);
            assert_non_null(modes);
            for (size_t k = 0; k < 12; k++) {
                double u[3];
                moved(&beam, modes, k, bar_cap_section(&beam, &end), 0.5 * beam.span, end.point, u);
                for (size_t i = 0; i < COUNT(t); i++) {
                    struct site_load load = site_load_make(&beam, &end, t[i], true);
                    near(modal_participation(&beam, modes, k, &load.family[f]), dot3(u, t[i]),
                         1e-13 * (1.0 + fabs(u[0])));
                }
                struct site_load load = site_load_make(&beam, &side, X, true);
                moved(&beam, modes, k, 0.31, 0.31, side.point, u);
                double row = load.family[f].acts
                                 ? modal_participation(&beam, modes, k, &load.family[f])
                                 : 0.0;
                near(row, u[0], 1e-12);
            }
            modal_family_free(modes);
        }
    }
}

/* The sum over N modes and over 2N, the rest of which falls like 1/N: their limit. */
static double limit_of_sums(const struct body *body, size_t family, size_t count,
                            const struct family_load *i, const struct family_load *j)
{
    struct modal_family *modes = modal_family_create(body, family, 2 * count);
    double sum[2] = {0.0, 0.0};
    assert_non_null(modes);
    for (size_t k = 2 * count; k-- > 0;) {
        double a = modal_participation(body, modes, k, i),
               b = modal_participation(body, modes, k, j);
        double part = a * b / (modes->omega[k] * modes->omega[k]);
        sum[k >= count] += part;
    }
    modal_family_free(modes);
    return sum[0] + 2.0 * sum[1];
}

/* The rod in closed form: u_i due to a force at j, x from the left end or the held one. */
static void rods_on_their_sides(void **state)
{
    (void)state;
    static const enum support ends[][2] = {{SUPPORT_FREE, SUPPORT_FREE},
                                           {SUPPORT_CLAMPED, SUPPORT_FREE},
                                           {SUPPORT_FREE, SUPPORT_CLAMPED},
                                           {SUPPORT_CLAMPED, SUPPORT_CLAMPED}};
    static const double at[][2] = {
        {-0.19, -0.19}, {-0.19, 0.3}, {0.1, -0.5}, {0.5, 0.2}, {0.0, 0.0}};
    for (size_t s = 0; s < COUNT(ends); s++)
        for (size_t p = 0; p < COUNT(at); p++) {
            struct body rod = bar(&rod_kind, 0.0, 0.0, INFINITY, ends[s][0], ends[s][1]);
            double stiffness = 70e9 * M_PI * 1e-4;
            struct family_load i = {.acts = true, .bar = {.x = at[p][0], .force = 0.9}};
            struct family_load j = {.acts = true, .bar = {.x = at[p][1], .force = -0.7}};
            double low = fmin(at[p][0], at[p][1]) + 0.5, high = fmax(at[p][0], at[p][1]) + 0.5;
            double expected = s == 0   ? 1.0 / 3.0 - high + 0.5 * (low * low + high * high)
                              : s == 1 ? low
                              : s == 2 ? 1.0 - high
                                       : low * (1.0 - high);
            double value = modal_compliance(&rod, BAR_LONGITUDINAL, &i, &j);
            near(value, -0.63 * expected / stiffness, 1e-15 / stiffness);
            near(modal_compliance(&rod, BAR_LONGITUDINAL, &j, &i), value, 1e-15 / stiffness);
            near(limit_of_sums(&rod, BAR_LONGITUDINAL, 20000, &i, &j), value, 1e-5 / stiffness);
        }
}

/* The rows of a contact: along its normal and along two tangents. */
static void rows_of(const struct body *body, const struct site *site, double t[ROWS][3],
                    struct site_load loads[ROWS])
{
    loads[0] = site_load_make(body, site, t[0], false);
    for (int r = 1; r < ROWS; r++)
        loads[r] = site_load_make(body, site, t[r], true);
}

static double compliance_of(const struct body *body, const struct site_load *i,
                            const struct site_load *j)
{
    double sum = 0.0;
    for (size_t f = 0; f < body->kind->family_count; f++)
        sum += modal_compliance(body, f, &i->family[f], &j->family[f]);
    return sum;
}

/* Two sites on the side and on an end; the modal sums approach the compliances between all rows of
 * both, which are symmetric. */
static void compliances_complete_the_sums(void **state)
{
    (void)state;
    static const double sections[][3] = {
        {0.0, 0.0, INFINITY}, {0.0, 0.0, 0.012}, {0.02, 0.02, INFINITY}, {0.02, 0.01, INFINITY}};
    for (int s = 0; s < 9 * (int)COUNT(sections); s++) {
        const double *section = sections[s / 9];
        struct body beam = bar(&beam_kind, section[0], section[1], section[2],
                               (enum support)(s % 3), (enum support)(s % 9 / 3));
        double top = section[1] > 0.0 ? 0.5 * section[1] : 0.01;
        struct site sites[2] = {place(SITE_BEAM_SIDE, -0.19, 0.0, top),
                                place(SITE_BEAM_SIDE, 0.27, 0.0, -top)};
        double t[ROWS][3] = {{0.0, 0.0, 1.0}, {0.6, 0.8, 0.0}, {-0.8, 0.6, 0.0}};
        struct site_load loads[2][ROWS];
        rows_of(&beam, &sites[0], t, loads[0]);
        rows_of(&beam, &sites[1], t, loads[1]);
        for (int i = 0; i < ROWS; i++)
            for (int j = 0; j < ROWS; j++)
                for (int other = 0; other < 2; other++) {
                    const struct site_load *a = &loads[0][i], *b = &loads[other][j];
                    double value = compliance_of(&beam, a, b), limit = 0.0;
                    double scale = sqrt(compliance_of(&beam, a, a) * compliance_of(&beam, b, b));
                    near(compliance_of(&beam, b, a), value, 1e-13 * scale);
                    for (size_t f = 0; f < beam.kind->family_count; f++)
                        if (a->family[f].acts && b->family[f].acts)
                            limit += limit_of_sums(&beam, f, 300, &a->family[f], &b->family[f]);
                    near(limit, value, 2e-4 * scale);
                }
    }
}

/* The notes' numbers of the paper's beam at x/L = 0.31, Cowper's shear factor: force with
 * deflection 2.324630e-6 m/N, force with rotation 1.271251e-5 rad/N, moment with rotation
 * 2.034746e-4 rad/(N m), along the axis 5.430973e-9 m/N. */
static void compliances_of_the_notes(void **state)
{
    (void)state;
    struct body beam = plain_beam(SUPPORT_FREE, SUPPORT_FREE);
    double r = 0.01, x = 0.31 - 0.5,
           t[ROWS][3] = {{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    struct site top = place(SITE_BEAM_SIDE, x, 0.0, r);
    struct site_load loads[ROWS];
    rows_of(&beam, &top, t, loads);
    for (int i = 0; i < ROWS; i++)
        for (size_t f = 0; f < BODY_MOST_FAMILIES; f++)
            loads[i].family[f].bar.curvature = 0.0; /* the notes' sections are rigid */
    near(compliance_of(&beam, &loads[0], &loads[0]), 2.324630e-6, 6e-13);
    near(compliance_of(&beam, &loads[0], &loads[1]), -r * 1.271251e-5, r * 6e-12);
    near(compliance_of(&beam, &loads[1], &loads[1]), r * r * 2.034746e-4 + 5.430973e-9, 6e-15);
    /* across: bending as along the normal, and twist by the half of the moment of inertia: with
     * G J = G pi r^4/2 and s = x/L the rotation is L (1/3 - s + s^2)/(G J) */
    double twist = (1.0 / 3.0 - 0.31 + 0.31 * 0.31) / (70e9 / 2.66 * 0.5 * M_PI * 1e-8);
    near(compliance_of(&beam, &loads[2], &loads[2]), 2.324630e-6 + r * r * twist, 6e-13);
    near(compliance_of(&beam, &loads[0], &loads[2]), 0.0, 0.0);
    near(compliance_of(&beam, &loads[1], &loads[2]), 0.0, 0.0);
}

/* Held beams in closed form (Timoshenko's): the cantilever a^3/3EI + a/kGA, a^2/2EI, a/EI, along
 * a/EA, twist a/GJ; between pins a moment turns its section by (a^3 + b^3)/(3 L^2 EI) + 1/(L kGA)
 * and bends it by ab(b - a)/(3 L EI). */
static void held_beams_in_closed_form(void **state)
{
    (void)state;
    double r = 0.01, a = 0.31, b = 0.69;
    double t[ROWS][3] = {{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    struct site top = place(SITE_BEAM_SIDE, a - 0.5, 0.0, r);
    for (int pinned = 0; pinned < 2; pinned++) {
        struct body beam = pinned ? plain_beam(SUPPORT_PINNED, SUPPORT_PINNED)
                                  : plain_beam(SUPPORT_CLAMPED, SUPPORT_FREE);
        double area = M_PI * r * r, shear = 70e9 / 2.66, ei = 70e9 * 0.25 * area * r * r;
        double kga = beam.shear_factor[1] * shear * area, gj = shear * 0.5 * area * r * r;
        double ff =
            pinned ? a * a * b * b / (3.0 * ei) + a * b / kga : a * a * a / (3.0 * ei) + a / kga;
        double fm = pinned ? a * b * (b - a) / (3.0 * ei) : a * a / (2.0 * ei);
        double mm = pinned ? (a * a * a + b * b * b) / (3.0 * ei) + 1.0 / kga : a / ei;
        double along = pinned ? a * b : a;
        struct site_load loads[ROWS];
        rows_of(&beam, &top, t, loads);
        for (int i = 0; i < ROWS; i++)
            for (size_t f = 0; f < BODY_MOST_FAMILIES; f++)
                loads[i].family[f].bar.curvature = 0.0;
        near_relative(compliance_of(&beam, &loads[0], &loads[0]), ff, 1e-13);
        near_relative(compliance_of(&beam, &loads[0], &loads[1]), -r * fm, 1e-13);
        near_relative(compliance_of(&beam, &loads[1], &loads[1]),
                      r * r * mm + along / (70e9 * area), 1e-13);
        near_relative(compliance_of(&beam, &loads[2], &loads[2]), ff + r * r * along / gj, 1e-13);
        /* it moves by its vibration alone */
        for (int i = 0; i < ROWS; i++)
            for (int j = 0; j < ROWS; j++)
                near(rigid_inverse_mass(&beam, top.point, t[i], top.point, t[j]), 0.0, 0.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_without_such_loads),
        cmocka_unit_test(parts_of_a_load),
        cmocka_unit_test(participations_are_displacements),
        cmocka_unit_test(rods_on_their_sides),
        cmocka_unit_test(compliances_complete_the_sums),
        cmocka_unit_test(compliances_of_the_notes),
        cmocka_unit_test(held_beams_in_closed_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
