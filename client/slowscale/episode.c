/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Answers being played. */

#include "episode.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pairs.h"
#include "question.h"
#include "slow.h"

/* The order of an episode's impulses in time. */

static int by_time(const void *x, const void *y)
{
    const struct entry *a = x, *b = y;
    if (a->play != b->play)
        return a->play < b->play ? -1 : 1;
    return a->contact < b->contact ? -1 : a->contact > b->contact;
}

/* Adds `sign` times P1 t1 + P2 t2 in the world, with t1 stated and t2 = n x t1. */
static void add_tangential(const double normal[3], const double t1[3], const double along[2],
                           double sign, double sum[3])
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        double t2 = normal[j] * t1[k] - normal[k] * t1[j];
        sum[i] += sign * (along[0] * t1[i] + along[1] * t2);
    }
}

/* The sub-impacts of a contact; their sum is its impulse to the last bit that matters. */
static void list_contact(struct episode *episode, const struct percuss_contact_result *result,
                         size_t contact)
{
    const double *normal = episode->contacts[contact].normal, *t1 = result->tangent;
    bool rubs =
        result->friction > 0.0 && episode->request.options.friction != PERCUSS_FRICTION_NONE;
    double sum = 0.0, tangential[3] = {0.0};
    episode->rubs = episode->rubs || rubs;
    struct entry *first = &episode->entries[episode->entry_count];
    for (uint32_t i = 0; i < result->sub_impacts_listed; i++) {
        const struct percuss_sub_impact *sub = &result->sub_impacts[i];
        struct entry *entry = &episode->entries[episode->entry_count++];
        *entry = (struct entry){.time = episode->time + percuss_slow_force_centre(sub),
                                .start = sub->start,
                                .end = sub->end,
                                .contact = contact,
                                .impulse = sub->impulse};
        sum += sub->impulse;
        if (!rubs)
            continue;
        add_tangential(normal, t1, sub->impulse_tangential, 1.0, entry->tangential);
        add_tangential(normal, t1, sub->impulse_tangential, -1.0, tangential);
    }
    if (rubs)
        add_tangential(normal, t1, result->impulse_tangential, 1.0, tangential);
    /* rounding, or more sub-impacts than are listed */
    struct entry rest = {.time = episode->time + result->end_time,
                         .start = result->end_time,
                         .end = result->end_time,
                         .contact = contact,
                         .impulse = result->impulse - sum};
    memcpy(rest.tangential, tangential, sizeof rest.tangential);
    if (result->sub_impact_count > result->sub_impacts_listed) {
        episode->entries[episode->entry_count++] = rest;
    } else if (result->sub_impacts_listed) {
        struct entry *last = &first[result->sub_impacts_listed - 1];
        last->impulse += rest.impulse;
        for (int i = 0; i < 3; i++)
            last->tangential[i] += rest.tangential[i];
    }
}

/* The entries of an episode, in the order in which they are applied: the reply's sub-impacts at the
 * centres of their forces, or without a reply the impulses of its contacts at its time. `total`:
 * all are applied at the episode's time. */
static void list_make(struct episode *episode, const struct percuss_reply *reply,
                      const double *impulse, bool total)
{
    for (size_t i = 0; i < episode->request.contact_count; i++)
        if (reply)
            list_contact(episode, &reply->contacts[i], i);
        else if (impulse[i] != 0.0)
            episode->entries[episode->entry_count++] =
                (struct entry){.time = episode->time, .contact = i, .impulse = impulse[i]};
    for (size_t i = 0; i < episode->entry_count; i++)
        episode->entries[i].play = total ? episode->time : episode->entries[i].time;
    qsort(episode->entries, episode->entry_count, sizeof *episode->entries, by_time);
}

static const double SHORTEST_HORIZON = 1e-9; /* s, that the service allows */
static const double MARGIN = 1e-9; /* s before a sub-impact, for its touch not to be cut in two */

static void episode_free(struct episode *episode)
{
    free(episode->delassus);
    free(episode->oblique);
    free(episode->contacts);
    free(episode->entries);
    free(episode);
}

static void forget(struct percuss_slow *slow, struct episode *episode)
{
    struct episode **link = &slow->episodes;
    while (*link != episode)
        link = &(*link)->next;
    *link = episode->next;
    episode_free(episode);
}

void episodes_free(struct percuss_slow *slow)
{
    while (slow->episodes)
        forget(slow, slow->episodes);
}

static double *copy_numbers(const double *numbers, size_t count)
{
    double *copy = malloc(count * sizeof *copy);
    if (copy)
        memcpy(copy, numbers, count * sizeof *copy);
    return copy;
}

/* Room for a group's contacts, their matrix and the entries of its reply; NULL: no memory. */
static struct episode *episode_create(const struct group *group)
{
    size_t n = group->count;
    /* an entry for each sub-impact, and one for the omitted part of a contact's list */
    size_t most = n;
    for (size_t i = 0; group->reply && i < n; i++)
        most += group->reply->contacts[i].sub_impacts_listed;
    struct episode *episode = calloc(1, sizeof *episode);
    if (!episode)
        return NULL;
    episode->request.contact_count = n;
    /* the matrices are its own, as it outlives the group */
    episode->delassus = copy_numbers(group->delassus, n * n);
    episode->oblique = group->oblique ? copy_numbers(group->oblique, 9 * n * n) : NULL;
    episode->contacts = malloc(n * sizeof *episode->contacts);
    episode->entries = malloc(most * sizeof *episode->entries);
    bool matrices = episode->delassus && (episode->oblique || !group->oblique);
    if (!matrices || !episode->contacts || !episode->entries) {
        episode_free(episode);
        return NULL;
    }
    memcpy(episode->contacts, group->contacts, n * sizeof *episode->contacts);
    return episode;
}

/* From the episode's entries: in a list, the pair plays up to its last one. */
static void latch(struct percuss_slow *slow, const struct group *group,
                  const struct episode *episode, size_t contact, double now)
{
    struct pair *pair = pairs_find(slow, &group->contacts[contact]);
    bool due = pairs_is_due(slow, &group->contacts[contact], group->gap_rate[contact], now);
    if (!pair || (group->impulse[contact] == 0.0 && !due)) /* nothing happens to it */
        return;
    const struct percuss_reply *reply = group->reply;
    pair->latch = LATCH_PLAYING;
    pair->touch = episode->time;
    pair->until = pair->over = episode->time + episode->window;
    if (!reply || !reply->complete)
        return;
    pair->until = episode->time + reply->contacts[contact].end_time;
    for (size_t i = 0; episode->revocable && i < episode->entry_count; i++)
        if (episode->entries[i].contact == contact)
            pair->until = episode->entries[i].play;
}

enum percuss_result episode_begin(struct percuss_slow *slow, const struct group *group,
                                  const struct percuss_request *request)
{
    struct episode *episode = episode_create(group);
    if (!episode)
        return slow_fail(PERCUSS_RESULT_NO_MEMORY, "no memory for an answer");
    const struct percuss_reply *reply = group->reply;
    bool total = slow->config.application == PERCUSS_SLOW_TOTAL;
    /* impulses applied in one go have happened, and cannot be revoked */
    episode->time = group->start;
    episode->window = reply ? reply->window : 0.0;
    episode->revocable = reply && !total;
    /* the question is kept, for that of the vibration at another time */
    if (reply) {
        episode->request = *request;
        episode->request.delassus = !request->delassus       ? NULL
                                    : request->delassus_rows ? episode->oblique
                                                             : episode->delassus;
    }
    /* impulses at their times, until when the pairs have no other impact */
    list_make(episode, reply, group->impulse, total);
    for (size_t i = 0; i < group->count; i++)
        latch(slow, group, episode, i, group->start);
    episode->next = slow->episodes;
    slow->episodes = episode;
    return PERCUSS_RESULT_OK;
}

/* The tangential impulse of an entry as it is on a of the contact by now, whose normal may have
 * turned since the question: of the same size, in the present surface. */
static void place_tangential(const struct episode *episode, const struct entry *entry,
                             const struct percuss_slow_contact *place, double tangential[3])
{
    const double *from = entry->tangential, *n = place->normal;
    double sign = place->a == episode->contacts[entry->contact].a ? 1.0 : -1.0;
    double out = from[0] * n[0] + from[1] * n[1] + from[2] * n[2];
    double size = sqrt(from[0] * from[0] + from[1] * from[1] + from[2] * from[2]);
    double left = 0.0;
    for (int i = 0; i < 3; i++) {
        tangential[i] = from[i] - out * n[i];
        left += tangential[i] * tangential[i];
    }
    for (int i = 0; i < 3; i++)
        tangential[i] *= left > 0.0 ? sign * size / sqrt(left) : 0.0;
}

/* `normal` along the contact's normal and `tangential`, in the world. */
static void add_up(const struct percuss_slow_contact *place, double normal,
                   const double tangential[3], double vector[3])
{
    for (int i = 0; i < 3; i++)
        vector[i] = normal * place->normal[i] + tangential[i];
}

/* Changes the velocities as the engine wants to be told: of the pair, or of each body. */
static bool change_velocities(const struct percuss_slow_engine *engine,
                              const struct percuss_slow_contact *place, double impulse,
                              const double tangential[3], bool slides)
{
    if (engine->apply && !slides)
        return engine->apply(engine->context, place, impulse);
    double on_a[3], on_b[3];
    add_up(place, impulse, tangential, on_a);
    if (engine->apply_vector)
        return engine->apply_vector(engine->context, place, on_a);
    for (int i = 0; i < 3; i++)
        on_b[i] = -on_a[i];
    return engine->push(engine->context, place->a, on_a, place->point) &&
           engine->push(engine->context, place->b, on_b, place->point);
}

/* The same for positions, by the impulses' moments. */
static bool change_positions(const struct percuss_slow_config *config,
                             const struct percuss_slow_contact *place, double moment,
                             const double tangential[3], double late, bool slides)
{
    if (config->move && !(slides && config->move_vector))
        return config->move(config->engine.context, place, moment);
    double along[3], on_a[3];
    for (int i = 0; i < 3; i++)
        along[i] = tangential[i] * late;
    add_up(place, moment, along, on_a);
    return config->move_vector(config->engine.context, place, on_a);
}

/* An impulse as it is applied now: where the bodies touch, and how late it comes, s. */
struct blow {
    struct percuss_slow_contact place;
    double factor, impulse, tangential[3], late;
    bool slides;
};

/* `factor`, 1 or -1, times an entry's impulse. */
static struct blow blow_make(const struct percuss_slow *slow, const struct episode *episode,
                             const struct entry *entry, double factor, double now)
{
    /* where the bodies touch by now, if they are still near */
    const struct percuss_slow_contact *contact = &episode->contacts[entry->contact];
    const struct pair *pair = pairs_find(slow, contact);
    struct blow blow = {.place = pair ? pair->contact : *contact,
                        .factor = factor,
                        .impulse = factor * entry->impulse,
                        .late = now - entry->time};
    place_tangential(episode, entry, &blow.place, blow.tangential);
    for (int i = 0; i < 3; i++) {
        blow.tangential[i] *= factor;
        blow.slides = blow.slides || blow.tangential[i] != 0.0;
    }
    return blow;
}

/* Whether the bodies have to be set to where the impulse at its own time would have had them. */
static bool is_displaced(const struct percuss_slow *slow, const struct blow *blow)
{
    return slow_moves(slow) && fabs(blow->late) > SLOW_INSTANT;
}

/* The gap rates of the pairs seen, in their order; NULL: *result says why. */
static struct group *look_at_pairs(const struct percuss_slow *slow, enum percuss_result *result)
{
    struct group *group = group_create(slow, slow->pair_count);
    *result = group ? PERCUSS_RESULT_OK : slow_no_memory();
    if (!group)
        return NULL;
    group->count = 0;
    for (size_t i = 0; i < slow->pair_count; i++)
        if (slow->pairs[i].seen)
            group->contacts[group->count++] = slow->pairs[i].contact;
    *result = group_probe(slow, group, false);
    if (!*result)
        return group;
    group_free(group);
    return NULL;
}

static enum percuss_result push(const struct percuss_slow *slow, const struct blow *blow)
{
    const struct percuss_slow_engine *engine = &slow->config.engine;
    if (change_velocities(engine, &blow->place, blow->impulse, blow->tangential, blow->slides))
        return PERCUSS_RESULT_OK;
    bool vector = engine->apply_vector && (blow->slides || !engine->apply);
    return slow_fail(PERCUSS_RESULT_INVALID_ARGUMENT, "the engine's %s failed",
                     engine->push ? "push"
                     : vector     ? "apply_vector"
                                  : "apply");
}

/* Changes the velocities, and the gaps of all pairs that this opens or closes by as long as it is
 * late: what `shift` does to the bodies. */
static enum percuss_result kick(const struct percuss_slow *slow, const struct blow *blow)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    if (!is_displaced(slow, blow))
        return push(slow, blow);
    struct group *before = look_at_pairs(slow, &result), *after = NULL;
    if (!result)
        result = push(slow, blow);
    if (!result)
        after = look_at_pairs(slow, &result);
    size_t next = 0;
    for (size_t i = 0; !result && i < slow->pair_count; i++) {
        if (!slow->pairs[i].seen)
            continue;
        double change = after->gap_rate[next] - before->gap_rate[next];
        slow->pairs[i].contact.gap += blow->late * change;
        next++;
    }
    group_free(before);
    group_free(after);
    return result;
}

/* Moves the bodies to where the impulse at its own time would have had them. */
static enum percuss_result shift(const struct percuss_slow *slow, const struct blow *blow)
{
    double moment = blow->impulse * blow->late;
    if (!is_displaced(slow, blow) || change_positions(&slow->config, &blow->place, moment,
                                                      blow->tangential, blow->late, blow->slides))
        return PERCUSS_RESULT_OK;
    return slow_fail(PERCUSS_RESULT_INVALID_ARGUMENT, "the engine's move failed");
}

/* Applies `factor`, 1 or -1, times an entry's impulse as if it had been at the entry's time. */
static enum percuss_result apply(const struct percuss_slow *slow, const struct episode *episode,
                                 const struct entry *entry, double factor, double now)
{
    struct blow blow = blow_make(slow, episode, entry, factor, now);
    enum percuss_result result = kick(slow, &blow);
    return result ? result : shift(slow, &blow);
}

/* With friction: all impulses that have come to be applied, while the point of contact lies where
 * it was asked about, and only then the movements: an arm along the surface turns a body. */
static enum percuss_result play_rubbing(const struct percuss_slow *slow, struct episode *episode,
                                        double now, size_t *applied)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    size_t first = episode->played;
    while (!result && episode->played < episode->entry_count &&
           slow_has_come(episode->entries[episode->played].play, now)) {
        struct blow blow = blow_make(slow, episode, &episode->entries[episode->played++], 1.0, now);
        result = kick(slow, &blow);
        ++*applied;
    }
    for (size_t i = first; !result && i < episode->played; i++) {
        struct blow blow = blow_make(slow, episode, &episode->entries[i], 1.0, now);
        result = shift(slow, &blow);
    }
    return result;
}

enum percuss_result episodes_play(struct percuss_slow *slow, double now, size_t *applied)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    struct episode *next;
    for (struct episode *episode = slow->episodes; !result && episode; episode = next) {
        next = episode->next;
        if (episode->rubs)
            result = play_rubbing(slow, episode, now, applied);
        while (!result && episode->played < episode->entry_count &&
               slow_has_come(episode->entries[episode->played].play, now)) {
            const struct entry *entry = &episode->entries[episode->played++];
            result = apply(slow, episode, entry, 1.0, now);
            ++*applied;
        }
        /* a touch within this step may still lie in its window */
        if (episode->played == episode->entry_count &&
            slow->time >= episode->time + episode->window)
            forget(slow, episode);
    }
    return result;
}

struct episode *episode_of(const struct percuss_slow *slow,
                           const struct percuss_slow_contact *contact, double time)
{
    for (struct episode *episode = slow->episodes; episode; episode = episode->next)
        for (size_t i = 0; i < episode->request.contact_count; i++) {
            const struct percuss_slow_contact *own = &episode->contacts[i];
            if (episode->revocable && !episode->revoked && time < episode->time + episode->window &&
                pairs_is_same(own, contact))
                return episode;
        }
    return NULL;
}

double episode_pause(const struct episode *episode, double time)
{
    bool moved = true;
    double pause = time - episode->time;
    while (moved) {
        moved = false;
        for (size_t i = 0; i < episode->entry_count; i++)
            if (episode->entries[i].start < pause && pause < episode->entries[i].end) {
                pause = episode->entries[i].start - MARGIN;
                moved = true;
            }
    }
    return pause > 0.0 ? episode->time + pause : episode->time;
}

/* The vibration of the episode's bodies at `time` from its start: that of the start, or by a
 * question up to then. */
static enum percuss_result take_vibration(struct percuss_slow *slow, struct episode *episode,
                                          struct group *group, double time)
{
    struct percuss_reply reply;
    if (time < SHORTEST_HORIZON) {
        tokens_restore(slow, episode->contacts, &episode->request, episode->time);
        return PERCUSS_RESULT_OK;
    }
    /* the same question, but for its end */
    struct percuss_request *request = &episode->request;
    double horizon = request->options.horizon;
    request->options.horizon = time;
    slow->counts.preempted++;
    enum percuss_result result = question_put(slow, group, request, &reply);
    request->options.horizon = horizon;
    /* unknown, the bodies go on without vibration if the user prefers that to a failure */
    if (!result) {
        tokens_keep(slow, episode->contacts, request, &reply, episode->time + time);
    } else if (result == PERCUSS_RESULT_INVALID_ARGUMENT || slow->config.fall_back) {
        tokens_forget(slow, request->contact_count, episode->contacts);
        group_note(group, "vibration unknown: %s", group->why);
        result = PERCUSS_RESULT_OK;
    }
    slow->config.service.release(&reply);
    return result ? question_fail(slow, group, result) : result;
}

/* A movement along the normal and by a vector along the surface, world, in the directions of a
 * contact. */
static void split_moment(const struct percuss_slow_contact *contact, double normal,
                         const double along[3], double moment[3])
{
    double tangent[2][3];
    percuss_slow_tangents(contact, tangent[0], tangent[1]);
    moment[0] = normal;
    for (int t = 0; t < 2; t++)
        moment[1 + t] =
            along[0] * tangent[t][0] + along[1] * tangent[t][1] + along[2] * tangent[t][2];
}

/* Adds an entry's impulse times how long it had been there. */
static void add_moved(const struct percuss_slow_contact *now,
                      const struct percuss_slow_contact *then, const struct entry *entry,
                      double late, double moved[3])
{
    /* the same two bodies may be the other way round by now */
    double along[3], moment[3], sign = now->a == then->a ? late : -late;
    for (int i = 0; i < 3; i++)
        along[i] = sign * entry->tangential[i];
    split_moment(now, entry->impulse * late, along, moment);
    for (int i = 0; i < 3; i++)
        moved[i] += moment[i];
}

/* Takes an impulse back that belongs to a sub-impact after the group's start. */
static enum percuss_result take_back(const struct percuss_slow *slow, const struct episode *episode,
                                     struct entry *entry, struct group *group, double now)
{
    const struct percuss_slow_contact *contact = &episode->contacts[entry->contact];
    for (size_t i = 0; i < group->count; i++)
        if (pairs_is_same(&group->contacts[i], contact))
            add_moved(&group->contacts[i], contact, entry, now - entry->time, &group->moved[3 * i]);
    entry->taken_back = true;
    return apply(slow, episode, entry, -1.0, now);
}

enum percuss_result episode_revoke(struct percuss_slow *slow, struct episode *episode,
                                   struct group *group, double now)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    double time = fmax(0.0, group->start - episode->time);
    size_t revoked = 0;
    episode->revoked = true;
    for (size_t i = 0; !result && i < episode->entry_count; i++) {
        struct entry *entry = &episode->entries[i];
        /* has happened, and was applied before its end; back at the start, nothing has: an entry
         * before it on a ringing body belongs to the same question */
        if (entry->end <= time && time >= SHORTEST_HORIZON)
            continue;
        revoked++;
        if (i < episode->played)
            result = take_back(slow, episode, entry, group, now);
    }
    if (!result && time < episode->window)
        result = take_vibration(slow, episode, group, time);
    if (revoked)
        group_note(group, "%zu sub-impacts of the impact at %.9g s revoked", revoked,
                   episode->time);
    return result;
}

void episodes_drop_revoked(struct percuss_slow *slow)
{
    struct episode *next;
    for (struct episode *episode = slow->episodes; episode; episode = next) {
        next = episode->next;
        if (!episode->revoked)
            continue;
        for (size_t i = 0; i < episode->request.contact_count; i++) {
            struct pair *pair = pairs_find(slow, &episode->contacts[i]);
            if (pair)
                pair->latch = LATCH_WAITING; /* its further sub-impacts belong to the new answer */
        }
        forget(slow, episode);
    }
}

enum percuss_result episodes_restore_revoked(struct percuss_slow *slow, double now)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    for (struct episode *episode = slow->episodes; episode; episode = episode->next) {
        for (size_t i = 0; !result && i < episode->entry_count; i++)
            if (episode->entries[i].taken_back)
                result = apply(slow, episode, &episode->entries[i], 1.0, now);
        for (size_t i = 0; i < episode->entry_count; i++)
            episode->entries[i].taken_back = false;
        episode->revoked = false;
    }
    return result;
}
