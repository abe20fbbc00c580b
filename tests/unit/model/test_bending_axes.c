/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/bending_axes.c: a load across a round beam excites one family alone
 * after the turn, with the same compliance, and turning back is the inverse. */
#include "check.h"
#include "model/bar.h"
#include "model/bending_axes.h"

static struct body beam(double width, double height)
{
    struct body body = {
        .id = "beam",
        .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0},
        .kind = &beam_kind,
        .radius = width > 0.0 ? 0.0 : 0.01,
        .width = width,
        .height = height,
        .length = 1.0,
        .tip_radius = INFINITY,
        .shear_rule = SHEAR_COWPER, /* a flat one's vibration is a block's else */
    };
    assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
    return body;
}

static struct site_load blow(const struct body *body, double angle)
{
    const struct site site = {.face = SITE_BEAM_SIDE, .point = {0.1, 0.0, 0.0}};
    return site_load_make(body, &site, (double[]){0.0, sin(angle), cos(angle)}, false);
}

static double compliance(const struct body *body, const struct site_load *load)
{
    double sum = 0.0;
    for (size_t f = 0; f < body->kind->family_count; f++)
        sum += modal_compliance(body, f, &load->family[f], &load->family[f]);
    return sum;
}

static void one_plane_does_for_a_round_section(void **state)
{
    (void)state;
    struct body round = beam(0.0, 0.0);
    for (double angle = -3.0; angle < 3.1; angle += 0.37) {
        struct site_load load = blow(&round, angle);
        double before = compliance(&round, &load);
        struct bending_axes axes;
        assert_true(bending_axes_choose(&round, &load, &axes));
        bending_axes_turn_load(&round, &axes, &load);
        assert_false(load.family[BAR_BENDING_Y].acts);
        near(fabs(load.family[BAR_BENDING_Z].bar.force), 1.0, 1e-15);
        near(compliance(&round, &load), before, 1e-15 * before);
    }
    assert_int_equal(bending_axes_common_family(&round, BAR_BENDING_Z), BAR_BENDING_Y);
    assert_int_equal(bending_axes_common_family(&round, BAR_TWIST), BAR_TWIST);
}

/* A contact at any place around the section, with tangents along the axis, across it, and aslant:
 * axes by its normal load. Compliances between all rows stay; a force along the axis bends in the
 * normal's plane, one across it in the other. */
static void tangential_loads_turn_with_the_normal(void **state)
{
    (void)state;
    enum { ROWS = 4 };
    struct body round = beam(0.0, 0.0), square = beam(0.02, 0.02);
    for (double angle = -3.0; angle < 3.1; angle += 0.37) {
        const struct body *body = angle > 0.0 ? &round : &square;
        double s = sin(angle), c = cos(angle);
        const struct site site = {.face = SITE_BEAM_SIDE, .point = {-0.19, 0.01 * s, 0.01 * c}};
        const double t[ROWS][3] = {
            {0.0, s, c}, {1.0, 0.0, 0.0}, {0.0, c, -s}, {0.8, 0.6 * c, -0.6 * s}};
        struct site_load loads[ROWS], turned[ROWS];
        struct bending_axes axes;
        for (int i = 0; i < ROWS; i++)
            turned[i] = loads[i] = site_load_make(body, &site, t[i], i > 0);
        assert_true(bending_axes_choose(body, &loads[0], &axes));
        for (int i = 0; i < ROWS; i++)
            bending_axes_turn_load(body, &axes, &turned[i]);
        assert_false(turned[0].family[BAR_BENDING_Y].acts || turned[1].family[BAR_BENDING_Y].acts);
        assert_true(turned[1].family[BAR_BENDING_Z].acts && turned[2].family[BAR_BENDING_Y].acts);
        assert_false(turned[2].family[BAR_BENDING_Z].acts);
        near(fabs(turned[1].family[BAR_BENDING_Z].bar.moment), 0.01, 1e-16);
        near(fabs(turned[2].family[BAR_TWIST].bar.moment), 0.01, 1e-16);
        for (int i = 0; i < ROWS; i++)
            for (int j = 0; j < ROWS; j++) {
                double before = 0.0, after = 0.0;
                for (size_t f = 0; f < body->kind->family_count; f++) {
                    before += modal_compliance(body, f, &loads[i].family[f], &loads[j].family[f]);
                    after += modal_compliance(body, f, &turned[i].family[f], &turned[j].family[f]);
                }
                near(after, before, 1e-14 * compliance(body, &loads[0]));
            }
    }
}

static void unlike_planes_stay(void **state)
{
    (void)state;
    struct body flat = beam(0.04, 0.01), square = beam(0.02, 0.02), rod = beam(0.0, 0.0);
    rod.kind = &rod_kind;
    struct site_load load = blow(&flat, 0.5);
    struct bending_axes axes;
    assert_false(bending_axes_choose(&flat, &load, &axes));
    assert_true(axes.cosine == 1.0 && axes.sine == 0.0);
    assert_false(bending_axes_choose(&rod, &load, &axes));
    assert_int_equal(bending_axes_common_family(&flat, BAR_BENDING_Z), BAR_BENDING_Z);
    assert_true(bending_axes_choose(&square, &load, &axes) && axes.sine != 0.0);
    /* rounding of the pose turns nothing */
    load = blow(&square, 1e-10);
    assert_true(bending_axes_choose(&square, &load, &axes) && axes.sine == 0.0);
}

static void coordinates_turn_there_and_back(void **state)
{
    (void)state;
    const struct bending_axes there = {BAR_BENDING_Y, 0.6, 0.8}, back = {BAR_BENDING_Y, 0.6, -0.8};
    double y[] = {1.0, 0.0, -2.5}, z[] = {0.0, 1.0, 4.0};
    bending_axes_turn(&there, 3, y, z);
    near(y[1], -0.8, 0.0);
    near(z[0], 0.8, 0.0);
    bending_axes_turn(&back, 3, y, z);
    near(y[2], -2.5, 1e-15);
    near(z[2], 4.0, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_plane_does_for_a_round_section),
        cmocka_unit_test(tangential_loads_turn_with_the_normal),
        cmocka_unit_test(unlike_planes_stay),
        cmocka_unit_test(coordinates_turn_there_and_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
