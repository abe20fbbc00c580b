/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdlib.h>

#include "pairs.h"
#include "touch.h"

struct approach touch_before(const struct percuss_slow *slow,
                             const struct percuss_slow_contact *contact, double gap_rate,
                             double now, double back)
{
    bool rests = fabs(gap_rate) <= pairs_rest_speed(slow, contact, now);
    double a = rests ? 0.0 : pairs_acceleration(slow, contact);
    double rate = gap_rate + a * slow->config.velocity_lag; /* of the path, at `now` */
    return (struct approach){contact->gap - back * (rate - 0.5 * a * back), rate - a * back};
}

/* The smallest s > 0 with gap - rate s + a s^2 / 2 = 0, for gap <= 0 and rate < 0, by the formula
 * that loses no digits; 0: the gap was never open. */
static double time_since_touch(double gap, double rate, double a)
{
    double squared = rate * rate - 2.0 * a * gap;
    return rate < 0.0 && squared > 0.0 ? -2.0 * gap / (sqrt(squared) - rate) : 0.0;
}

double touch_time(const struct percuss_slow *slow, const struct percuss_slow_contact *contact,
                  double gap_rate, double now)
{
    /* an acceleration that is left out would make energy */
    if (!slow_moves(slow) || !pairs_knows_acceleration(slow, contact))
        return now;
    const struct pair *pair = pairs_find(slow, contact);
    struct approach present = touch_before(slow, contact, gap_rate, now, 0.0);
    double s = time_since_touch(present.gap, present.rate, pairs_acceleration(slow, contact));
    if (s > now - slow->time) /* never, before the first call has ended */
        s = now - slow->time;
    if (pair && s > now - pair->over)
        s = now - pair->over;
    /* on the side where they overlap */
    s = fmax(0.0, s - SLOW_INSTANT);
    struct approach then = touch_before(slow, contact, gap_rate, now, s);
    return then.rate < -pairs_rest_speed(slow, contact, now) ? now - s : now;
}

/* The share of a in where the point lies between the surfaces, 0..1: 1 on its own. */
static double share_of_a(const struct percuss_slow *slow,
                         const struct percuss_slow_contact *contact)
{
    bool a = slow->bodies[contact->a].fixed, b = slow->bodies[contact->b].fixed;
    return a == b ? 0.5 : b ? 1.0 : 0.0;
}

void touch_lay_point(const struct percuss_slow *slow, struct percuss_slow_contact *contact)
{
    /* a's surface is where b's is, and `gap` along the normal from there */
    double along = fmin(0.0, contact->gap) * (share_of_a(slow, contact) - 0.5);
    for (int k = 0; k < 3; k++)
        contact->point[k] += along * contact->normal[k];
}

/* Change of the gap of contact i by the impulses taken back, which had been there for a while: by
 * the engine's matrices; without `oblique` by the parts along the normals. */
static double gap_change(const struct group *group, size_t i)
{
    size_t n = group->count;
    double change = 0.0;
    for (size_t j = 0; j < n; j++) {
        const double *moment = &group->moved[3 * j];
        const double *w = group->oblique ? &group->oblique[9 * n * i + 3 * j] : NULL;
        change += w ? w[0] * moment[0] + w[1] * moment[1] + w[2] * moment[2]
                    : group->delassus[i * n + j] * moment[0];
    }
    return change;
}

/* A body at the group's start against now. */
struct place {
    bool known;
    double moved[3], faster[3]; /* m, m/s */
};

/* The place of one body of a contact, from that of the other one: further apart by `opened` along
 * the normal, and by `faster` in its rate. */
static void place_body(const struct percuss_slow_contact *contact, bool is_a,
                       struct approach change, struct place *places)
{
    const struct place *other = &places[is_a ? contact->b : contact->a];
    struct place *place = &places[is_a ? contact->a : contact->b];
    double sign = is_a ? 1.0 : -1.0;
    for (int k = 0; k < 3; k++) {
        place->moved[k] = other->moved[k] + sign * change.gap * contact->normal[k];
        place->faster[k] = other->faster[k] + sign * change.rate * contact->normal[k];
    }
    place->known = true;
}

/* Places every body that touches a known one; whether there was any. */
static bool place_neighbours(const struct group *group, const struct approach *change,
                             struct place *places)
{
    bool any = false;
    for (size_t i = 0; i < group->count; i++) {
        const struct percuss_slow_contact *contact = &group->contacts[i];
        bool a = places[contact->a].known, b = places[contact->b].known;
        if (a != b)
            place_body(contact, b, change[i], places);
        any = any || a != b;
    }
    return any;
}

/* Goes from body to body through the contacts, from the fixed bodies and, where these are not
 * coupled to any, from one of them that stays: only relative places count. In a ring of contacts
 * the last one has what the others lead to. */
static void place_bodies(const struct percuss_slow *slow, const struct group *group,
                         const struct approach *change, struct place *places)
{
    for (size_t i = 0; i < slow->config.body_count; i++)
        places[i].known = slow->bodies[i].fixed;
    for (size_t i = 0; i < group->count; i++) {
        while (place_neighbours(group, change, places))
            continue;
        places[group->contacts[i].b].known = true;
    }
    while (place_neighbours(group, change, places))
        continue;
}

static void set_back(const struct percuss_slow *slow, struct group *group,
                     const struct place *places)
{
    for (size_t i = 0; i < group->count; i++) {
        struct percuss_slow_contact *contact = &group->contacts[i];
        const struct place *a = &places[contact->a], *b = &places[contact->b];
        double share = share_of_a(slow, contact);
        for (int k = 0; k < 3; k++) /* with the surface that it lies on, or halfway between them */
            contact->point[k] += share * a->moved[k] + (1.0 - share) * b->moved[k];
    }
}

enum percuss_result touch_go_back(const struct percuss_slow *slow, struct group *group, double now)
{
    size_t n = group->count, bodies = slow->config.body_count;
    struct approach *change = calloc(n, sizeof *change);
    struct place *places = calloc(bodies, sizeof *places);
    enum percuss_result result = change && places ? PERCUSS_RESULT_OK : slow_no_memory();
    for (size_t i = 0; !result && i < n; i++) {
        struct percuss_slow_contact *contact = &group->contacts[i];
        double here = contact->gap, rate = group->gap_rate[i];
        /* motion from the start on, without the impulses taken back, led to this gap now */
        contact->gap -= gap_change(group, i);
        if (slow_moves(slow)) /* where the bodies are by now */
            pairs_find(slow, contact)->contact.gap = here = contact->gap;
        struct approach then = touch_before(slow, contact, rate, now, now - group->start);
        contact->gap = then.gap;
        group->gap_rate[i] = then.rate;
        /* overlapping surfaces are parted to where they touch; further apart the gap says it */
        change[i] = (struct approach){fmin(0.0, then.gap) - fmin(0.0, here), then.rate - rate};
    }
    if (!result) {
        place_bodies(slow, group, change, places);
        set_back(slow, group, places);
    }
    for (size_t i = 0; !result && i < bodies; i++)
        for (int k = 0; k < 3; k++) {
            group->bodies[i].position[k] += places[i].moved[k];
            group->bodies[i].velocity[k] += places[i].faster[k];
        }
    free(change);
    free(places);
    return result;
}
