/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <percuss/slowscale.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "episode.h"
#include "group.h"
#include "impact.h"
#include "pairs.h"

struct percuss_slow_config percuss_slow_config_default(void)
{
    return (struct percuss_slow_config){
        .application = PERCUSS_SLOW_LIST,
        .restitution = 0.5,
        .group_gap = 1e-5,
    };
}

static enum percuss_result check(const struct percuss_slow_config *config)
{
    const enum percuss_result bad = PERCUSS_RESULT_INVALID_ARGUMENT;
    if (config->body_count == 0 || !config->bodies)
        return slow_fail(bad, "body_count: %zu: at least 1 body is needed", config->body_count);
    for (size_t i = 0; i < config->body_count; i++)
        if (!config->bodies[i].id || !config->bodies[i].id[0] ||
            strlen(config->bodies[i].id) >= PERCUSS_ID_SIZE)
            return slow_fail(bad, "bodies[%zu].id: must be a name of 1 to %d bytes", i,
                             PERCUSS_ID_SIZE - 1);
    if (!config->engine.probe || !config->engine.now)
        return slow_fail(bad, "engine: probe and now must both be given");
    if (!config->engine.apply == !config->engine.push)
        return slow_fail(bad, "engine: one of apply and push must be given");
    if (config->service.solve && !config->service.release)
        return slow_fail(bad, "service.release: must be given with service.solve");
    if (!(config->restitution >= 0.0 && config->restitution <= 1.0))
        return slow_fail(bad, "restitution: %g: must be in [0, 1]", config->restitution);
    if (!(config->rest_speed >= 0.0) || isinf(config->rest_speed))
        return slow_fail(bad, "rest_speed: %g: must be finite and >= 0 m/s", config->rest_speed);
    if (!(config->group_gap >= 0.0) || isinf(config->group_gap))
        return slow_fail(bad, "group_gap: %g: must be finite and >= 0 m", config->group_gap);
    if (config->application != PERCUSS_SLOW_LIST && config->application != PERCUSS_SLOW_TOTAL)
        return slow_fail(bad, "application: %u: must be 0 (list) or 1 (total)",
                         (unsigned)config->application);
    return PERCUSS_RESULT_OK;
}

enum percuss_result percuss_slow_create(const struct percuss_slow_config *config,
                                        struct percuss_slow **slow)
{
    if (slow)
        *slow = NULL;
    enum percuss_result result = SLOW_NULL(config, slow);
    if (!result)
        result = check(config);
    if (result)
        return result;
    struct percuss_slow *made = calloc(1, sizeof *made);
    if (made) {
        made->config = *config;
        made->ids = calloc(config->body_count, sizeof *made->ids);
        made->bodies = calloc(config->body_count, sizeof *made->bodies);
        made->tokens = calloc(config->body_count, sizeof *made->tokens);
    }
    if (!made || !made->ids || !made->bodies || !made->tokens) {
        percuss_slow_free(made);
        return slow_fail(PERCUSS_RESULT_NO_MEMORY, "no memory for %zu bodies", config->body_count);
    }
    for (size_t i = 0; i < config->body_count; i++) {
        strcpy(made->ids[i], config->bodies[i].id);
        made->bodies[i] = (struct percuss_slow_body){made->ids[i], config->bodies[i].fixed};
    }
    made->config.bodies = made->bodies;
    *slow = made;
    return PERCUSS_RESULT_OK;
}

void percuss_slow_free(struct percuss_slow *slow)
{
    if (!slow)
        return;
    episodes_free(slow);
    free(slow->pairs);
    free(slow->tokens);
    free(slow->bodies);
    free(slow->ids);
    free(slow);
}

struct percuss_slow_counts percuss_slow_counts(const struct percuss_slow *slow)
{
    return SLOW_NULL(slow) ? (struct percuss_slow_counts){0} : slow->counts;
}

double percuss_slow_next(const struct percuss_slow *slow)
{
    double next = INFINITY;
    if (SLOW_NULL(slow))
        return next;
    for (const struct episode *episode = slow->episodes; episode; episode = episode->next)
        if (episode->played < episode->entry_count)
            next = fmin(next, episode->entries[episode->played].play);
    return next;
}

/* A group of these contacts with their rates; NULL with *result set. */
static struct group *look(const struct percuss_slow *slow, size_t count,
                          const struct percuss_slow_contact *contacts, enum percuss_result *result)
{
    for (size_t i = 0; i < count; i++)
        if (contacts[i].a >= slow->config.body_count || contacts[i].b >= slow->config.body_count ||
            contacts[i].a == contacts[i].b) {
            *result = slow_fail(PERCUSS_RESULT_INVALID_ARGUMENT,
                                "contacts[%zu]: bodies %u and %u: must be two different ones below "
                                "%zu",
                                i, contacts[i].a, contacts[i].b, slow->config.body_count);
            return NULL;
        }
    struct group *group = group_create(slow, count);
    if (!group) {
        *result = slow_fail(PERCUSS_RESULT_NO_MEMORY, "no memory for %zu contacts", count);
        return NULL;
    }
    if (count)
        memcpy(group->contacts, contacts, count * sizeof *contacts);
    *result = group_probe(slow, group, false);
    if (!*result)
        return group;
    free(group);
    return NULL;
}

static size_t first_due(const struct percuss_slow *slow, const struct group *group, double now)
{
    size_t i = 0;
    while (i < group->count && !pairs_is_due(slow, &group->contacts[i], group->gap_rate[i], now))
        i++;
    return i;
}

bool percuss_slow_due(const struct percuss_slow *slow, size_t count,
                      const struct percuss_slow_contact *contacts)
{
    if (SLOW_NULL(slow) || (count > 0 && SLOW_NULL(contacts)))
        return false;
    /* nothing that does not touch can be due: most trial states end here */
    bool touches = false;
    for (size_t i = 0; i < count; i++)
        touches = touches || contacts[i].gap <= 0.0;
    enum percuss_result result = PERCUSS_RESULT_OK;
    struct group *group = touches ? look(slow, count, contacts, &result) : NULL;
    double now = slow->config.engine.now(slow->config.engine.context);
    bool due = group && first_due(slow, group, now) < count;
    free(group);
    return due;
}

/* Velocities and places have changed, or time has gone on: the latches see the rates of now. */
static enum percuss_result see_rates(struct percuss_slow *slow, struct group *group, bool changed,
                                     double now)
{
    enum percuss_result result = changed ? group_probe(slow, group, false) : PERCUSS_RESULT_OK;
    for (size_t i = 0; !result && i < group->count; i++) {
        struct pair *pair = pairs_find(slow, &group->contacts[i]);
        pair->gap_rate = group->gap_rate[i];
        pair->when = now;
    }
    pairs_give_gaps(slow, group->count, group->contacts);
    if (!result)
        pairs_update(slow, now);
    return result;
}

/* Impacts of one call are bounded: those that follow one another at an instant have other bodies.
 */
static enum percuss_result solve_all(struct percuss_slow *slow, struct group *group, double now)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    for (size_t i = 0; !result && i <= group->count; i++) {
        size_t first = first_due(slow, group, now);
        if (first == group->count)
            break;
        result = impact_solve(slow, group, first, now);
        if (!result)
            result = see_rates(slow, group, true, now);
    }
    return result;
}

enum percuss_result percuss_slow_advance(struct percuss_slow *slow, size_t count,
                                         const struct percuss_slow_contact *contacts)
{
    enum percuss_result result;
    size_t applied = 0;
    if (SLOW_NULL(slow) || (count > 0 && SLOW_NULL(contacts)))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    double now = slow->config.engine.now(slow->config.engine.context);
    struct group *group = look(slow, count, contacts, &result);
    if (!group)
        return result;
    if (!pairs_take(slow, count, contacts))
        result = slow_fail(PERCUSS_RESULT_NO_MEMORY, "no memory for %zu pairs", count);
    if (!result) {
        pairs_observe(slow, count, group->contacts, group->gap_rate, now);
        result = episodes_play(slow, now, &applied);
    }
    if (!result)
        result = see_rates(slow, group, applied > 0, now);
    if (!result)
        result = solve_all(slow, group, now);
    if (!result) {
        pairs_settle(slow, now);
        slow->time = now;
    }
    free(group);
    return result;
}
