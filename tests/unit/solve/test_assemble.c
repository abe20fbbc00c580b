/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/assemble.c: which modes take part, and the residual flexibility of the
 * rest. */
#include "model/bar.h"
#include "unit/solve/assembly_bench.h"

static struct bench *with_rod(void)
{
    struct bench *bench = bench_create();
    lab_add(bench->lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0));
    return bench;
}

static const struct assembly *put_together(struct bench *bench, const struct solve_request *request,
                                           double cut)
{
    bench_place(bench, request);
    bench_assemble(bench, cut);
    return &bench->assembly;
}

static struct solve_request on_beam(double x, double about)
{
    return strike(sphere_spot("ball", 0.015), side_spot("beam", x, 0.010, about), 0.2);
}

/* What a static force of 1 N finds: kept modes and residual together are the exact compliance. */
static void modes_and_residual_are_the_compliance(void **state)
{
    (void)state;
    struct bench *bench = with_rod();
    const struct solve_request requests[] = {
        on_beam(0.0, 0.0), on_beam(0.31, 0.0), on_beam(0.31, 0.7),
        strike(sphere_spot("ball", 0.015), end_spot("rod", 1.0), 0.2)};
    const double hutchinson = 6.0 * 1.33 * 1.33 / (7.0 + 12.0 * 0.33 + 4.0 * 0.33 * 0.33);
    double side = NAN;
    for (size_t i = 0; i < COUNT(requests); i++) {
        double all = NAN;
        for (double cut = 0.0; cut < 3e6; cut = 4.0 * cut + 1e3) {
            const struct assembly *assembly = put_together(bench, &requests[i], cut);
            double sum = assembly->scene.residual[0];
            double residual = sum;
            for (size_t g = 0; g < assembly->scene.groups; g++)
                for (size_t k = 0; k < assembly->groups[g].count; k++) {
                    double phi = assembly->groups[g].participation[0][k];
                    double omega = assembly->groups[g].set->omega[k];
                    assert_true(omega <= cut);
                    sum += phi * phi / (omega * omega);
                }
            all = cut == 0.0 ? sum : all;
            measured_relative("compliance", sum, all, 1e-14);
            /* less remains with every mode, and never less than nothing but rounding */
            assert_true(residual > -1e-14 * all);
            assert_true(cut == 0.0 ? assembly->all_modes == 0 : residual <= all);
            assert_true(assembly->lowest_omitted > cut);
            assert_true(assembly->highest <= cut);
        }
        /* of a free beam hit in the middle: L^3/(320 E I) + L/(12 kappa G A), and its section's
         * deformation: c = nu r^2/2 times the mean over d = 1.4 r of M/(E I), M = (L/2 - |x|)^2/2L,
         * twice, and c^2/(E I d) */
        double bend = 70e9 * 0.25 * M_PI * 1e-8, c = 0.5 * 0.33 * 1e-4, d = 0.014;
        double mean = (0.125 - pow(0.5 - 0.5 * d, 3.0)) / (3.0 * d * bend);
        if (i == 0)
            measured_relative("centre", all,
                              1.0 / (320.0 * bend) +
                                  1.0 / (12.0 * hutchinson * 70e9 / 2.66 * M_PI * 1e-4) -
                                  2.0 * c * mean + c * c / (bend * d),
                              1e-12);
        side = i == 1 ? all : side;
        if (i == 2)
            measured_relative("the same in any plane", all, side, 1e-13);
        if (i == 3)
            measured_relative("rod", all, 1.0 / (3.0 * 70e9 * M_PI * 1e-4), 1e-13);
    }
    bench_free(bench);
}

/* Odd shapes have a node in the middle: not there. Off it they are. */
static void modes_with_a_node_there_stay_out(void **state)
{
    (void)state;
    struct bench *bench = with_rod();
    struct solve_request centre = on_beam(0.0, 0.0), beside = on_beam(0.01, 0.0);
    struct solve_request turned = on_beam(0.01, 0.5);
    const struct assembly *assembly = put_together(bench, &centre, 1e5);
    assert_int_equal(assembly->scene.groups, 1);
    size_t even = assembly->all_modes;
    assert_int_equal(assembly->modes[0], 0);
    assert_int_equal(assembly->modes[1], even);
    assembly = put_together(bench, &beside, 1e5);
    assert_int_equal(assembly->scene.groups, 2);
    size_t all = assembly->all_modes;
    assert_in_range(all, 2 * even - 1, 2 * even + 1);
    assembly = put_together(bench, &turned, 1e5);
    assert_int_equal(assembly->all_modes, all); /* its own plane of bending */
    bench_free(bench);
}

static void a_fixed_number_is_that_number(void **state)
{
    (void)state;
    struct bench *bench = with_rod();
    struct body beam = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    struct solve_request request = on_beam(0.1, 0.0);
    beam.modes = 16;
    lab_add(bench->lab, "beam", beam);
    assert_int_equal(put_together(bench, &request, 1.0)->all_modes, 16);
    assert_int_equal(put_together(bench, &request, 1e9)->all_modes, 16);
    assert_false(bench->assembly.adjustable);
    bench_free(bench);
}

/* What is left out, by its own sum over thousands of modes: the rod's inertia to the evenly spaced
 * frequencies' accuracy, 1/(2N) of it; of beams, whose frequencies spread, the estimate is a bound
 * that is not far off. */
static void omitted_inertia_is_a_bound(void **state)
{
    (void)state;
    struct bench *bench = with_rod();
    const struct solve_request requests[] = {
        strike(sphere_spot("ball", 0.015), end_spot("rod", 1.0), 0.2), on_beam(0.0, 0.0),
        on_beam(0.31, 0.0)};
    for (size_t i = 0; i < COUNT(requests); i++) {
        double all = 0.0;
        const struct assembly *assembly = put_together(bench, &requests[i], 2e7);
        for (size_t g = 0; g < assembly->scene.groups; g++)
            for (size_t k = 0; k < assembly->groups[g].count; k++) {
                double phi = assembly->groups[g].participation[0][k];
                double omega = assembly->groups[g].set->omega[k];
                all += omega > 2e5 ? phi * phi / pow(omega, 4.0) : 0.0;
            }
        double estimate = put_together(bench, &requests[i], 2e5)->omitted[0].inertia;
        assert_true(estimate > 0.9 * all && estimate < 2.5 * all);
        if (i == 0)
            measured_relative("rod", estimate, all, 0.1);
    }
    bench_free(bench);
}

/* The next better model holds the same compliance, none of it without inertia. */
static void a_remainder_takes_the_residual(void **state)
{
    (void)state;
    struct bench *bench = with_rod();
    struct solve_request request = on_beam(0.1, 0.0);
    const struct assembly *assembly = put_together(bench, &request, 1e5);
    struct scene next;
    assert_true(assemble_remainder(assembly, bench->problem, &next));
    assert_int_equal(next.groups, assembly->scene.groups + 1);
    const struct scene_group *group = &next.group[next.groups - 1];
    double omega = group->set->omega[0];
    double phi = group->participation[0][0];
    measured_relative("compliance", phi * phi / (omega * omega), assembly->scene.residual[0],
                      1e-12);
    measured("left", next.residual[0], 0.0, 1e-12 * assembly->scene.residual[0]);
    measured_relative("inertia", phi * phi / pow(omega, 4.0), assembly->omitted[0].inertia, 1e-12);
    bench_free(bench);
}

/* The tolerance decides: less allowed, more modes; a stiff short bar needs none. */
static void less_allowed_is_more_modes(void **state)
{
    (void)state;
    struct bench *bench = with_rod();
    struct solve_request request = on_beam(0.0, 0.0);
    struct fault fault = {""};
    size_t last = 0;
    prepared_cache_use(bench->cache, bench->lab->set.revision);
    struct problem *problem = problem_create(&request, bench->cache, &bench->arena);
    assert_non_null(problem);
    assert_false(placement_find(problem, &bench->lab->set, &fault));
    assert_false(contact_model_choose(problem, &bench->lab->set, NULL, &fault));
    for (double allowed = 1e-3; allowed > 1e-9; allowed /= 10.0) {
        struct mode_choice choice = {.cut = INFINITY, .allowed = allowed, .most = 1000};
        assert_true(assemble(&bench->assembly, problem, &choice));
        assert_true(bench->assembly.all_modes > last);
        last = bench->assembly.all_modes;
    }
    struct mode_choice few = {.cut = INFINITY, .allowed = 0.0, .most = 10};
    assert_true(assemble(&bench->assembly, problem, &few));
    assert_true(bench->assembly.capped);
    bench_free(bench);
}

/* Modes of an initial state take part whatever the cut, moved on by the time since. */
static void a_state_brings_its_modes(void **state)
{
    (void)state;
    struct bench *bench = with_rod();
    struct solve_request request = on_beam(0.1, 0.0);
    const size_t count = 12;
    struct body_state *ringing =
        calloc(1, sizeof *ringing + 2 * count * sizeof *ringing->coordinates);
    assert_non_null(ringing);
    ringing->count[BAR_BENDING_Z] = count;
    for (size_t k = 0; k < count; k++)
        ringing->coordinates[2 * k] = 1e-6 * (double)(k + 1);
    request.bodies[1].state = ringing;
    request.bodies[1].elapsed = 1e-4;
    const struct assembly *assembly = put_together(bench, &request, 0.0);
    assert_int_equal(assembly->all_modes, count);
    size_t seen = 0;
    for (size_t g = 0; g < assembly->scene.groups; g++) {
        const struct scene_group *group = &assembly->groups[g];
        for (size_t k = 0; k < group->count; k++, seen++) {
            double mode = (double)assembly->sources[g]->mode[k] + 1.0;
            double angle = group->set->omega[k] * 1e-4;
            measured_relative("q", group->q[k], 1e-6 * mode * cos(angle), 1e-12);
            measured("v", group->v[k], -1e-6 * mode * group->set->omega[k] * sin(angle),
                     1e-12 * group->set->omega[k] * 1e-6 * mode);
        }
    }
    assert_int_equal(seen, count);
    free(ringing);
    bench_free(bench);
}

/* Two contacts on one beam share its modes: off-diagonal residuals complete the cross compliance.
 */
static void residuals_couple_contacts(void **state)
{
    (void)state;
    struct bench *bench = with_rod();
    struct solve_request request = on_beam(0.1, 0.0);
    request.body_count = 3;
    request.contact_count = 2;
    request.bodies[2] = request.bodies[0];
    request.bodies[2].position[0] = -0.35;
    request.contacts[1] = request.contacts[0];
    request.contacts[1].a = 2;
    request.contacts[1].point[0] = -0.35;
    double all[4];
    for (int few = 0; few < 2; few++) {
        const struct assembly *assembly = put_together(bench, &request, few ? 2e4 : 0.0);
        for (int ij = 0; ij < 4; ij++) {
            double sum = assembly->scene.residual[ij];
            for (size_t g = 0; g < assembly->scene.groups; g++)
                for (size_t k = 0; k < assembly->groups[g].count; k++) {
                    double omega = assembly->groups[g].set->omega[k];
                    sum += assembly->groups[g].participation[ij / 2][k] *
                           assembly->groups[g].participation[ij % 2][k] / (omega * omega);
                }
            all[ij] = few ? all[ij] : sum;
            measured("compliance", sum, all[ij], 1e-14 * all[0]);
        }
    }
    measured_relative("symmetric", all[1], all[2], 1e-13);
    assert_true(all[1] * all[1] < all[0] * all[3]);
    bench_free(bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(modes_and_residual_are_the_compliance),
        cmocka_unit_test(modes_with_a_node_there_stay_out),
        cmocka_unit_test(a_fixed_number_is_that_number),
        cmocka_unit_test(omitted_inertia_is_a_bound),
        cmocka_unit_test(a_remainder_takes_the_residual),
        cmocka_unit_test(less_allowed_is_more_modes),
        cmocka_unit_test(a_state_brings_its_modes),
        cmocka_unit_test(residuals_couple_contacts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
