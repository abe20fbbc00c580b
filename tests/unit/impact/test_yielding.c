/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/yielding.c: impacts whose contacts yield, against the energy of a
 * rigid pair and against CVODE; order of the steps that end where a law's slope jumps. */
#include <float.h>

#include "contact/law_closed_form.h"
#include "contact/plastic.h"
#include "impact/yielding.h"
#include "unit/contact/sampled_table.h"
#include "unit/impact/toy_scene.h"

/* The paper's sphere on its rod 1. */
static struct contact_law soft_law(void)
{
    static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
    static const struct material soft = {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0};
    struct hertz_contact hertz =
        hertz_contact_make(hertz_effective_modulus(&steel, &soft), 0.5 / 0.015, 0.5 / 0.015);
    return contact_law_closed_form(&hertz, &steel, &soft);
}

static struct impact_outcome run(struct toy *toy, bool cvode, double accuracy)
{
    struct impact_outcome outcome;
    struct impact_settings settings = {.accuracy = accuracy, .horizon = 0.02, .max_work = 1e9};
    assert_true(impact_create(&outcome, &toy->scene, &toy->arena));
    enum percuss_status status =
        (cvode ? impact_cvode : impact_modal)(&toy->scene, &settings, &toy->arena, &outcome);
    assert_int_equal(status, PERCUSS_OK);
    return outcome;
}

static void toy_on_soft(struct toy *toy, double speed)
{
    toy_init(toy, 1);
    toy->laws[0] = soft_law();
    toy->w[0] = 1.0 / 0.11;
    toy->gap_rate[0] = -speed;
}

/* Rebound of a rigid pair by its energy alone, from the law's own curves. */
static double rebound(const struct contact_law *law, double speed, double w)
{
    double energy = 0.5 * speed * speed / w;
    struct contact_law after = *law;
    double d = law->operations->indentation(law, 1.0);
    for (int i = 0; i < 100; i++) {
        double slope;
        double stored = law->operations->stored(law, d);
        d *= exp(log(energy / stored) * stored / (contact_law_force(law, d, &slope) * d));
    }
    if (d > contact_law_limit(law))
        energy -= contact_law_yield(&after, d);
    return sqrt(2.0 * energy * w);
}

static void a_rigid_pair_rebounds_by_its_energy(void **state)
{
    (void)state;
    static const double speeds[] = {0.01, 0.03, 0.1, 0.3, 1.0, 10.0};
    for (size_t i = 0; i < sizeof speeds / sizeof *speeds; i++) {
        double last = INFINITY;
        for (double accuracy = 1e-4; accuracy > 1e-13; accuracy *= 1e-2) {
            struct toy toy;
            toy_on_soft(&toy, speeds[i]);
            struct impact_outcome outcome = run(&toy, false, accuracy);
            double e = outcome.motion.gap_rate[0] / speeds[i];
            double expected = rebound(&toy.laws[0], speeds[i], toy.w[0]) / speeds[i];
            /* the step control's own statement, see docs/lab/accuracy.md, and rounding */
            double allowed = 0.1 * pow(accuracy, 0.8) + 1e-12;
            measured("restitution", e, expected, allowed);
            /* what solve/step_search.c counts on: tolerance ten times, or 1e-3, the accuracy */
            measured("closure", outcome.energy.closure / outcome.energy.available, 0.0,
                     100.0 * accuracy + 1e-12);
            assert_true((outcome.energy.plastic > 0.0) == (e < 1.0 - 1e-4));
            last = fabs(e - expected);
            toy_free(&toy);
        }
        assert_true(last < 1e-9);
    }
}

/* Too weak to yield: the law answers like Hertz, also by the closed form of a rigid pair. */
static void a_weak_blow_is_hertz(void **state)
{
    (void)state;
    struct toy toy;
    struct impact_outcome outcome[2];
    struct impact_settings settings = {.accuracy = 1e-4, .horizon = 0.02, .max_work = 1e9};
    toy_on_soft(&toy, 0.010);
    assert_true(impact_is_rigid_pair(&toy.scene));
    for (int hertz = 0; hertz < 2; hertz++) {
        if (hertz)
            toy.laws[0] = contact_law_hertz(toy.laws[0].parameters[0]);
        assert_true(impact_create(&outcome[hertz], &toy.scene, &toy.arena));
        assert_int_equal(impact_rigid_pair(&toy.scene, &settings, &toy.arena, &outcome[hertz]),
                         PERCUSS_OK);
    }
    assert_true(outcome[0].tracks[0].impulse == outcome[1].tracks[0].impulse);
    measured("depth", outcome[0].tracks[0].list[0].max_indentation * 1e6,
             outcome[1].tracks[0].list[0].max_indentation * 1e6, 1e-14);
    /* by quadrature and by closed form: rounding */
    measured("duration", outcome[0].window / outcome[1].window, 1.0, 1e-14);
    measured("viscosity", outcome[0].tracks[0].viscosity / outcome[1].tracks[0].viscosity, 1.0,
             1e-14);
    toy_free(&toy);
    toy_on_soft(&toy, 0.012);
    assert_false(impact_is_rigid_pair(&toy.scene));
    toy_free(&toy);
}

/* A second blow into the dent of the first, weaker, as strong, and stronger. */
static void a_dent_hardens(void **state)
{
    (void)state;
    static const double speeds[] = {0.1, 0.3, 0.6};
    for (int i = 0; i < 3; i++) {
        struct toy toy;
        toy_on_soft(&toy, 0.3);
        struct impact_outcome first = run(&toy, false, 1e-11);
        contact_law_remember(&toy.laws[0], &first.laws[0].history);
        toy.gap_rate[0] = -speeds[i];
        struct impact_outcome second = run(&toy, false, 1e-11);
        double expected = rebound(&toy.laws[0], speeds[i], toy.w[0]);
        measured("rebound", second.motion.gap_rate[0] / speeds[i], expected / speeds[i], 1e-9);
        measured("closure", second.energy.closure / second.energy.available, 0.0, 1e-9);
        const struct sub_impact *sub = second.tracks[0].list;
        if (speeds[i] < 0.3) {
            assert_true(second.energy.plastic == 0.0);
            measured("rebound, elastic", expected / speeds[i], 1.0, 1e-12);
        } else {
            assert_true(second.laws[0].history.dent > first.laws[0].history.dent);
            measured("depth", sub->max_indentation + first.laws[0].history.dent,
                     second.laws[0].history.max_indentation, 1e-14);
            measured("force", sub->peak_force, second.laws[0].history.max_force,
                     1e-9 * sub->peak_force);
        }
        toy_free(&toy);
    }
}

/* Modes that make the indentation rise and fall several times in one contact. */
static void add_modes(struct toy *toy, double damping)
{
    static const double omega[] = {3e4, 7e4, 1.1e5, 1.9e5};
    static const double participation[] = {1.5, -1.9, 1.4, 2.0};
    toy->residual[0] = 2e-9;
    toy_add(toy, 1, 4, omega, damping, participation);
}

static void both_methods_agree(void **state)
{
    (void)state;
    static const double speeds[] = {0.02, 0.1, 0.3, 1.0};
    for (int i = 0; i < 8; i++) {
        struct toy toy;
        toy_on_soft(&toy, speeds[i % 4]);
        add_modes(&toy, i < 4 ? 0.0 : 0.02);
        struct impact_outcome modal = run(&toy, false, 1e-11);
        struct impact_outcome cvode = run(&toy, true, 1e-10);
        measured("rate after", modal.motion.gap_rate[0] / speeds[i % 4],
                 cvode.motion.gap_rate[0] / speeds[i % 4], 1e-7);
        measured("plastic", modal.energy.plastic / modal.energy.available,
                 cvode.energy.plastic / cvode.energy.available, 1e-7);
        measured("dent", modal.laws[0].history.dent / 1e-6, cvode.laws[0].history.dent / 1e-6,
                 1e-6);
        measured("closure", modal.energy.closure / modal.energy.available, 0.0, 1e-9);
        assert_int_equal(modal.tracks[0].count, cvode.tracks[0].count);
        measured("depth", modal.tracks[0].list[0].max_indentation / 1e-6,
                 cvode.tracks[0].list[0].max_indentation / 1e-6, 1e-6);
        toy_free(&toy);
    }
}

/* Steps and rejected steps together, against the elastic law on the same scene: closed form and
 * table. */
static void yielding_costs_few_steps(void **state)
{
    (void)state;
    static struct sampled_table sampled;
    struct fault fault = {""};
    struct contact_law closed = soft_law();
    sampled_table_make(&sampled, &closed, 60.0);
    struct contact_curves *curves;
    contact_curves_create(&sampled.table, &curves, &fault);
    assert_non_null(curves);
    /* with steps where it begins and ends as those of the others, whose forces are not projected */
    struct contact_law_operations plain = contact_law_HERTZ;
    struct contact_law elastic = contact_law_hertz(closed.parameters[0]);
    plain.three_halves = false;
    elastic.operations = &plain;
    const struct contact_law laws[] = {elastic, closed, contact_law_table(curves)};
    for (double accuracy = 1e-4; accuracy > 1e-12; accuracy *= 1e-2) {
        unsigned long steps[3];
        for (int i = 0; i < 3; i++) {
            struct toy toy;
            toy_on_soft(&toy, 0.3);
            add_modes(&toy, 0.0);
            toy.laws[0] = laws[i];
            struct impact_outcome outcome = run(&toy, false, accuracy);
            steps[i] = outcome.steps + outcome.rejected;
            toy_free(&toy);
        }
        if (getenv("PERCUSS_MEASURE"))
            print_message("    accuracy %g: elastic %lu, closed form %lu, table %lu steps\n",
                          accuracy, steps[0], steps[1], steps[2]);
        /* two joints and the turn, six and the turn: some two to three steps each */
        assert_true(steps[1] <= steps[0] + 3 * 8 && steps[2] <= steps[0] + 7 * 8);
    }
    contact_curves_free(curves);
}

/* A dent far deeper than what its law bears springs back: the limit, their difference, is known to
 * the rounding of the depth, and a peak within that is the same again. It was yielded to over and
 * over, without a step between. */
static void a_peak_within_rounding_is_the_same_again(void **state)
{
    (void)state;
    struct toy toy;
    struct impact_outcome outcome;
    bool closed = true;
    toy_on_soft(&toy, 1.0);
    assert_true(impact_create(&outcome, &toy.scene, &toy.arena));
    impact_begin(&outcome, &toy.scene);
    contact_law_yield(&outcome.laws[0], 1e-3);
    const double depth = outcome.laws[0].history.max_indentation;
    const double limit = contact_law_limit(&outcome.laws[0]);
    struct contact_start now = {limit + depth * 2.0 * DBL_EPSILON, 0.0, -1e3, 0.0};
    struct impact_scale scale = {.duration = 1e-5};
    struct contact_step step = {.iterations = 0};
    struct scene scene = toy.scene;
    scene.laws = outcome.laws;
    struct yielding yielding = {.scene = &scene,
                                .outcome = &outcome,
                                .step = &step,
                                .now = &now,
                                .closed = &closed,
                                .scales = &scale,
                                .accuracy = 1e-18};
    assert_true(yielding_create(&yielding, &toy.arena));
    int level = 20;
    yielding.event[0] = (struct yielding_event){EVENT_PEAK, 0.0, 1e-6, now.indentation};
    yielding_meet(&yielding, step_length(level), &level);
    assert_true(outcome.laws[0].history.max_indentation == depth);
    /* beyond it there is one */
    now.indentation = limit + depth * 1e-14;
    yielding.event[0] = (struct yielding_event){EVENT_PEAK, 0.0, 1e-6, now.indentation};
    yielding_meet(&yielding, step_length(level), &level);
    assert_true(outcome.laws[0].history.max_indentation > depth);
    toy_free(&toy);
}

/* Steps that end so near the peak that its rate is rounding may have the turn in neither: what
 * falls from beyond the limit yields there, or its dent would be lost. */
static void a_turn_between_two_steps_is_no_loss(void **state)
{
    (void)state;
    static const double rates[] = {0.0, -1e-7};
    for (size_t i = 0; i < COUNT(rates); i++) {
        struct toy toy;
        struct impact_outcome outcome;
        bool closed = true;
        int level = 30;
        double nodes[1][NODES], end;
        const double h = step_length(level);
        toy_on_soft(&toy, 1.0);
        assert_true(impact_create(&outcome, &toy.scene, &toy.arena));
        impact_begin(&outcome, &toy.scene);
        /* the step that follows: down from twice the limit, without an event expected */
        struct contact_start now = {2.0 * contact_law_limit(&outcome.laws[0]), rates[i], -3e3, 0.0};
        for (int j = 0; j < NODES; j++) {
            double t = h * collocation.node[j];
            nodes[0][j] = now.indentation + t * (now.rate + 0.5 * now.curvature * t);
        }
        end = now.indentation + h * (now.rate + 0.5 * now.curvature * h);
        struct contact_step step = {.indentation = nodes, .end_indentation = &end};
        struct impact_scale scale = {.duration = 1e-5};
        struct scene scene = toy.scene;
        scene.laws = outcome.laws;
        struct yielding yielding = {.scene = &scene,
                                    .outcome = &outcome,
                                    .step = &step,
                                    .now = &now,
                                    .closed = &closed,
                                    .scales = &scale,
                                    .accuracy = 1e-16};
        assert_true(yielding_create(&yielding, &toy.arena));
        /* the parabola's top; a rounding or two of it */
        const double peak = now.indentation - 0.5 * now.rate * now.rate / now.curvature;
        assert_true(yielding_passes(&yielding, h, &level));
        near(outcome.laws[0].history.max_indentation, peak, 1e-15 * peak);
        assert_true(outcome.laws[0].history.dent > 0.0);
        /* once */
        assert_false(yielding_passes(&yielding, h, &level));
        toy_free(&toy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rigid_pair_rebounds_by_its_energy),
        cmocka_unit_test(a_weak_blow_is_hertz),
        cmocka_unit_test(a_dent_hardens),
        cmocka_unit_test(both_methods_agree),
        cmocka_unit_test(yielding_costs_few_steps),
        cmocka_unit_test(a_peak_within_rounding_is_the_same_again),
        cmocka_unit_test(a_turn_between_two_steps_is_no_loss),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
