/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdlib.h>

#include "pairs.h"

static const double SLOWEST = 1e-3; /* m/s: rounding and the engine's own contact stay below */
static const double GRAVITY = 9.81; /* m/s^2: presses a pair of unknown acceleration */
static const double ALLOWANCE =
    1.5; /* times the change by one step, for accelerations that change */

bool pairs_is_same(const struct percuss_slow_contact *x, const struct percuss_slow_contact *y)
{
    bool straight = x->a == y->a && x->b == y->b;
    bool flipped = x->a == y->b && x->b == y->a;
    return (straight || flipped) && x->feature == y->feature;
}

struct pair *pairs_find(const struct percuss_slow *slow, const struct percuss_slow_contact *contact)
{
    for (size_t i = 0; i < slow->pair_count; i++)
        if (pairs_is_same(&slow->pairs[i].contact, contact))
            return &slow->pairs[i];
    return NULL;
}

static struct pair *add(struct percuss_slow *slow)
{
    if (slow->pair_count == slow->pair_capacity) {
        size_t capacity = slow->pair_capacity ? 2 * slow->pair_capacity : 16;
        struct pair *pairs = realloc(slow->pairs, capacity * sizeof *pairs);
        if (!pairs)
            return NULL;
        slow->pairs = pairs;
        slow->pair_capacity = capacity;
    }
    struct pair *pair = &slow->pairs[slow->pair_count++];
    *pair = (struct pair){.latch = LATCH_ARMED, .when = NAN, .over = -INFINITY, .touch = -INFINITY};
    return pair;
}

bool pairs_take(struct percuss_slow *slow, size_t count,
                const struct percuss_slow_contact *contacts)
{
    for (size_t i = 0; i < slow->pair_count; i++)
        slow->pairs[i].seen = false;
    /* the pairs that the engine reports, known or new */
    for (size_t i = 0; i < count; i++) {
        struct pair *pair = pairs_find(slow, &contacts[i]);
        if (!pair)
            pair = add(slow);
        if (!pair)
            return false;
        pair->gap_before = pair->contact.gap;
        pair->contact = contacts[i];
        pair->seen = true;
    }
    /* the pairs that it reports no longer */
    size_t kept = 0;
    for (size_t i = 0; i < slow->pair_count; i++) {
        if (!slow->pairs[i].seen && slow->pairs[i].latch != LATCH_PLAYING)
            continue;
        slow->pairs[kept] = slow->pairs[i];
        if (!slow->pairs[kept].seen) /* impulses may change its rate meanwhile */
            slow->pairs[kept].when = NAN;
        kept++;
    }
    slow->pair_count = kept;
    return true;
}

void pairs_observe(struct percuss_slow *slow, size_t count,
                   const struct percuss_slow_contact *contacts, const double *gap_rate, double now)
{
    for (size_t i = 0; i < count; i++) {
        struct pair *pair = pairs_find(slow, &contacts[i]);
        if (!(now > pair->when)) /* always, if that is unknown */
            continue;
        pair->observed = true;
        double step = now - pair->when;
        pair->acceleration = (gap_rate[i] - pair->gap_rate) / step;
        /* a parabola's chord has the mean rate */
        double chord = (contacts[i].gap - pair->gap_before) / step;
        pair->lag = (chord - 0.5 * (gap_rate[i] + pair->gap_rate)) / pair->acceleration;
    }
}

void pairs_give_gaps(const struct percuss_slow *slow, size_t count,
                     struct percuss_slow_contact *contacts)
{
    for (size_t i = 0; i < count; i++)
        contacts[i].gap = pairs_find(slow, &contacts[i])->contact.gap;
}

/* The acceleration that presses a pair together, m/s^2. */
static double pressing(const struct percuss_slow_contact *contact)
{
    return contact->gap_acceleration != 0.0 ? fmax(0.0, -contact->gap_acceleration) : GRAVITY;
}

double pairs_acceleration(const struct percuss_slow *slow,
                          const struct percuss_slow_contact *contact)
{
    const struct pair *pair = pairs_find(slow, contact);
    return contact->gap_acceleration != 0.0 || !pair ? contact->gap_acceleration
                                                     : pair->acceleration;
}

bool pairs_knows_acceleration(const struct percuss_slow *slow,
                              const struct percuss_slow_contact *contact)
{
    const struct pair *pair = pairs_find(slow, contact);
    return contact->gap_acceleration != 0.0 || (pair && pair->observed);
}

/* A pair that lay together without approach at the last call can approach only by the pressing
 * acceleration since then, for one step: that is a permanent contact. An approach from further
 * away, or a faster one, is an impact, however slow. */
double pairs_rest_speed(const struct percuss_slow *slow, const struct percuss_slow_contact *contact,
                        double now)
{
    if (slow->config.rest_speed > 0.0)
        return slow->config.rest_speed;
    const struct pair *pair = pairs_find(slow, contact);
    if (!pair || !pair->lies)
        return SLOWEST;
    return fmax(SLOWEST, pair->had + ALLOWANCE * pressing(contact) * (now - slow->time));
}

/* The rate by which a pair is judged, m/s: that of the state or, where the engine's velocities lag,
 * that of its path, whichever approaches more slowly. A body that lies still has but one of them
 * that is 0. */
static double slower_rate(const struct percuss_slow *slow,
                          const struct percuss_slow_contact *contact, double gap_rate)
{
    double path = gap_rate + pairs_acceleration(slow, contact) * slow->config.velocity_lag;
    return fmax(gap_rate, path);
}

bool pairs_is_due(const struct percuss_slow *slow, const struct percuss_slow_contact *contact,
                  double gap_rate, double now)
{
    const struct pair *pair = pairs_find(slow, contact);
    return contact->gap <= 0.0 && (!pair || pair->latch == LATCH_ARMED) &&
           slower_rate(slow, contact, gap_rate) < -pairs_rest_speed(slow, contact, now);
}

/* How far apart bodies still lie together: a flight that one step of the engine cannot resolve is
 * none, where its acceleration is known. */
static double lying_gap(const struct percuss_slow *slow, const struct pair *pair, double step)
{
    bool known = slow->config.rest_speed == 0.0 && pair->contact.gap_acceleration != 0.0;
    return fmax(slow->config.group_gap, known ? pressing(&pair->contact) * step * step : 0.0);
}

static bool touches(const struct percuss_slow *slow, const struct pair *pair, double now)
{
    return pair->seen && pair->contact.gap <= lying_gap(slow, pair, now - slow->time);
}

/* A pair that touched within this step and has turned round since then made a flight that is none
 * as well. */
static void settle(const struct percuss_slow *slow, struct pair *pair, double now)
{
    bool hit = pair->touch > slow->time;
    double turned = hit ? pressing(&pair->contact) * (now - pair->touch) : 0.0;
    double slow_enough = pairs_rest_speed(slow, &pair->contact, now) + turned;
    pair->lies = touches(slow, pair, now) && pair->latch == LATCH_ARMED &&
                 slower_rate(slow, &pair->contact, pair->gap_rate) >= -slow_enough;
    /* above the touch the engine's own contact could not act yet */
    pair->had = pair->contact.gap > 0.0 ? fmax(0.0, -pair->gap_rate) : 0.0;
}

void pairs_update(struct percuss_slow *slow, double now)
{
    for (size_t i = 0; i < slow->pair_count; i++) {
        struct pair *pair = &slow->pairs[i];
        if (pair->latch == LATCH_PLAYING && slow_has_come(pair->until, now))
            pair->latch = LATCH_WAITING;
        bool apart = !pair->seen || pair->contact.gap > 0.0 || pair->gap_rate >= 0.0;
        if (pair->latch == LATCH_WAITING && (apart || slow_has_come(pair->over, now)))
            pair->latch = LATCH_ARMED;
        if (pair->touch > slow->time && pair->gap_rate < 0.0)
            settle(slow, pair, now);
    }
}

void pairs_settle(struct percuss_slow *slow, double now)
{
    for (size_t i = 0; i < slow->pair_count; i++) {
        struct pair *pair = &slow->pairs[i];
        double slow_enough = pairs_rest_speed(slow, &pair->contact, now);
        settle(slow, pair, now);
        pair->rests = touches(slow, pair, now) && pair->latch != LATCH_PLAYING &&
                      fabs(pair->gap_rate) <= slow_enough;
    }
}

bool percuss_slow_rests(const struct percuss_slow *slow, uint32_t a, uint32_t b, uint32_t feature)
{
    if (SLOW_NULL(slow))
        return false;
    struct percuss_slow_contact key = {.a = a, .b = b, .feature = feature};
    const struct pair *pair = pairs_find(slow, &key);
    return pair && pair->rests;
}
