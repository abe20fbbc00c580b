/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A ball that bounces on a ringing beam under gravity. The beam is in its way before and after the
 * rigid touch, so that impulses lie up to milliseconds before the instant that is asked about. What
 * the ball has and what the beam rings with is one sum, whatever the engine's steps are. */
#include "cosim/loop.h"

#include "impact/trace.h"

static const double ball = 0.015, bar = 0.010, gravity = 9.81;

static struct loop *make_loop(struct lab *lab, double height)
{
    struct loop *loop = calloc(1, sizeof *loop);
    assert_non_null(loop);
    loop->lab = lab;
    uint32_t falling = loop_add(loop, "ball", 0.13, bar + ball, 0.0);
    uint32_t beam = loop_add(loop, "beam", 0.0, 0.0, 0.0);
    loop->inertias[beam].mass = INFINITY; /* pinned at both ends */
    loop->falls[falling] = gravity;
    loop_pair(loop, falling, beam, bar, height);
    return loop;
}

static struct lab *make_lab(void)
{
    struct lab *lab = lab_create();
    lab_add(
        lab, "beam",
        make_supported(make_bar(&beam_kind, ALUMINIUM, bar, 1.0), SUPPORT_PINNED, SUPPORT_PINNED));
    lab_add(lab, "ball", make_sphere(STEEL, ball));
    return lab;
}

static double energy(const struct loop *loop)
{
    double v = loop->bodies[0].velocity[2];
    return loop->inertias[0].mass * (0.5 * v * v + gravity * loop->pairs[0].gap) + loop->vibration;
}

struct manner {
    enum percuss_slow_application application;
    bool moves;
    bool locates; /* touches, and steps end where a sub-impact is */
    size_t bounces;
    double height, step; /* m, s */
};

/* Lets the ball bounce; the energy after the last bounce by that before the first. */
static double bounce(const struct manner *manner, struct loop *loop)
{
    /* the reply's energy balance closes to ten times the tolerance */
    loop_start_moving(loop, manner->application, 1e-4, manner->moves);
    double before = energy(loop);
    while (loop->reports < manner->bounces || !isinf(percuss_slow_next(loop->slow))) {
        if (manner->locates)
            loop_run(loop, loop->time + manner->step, manner->step);
        else
            loop_step(loop, manner->step);
        assert_true(loop->time < 0.3 * (double)manner->bounces);
    }
    return energy(loop) / before;
}

struct dropped {
    double left;  /* share of the energy */
    double shift; /* earliest touch before the rigid one, s */
    bool late;    /* the notes say that an impulse was applied late */
};

static struct dropped drop(const struct manner *manner)
{
    struct lab *lab = make_lab();
    struct loop *loop = make_loop(lab, manner->height);
    struct dropped dropped = {.left = bounce(manner, loop), .shift = loop->time_shift};
    dropped.late = strstr(loop->notes, "late without config.move") != NULL;
    loop_free(loop);
    lab_free(lab);
    return dropped;
}

static void check(const struct manner *manner, double lowest, double highest)
{
    struct dropped dropped = drop(manner);
    if (!(dropped.left >= lowest && dropped.left <= highest))
        fail_msg("%g of the energy is left: must be %g to %g", dropped.left, lowest, highest);
    /* worth the name: the beam was in the way up to a millisecond before the rigid touch */
    assert_true(dropped.shift < -0.5e-3);
    assert_false(dropped.late);
}

/* 0.999 to 1.0008 was seen: the centres of forces are known to some microseconds. */
static void ten_bounces_on_a_ringing_beam_keep_the_energy(void **state)
{
    (void)state;
    check(&(struct manner){PERCUSS_SLOW_LIST, true, true, 10, 5e-3, 1e-3}, 0.997, 1.003);
}

static void so_they_do_with_each_impact_applied_in_total(void **state)
{
    (void)state;
    check(&(struct manner){PERCUSS_SLOW_TOTAL, true, true, 10, 5e-3, 1e-3}, 0.997, 1.003);
}

static void so_they_do_with_steps_that_stop_nowhere(void **state)
{
    (void)state;
    check(&(struct manner){PERCUSS_SLOW_LIST, true, false, 5, 5e-3, 1e-3}, 0.997, 1.003);
    /* overlaps of some millimetres, far more than the service takes of a ball of 15 mm */
    check(&(struct manner){PERCUSS_SLOW_LIST, true, false, 5, 60e-3, 1.0 / 240.0}, 0.997, 1.003);
    check(&(struct manner){PERCUSS_SLOW_TOTAL, true, false, 5, 60e-3, 1.0 / 240.0}, 0.997, 1.003);
}

/* What `move` is for; the report says that it is missing. How much is lost is up to the beam's
 * phases, which a sequence of bounces makes chance: the most of several drops. */
static void without_moving_energy_is_lost(void **state)
{
    (void)state;
    struct dropped worst = {.left = INFINITY};
    for (int i = 0; i < 6; i++) {
        struct dropped dropped =
            drop(&(struct manner){PERCUSS_SLOW_LIST, false, true, 5, 4.5e-3 + 0.2e-3 * i, 1e-3});
        worst = dropped.left < worst.left ? dropped : worst;
    }
    if (!(worst.left >= 0.5 && worst.left <= 0.97))
        fail_msg("%g of the energy is left: must be 0.5 to 0.97", worst.left);
    assert_true(worst.shift < -0.5e-3 && worst.late);
}

/* Under gravity, with an acceleration that the engine states and one that it does not. */
static void total_without_moving_is_refused(void **state)
{
    (void)state;
    for (int silent = 0; silent < 2; silent++) {
        struct lab *lab = make_lab();
        struct loop *loop = make_loop(lab, 1e-3);
        loop->silent = silent;
        loop_start(loop, PERCUSS_SLOW_TOTAL, 1e-4);
        enum percuss_result result = PERCUSS_RESULT_OK;
        while (!result && loop->time < 0.1) {
            loop_fly(loop, 1e-3);
            result = percuss_slow_advance(loop->slow, loop->pair_count, loop->pairs);
        }
        for (int again = 0; again < 2; again++) { /* asking twice changes nothing */
            assert_int_equal(result, PERCUSS_RESULT_INVALID_ARGUMENT);
            assert_non_null(strstr(percuss_slow_error_text(),
                                   "application: total: the gap of ball and "
                                   "beam accelerates with -9.81 m/s^2"));
            result = percuss_slow_advance(loop->slow, loop->pair_count, loop->pairs);
        }
        /* nothing was applied */
        measured("speed", loop->bodies[0].velocity[2], -gravity * loop->time, 1e-12);
        loop_free(loop);
        lab_free(lab);
    }
}

/* The centre in time of the force in [start, end] of a history, by the trapezoidal rule. */
static double true_centre(const struct trace *trace, double start, double end)
{
    double sum = 0.0, first = 0.0;
    for (size_t i = 1; i < trace->count; i++) {
        double h = trace->time[i] - trace->time[i - 1];
        if (trace->time[i - 1] < start - h || trace->time[i] > end + h)
            continue;
        for (size_t k = i - 1; k <= i; k++) {
            sum += 0.5 * h * trace->contact[0].force[k];
            first += 0.5 * h * trace->contact[0].force[k] * trace->time[k];
        }
    }
    return first / sum;
}

/* What is applied at is where the force really has its centre; the end of the compression is not.
 */
static void impulses_belong_to_the_centre_of_the_force(void **state)
{
    (void)state;
    struct lab *lab = make_lab();
    double worst = 0.0, worst_peak = 0.0;
    for (int i = 0; i < 12; i++) {
        struct loop *loop = make_loop(lab, 0.0);
        struct percuss_request request = {.body_count = 2, .contact_count = 1};
        for (int b = 0; b < 2; b++) {
            request.bodies[b] = loop->bodies[b];
            memcpy(request.bodies[b].id, loop->ids[b], PERCUSS_ID_SIZE);
        }
        request.bodies[0].velocity[2] = -0.1 - 0.03 * i;
        request.contacts[0] = (struct percuss_contact){.a = 0, .b = 1, .normal = {0, 0, 1}};
        memcpy(request.contacts[0].point, loop->pairs[0].point, sizeof(double[3]));
        request.options.tolerance = 1e-4;
        request.options.trace = true;
        loop_ask(loop, &request);
        assert_int_equal(loop->result.status, PERCUSS_OK);
        for (size_t j = 0; j < loop->result.contacts[0].sub_impacts_listed; j++) {
            struct percuss_sub_impact sub = loop_sub_impact(&loop->result.contacts[0], j);
            /* a graze may have two humps: one of 5 % has its centre 0.13 of its length beside */
            if (sub.impulse < 0.1 * loop->result.contacts[0].impulse)
                continue;
            double centre = true_centre(loop->result.trace, sub.start, sub.end);
            double length = sub.end - sub.start;
            worst = fmax(worst, fabs(percuss_slow_force_centre(&sub) - centre) / length);
            worst_peak = fmax(worst_peak, fabs(sub.compression_end - centre) / length);
        }
        loop_free(loop);
    }
    /* 0.038 and 0.165 were seen: vibration bends the force away from the shape that is assumed */
    assert_true(worst <= 0.042);
    assert_true(worst_peak >= 3.0 * worst);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ten_bounces_on_a_ringing_beam_keep_the_energy),
        cmocka_unit_test(so_they_do_with_each_impact_applied_in_total),
        cmocka_unit_test(so_they_do_with_steps_that_stop_nowhere),
        cmocka_unit_test(without_moving_energy_is_lost),
        cmocka_unit_test(total_without_moving_is_refused),
        cmocka_unit_test(impulses_belong_to_the_centre_of_the_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
