/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <stdlib.h>

#include "pairs.h"

static bool is_same(const struct percuss_slow_contact *x, const struct percuss_slow_contact *y)
{
    return x->a == y->a && x->b == y->b && x->feature == y->feature;
}

struct pair *pairs_find(const struct percuss_slow *slow, const struct percuss_slow_contact *contact)
{
    for (size_t i = 0; i < slow->pair_count; i++)
        if (is_same(&slow->pairs[i].contact, contact))
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
    *pair = (struct pair){.latch = LATCH_ARMED};
    return pair;
}

bool pairs_take(struct percuss_slow *slow, size_t count,
                const struct percuss_slow_contact *contacts)
{
    for (size_t i = 0; i < slow->pair_count; i++)
        slow->pairs[i].seen = false;
    for (size_t i = 0; i < count; i++) {
        struct pair *pair = pairs_find(slow, &contacts[i]);
        if (!pair)
            pair = add(slow);
        if (!pair)
            return false;
        pair->contact = contacts[i];
        pair->seen = true;
    }
    size_t kept = 0;
    for (size_t i = 0; i < slow->pair_count; i++)
        if (slow->pairs[i].seen || slow->pairs[i].latch == LATCH_PLAYING)
            slow->pairs[kept++] = slow->pairs[i];
    slow->pair_count = kept;
    return true;
}

void pairs_update(struct percuss_slow *slow, double now)
{
    for (size_t i = 0; i < slow->pair_count; i++) {
        struct pair *pair = &slow->pairs[i];
        if (pair->latch == LATCH_PLAYING && now >= pair->until)
            pair->latch = pair->continues ? LATCH_ARMED : LATCH_WAITING;
        bool apart = !pair->seen || pair->contact.gap > 0.0 || pair->gap_rate >= 0.0;
        if (pair->latch == LATCH_WAITING && apart)
            pair->latch = LATCH_ARMED;
    }
}

bool pairs_is_due(const struct percuss_slow *slow, const struct percuss_slow_contact *contact,
                  double gap_rate)
{
    const struct pair *pair = pairs_find(slow, contact);
    return contact->gap <= 0.0 && gap_rate < -slow->config.rest_speed &&
           (!pair || pair->latch == LATCH_ARMED);
}

bool percuss_slow_rests(const struct percuss_slow *slow, uint32_t a, uint32_t b, uint32_t feature)
{
    struct percuss_slow_contact key = {.a = a, .b = b, .feature = feature};
    const struct pair *pair = pairs_find(slow, &key);
    return pair && pair->latch != LATCH_PLAYING && pair->contact.gap <= slow->config.group_gap &&
           pair->gap_rate >= -slow->config.rest_speed && pair->gap_rate <= slow->config.rest_speed;
}
