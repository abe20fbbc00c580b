/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Random valid scenes of one contact, also traced, overlapping, ringing, soft and damped, end
 * within the effort a request may take or are refused; none hangs. PERCUSS_SCENES=6000 draws more
 * of them, PERCUSS_MEASURE=1 prints how long they take. */
#include <time.h>
#include <unistd.h>

#include "physics/support.h"

enum { BALLS = 3, TARGETS = 8, USUAL = 500, MOST = 1000000 };

struct target {
    char id[16];
    enum shape shape;
    double length;
    struct body_state *state; /* of the last impact that left one */
};

struct campaign {
    struct lab *lab;
    struct target targets[TARGETS];
    unsigned asked; /* by the solver, once in PACE_WORK */
};

static void add_bar(struct campaign *c, size_t at, struct body body, double damping)
{
    struct target *target = &c->targets[at];
    body.damping = damping;
    *target = (struct target){.shape = body.shape, .length = body.length};
    snprintf(target->id, sizeof target->id, "bar-%zu", at);
    lab_add(c->lab, target->id, body);
}

static bool proceed(void *context, double done)
{
    struct campaign *c = context;
    (void)done;
    c->asked++;
    return true;
}

static void begin(struct campaign *c)
{
    struct material soft = ALUMINIUM, hard = ALUMINIUM;
    soft.yield = 30e6;
    hard.yield = 300e6;
    c->lab = lab_create();
    lab_add(c->lab, "ball-0", make_sphere(STEEL, 0.015));
    lab_add(c->lab, "ball-1", make_sphere(GLASS, 0.005));
    lab_add(c->lab, "ball-2", make_sphere(soft, 0.020));
    add_bar(c, 0, make_bar(SHAPE_BEAM, ALUMINIUM, 0.010, 1.0), 0.0);
    add_bar(c, 1, make_bar(SHAPE_BEAM, hard, 0.010, 0.3), 0.002);
    add_bar(c, 2, make_bar(SHAPE_BEAM, soft, 0.010, 1.0), 0.03);
    add_bar(c, 3, make_bar(SHAPE_ROD, ALUMINIUM, 0.010, 1.0), 0.0);
    add_bar(c, 4, make_bar(SHAPE_ROD, hard, 0.010, 0.2), 0.002);
    add_bar(c, 5, make_bar(SHAPE_ROD, soft, 0.010, 1.0), 0.03);
    add_bar(c, 6, make_body(SHAPE_HALF_SPACE, STEEL), 0.0);
    add_bar(c, 7, make_body(SHAPE_HALF_SPACE, soft), 0.0);
    solve_workspace_watch(c->lab->workspace, (struct watch){proceed, c});
}

static void end(struct campaign *c)
{
    for (size_t i = 0; i < TARGETS; i++)
        free(c->targets[i].state);
    lab_free(c->lab);
}

static bool chance(uint64_t *seed, double share)
{
    return random_between(seed, 0.0, 1.0) < share;
}

static struct solve_request draw(struct campaign *c, uint64_t *seed, size_t *which)
{
    static const double radii[BALLS] = {0.015, 0.005, 0.020};
    static const double tolerances[] = {0.0, 0.0, 0.0, 1e-2, 1e-4, 1e-6, 1e-8};
    static const char *const balls[BALLS] = {"ball-0", "ball-1", "ball-2"};
    size_t ball = (size_t)random_between(seed, 0.0, BALLS);
    *which = (size_t)random_between(seed, 0.0, TARGETS);
    struct target *target = &c->targets[*which];
    double along = random_between(seed, -0.49, 0.49) * target->length;
    struct spot spot = target->shape == SHAPE_BEAM
                           ? side_spot(target->id, along, 0.010, random_between(seed, 0.0, 6.0))
                       : target->shape == SHAPE_ROD ? end_spot(target->id, target->length)
                                                    : wall_spot(target->id);
    struct solve_request request = strike(sphere_spot(balls[ball], radii[ball]), spot,
                                          pow(10.0, random_between(seed, -3.5, 0.7)));
    struct solve_contact *contact = &request.contacts[0];
    struct solve_options *options = &request.options;
    if (chance(seed, 0.4))
        contact->gap = -pow(10.0, random_between(seed, -9.0, -3.3));
    else if (chance(seed, 0.3))
        contact->gap = pow(10.0, random_between(seed, -9.0, -2.0));
    if (chance(seed, 0.6))
        contact->gap_acceleration = chance(seed, 0.5) ? -9.81 : random_between(seed, -100.0, 100.0);
    options->tolerance = tolerances[(size_t)random_between(seed, 0.0, COUNT(tolerances))];
    options->trace = chance(seed, 0.5);
    options->conditioning = chance(seed, 0.1);
    if (chance(seed, 0.15))
        options->horizon = pow(10.0, random_between(seed, -4.0, 1.0));
    options->contact_model = (enum percuss_contact_model)random_between(seed, 0.0, 3.0);
    if (target->state && chance(seed, 0.5)) {
        request.bodies[1].state = target->state;
        request.bodies[1].elapsed = random_between(seed, 0.0, 0.05);
    }
    return request;
}

static double thread_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void keep_state(struct target *target, const struct body_state *state)
{
    struct body_state *copy = malloc(body_state_size(state));
    assert_non_null(copy);
    memcpy(copy, state, body_state_size(state));
    free(target->state);
    target->state = copy;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void any_scene_ends_or_is_refused(void **state)
{
    (void)state;
    static struct solve_result result;
    static struct campaign campaign;
    const char *wanted = getenv("PERCUSS_SCENES");
    size_t count = wanted ? strtoul(wanted, NULL, 10) : USUAL, which;
    assert_in_range(count, 1, MOST);
    double *seconds = calloc(count, sizeof *seconds);
    unsigned statuses[PERCUSS_STATUS_COUNT] = {0};
    uint64_t seed = 2;
    assert_non_null(seconds);
    begin(&campaign);
    for (size_t i = 0; i < count; i++) {
        struct solve_request request = draw(&campaign, &seed, &which);
        double start = thread_seconds();
        campaign.asked = 0;
        alarm(100); /* only a hang lasts so long */
        enum percuss_status status =
            solve(campaign.lab->workspace, &campaign.lab->set, &request, &result);
        alarm(0);
        seconds[i] = thread_seconds() - start;
        statuses[status]++;
        /* the effort of a solve is 4e7, and as much with another contact model; a trace goes
         * through the answer in eighths of its steps */
        double allowed = request.options.trace ? 4e8 : 9e7;
        if (campaign.asked * PACE_WORK > allowed)
            fail_msg("scene %zu: %g of work", i, campaign.asked * PACE_WORK);
        if (status == PERCUSS_OK || status == PERCUSS_TRUNCATED) {
            if (result.bodies[1].state_after && chance(&seed, 0.3))
                keep_state(&campaign.targets[which], result.bodies[1].state_after);
        } else if (result.fault.text[0] == '\0') {
            fail_msg("scene %zu: %s without a word", i, status_name(status));
        }
    }
    assert_true(statuses[PERCUSS_OK] > count / 2 && statuses[PERCUSS_TIMEOUT] == 0);
    qsort(seconds, count, sizeof *seconds, ascending);
    if (getenv("PERCUSS_MEASURE"))
        print_message("    %zu scenes: median %.2g s, 90 %% %.2g s, 99 %% %.2g s, longest %.2g s; "
                      "%u OK, %u truncated, %u refused\n",
                      count, seconds[count / 2], seconds[count * 9 / 10], seconds[count * 99 / 100],
                      seconds[count - 1], statuses[PERCUSS_OK], statuses[PERCUSS_TRUNCATED],
                      statuses[PERCUSS_BAD_REQUEST]);
    free(seconds);
    end(&campaign);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_scene_ends_or_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
