/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The slow scale: its state, and the impacts that are due at an accepted state. */

#include <math.h>
#include <percuss/slowscale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "episode.h"
#include "group.h"
#include "pairs.h"
#include "question.h"
#include "touch.h"

/* One impact: the group of contacts, the question, the answer or the declared restitution. */

/* Couplings below this, relative to the contacts' own inverse masses, are rounding. */
static const double NO_COUPLING = 1e-12;

/* Change of speed by an acceleration during an impact, relative to the approach, below which it is
 * omitted. */
static const double NEGLIGIBLE = 1e-3;

/* Impacts of a contact in one call. */
enum { MOST_IMPACTS = 4 };

/* Whether an impulse at one contact is felt at the other, rigidly or through a shared body's
 * vibration. */
static bool are_coupled(const struct percuss_slow *slow, const struct group *seen, size_t i,
                        size_t j)
{
    const struct percuss_slow_contact *x = &seen->contacts[i], *y = &seen->contacts[j];
    const uint32_t shared[4][2] = {{x->a, y->a}, {x->a, y->b}, {x->b, y->a}, {x->b, y->b}};
    for (int k = 0; k < 4; k++)
        if (shared[k][0] == shared[k][1] && !slow->bodies[shared[k][0]].fixed)
            return true;
    size_t n = seen->count;
    double size = sqrt(seen->delassus[i * n + i] * seen->delassus[j * n + j]);
    return fabs(seen->delassus[i * n + j]) > NO_COUPLING * size;
}

/* Whether a contact may take part in an impact at seen->start: it touches or nearly does, or its
 * list is being played and can be revoked. Impulses applied in one go have happened. */
static bool may_join(const struct percuss_slow *slow, const struct group *seen, size_t i,
                     double now)
{
    const struct percuss_slow_contact *contact = &seen->contacts[i];
    if (episode_of(slow, contact, seen->start))
        return true;
    const struct pair *pair = pairs_find(slow, contact);
    struct approach then = touch_before(slow, contact, seen->gap_rate[i], now, now - seen->start);
    return then.gap <= slow->config.group_gap && !(pair && pair->latch == LATCH_PLAYING);
}

/* Marks `first` and all contacts coupled to it through touching pairs; returns their number. */
static size_t mark_members(const struct percuss_slow *slow, const struct group *seen, size_t first,
                           double now, bool *member)
{
    size_t count = 1;
    bool grown = true;
    member[first] = true;
    while (grown) {
        grown = false;
        for (size_t i = 0; i < seen->count; i++) {
            if (member[i] || !may_join(slow, seen, i, now))
                continue;
            for (size_t j = 0; j < seen->count && !member[i]; j++)
                member[i] = member[j] && are_coupled(slow, seen, i, j);
            count += member[i];
            grown = grown || member[i];
        }
    }
    return count;
}

/* Revokes the members' episodes, back to an instant without a sub-impact under way: the new
 * question begins there. Rates change.
 *
 *     list 1   ...[====]....[====]........   [ ] a sub-impact
 *     list 2   .......[===].....[=====]...   1 the touch, in one of list 2
 *                          3   2    1        2 before it, in one of list 1
 *                                            3 before that, in none: the start
 */
static enum percuss_result preempt(struct percuss_slow *slow, struct group *group, double now)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    /* a pause of one list may be the midst of a sub-impact of another */
    for (bool moved = true; moved;) {
        moved = false;
        for (size_t i = 0; i < group->count; i++) {
            const struct episode *episode = episode_of(slow, &group->contacts[i], group->start);
            double start = episode ? episode_pause(episode, group->start) : group->start;
            moved = moved || start < group->start;
            group->start = fmin(group->start, start);
        }
    }
    /* all go back to the same instant */
    for (size_t i = 0; !result && i < group->count; i++) {
        struct episode *episode = episode_of(slow, &group->contacts[i], group->start);
        if (episode)
            result = episode_revoke(slow, episode, group, now);
    }
    return result;
}

static bool use_declared(const struct percuss_slow *slow, struct group *group)
{
    struct percuss_slow_outcome outcome = {.impulse = group->impulse};
    for (size_t i = 0; i < group->count; i++)
        group->restitution[i] = slow->config.restitution;
    return percuss_slow_poisson(group->count, group->delassus, group->gap_rate, group->restitution,
                                &outcome);
}

static enum percuss_result report(const struct percuss_slow *slow, struct group *group)
{
    /* the coefficients that the impulses amount to, Eq. (6) */
    if (!percuss_slow_restitution(group->count, group->delassus, group->gap_rate, group->impulse,
                                  group->restitution))
        for (size_t i = 0; i < group->count; i++)
            group->restitution[i] = NAN;
    struct percuss_slow_report text = {
        .time = group->start,
        .count = group->count,
        .contacts = group->contacts,
        .gap_rate = group->gap_rate,
        .delassus = group->delassus,
        .impulse = group->impulse,
        .restitution = group->restitution,
        .reply = group->reply,
        .message = group->message,
        .declared = slow->counts.declared,
    };
    if (slow->config.report)
        slow->config.report(slow->config.report_context, &text);
    return PERCUSS_RESULT_OK;
}

/* Other bodies under the same names change the results: another server, or a catalogue that was
 * read again, is not gone over to without a word. */
static void compare_catalogue(const struct percuss_slow *slow, struct group *group)
{
    const char *revision = group->answer.catalogue_revision;
    if (slow->catalogue[0] && revision[0] && strcmp(revision, slow->catalogue) != 0)
        group_note(group, "answered with another catalogue (%.8s) than before (%.8s)", revision,
                   slow->catalogue);
}

static void keep_catalogue(struct percuss_slow *slow, const struct percuss_reply *reply)
{
    if (reply->catalogue_revision[0])
        snprintf(slow->catalogue, sizeof slow->catalogue, "%s", reply->catalogue_revision);
}

/* Asks about the group. OK with group->reply NULL: the declared restitution is to be used, which
 * takes the user's leave. */
static enum percuss_result ask(struct percuss_slow *slow, struct group *group,
                               struct percuss_request *request)
{
    if (!slow->config.service.solve)
        return PERCUSS_RESULT_OK;
    /* one question about all of them */
    enum percuss_result result = PERCUSS_RESULT_INVALID_ARGUMENT;
    if (question_make(slow, group, group->start, request))
        result = question_ask(slow, group, request, &group->answer);
    if (!result && !question_has_these_masses(slow, group, request, &group->answer))
        result = PERCUSS_RESULT_INVALID_ARGUMENT;
    /* the service's impulses */
    if (!result) {
        group->reply = &group->answer;
        compare_catalogue(slow, group);
        for (size_t i = 0; i < group->count; i++)
            group->impulse[i] = group->answer.contacts[i].impulse;
        return PERCUSS_RESULT_OK;
    }
    /* the declared restitution, with the user's leave */
    slow->config.service.release(&group->answer);
    if (!slow->config.fall_back)
        return question_fail(slow, group, result);
    group_note(group, "%s: declared restitution %g used", group->why, slow->config.restitution);
    return PERCUSS_RESULT_OK;
}

/* Begins the episode of the group's answer, or of its impulses. */
static enum percuss_result begin(struct percuss_slow *slow, struct group *group,
                                 const struct percuss_request *request, double now)
{
    size_t applied = 0;
    /* takes the place of the revoked episodes */
    slow->counts.impacts++;
    slow->counts.declared += !group->reply;
    episodes_drop_revoked(slow);
    /* the bodies' vibration is that of the answer, or unknown */
    if (group->reply) {
        keep_catalogue(slow, group->reply);
        tokens_keep(slow, group->contacts, request, group->reply,
                    group->start + group->reply->window);
    } else {
        tokens_forget(slow, group->count, group->contacts);
    }
    /* plays up to now: the start may lie before */
    enum percuss_result result = episode_begin(slow, group, request);
    if (!result)
        result = report(slow, group);
    if (!result)
        result = episodes_play(slow, now, &applied);
    if (group->reply)
        slow->config.service.release(&group->answer);
    return result;
}

/* Finds the impulses of a group that has been probed. */
static enum percuss_result find_impulses(struct percuss_slow *slow, struct group *group,
                                         struct percuss_request *request)
{
    enum percuss_result result = ask(slow, group, request);
    if (result || group->reply || use_declared(slow, group))
        return result;
    return slow_fail(PERCUSS_RESULT_INVALID_ARGUMENT,
                     "delassus: no impulses stop the approach of %zu contacts: check the engine's "
                     "matrix",
                     group->count);
}

/* The members of `all` as a group. NULL: no memory. */
static struct group *gather(const struct percuss_slow *slow, const struct group *all, size_t first,
                            double now)
{
    bool *member = calloc(all->count, sizeof *member);
    struct group *group =
        member ? group_create(slow, mark_members(slow, all, first, now, member)) : NULL;
    size_t next = 0;
    for (size_t i = 0; group && i < all->count; i++)
        if (member[i])
            group->contacts[next++] = all->contacts[i];
    if (group)
        group->start = all->start;
    free(member);
    return group;
}

/* Without config.move, impulses that are not applied at their times leave the bodies in wrong
 * places. Pressing or swinging accelerations make energy of that: TOTAL is then refused. */
static enum percuss_result check_places(const struct percuss_slow *slow, struct group *group,
                                        double now)
{
    double latest = 0.0;
    for (size_t i = 0; group->reply && !slow_moves(slow) && i < group->count; i++) {
        const struct percuss_contact_result *contact = &group->reply->contacts[i];
        double a = pairs_acceleration(slow, &group->contacts[i]);
        /* all at the start: the effect of the gap's acceleration meanwhile must be negligible */
        if (slow->config.application == PERCUSS_SLOW_TOTAL &&
            fabs(a) * contact->end_time > NEGLIGIBLE * fabs(group->gap_rate[i]))
            return slow_fail(PERCUSS_RESULT_INVALID_ARGUMENT,
                             "application: total: the gap of %s and %s accelerates with %.3g m/s^2 "
                             "during an impact of %.3g s, which would change its energy: give "
                             "config.move, or use the list",
                             slow->ids[group->contacts[i].a], slow->ids[group->contacts[i].b], a,
                             contact->end_time);
        /* of a list, impulses due before now come late */
        for (uint32_t j = 0; j < contact->sub_impacts_listed; j++)
            latest = fmax(latest,
                          now - group->start - percuss_slow_force_centre(&contact->sub_impacts[j]));
    }
    if (latest > SLOW_INSTANT)
        group_note(group, "impulses applied up to %.3g s late without config.move", latest);
    return PERCUSS_RESULT_OK;
}

/* Tells of velocities that hold at another time than they are said to, where a touch within the
 * step is found by them. */
static void check_lag(const struct percuss_slow *slow, struct group *group, double now)
{
    double step = now - slow->time, stated = slow->config.velocity_lag;
    for (size_t i = 0; now - group->start > NEGLIGIBLE * step && i < group->count; i++) {
        const struct pair *pair = pairs_find(slow, &group->contacts[i]);
        double unsaid = pair && pair->observed ? pair->lag - stated : 0.0;
        double wrong = pair ? fabs(pair->acceleration * unsaid) : 0.0; /* m/s */
        if (!(fabs(unsaid) > 0.25 * step && wrong > NEGLIGIBLE * fabs(group->gap_rate[i])))
            continue;
        group_note(group,
                   "the gap of %s and %s moved as if its rates were %.3g s old: "
                   "config.velocity_lag is %g s",
                   slow->ids[group->contacts[i].a], slow->ids[group->contacts[i].b], pair->lag,
                   stated);
        return;
    }
}

/* Revokes and asks. A failure leaves all as it was. */
static enum percuss_result prepare(struct percuss_slow *slow, struct group *group,
                                   struct percuss_request *request, double now)
{
    size_t size = slow->config.body_count * sizeof *slow->tokens;
    /* vibration as it was, should anything fail */
    struct token *tokens = malloc(size);
    if (!tokens)
        return slow_no_memory();
    memcpy(tokens, slow->tokens, size);
    /* the question is of the state of the start, which may lie before now */
    enum percuss_result result = preempt(slow, group, now);
    if (!result)
        result = group_probe(slow, group, true);
    if (!result && question_is_oblique(slow, group))
        result = group_probe_oblique(slow, group);
    if (!result)
        result = touch_go_back(slow, group, now);
    if (!result)
        check_lag(slow, group, now);
    if (!result)
        result = find_impulses(slow, group, request);
    if (!result)
        result = check_places(slow, group, now);
    /* back to where all was */
    if (result) {
        if (group->reply)
            slow->config.service.release(&group->answer);
        memcpy(slow->tokens, tokens, size);
        enum percuss_result restored = episodes_restore_revoked(slow, now);
        result = restored ? restored : result;
    }
    free(tokens);
    return result;
}

/* Solves the impact of the due contact `first` of `seen`, a group that has been probed. */
static enum percuss_result impact_solve(struct percuss_slow *slow, const struct group *seen,
                                        size_t first, double now)
{
    /* everything near as it is now, bodies and matrix included */
    struct group *all = group_create(slow, seen->count), *group = NULL;
    struct percuss_request *request = malloc(sizeof *request);
    enum percuss_result result = all && request ? PERCUSS_RESULT_OK : slow_no_memory();
    if (!result) {
        memcpy(all->contacts, seen->contacts, seen->count * sizeof *seen->contacts);
        result = group_probe(slow, all, true);
    }
    if (!result) {
        /* of these the group of the first one, when it touched */
        all->start = touch_time(slow, &all->contacts[first], all->gap_rate[first], now);
        group = gather(slow, all, first, now);
        result = group ? prepare(slow, group, request, now) : slow_no_memory();
    }
    if (!result)
        result = begin(slow, group, request, now);
    group_free(group);
    free(request);
    group_free(all);
    return result;
}

struct percuss_slow_config percuss_slow_config_default(void)
{
    return (struct percuss_slow_config){
        .application = PERCUSS_SLOW_LIST,
        .restitution = 0.5,
        .group_gap = 1e-5,
    };
}

static enum percuss_result slowscale_check(const struct percuss_slow_config *config)
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
    if ((config->engine.apply || config->engine.apply_vector) == (config->engine.push != NULL))
        return slow_fail(bad, "engine: one of apply and push must be given, or apply_vector");
    if (config->service.solve && !config->service.release)
        return slow_fail(bad, "service.release: must be given with service.solve");
    if (!(config->restitution >= 0.0 && config->restitution <= 1.0))
        return slow_fail(bad, "restitution: %g: must be in [0, 1]", config->restitution);
    if (!(config->rest_speed >= 0.0) || isinf(config->rest_speed))
        return slow_fail(bad, "rest_speed: %g: must be finite and >= 0 m/s", config->rest_speed);
    if (!(config->group_gap >= 0.0) || isinf(config->group_gap))
        return slow_fail(bad, "group_gap: %g: must be finite and >= 0 m", config->group_gap);
    if (!isfinite(config->velocity_lag))
        return slow_fail(bad, "velocity_lag: %g: must be finite, s", config->velocity_lag);
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
        result = slowscale_check(config);
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
        made->bodies[i] = config->bodies[i];
        made->bodies[i].id = made->ids[i];
    }
    made->config.bodies = made->bodies;
    made->time = NAN;
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
    for (size_t i = 0; i < count; i++) {
        group->contacts[i] = contacts[i];
        touch_lay_point(slow, &group->contacts[i]);
    }
    *result = group_probe(slow, group, false);
    if (!*result)
        return group;
    group_free(group);
    return NULL;
}

/* The contact that is due and touched first; group->count: none. */
static size_t first_due(const struct percuss_slow *slow, const struct group *group, double now)
{
    size_t first = group->count;
    double earliest = INFINITY;
    for (size_t i = 0; i < group->count; i++) {
        if (!pairs_is_due(slow, &group->contacts[i], group->gap_rate[i], now))
            continue;
        double time = touch_time(slow, &group->contacts[i], group->gap_rate[i], now);
        first = time < earliest ? i : first;
        earliest = fmin(time, earliest);
    }
    return first;
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
    group_free(group);
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

/* Impacts of one call are bounded: those that follow one another at an instant have other bodies,
 * and a pair that hits again and again within a step is due at the next call. */
static enum percuss_result solve_all(struct percuss_slow *slow, struct group *group, double now)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    for (size_t i = 0; !result && i < MOST_IMPACTS * group->count; i++) {
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
    if (!pairs_take(slow, count, group->contacts))
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
    group_free(group);
    return result;
}
