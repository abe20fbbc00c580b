/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* States handed from one impact to the next: vibration goes on freely in between, and a ringing
 * body answers differently from a silent one. */
#include <time.h>

#include "model/bar.h"
#include "physics/support.h"

struct ringing {
    struct lab *lab;
    struct body_state *state; /* of the beam after one impact */
    double vibration;
};

static struct body_state *copy_state(const struct body_state *state)
{
    struct body_state *copy = malloc(body_state_size(state));
    assert_non_null(copy);
    memcpy(copy, state, body_state_size(state));
    return copy;
}

static struct solve_request blow(double speed, double tolerance)
{
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("beam", 0.12, 0.010, 0.6), speed);
    request.options.tolerance = tolerance;
    return request;
}

/* A beam that was hit off its centre in both planes. */
static struct ringing ring(double damping, unsigned modes)
{
    static struct solve_result result;
    struct ringing ringing = {.lab = lab_create()};
    struct body beam = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    beam.damping = damping;
    beam.modes = modes;
    lab_add(ringing.lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(ringing.lab, "beam", beam);
    struct solve_request request = blow(0.2, 1e-8);
    lab_solve(ringing.lab, &request, &result);
    assert_null(result.bodies[0].state_after);
    assert_non_null(result.bodies[1].state_after);
    ringing.state = copy_state(result.bodies[1].state_after);
    ringing.vibration = result.bodies[1].vibration;
    return ringing;
}

static void ring_free(struct ringing *ringing)
{
    free(ringing->state);
    lab_free(ringing->lab);
}

/* Energy of a state with the frequencies of the model itself. */
static double state_energy(const struct body *body, const struct body_state *state)
{
    double sum = 0.0;
    for (size_t f = 0; f < BODY_MOST_FAMILIES; f++) {
        if (!state->count[f])
            continue;
        struct modal_family *modes = modal_family_create(body, f, state->count[f]);
        const double *pairs = body_state_family(state, f);
        assert_non_null(modes);
        for (size_t k = 0; k < state->count[f]; k++) {
            double spring = modes->omega[k] * pairs[2 * k];
            sum += 0.5 * (spring * spring + pairs[2 * k + 1] * pairs[2 * k + 1]);
        }
        modal_family_free(modes);
    }
    return sum;
}

static void a_state_holds_the_vibration(void **state)
{
    (void)state;
    struct ringing ringing = ring(0.0, 100);
    assert_true(ringing.state->count[BAR_BENDING_Y] > 0);
    assert_true(ringing.state->count[BAR_BENDING_Z] > 0);
    assert_int_equal(ringing.state->count[BAR_LONGITUDINAL], 0);
    /* two sums of the same terms in different order */
    measured_relative("energy of the state", state_energy(&ringing.lab->bodies[1], ringing.state),
                      ringing.vibration, 1e-12);
    ring_free(&ringing);
}

/* Flights for `shares` parts of 30 ms by a distant ball that misses: the state after each. */
static struct body_state *fly(const struct ringing *ringing, int parts)
{
    static struct solve_result result;
    struct body_state *state = copy_state(ringing->state);
    for (int i = 0; i < parts; i++) {
        struct solve_request request = blow(1e-3, 1e-6);
        request.contacts[0].gap = 0.5; /* 500 s away */
        request.options.horizon = 0.02 / parts;
        request.bodies[1].state = state;
        request.bodies[1].elapsed = 0.01 / parts;
        assert_int_equal(solve(ringing->lab->workspace, &ringing->lab->means, &request, &result),
                         PERCUSS_TRUNCATED);
        struct body_state *next = copy_state(result.bodies[1].state_after);
        free(state);
        state = next;
    }
    return state;
}

static void flights_add_up(void **state)
{
    (void)state;
    static const double dampings[] = {0.0, 0.003};
    for (size_t d = 0; d < COUNT(dampings); d++) {
        struct ringing ringing = ring(dampings[d], 100);
        const struct body *beam = &ringing.lab->bodies[1];
        struct body_state *whole = fly(&ringing, 1);
        struct body_state *parts = fly(&ringing, 2);
        double scale = sqrt(ringing.vibration);
        assert_memory_equal(whole->count, parts->count, sizeof whole->count);
        for (size_t f = 0; f < BODY_MOST_FAMILIES; f++) {
            if (!whole->count[f])
                continue;
            struct modal_family *modes = modal_family_create(beam, f, whole->count[f]);
            const double *a = body_state_family(whole, f);
            const double *b = body_state_family(parts, f);
            assert_non_null(modes);
            for (size_t k = 0; k < whole->count[f]; k++) {
                /* the phase omega t of up to 1e6 rad is rounded to 1e-16 of itself */
                double allowed = scale * (1e-12 + 4e-16 * modes->omega[k] * 0.03);
                measured("q", modes->omega[k] * a[2 * k], modes->omega[k] * b[2 * k], allowed);
                measured("v", a[2 * k + 1], b[2 * k + 1], allowed);
            }
            modal_family_free(modes);
        }
        double energy = state_energy(beam, whole);
        if (dampings[d] == 0.0)
            /* rotations: rounding of each */
            measured_relative("energy", energy, ringing.vibration, 1e-12);
        else
            assert_true(energy < ringing.vibration);
        free(whole);
        free(parts);
        ring_free(&ringing);
    }
}

static void a_ringing_beam_answers_differently(void **state)
{
    (void)state;
    static struct solve_result silent, result;
    static const double dampings[] = {0.0, 0.003};
    for (size_t d = 0; d < COUNT(dampings); d++) {
        struct ringing ringing = ring(dampings[d], 40);
        struct solve_request request = blow(0.2, 1e-8);
        lab_solve(ringing.lab, &request, &silent);
        double e = silent.contacts[0].restitution;
        for (double elapsed = 0.0; elapsed < 0.02; elapsed += 0.0037) {
            request.bodies[1].state = ringing.state;
            request.bodies[1].elapsed = elapsed;
            lab_solve(ringing.lab, &request, &result);
            assert_true(fabs(result.contacts[0].restitution - e) > 1e-3);
            double w = result.contacts[0].inverse_effective_mass;
            /* notes, section 4 */
            measured("closure", result.energy.closure / result.energy.available, 0.0, 1e-9);
            if (dampings[d] == 0.0)
                measured_relative("available", result.energy.available,
                                  0.5 * 0.04 / w + ringing.vibration, 1e-12);
            /* dP_c is the rigid motion's, ringing or not */
            measured_relative("compression", result.contacts[0].impulse_compression, 0.2 / w,
                              1e-14);
            /* the touch is where the vibration puts it, within its reach of some 0.1 mm */
            assert_true(fabs(result.time_shift) < 5e-4 / 0.2);
            measured("start", result.contacts[0].sub_impacts[0].start, result.time_shift, 1e-18);
        }
        ring_free(&ringing);
    }
}

/* Modal against CVODE with a ringing start: gap, overlap, damping. */
static void a_ringing_start_agrees_with_cvode(void **state)
{
    (void)state;
    static struct solve_result modal, cvode;
    static const double gaps[] = {0.0, 2e-4, -2e-4};
    for (int damped = 0; damped < 2; damped++) {
        struct ringing ringing = ring(damped * 0.01, 8);
        for (size_t i = 0; i < COUNT(gaps); i++) {
            struct solve_request request = blow(0.3, 1e-7);
            request.contacts[0].gap = gaps[i];
            request.bodies[1].state = ringing.state;
            request.bodies[1].elapsed = 0.002;
            lab_solve(ringing.lab, &request, &modal);
            struct solve_workspace *other = solve_workspace_create();
            assert_non_null(other);
            request.options.method = PERCUSS_METHOD_CVODE;
            assert_int_equal(solve(other, &ringing.lab->means, &request, &cvode), PERCUSS_OK);
            /* tolerance 1e-7 each, amplified by a sequence */
            measured("e", modal.contacts[0].restitution, cvode.contacts[0].restitution, 1e-5);
            measured("time shift", modal.time_shift, cvode.time_shift, 1e-9);
            solve_workspace_free(other);
        }
        ring_free(&ringing);
    }
}

/* An overlap of a strongly damped ringing body: the way back to the touch must not blow rounding up
 * by exp(zeta omega t), whatever the number of modes. */
static void a_damped_overlap_stays_tame(void **state)
{
    (void)state;
    static struct solve_result result;
    static const unsigned modes[] = {20, 60, 200};
    double e[COUNT(modes)];
    for (size_t i = 0; i < COUNT(modes); i++) {
        struct ringing ringing = ring(0.05, modes[i]);
        struct solve_request request = blow(0.2, 1e-6);
        request.contacts[0].gap = -3e-4;
        request.bodies[1].state = ringing.state;
        lab_solve(ringing.lab, &request, &result);
        e[i] = result.contacts[0].restitution;
        measured("closure", result.energy.closure / result.energy.available, 0.0, 1e-5);
        /* some 0.2 mm of vibration move the touch by a millisecond at most */
        measured("time shift", result.time_shift, -3e-4 / 0.2, 1e-3);
        ring_free(&ringing);
    }
    /* the residual flexibility leaves 20 modes an error of some 1e-3; a blown-up mode would leave
     * nothing of the digits */
    measured("e, 20 modes", e[0], e[2], 1e-2);
    measured("e, 60 modes", e[1], e[2], 1e-3);
}

/* A ringing body that touched longer ago than the horizon: the refusal names the option, and with
 * what it asks for there is an answer. One that never was apart is refused for that. */
static void an_old_touch_of_a_ringing_body_asks_for_the_horizon(void **state)
{
    (void)state;
    static struct solve_result result;
    struct ringing ringing = ring(0.0, 20);
    struct solve_request request = blow(0.1, 1e-3);
    request.contacts[0].gap = -3e-3; /* 30 ms ago; the default horizon is 20 ms, or two periods */
    request.options.horizon = 0.02;
    request.bodies[1].state = ringing.state;
    assert_int_equal(solve(ringing.lab->workspace, &ringing.lab->means, &request, &result),
                     PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(result.fault.text, "within options.horizon (0.02 s) before: raise it"));
    request.options.horizon = 0.1;
    lab_solve(ringing.lab, &request, &result);
    measured("time shift", result.time_shift, -0.03, 3e-3); /* some 0.2 mm of vibration */
    request.contacts[0].gap_acceleration = -100.0; /* v^2/2a: overlapped 2.95 mm at least */
    assert_int_equal(solve(ringing.lab->workspace, &ringing.lab->means, &request, &result),
                     PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(result.fault.text, "vibration they never touched before"));
    ring_free(&ringing);
}

/* Free motion of one mode in closed form, as w q and v. */
static void turn(double w, double damping, double t, double pair[2])
{
    double slower = sqrt(1.0 - damping * damping);
    double c = exp(-damping * w * t) * cos(slower * w * t);
    double s = exp(-damping * w * t) * sin(slower * w * t) / slower;
    double wq = (c + damping * s) * pair[0] + s * pair[1];
    pair[1] = (c - damping * s) * pair[1] - s * pair[0];
    pair[0] = wq;
}

/* What took no part in the second impact rings on: hit at a vibration node, or in the other plane.
 * Where the bodies overlap the way back to their touch, 10 ms, is undamped for it too. */
static void modes_that_take_no_part_ring_on(void **state)
{
    (void)state;
    static struct solve_result result;
    for (int damped = 0; damped < 2; damped++) {
        double damping = 0.05 * damped;
        struct ringing ringing = ring(damping, 100);
        /* along z at the centre: nothing of the plane y, nothing odd of the plane z */
        struct solve_request request =
            strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 0.2);
        request.contacts[0].gap = -2e-3 * damped;
        request.bodies[1].state = ringing.state;
        request.options.tolerance = damped ? 1e-6 : 1e-8;
        lab_solve(ringing.lab, &request, &result);
        const double *y0 = body_state_family(ringing.state, BAR_BENDING_Y);
        const double *y1 = body_state_family(result.bodies[1].state_after, BAR_BENDING_Y);
        size_t count = ringing.state->count[BAR_BENDING_Y];
        struct modal_family *modes =
            modal_family_create(&ringing.lab->bodies[1], BAR_BENDING_Y, count);
        assert_non_null(modes);
        assert_int_equal(result.bodies[1].state_after->count[BAR_BENDING_Y], count);
        double back = fmin(result.time_shift, 0.0);
        for (size_t k = 0; k < count; k++) {
            double w = modes->omega[k];
            double pair[2] = {w * y0[2 * k], y0[2 * k + 1]};
            turn(w, 0.0, back, pair);
            turn(w, damping, result.window - back, pair);
            /* rounding of omega t */
            measured("q", w * y1[2 * k], pair[0], 1e-12 + 4e-16 * w * 0.02);
            measured("v", y1[2 * k + 1], pair[1], 1e-12 + 4e-16 * w * 0.02);
        }
        modal_family_free(modes);
        ring_free(&ringing);
    }
}

static double thread_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool count(void *context, double done)
{
    (void)done;
    ++*(unsigned *)context;
    return true;
}

/* Impacts on impacts: where the beam's vibration makes the bodies overlap, the way back to the
 * touch is as cheap as a flight. It was a walk of up to a million steps, with all modes at each of
 * them: of these 600 one took 8.5 s. */
static void questions_on_ringing_beams_take_no_seconds(void **state)
{
    (void)state;
    enum { SEQUENCES = 100, BLOWS = 6 };
    static struct solve_result result;
    static const double dampings[] = {0.0, 0.001, 0.01, 0.05};
    static const char *const ids[] = {"beam0", "beam1", "beam2", "beam3"};
    struct lab *lab = lab_create();
    uint64_t seed = 22;
    unsigned asked = 0, before = 0, most = 0, back = 0;
    double longest = 0.0;
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    for (size_t i = 0; i < COUNT(ids); i++) {
        struct body beam = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
        beam.damping = dampings[i];
        lab_add(lab, ids[i], beam);
    }
    lab->means.watch = (struct watch){count, &asked};
    for (int sequence = 0; sequence < SEQUENCES; sequence++) {
        const char *id = ids[(int)random_between(&seed, 0.0, 4.0)];
        struct body_state *ringing = NULL;
        double elapsed = 0.0;
        for (int blow = 0; blow < BLOWS; blow++) {
            double x =
                random_between(&seed, 0.0, 1.0) < 0.4 ? 0.0 : random_between(&seed, -0.45, 0.45);
            double speed = pow(10.0, random_between(&seed, -2.0, 0.0));
            struct solve_request request =
                strike(sphere_spot("ball", 0.015), side_spot(id, x, 0.010, 0.0), speed);
            request.options.tolerance = 1e-4;
            request.bodies[1].state = ringing;
            request.bodies[1].elapsed = elapsed;
            if (random_between(&seed, 0.0, 1.0) < 0.5)
                request.contacts[0].gap_acceleration = -9.81;
            double start = thread_seconds();
            enum percuss_status status = solve(lab->workspace, &lab->means, &request, &result);
            longest = fmax(longest, thread_seconds() - start);
            most = asked - before > most ? asked - before : most;
            before = asked;
            assert_true(status == PERCUSS_OK || status == PERCUSS_TRUNCATED ||
                        status == PERCUSS_BAD_REQUEST);
            back += result.time_shift < -1e-4;
            elapsed = random_between(&seed, 0.0, 0.05);
            if (status == PERCUSS_BAD_REQUEST || !result.bodies[1].state_after)
                continue;
            free(ringing);
            ringing = copy_state(result.bodies[1].state_after);
        }
        free(ringing);
    }
    if (getenv("PERCUSS_MEASURE"))
        print_message("    %u ways back, most work %g, longest %.3f s\n", back, most * PACE_WORK,
                      longest);
    assert_true(back > 50);
    /* the effort that one solve by the modal method may take, and half of it for the step tables,
     * which are made once: those of 53, 348, 530 and 894 modes were 0.9e7 */
    assert_true(most * PACE_WORK < 4.5e7);
    /* seen: 1 s; what else the machine does counts little in this thread's own time */
    assert_true(longest < 4.0);
    lab_free(lab);
}

static bool warns(const struct solve_result *result, const char *words)
{
    for (size_t w = 0; w < result->warning_count; w++)
        if (strstr(result->warnings[w], words))
            return true;
    return false;
}

/* A state knows what the answer that left it was wrong by; what that does to the next one is in its
 * errors, and in nothing else of it. */
static void states_carry_their_error(void **state)
{
    (void)state;
    static struct solve_result silent, told, loud;
    struct ringing ringing = ring(0.0, 0);
    assert_true(ringing.state->unknown > 0.0 && ringing.state->unknown < 1e-5);
    assert_true(ringing.state->unknown_model > ringing.state->unknown);
    assert_true(ringing.state->abruptness > 0.0);
    assert_true(ringing.state->known[BAR_BENDING_Y] <= ringing.state->count[BAR_BENDING_Y]);
    struct body_state *other = copy_state(ringing.state);
    struct solve_request request = blow(0.1, 1e-4);
    request.bodies[1].elapsed = 0.02;
    request.bodies[1].state = ringing.state;
    lab_solve(ringing.lab, &request, &told);
    /* the same vibration of which nothing is known */
    request.bodies[1].state = other;
    other->unknown = other->unknown_model = other->abruptness = 0.0;
    lab_solve(ringing.lab, &request, &silent);
    assert_true(told.contacts[0].restitution == silent.contacts[0].restitution);
    assert_true(told.contacts[0].impulse == silent.contacts[0].impulse);
    assert_true(told.restitution_modes > silent.restitution_modes);
    assert_true(told.restitution_model > silent.restitution_model);
    assert_true(told.tolerance_met && silent.tolerance_met);
    assert_non_null(strstr(told.reason, "what the states are wrong by"));
    assert_null(strstr(silent.reason, "what the states are wrong by"));
    /* and one that is wrong by a per cent */
    other->unknown = 0.01;
    lab_solve(ringing.lab, &request, &loud);
    assert_true(loud.contacts[0].restitution == silent.contacts[0].restitution);
    assert_true(loud.restitution_modes > 1e-3 && !loud.tolerance_met && !loud.total_met);
    assert_true(warns(&loud, "the states that the bodies begin from"));
    free(other);
    ring_free(&ringing);
}

/* What a state is wrong by stays so, where nothing is damped: the next state is no better. */
static void errors_of_states_add_up(void **state)
{
    (void)state;
    static struct solve_result result;
    struct ringing ringing = ring(0.0, 0);
    struct solve_request request = blow(0.1, 1e-4);
    ringing.state->unknown = 0.01;
    double before = 0.01 * sqrt(ringing.vibration);
    request.bodies[1].elapsed = 0.02;
    request.bodies[1].state = ringing.state;
    lab_solve(ringing.lab, &request, &result);
    const struct body_state *after = result.bodies[1].state_after;
    assert_true(after->unknown * sqrt(result.bodies[1].vibration) >= before * (1.0 - 1e-9));
    assert_true(after->abruptness > ringing.state->abruptness);
    ring_free(&ringing);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_state_holds_the_vibration),
        cmocka_unit_test(flights_add_up),
        cmocka_unit_test(a_ringing_beam_answers_differently),
        cmocka_unit_test(a_ringing_start_agrees_with_cvode),
        cmocka_unit_test(a_damped_overlap_stays_tame),
        cmocka_unit_test(an_old_touch_of_a_ringing_body_asks_for_the_horizon),
        cmocka_unit_test(questions_on_ringing_beams_take_no_seconds),
        cmocka_unit_test(modes_that_take_no_part_ring_on),
        cmocka_unit_test(states_carry_their_error),
        cmocka_unit_test(errors_of_states_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
