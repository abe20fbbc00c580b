/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "cosim/loop.h"

static bool loop_probe(void *context, struct percuss_slow_view *view)
{
    struct loop *loop = context;
    percuss_slow_gap_rates(loop->bodies, view->count, view->contacts, view->gap_rate);
    if (view->delassus)
        percuss_slow_free_delassus(loop->bodies, loop->inertias, view->count, view->contacts,
                                   view->delassus);
    for (size_t i = 0; view->bodies && i < loop->body_count; i++) {
        char id[PERCUSS_ID_SIZE];
        memcpy(id, view->bodies[i].id, sizeof id);
        view->bodies[i] = loop->bodies[i];
        memcpy(view->bodies[i].id, id, sizeof id);
    }
    /* bodies hold their places but for their overlap, half of which is on either side of a point */
    for (size_t i = 0; view->bodies && i < loop->pair_count; i++)
        view->bodies[loop->pairs[i].a].position[2] += fmin(0.0, loop->pairs[i].gap);
    return true;
}

static bool loop_apply(void *context, const struct percuss_slow_contact *contact, double impulse)
{
    struct loop *loop = context;
    percuss_slow_free_apply(loop->bodies, loop->inertias, contact, impulse);
    return true;
}

/* Places are kept in the gaps. */
static bool loop_move(void *context, const struct percuss_slow_contact *contact, double moment)
{
    struct loop *loop = context;
    struct percuss_body_motion still[LOOP_BODIES];
    double change[LOOP_CONTACTS];
    memcpy(still, loop->bodies, sizeof still);
    for (size_t i = 0; i < loop->body_count; i++)
        for (int k = 0; k < 3; k++)
            still[i].velocity[k] = still[i].angular_velocity[k] = 0.0;
    percuss_slow_free_apply(still, loop->inertias, contact, moment);
    percuss_slow_gap_rates(still, loop->pair_count, loop->pairs, change);
    for (size_t i = 0; i < loop->pair_count; i++)
        loop->pairs[i].gap += change[i];
    return true;
}

static double loop_now(void *context)
{
    return ((struct loop *)context)->time;
}

static void loop_release(struct percuss_reply *reply)
{
    free(reply->contacts);
    free(reply->states_after);
    *reply = (struct percuss_reply){0};
}

void loop_ask(struct loop *loop, const struct percuss_request *request)
{
    static struct solve_request question;
    question = (struct solve_request){.body_count = request->body_count,
                                      .contact_count = request->contact_count,
                                      .delassus = request->delassus,
                                      .delassus_oblique = request->delassus_rows > 0};
    for (size_t i = 0; i < request->body_count; i++) {
        const struct percuss_body_motion *from = &request->bodies[i];
        struct solve_body *to = &question.bodies[i];
        memcpy(to->id, from->id, sizeof to->id);
        memcpy(to->position, from->position, sizeof to->position);
        memcpy(to->orientation, from->orientation, sizeof to->orientation);
        memcpy(to->velocity, from->velocity, sizeof to->velocity);
        memcpy(to->angular_velocity, from->angular_velocity, sizeof to->angular_velocity);
        to->state = from->state[0] ? loop->state[atoi(from->state)] : NULL;
        to->elapsed = from->elapsed;
    }
    for (size_t i = 0; i < request->contact_count; i++) {
        const struct percuss_contact *from = &request->contacts[i];
        struct solve_contact *to = &question.contacts[i];
        *to = (struct solve_contact){.a = from->a,
                                     .b = from->b,
                                     .gap = from->gap,
                                     .gap_acceleration = from->gap_acceleration,
                                     .friction = from->friction};
        memcpy(to->point, from->point, sizeof to->point);
        memcpy(to->normal, from->normal, sizeof to->normal);
        memcpy(to->tangent, from->tangent, sizeof to->tangent);
    }
    question.options.friction = request->options.friction;
    question.options.tolerance = request->options.tolerance;
    question.options.horizon = request->options.horizon;
    question.options.trace = request->options.trace;
    solve(loop->lab->workspace, &loop->lab->means, &question, &loop->result);
}

struct percuss_sub_impact loop_sub_impact(const struct solve_contact_result *from, size_t i)
{
    const struct sub_impact *one = &from->sub_impacts[i];
    return (struct percuss_sub_impact){
        .start = one->start,
        .compression_end = one->compression_end,
        .end = one->end,
        .compression_impulse = one->compression_impulse,
        .peak_force = one->peak_force,
        .impulse = one->impulse,
        .impulse_tangential = {one->impulse_tangential[0], one->impulse_tangential[1]}};
}

static enum percuss_result loop_solve(void *context, const struct percuss_request *request,
                                      struct percuss_reply *reply)
{
    struct loop *loop = context;
    struct solve_result *result = &loop->result;
    static struct percuss_sub_impact subs[LOOP_CONTACTS][PERCUSS_MAX_SUB_IMPACTS];
    loop_ask(loop, request);
    reply->status = result->status;
    snprintf(reply->message, sizeof reply->message, "%s", result->fault.text);
    if (result->status != PERCUSS_OK && result->status != PERCUSS_TRUNCATED)
        return PERCUSS_RESULT_OK;
    reply->complete = result->complete;
    reply->end_reason = result->end_reason;
    reply->window = result->window;
    loop->time_shift = fmin(loop->time_shift, result->time_shift);
    reply->contact_count = result->contact_count;
    reply->states_after_count = request->body_count;
    reply->contacts = calloc(result->contact_count, sizeof *reply->contacts);
    reply->states_after = calloc(request->body_count, sizeof *reply->states_after);
    for (size_t i = 0; i < result->contact_count; i++) {
        const struct solve_contact_result *from = &result->contacts[i];
        struct percuss_contact_result *to = &reply->contacts[i];
        to->impulse = from->impulse;
        to->restitution = from->restitution;
        to->end_time = from->end_time;
        to->friction = from->friction;
        memcpy(to->tangent, from->tangent, sizeof to->tangent);
        memcpy(to->impulse_tangential, from->impulse_tangential, sizeof to->impulse_tangential);
        to->sub_impact_count = (uint32_t)from->sub_impact_count;
        to->sub_impacts_listed = (uint32_t)from->sub_impacts_listed;
        to->sub_impacts = subs[i];
        for (size_t j = 0; j < from->sub_impacts_listed; j++)
            subs[i][j] = loop_sub_impact(from, j);
    }
    loop->vibration = 0.0;
    for (size_t i = 0; i < request->body_count; i++) {
        loop->vibration += result->bodies[i].vibration;
        const struct body_state *state = result->bodies[i].state_after;
        if (!state)
            continue;
        assert_true(loop->states < LOOP_STATES);
        size_t number = loop->states++;
        loop->state[number] = malloc(body_state_size(state));
        memcpy(loop->state[number], state, body_state_size(state));
        snprintf(reply->states_after[i].state, PERCUSS_ID_SIZE, "%zu", number);
    }
    return PERCUSS_RESULT_OK;
}

static void loop_report(void *context, const struct percuss_slow_report *report)
{
    struct loop *loop = context;
    loop->reports++;
    snprintf(loop->message, sizeof loop->message, "%s", report->message);
    size_t used = strlen(loop->notes);
    snprintf(loop->notes + used, sizeof loop->notes - used, "%s\n", report->message);
    if (!report->reply)
        fail_msg("no answer: %s", report->message);
    for (size_t i = 0; i < report->count; i++) {
        loop->restitution[i] = report->restitution[i];
        loop->restitution_reply[i] = report->reply->contacts[i].restitution;
    }
}

uint32_t loop_add(struct loop *loop, const char *id, double x, double z, double speed)
{
    const struct body *body = body_set_find(&loop->lab->set, id);
    uint32_t index = (uint32_t)loop->body_count++;
    assert_non_null(body);
    snprintf(loop->ids[index], PERCUSS_ID_SIZE, "%s", id);
    loop->bodies[index] = (struct percuss_body_motion){.orientation = {1.0, 0.0, 0.0, 0.0},
                                                       .position = {x, 0.0, z},
                                                       .velocity = {0.0, 0.0, speed}};
    loop->inertias[index] = (struct percuss_slow_inertia){
        body->mass, {body->inertia[0], body->inertia[1], body->inertia[2]}};
    return index;
}

void loop_pair(struct loop *loop, uint32_t a, uint32_t b, double z, double gap)
{
    loop->pairs[loop->pair_count++] =
        (struct percuss_slow_contact){.a = a,
                                      .b = b,
                                      .point = {loop->bodies[a].position[0], 0.0, z},
                                      .normal = {0.0, 0.0, 1.0},
                                      .gap = gap};
}

struct percuss_slow_service loop_service(struct loop *loop)
{
    return (struct percuss_slow_service){loop, loop_solve, loop_release, NULL};
}

void loop_start_moving(struct loop *loop, enum percuss_slow_application application,
                       double tolerance, bool moves)
{
    struct percuss_slow_body bodies[LOOP_BODIES];
    struct percuss_slow_config config = percuss_slow_config_default();
    config.move = moves ? loop_move : NULL;
    for (size_t i = 0; i < loop->body_count; i++)
        bodies[i] = (struct percuss_slow_body){.id = loop->ids[i]};
    config.body_count = loop->body_count;
    config.bodies = bodies;
    config.engine = (struct percuss_slow_engine){
        .context = loop, .probe = loop_probe, .apply = loop_apply, .now = loop_now};
    config.service = loop_service(loop);
    config.options.tolerance = tolerance;
    config.application = application;
    config.report = loop_report;
    config.report_context = loop;
    assert_int_equal(percuss_slow_create(&config, &loop->slow), PERCUSS_RESULT_OK);
}

void loop_start(struct loop *loop, enum percuss_slow_application application, double tolerance)
{
    loop_start_moving(loop, application, tolerance, false);
}

void loop_fly(struct loop *loop, double dt)
{
    double rates[LOOP_CONTACTS];
    loop->time += dt;
    percuss_slow_gap_rates(loop->bodies, loop->pair_count, loop->pairs, rates);
    for (size_t i = 0; i < loop->pair_count; i++) {
        struct percuss_slow_contact *pair = &loop->pairs[i];
        double a = loop->falls[pair->b] - loop->falls[pair->a];
        pair->gap_acceleration = loop->silent ? 0.0 : a;
        pair->gap += dt * (rates[i] + 0.5 * dt * a);
    }
    for (size_t i = 0; i < loop->body_count; i++)
        loop->bodies[i].velocity[2] -= dt * loop->falls[i];
}

void loop_step(struct loop *loop, double dt)
{
    struct percuss_slow_contact contacts[LOOP_CONTACTS];
    loop_fly(loop, dt);
    memcpy(contacts, loop->pairs, sizeof contacts);
    for (size_t i = 0; i < loop->pair_count; i++)
        contacts[i].point[2] += 0.5 * fmin(0.0, contacts[i].gap);
    if (percuss_slow_advance(loop->slow, loop->pair_count, contacts))
        fail_msg("%s", percuss_slow_error_text());
}

/* Time until a gap is closed by 1e-15 m; INFINITY: never. */
static double loop_touch(const struct percuss_slow_contact *pair, double rate)
{
    double gap = pair->gap + 1e-15, press = -pair->gap_acceleration;
    double root = sqrt(fmax(0.0, rate * rate + 2.0 * press * gap));
    return rate < 0.0 || press > 0.0 ? 2.0 * gap / (root - rate) : INFINITY;
}

void loop_run(struct loop *loop, double end, double step)
{
    while (loop->time < end) {
        double rates[LOOP_CONTACTS];
        double h = fmin(fmin(step, end - loop->time), percuss_slow_next(loop->slow) - loop->time);
        percuss_slow_gap_rates(loop->bodies, loop->pair_count, loop->pairs, rates);
        for (size_t i = 0; i < loop->pair_count; i++) /* a little behind the touch */
            if (loop->pairs[i].gap > 0.0)
                h = fmin(h, loop_touch(&loop->pairs[i], rates[i]));
        loop_step(loop, h);
    }
}

double loop_kinetic(const struct loop *loop)
{
    double sum = 0.0;
    for (size_t i = 0; i < loop->body_count; i++)
        for (int k = 0; k < 3; k++) {
            double v = loop->bodies[i].velocity[k], o = loop->bodies[i].angular_velocity[k];
            sum += 0.5 * loop->inertias[i].mass * v * v;
            sum += 0.5 * loop->inertias[i].moments[k] * o * o;
        }
    return sum;
}

void loop_free(struct loop *loop)
{
    percuss_slow_free(loop->slow);
    for (size_t i = 0; i < loop->states; i++)
        free(loop->state[i]);
    free(loop);
}
