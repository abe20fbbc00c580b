/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/region.c, solid.c and active_set.c: Hertz, yield onset,
 * Jackson-Green, the dent that stays, energy, stepping. */
#include <string.h>

#include "check.h"
#include "fe/region.h"

static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
static const struct material al_205 = {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0};
static const struct material rubber = {"rubber", 1e9, 0.499, 1000.0, INFINITY, 0.0};

static struct region *make(const struct material *a, const struct material *b, double radius,
                           double indentation, size_t resolution)
{
    struct region_input input = {{*a, *b}, radius, indentation, resolution, 0.0};
    struct region *region;
    struct fault fault;
    if (region_create(&input, &region, &fault) != PERCUSS_OK)
        fail_msg("%s", fault.text);
    return region;
}

static struct region_answer press(struct region *region, double indentation)
{
    struct region_answer answer;
    struct fault fault;
    if (region_press(region, indentation, &answer, &fault) != PERCUSS_OK)
        fail_msg("%s", fault.text);
    return answer;
}

static struct region_answer load(struct region *region, double force)
{
    struct region_answer answer;
    struct fault fault;
    if (region_load(region, force, &answer, &fault) != PERCUSS_OK)
        fail_msg("%s", fault.text);
    return answer;
}

static struct region_answer edge(struct region *region, size_t node)
{
    struct region_answer answer;
    struct fault fault;
    if (region_edge(region, node, &answer, &fault) != PERCUSS_OK)
        fail_msg("%s", fault.text);
    return answer;
}

static double effective(const struct material *a, const struct material *b)
{
    return 1.0 / ((1.0 - a->poisson * a->poisson) / a->young +
                  (1.0 - b->poisson * b->poisson) / b->young);
}

/* Elastic pairs follow Hertz; an almost incompressible one too, so nothing locks. Nodes that come
 * into contact one by one leave a ripple of 0.3 % at 12 elements along the core; at equal phases of
 * it, with the contact well outside the core, 0.05 % remain. */
static void elastic_pairs_are_hertz(void **state)
{
    (void)state;
    const struct material elastic = {"al", 70e9, 0.33, 2700.0, INFINITY, 0.0};
    const struct material *pairs[][2] = {
        {&steel, &elastic}, {&elastic, &elastic}, {&rubber, &steel}};
    for (size_t i = 0; i < 3; i++) {
        struct region *region = make(pairs[i][0], pairs[i][1], 0.0075, 1e-5, 12);
        double k = 4.0 / 3.0 * effective(pairs[i][0], pairs[i][1]) * sqrt(0.0075);
        for (double d = 2.5e-6; d <= 1e-5; d *= 1.1) {
            struct region_answer a = press(region, d);
            assert_true(fabs(a.force / (k * pow(d, 1.5)) - 1.0) < 4e-3);
            assert_true(fabs(a.radius / sqrt(0.0075 * d) - 1.0) < 0.06);
        }
        for (size_t node = 15; node < 20; node++) {
            struct region_answer a = edge(region, node);
            assert_true(fabs(a.force / (k * pow(a.indentation, 1.5)) - 1.0) < 5e-4);
        }
        region_destroy(region);
    }
}

/* twice the resolution, a quarter of the error or less */
static void converges(void **state)
{
    (void)state;
    const struct material elastic = {"al", 70e9, 0.33, 2700.0, INFINITY, 0.0};
    double error[2];
    for (size_t i = 0; i < 2; i++) {
        struct region *region = make(&steel, &elastic, 0.015, 2e-5, i ? 16 : 8);
        double k = 4.0 / 3.0 * effective(&steel, &elastic) * sqrt(0.015);
        error[i] = 0.0;
        for (double d = 1e-5; d <= 2e-5; d *= 1.01)
            error[i] = fmax(error[i], fabs(press(region, d).force / (k * pow(d, 1.5)) - 1.0));
        region_destroy(region);
    }
    assert_true(error[0] < 8e-3);
    assert_true(error[1] < 0.35 * error[0]);
}

/* lengths scale with the radius, forces with its square, to the last digits */
static void scales_with_the_radius(void **state)
{
    (void)state;
    struct region *small = make(&steel, &al_205, 0.004, 4e-6, 8);
    struct region *large = make(&steel, &al_205, 0.04, 4e-5, 8);
    for (int i = 1; i <= 4; i++) {
        double a = press(small, i * 1e-6).force, b = press(large, i * 1e-5).force;
        region_commit(small);
        region_commit(large);
        assert_true(fabs(b / a / 100.0 - 1.0) < 1e-7);
    }
    region_destroy(small);
    region_destroy(large);
}

static double flow(const struct region *region)
{
    struct region_ledger ledger;
    region_ledger(region, &ledger);
    assert_true(ledger.flow[0] == 0.0);
    return ledger.flow[1];
}

/* Flow begins at Jackson and Green's critical indentation, C = 1.295 exp(0.736 nu) = 1.651, which
 * is p0 = 1.65 yield; between Gauss points the peak is missed by a few per cent. */
static void yields_where_theory_says(void **state)
{
    (void)state;
    struct region *region = make(&steel, &al_205, 0.015, 4e-6, 16);
    double c = 1.295 * exp(0.736 * 0.33), modulus = effective(&steel, &al_205);
    double critical = pow(0.5 * M_PI * c * 205e6 / modulus, 2.0) * 0.015;
    press(region, 0.97 * critical);
    assert_true(flow(region) == 0.0);
    press(region, 1.08 * critical);
    assert_true(flow(region) > 0.0);
    region_destroy(region);
}

static double jackson_green(double d)
{
    double e = effective(&steel, &al_205), s = 205e6, r = 0.015;
    double c = 1.295 * exp(0.736 * 0.33), w = d / (pow(0.5 * M_PI * c * s / e, 2.0) * r);
    double f = 4.0 / 3.0 * pow(r / e, 2.0) * pow(0.5 * M_PI * c * s, 3.0);
    double a = sqrt(r * d * pow(w / 1.9, 0.14 * exp(23.0 * s / e)));
    double h = 2.84 * (1.0 - exp(-0.82 * pow(a / r, -0.7)));
    return f * (exp(-0.25 * pow(w, 5.0 / 12.0)) * pow(w, 1.5) +
                4.0 * h / c * (1.0 - exp(-0.04 * pow(w, 5.0 / 9.0))) * w);
}

/* Their fit to their own FE results is within 2 % or so above w = 3 and worst near 2, where it
 * starts off below Hertz at once. */
static void loading_agrees_with_jackson_green(void **state)
{
    (void)state;
    struct region *region = make(&steel, &al_205, 0.015, 2e-5, 12);
    for (size_t node = 12;; node++) {
        struct region_answer a = edge(region, node);
        region_commit(region);
        if (a.indentation > 2e-5)
            break;
        if (a.indentation > 3.5e-6)
            assert_true(fabs(a.force / jackson_green(a.indentation) - 1.0) < 0.02);
    }
    region_destroy(region);
}

/* The dent, the cycle's work, and the way back up. */
static void unloads_and_reloads(void **state)
{
    (void)state;
    struct region *region = make(&steel, &al_205, 0.015, 2e-5, 10);
    struct fault fault;
    double work = 0.0, before = 0.0, depth = 0.0, touch;
    for (int i = 1; i <= 60; i++) {
        struct region_answer a = press(region, i * 2e-7);
        region_commit(region);
        work += 0.5 * (a.force + before) * (a.indentation - depth);
        before = a.force;
        depth = a.indentation;
    }
    double top = before, bottom = depth, path[10];
    for (int i = 1; i < 100; i++) {
        struct region_answer a = load(region, top * (1.0 - 0.01 * i));
        region_commit(region);
        work += 0.5 * (a.force + before) * (a.indentation - depth);
        before = a.force;
        depth = a.indentation;
        if (i % 10 == 0)
            path[i / 10] = depth;
    }
    assert_int_equal(region_touch(region, &touch, &fault), PERCUSS_OK);
    work += 0.5 * before * (touch - depth);
    /* Jackson and Green 2010: 1.02 d (1 - ((w + 5.9) / 6.9)^-0.54), a fit */
    double c = 1.295 * exp(0.736 * 0.33);
    double w = bottom / (pow(0.5 * M_PI * c * 205e6 / effective(&steel, &al_205), 2.0) * 0.015);
    double dent = 1.02 * bottom * (1.0 - pow((w + 5.9) / 6.9, -0.54));
    assert_true(fabs(touch - dent) < 0.05 * bottom);
    /* The cycle's work went into flow and into the energy of the residual stresses, each computed
     * by itself; the trapezoids and the return's steps leave 3e-4. */
    struct region_ledger ledger;
    region_ledger(region, &ledger);
    double spent = ledger.plastic[1] + ledger.elastic[0] + ledger.elastic[1];
    assert_true(fabs(spent / work - 1.0) < 1e-3);
    assert_true(ledger.elastic[0] < 1e-3 * work);
    /* reloading retraces the branch: unloading was elastic but for a trace */
    for (int i = 9; i >= 1; i--) {
        struct region_answer a = load(region, top * (1.0 - 0.1 * i));
        region_commit(region);
        assert_true(fabs(a.indentation - path[i]) < 2e-3 * bottom);
    }
    assert_true(fabs(load(region, top).indentation / bottom - 1.0) < 2e-3);
    region_destroy(region);
}

/* Uncommitted steps leave no trace; force and indentation are two ways to one state; the slope is
 * the derivative. */
static void steps_are_functional(void **state)
{
    (void)state;
    struct region *region = make(&steel, &al_205, 0.015, 2e-5, 8);
    press(region, 8e-6);
    region_commit(region);
    struct region_answer first = press(region, 8.4e-6);
    press(region, 1.5e-5);
    press(region, -1e-5);
    struct region_answer again = press(region, 8.4e-6);
    /* to rounding: the zone that is treated as plastic may have widened in between */
    assert_true(fabs(again.force / first.force - 1.0) < 1e-8);
    struct region_answer by_force = load(region, first.force);
    assert_true(fabs(by_force.indentation / 8.4e-6 - 1.0) < 1e-8);
    double slope = (press(region, 8.4004e-6).force - press(region, 8.3996e-6).force) / 8e-10;
    assert_true(fabs(slope / first.stiffness - 1.0) < 1e-2);
    assert_true(press(region, -1e-6).force == 0.0);
    region_destroy(region);
}

/* In series with a spring the same states are reached as by their indentations, loading and
 * unloading: within what Newton's method leaves of the balance, 1e-6; the stiffness is that of its
 * last tangent. */
static void presses_through_a_spring(void **state)
{
    (void)state;
    static const double places[] = {4e-6, 8e-6, 7e-6, 5e-6};
    /* m/N; the region's own at 300 N is 4e-8 */
    static const double softnesses[] = {1e-8, 1e-8, -1e-8, -1e-8};
    struct region *straight = make(&steel, &al_205, 0.015, 1e-5, 8);
    struct region *through = make(&steel, &al_205, 0.015, 1e-5, 8);
    struct fault fault;
    for (size_t i = 0; i < 4; i++) {
        struct region_answer a = press(straight, places[i]);
        struct region_answer b;
        double softness = softnesses[i];
        double approach = places[i] + softness * a.force;
        if (region_approach(through, approach, softness, &b, &fault) != PERCUSS_OK)
            fail_msg("%s", fault.text);
        measured_relative("force", b.force, a.force, 1e-6);
        measured_relative("indentation", b.indentation, a.indentation, 1e-6);
        measured_relative("stiffness", b.stiffness, a.stiffness, 1e-3);
        region_commit(straight);
        region_commit(through);
    }
    /* apart: the spring is without force */
    struct region_answer open;
    assert_int_equal(region_approach(through, -1e-6, 1e-8, &open, &fault), PERCUSS_OK);
    assert_true(open.force == 0.0 && open.indentation == -1e-6);
    region_destroy(straight);
    region_destroy(through);
}

/* A phase moves all nodes outward by its part of a ring, which grows by 1 + pi/32. */
static void a_phase_moves_the_nodes(void **state)
{
    (void)state;
    struct region_input input = {{steel, al_205}, 0.015, 1e-5, 8, 0.5};
    struct region *moved;
    struct fault fault;
    assert_int_equal(region_create(&input, &moved, &fault), PERCUSS_OK);
    struct region *still = make(&steel, &al_205, 0.015, 1e-5, 8);
    double growth = region_edge_radius(still, 20) / region_edge_radius(still, 19);
    double shift = region_edge_radius(moved, 19) / region_edge_radius(still, 19);
    measured_relative("shift", log(shift), 0.5 * log(1.0 + M_PI / 32.0), 1e-9);
    assert_true(shift > 1.0 && shift < growth);
    region_destroy(moved);
    region_destroy(still);
}

static void refuses_bad_input(void **state)
{
    (void)state;
    struct region *region;
    struct fault fault;
    struct region_input input = {{steel, al_205}, 0.0, 1e-5, 8, 0.0};
    assert_int_equal(region_create(&input, &region, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "contact radius: 0"));
    input.radius = 0.01;
    input.indentation = 0.001;
    assert_int_equal(region_create(&input, &region, &fault), PERCUSS_BAD_REQUEST);
    input.indentation = 1e-5;
    input.resolution = 2;
    assert_int_equal(region_create(&input, &region, &fault), PERCUSS_BAD_REQUEST);
    input.resolution = 8;
    input.materials[1].tangent = 80e9;
    assert_int_equal(region_create(&input, &region, &fault), PERCUSS_BAD_REQUEST);
    /* beyond what the mesh was made for: an answer with a reason, and the state stays */
    struct region_answer answer;
    region = make(&steel, &al_205, 0.01, 2e-6, 8);
    assert_int_equal(region_press(region, 1e-4, &answer, &fault), PERCUSS_INTERNAL);
    assert_true(press(region, 2e-6).force > 0.0);
    region_destroy(region);
}

/* A metal that flows at a thousandth of a thousandth of the largest load: no mesh is made for the
 * beginning, and where Newton's method fails for it the yield is named. */
static void what_flows_at_once_is_refused_by_name(void **state)
{
    (void)state;
    static const struct material hard = {"hard", 600e9, 0.22, 15000.0, INFINITY, 0.0};
    static const struct material annealed = {"annealed", 210e9, 0.30, 7800.0, 1.16e6, 0.0};
    struct region *region = make(&hard, &annealed, 5.27e-3, 2.62e-5, 6);
    struct region_answer answer;
    struct fault fault;
    assert_int_equal(region_approach(region, 7.35e-7, 2.64e-8, &answer, &fault),
                     PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "material: yield: "));
    region_destroy(region);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_pairs_are_hertz),
        cmocka_unit_test(converges),
        cmocka_unit_test(scales_with_the_radius),
        cmocka_unit_test(yields_where_theory_says),
        cmocka_unit_test(loading_agrees_with_jackson_green),
        cmocka_unit_test(unloads_and_reloads),
        cmocka_unit_test(steps_are_functional),
        cmocka_unit_test(presses_through_a_spring),
        cmocka_unit_test(a_phase_moves_the_nodes),
        cmocka_unit_test(refuses_bad_input),
        cmocka_unit_test(what_flows_at_once_is_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
