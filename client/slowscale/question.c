/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <percuss/result.h>
#include <stdio.h>
#include <string.h>

#include "pairs.h"
#include "question.h"

/* With friction of free bodies the service uses its own inverse masses, which must be the engine's
 * within this. */
static const double SAME_MASSES = 1e-2;
static const double LONGEST_HORIZON = 10.0; /* s, that the service allows */
enum { MOST_LONGER = 2 };                   /* questions with a longer horizon */

static const char *status_name(enum percuss_status status)
{
#define STATUS_NAME(name, text) text,
    static const char *const names[] = {PERCUSS_STATUS_LIST(STATUS_NAME)};
    return (unsigned)status < PERCUSS_STATUS_COUNT ? names[status] : "an unknown status";
}

/* Index in the request of the engine's body; adds it. False: there is no room. */
static bool enter_body(const struct percuss_slow *slow, const struct group *group, uint32_t body,
                       double now, struct percuss_request *request, uint32_t *map, uint32_t *index)
{
    /* there already with another contact */
    uint32_t i = 0;
    while (i < request->body_count && map[i] != body)
        i++;
    *index = i;
    if (i < request->body_count)
        return true;
    if (i >= PERCUSS_MAX_BODIES)
        return false;
    /* as the engine has it, with the vibration that it was left in */
    const struct token *token = &slow->tokens[body];
    struct percuss_body_motion *motion = &request->bodies[i];
    map[i] = body;
    request->body_count = i + 1;
    *motion = group->bodies[body];
    memcpy(motion->id, slow->ids[body], sizeof motion->id);
    memcpy(motion->state, token->state, sizeof motion->state);
    motion->elapsed = token->state[0] ? fmax(0.0, now - token->time) : 0.0;
    return true;
}

/* The reason why the group has no friction, about *body if that is not empty; NULL: it has. */
static const char *without_friction(const struct percuss_slow *slow, const struct group *group,
                                    const char **body)
{
    const struct percuss_slow_engine *engine = &slow->config.engine;
    bool any = false;
    *body = "";
    if (slow->config.options.friction == PERCUSS_FRICTION_NONE)
        return "options.friction is none";
    if (!engine->push && !engine->apply_vector)
        return "the engine must give apply_vector or push";
    if (engine->oblique && group->count <= PERCUSS_MAX_CONTACTS_OBLIQUE)
        return NULL;
    for (size_t i = 0; i < group->count; i++) {
        const uint32_t bodies[2] = {group->contacts[i].a, group->contacts[i].b};
        for (int side = 0; side < 2; side++) {
            const struct percuss_slow_body *one = &slow->bodies[bodies[side]];
            any = any || one->free;
            *body = one->id;
            if (!one->free && !one->fixed)
                return engine->oblique ? " is not stated to be free, and the engine's oblique "
                                         "serves at most 21 contacts"
                                       : " is not stated to be free, and the engine gives no "
                                         "oblique";
        }
    }
    return any ? NULL : " is fixed, and so is the other one";
}

/* Whether the group has friction. False in *allowed: a contact states a coefficient in vain. */
static bool rubs(const struct percuss_slow *slow, struct group *group, bool *allowed)
{
    const char *body, *reason = without_friction(slow, group, &body);
    *allowed = true;
    if (!reason || slow->config.options.friction == PERCUSS_FRICTION_NONE)
        return !reason;
    for (size_t i = 0; i < group->count; i++)
        if (group->contacts[i].friction != 0.0) {
            snprintf(group->why, sizeof group->why,
                     "contact of %s and %s: friction: %g: %s%s: 0, or options.friction none, is "
                     "allowed",
                     slow->ids[group->contacts[i].a], slow->ids[group->contacts[i].b],
                     group->contacts[i].friction, body, reason);
            *allowed = false;
            break;
        }
    return false;
}

bool question_is_oblique(const struct percuss_slow *slow, const struct group *group)
{
    const char *body;
    return slow->config.service.solve && slow->config.engine.oblique &&
           group->count <= PERCUSS_MAX_CONTACTS_OBLIQUE && !without_friction(slow, group, &body);
}

bool question_has_these_masses(const struct percuss_slow *slow, struct group *group,
                               const struct percuss_request *request,
                               const struct percuss_reply *reply)
{
    for (size_t i = 0; !request->delassus && i < group->count; i++) {
        double ours = group->delassus[i * group->count + i];
        double theirs = reply->contacts[i].inverse_effective_mass;
        if (fabs(ours - theirs) <= SAME_MASSES * fabs(ours))
            continue;
        snprintf(group->why, sizeof group->why,
                 "contact of %s and %s: the inverse effective mass is %.9g 1/kg in the engine and "
                 "%.9g 1/kg in the catalogue; bodies that are stated to be free must have the same",
                 slow->ids[group->contacts[i].a], slow->ids[group->contacts[i].b], ours, theirs);
        return false;
    }
    return true;
}

bool question_make(const struct percuss_slow *slow, struct group *group, double now,
                   struct percuss_request *request)
{
    uint32_t map[PERCUSS_MAX_BODIES];
    bool allowed, slides = rubs(slow, group, &allowed);
    if (!allowed)
        return false;
    snprintf(group->why, sizeof group->why, "%zu contacts are more than one question holds",
             group->count);
    if (group->count > PERCUSS_MAX_CONTACTS)
        return false;
    request->sequence = 0;
    request->body_count = 0;
    request->contact_count = group->count;
    request->options = slow->config.options;
    /* the engine's matrix; with friction one of the tangents too, or the catalogue's */
    request->delassus = slides ? group->oblique : group->delassus;
    request->delassus_rows = slides && group->oblique ? 3 * group->count : 0;
    if (!slides)
        request->options.friction = PERCUSS_FRICTION_NONE;
    for (size_t i = 0; i < group->count; i++) {
        const struct percuss_slow_contact *from = &group->contacts[i];
        struct percuss_contact *to = &request->contacts[i];
        *to = (struct percuss_contact){0};
        memcpy(to->point, from->point, sizeof to->point);
        memcpy(to->normal, from->normal, sizeof to->normal);
        if (slides) {
            double second[3];
            to->friction = from->friction;
            memcpy(to->tangent, from->tangent, sizeof to->tangent);
            if (group->oblique)
                percuss_slow_tangents(from, to->tangent, second);
        }
        to->gap = from->gap;
        /* the pressing force balances bodies that lie together */
        bool rests = fabs(group->gap_rate[i]) <= pairs_rest_speed(slow, from, now);
        to->gap_acceleration = rests ? 0.0 : from->gap_acceleration;
        if (!enter_body(slow, group, from->a, now, request, map, &to->a) ||
            !enter_body(slow, group, from->b, now, request, map, &to->b))
            return false;
    }
    return true;
}

/* A judgement that another time would be another one is no answer. */
static enum percuss_result judge(enum percuss_status status)
{
    bool later = status == PERCUSS_BUSY || status == PERCUSS_TIMEOUT;
    return later ? PERCUSS_RESULT_TIMEOUT : PERCUSS_RESULT_INVALID_ARGUMENT;
}

enum percuss_result question_put(struct percuss_slow *slow, struct group *group,
                                 const struct percuss_request *request, struct percuss_reply *reply)
{
    const struct percuss_slow_service *service = &slow->config.service;
    *reply = (struct percuss_reply){0};
    slow->counts.requests++;
    enum percuss_result result = service->solve(service->context, request, reply);
    if (result) {
        const char *problem = service->problem ? service->problem(service->context) : "no answer";
        snprintf(group->why, sizeof group->why, "%s", problem);
        return result;
    }
    /* cut off for its effort an answer ends anywhere; at a horizon, between sub-impacts */
    bool answered = reply->status == PERCUSS_OK ||
                    (reply->status == PERCUSS_TRUNCATED && reply->end_reason != PERCUSS_END_LIMIT);
    if (answered && reply->contact_count == request->contact_count)
        return PERCUSS_RESULT_OK;
    snprintf(group->why, sizeof group->why, "%s: %s", status_name(reply->status), reply->message);
    return judge(reply->status);
}

/* Asks again without states, from rest. */
static enum percuss_result ask_from_rest(struct percuss_slow *slow, struct group *group,
                                         struct percuss_request *request,
                                         struct percuss_reply *reply)
{
    group_note(group, "%s; asked again without earlier vibration", reply->message);
    slow->config.service.release(reply);
    for (size_t i = 0; i < request->body_count; i++) {
        request->bodies[i].state[0] = '\0';
        request->bodies[i].elapsed = 0.0;
    }
    slow->counts.repeated++;
    return question_put(slow, group, request, reply);
}

/* A window that was cut off is asked for again, longer; the first answer stays if that is refused,
 * or if no answer comes and the user prefers to go on. */
static enum percuss_result ask_longer(struct percuss_slow *slow, struct group *group,
                                      struct percuss_request *request, struct percuss_reply *reply)
{
    for (int i = 0; i < MOST_LONGER && !reply->complete; i++) {
        /* ended by nothing but the length of the window */
        bool cut =
            reply->end_reason == PERCUSS_END_HORIZON || reply->end_reason == PERCUSS_END_IN_CONTACT;
        double horizon = fmin(4.0 * reply->window, LONGEST_HORIZON);
        if (!cut || !(horizon > reply->window))
            break;
        /* the same, longer */
        struct percuss_reply longer;
        double before = request->options.horizon;
        request->options.horizon = horizon;
        slow->counts.repeated++;
        enum percuss_result result = question_put(slow, group, request, &longer);
        /* refused, or not answered */
        if (result) {
            slow->config.service.release(&longer);
            request->options.horizon = before;
            if (result != PERCUSS_RESULT_INVALID_ARGUMENT && !slow->config.fall_back)
                return result;
            group_note(group, "horizon %g s: %s", horizon, group->why);
            break;
        }
        slow->config.service.release(reply);
        *reply = longer;
    }
    if (!reply->complete)
        group_note(group, "cut off after %g s: the restitution is not final", reply->window);
    return PERCUSS_RESULT_OK;
}

enum percuss_result question_ask(struct percuss_slow *slow, struct group *group,
                                 struct percuss_request *request, struct percuss_reply *reply)
{
    enum percuss_result result = question_put(slow, group, request, reply);
    if (result && reply->status == PERCUSS_UNKNOWN_STATE)
        result = ask_from_rest(slow, group, request, reply);
    return result ? result : ask_longer(slow, group, request, reply);
}

enum percuss_result question_fail(const struct percuss_slow *slow, const struct group *group,
                                  enum percuss_result result)
{
    return slow_fail(result,
                     "impact of %s and %s at %.9g s: %s; config.fall_back would go on with the "
                     "declared restitution",
                     slow->ids[group->contacts[0].a], slow->ids[group->contacts[0].b], group->start,
                     group->why);
}

void tokens_keep(struct percuss_slow *slow, const struct percuss_slow_contact *contacts,
                 const struct percuss_request *request, const struct percuss_reply *reply,
                 double time)
{
    for (size_t i = 0; i < request->contact_count; i++) {
        const uint32_t bodies[2] = {contacts[i].a, contacts[i].b};
        const uint32_t places[2] = {request->contacts[i].a, request->contacts[i].b};
        for (int side = 0; side < 2; side++) {
            struct token *token = &slow->tokens[bodies[side]];
            bool known = places[side] < reply->states_after_count;
            snprintf(token->state, sizeof token->state, "%s",
                     known ? reply->states_after[places[side]].state : "");
            token->time = time;
        }
    }
}

void tokens_restore(struct percuss_slow *slow, const struct percuss_slow_contact *contacts,
                    const struct percuss_request *request, double time)
{
    for (size_t i = 0; i < request->contact_count; i++) {
        const uint32_t bodies[2] = {contacts[i].a, contacts[i].b};
        const uint32_t places[2] = {request->contacts[i].a, request->contacts[i].b};
        for (int side = 0; side < 2; side++) {
            const struct percuss_body_motion *motion = &request->bodies[places[side]];
            struct token *token = &slow->tokens[bodies[side]];
            memcpy(token->state, motion->state, sizeof token->state);
            token->time = time - motion->elapsed;
        }
    }
}

void tokens_forget(struct percuss_slow *slow, size_t count,
                   const struct percuss_slow_contact *contacts)
{
    for (size_t i = 0; i < count; i++) {
        slow->tokens[contacts[i].a].state[0] = '\0';
        slow->tokens[contacts[i].b].state[0] = '\0';
    }
}
