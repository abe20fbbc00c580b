/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/placed.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The key's numbers, one behind the other. */
struct place {
    double point[3], normal[3];
    struct pose poses[2];
    struct body bodies[2];
};

struct placed {
    uint64_t mark; /* of the one that was asked for last; 0: none */
    bool whole;    /* what follows is filled */
    struct place place;
    struct contact_side sides[2];
    struct hertz_contact hertz;
};

struct placed_store {
    struct placed places[PLACED_PLACES]; /* by their marks */
};

struct placed_store *placed_store_create(void)
{
    return calloc(1, sizeof(struct placed_store));
}

void placed_store_free(struct placed_store *store)
{
    free(store);
}

static uint64_t mix(uint64_t mark, const double vector[3])
{
    uint64_t bits[3];
    memcpy(bits, vector, sizeof bits);
    for (int i = 0; i < 3; i++)
        mark = (mark ^ bits[i] ^ bits[i] >> 32) * 0xff51afd7ed558ccdu;
    return mark;
}

/* By where the contact and its bodies are. */
static uint64_t mark_of(const struct placed_key *key)
{
    uint64_t mark = mix(mix(1, key->point), key->normal);
    return mix(mix(mark, key->poses[0]->position), key->poses[1]->position);
}

static bool is_of(const struct place *place, const struct placed_key *key)
{
    bool same = memcmp(place->point, key->point, sizeof place->point) == 0 &&
                memcmp(place->normal, key->normal, sizeof place->normal) == 0;
    for (int which = 0; same && which < 2; which++)
        same = memcmp(&place->poses[which], key->poses[which], sizeof place->poses[which]) == 0 &&
               memcmp(&place->bodies[which], key->bodies[which], sizeof *place->bodies) == 0;
    return same;
}

bool placed_find(struct placed_store *store, const struct placed_key *key,
                 struct contact_side sides[2], struct hertz_contact *hertz, struct placed **room)
{
    *room = NULL;
    if (key->bodies[0]->mesh || key->bodies[1]->mesh)
        return false;
    uint64_t mark = mark_of(key);
    struct placed *found = &store->places[mark >> 32 & (PLACED_PLACES - 1)];
    if (found->mark != mark) {
        found->mark = mark;
        found->whole = false;
        return false;
    }
    *room = found;
    if (!found->whole || !is_of(&found->place, key))
        return false;
    memcpy(sides, found->sides, sizeof found->sides);
    *hertz = found->hertz;
    return true;
}

void placed_keep(struct placed *room, const struct placed_key *key,
                 const struct contact_side sides[2], const struct hertz_contact *hertz)
{
    memcpy(room->place.point, key->point, sizeof room->place.point);
    memcpy(room->place.normal, key->normal, sizeof room->place.normal);
    for (int which = 0; which < 2; which++) {
        memcpy(&room->place.poses[which], key->poses[which], sizeof *room->place.poses);
        memcpy(&room->place.bodies[which], key->bodies[which], sizeof *room->place.bodies);
    }
    memcpy(room->sides, sides, sizeof room->sides);
    room->hertz = *hertz;
    room->whole = true;
}
