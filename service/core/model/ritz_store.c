/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/ritz_store.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>

#include "base/watch.h"

/* Cached flexibilities of a box, one for each place. */
enum { PLACES = 64 };

struct ritz_box {
    struct ritz_box *next;
    struct ritz_shape shape;
    double poisson;
    struct ritz *ritz; /* NULL: a thread computes it */
    unsigned holders;
    size_t next_place;
    struct place {
        int axis, side; /* 0: none yet */
        bool all_ways;  /* it is the tensor; else the flexibility */
        double point[3], flexibility, tensor[6];
    } places[PLACES];
};

struct ritz_store {
    atomic_flag taken; /* lock of the members below, while a list is searched */
    unsigned owners;
    size_t bytes;
    unsigned long computed;
    struct ritz_box *boxes; /* the one asked for last first */
};

static void store_take(struct ritz_store *store)
{
    while (atomic_flag_test_and_set_explicit(&store->taken, memory_order_acquire))
        thrd_yield();
}

static void store_give_back(struct ritz_store *store)
{
    atomic_flag_clear_explicit(&store->taken, memory_order_release);
}

struct ritz_store *ritz_store_create(size_t bytes)
{
    struct ritz_store *store = calloc(1, sizeof *store);
    if (!store)
        return NULL;
    atomic_flag_clear(&store->taken);
    store->bytes = bytes;
    store->owners = 1;
    return store;
}

struct ritz_store *ritz_store_share(struct ritz_store *store)
{
    if (!store)
        return NULL;
    store_take(store);
    store->owners++;
    store_give_back(store);
    return store;
}

static void free_box(struct ritz_box *box)
{
    ritz_free(box->ritz);
    free(box);
}

/* With the store locked: drops the oldest boxes that no thread holds, beyond this many bytes. */
static void store_trim(struct ritz_store *store, size_t bytes)
{
    size_t kept = 0;
    for (struct ritz_box **link = &store->boxes; *link;) {
        struct ritz_box *box = *link;
        kept += box->ritz ? ritz_size(box->ritz) : 0;
        if (kept <= bytes || box->holders > 0) {
            link = &box->next;
            continue;
        }
        kept -= ritz_size(box->ritz);
        *link = box->next;
        free_box(box);
    }
}

void ritz_store_free(struct ritz_store *store)
{
    if (!store)
        return;
    store_take(store);
    bool last = --store->owners == 0;
    store_give_back(store);
    if (!last)
        return;
    store_trim(store, 0);
    free(store);
}

static bool same_shape(const struct ritz_shape *a, const struct ritz_shape *b)
{
    return a->round == b->round && a->held[0] == b->held[0] && a->held[1] == b->held[1] &&
           memcmp(a->side, b->side, sizeof a->side) == 0;
}

/* With the store locked: removes the box of these proportions from the list; NULL: there is none.
 */
static struct ritz_box *store_take_out(struct ritz_store *store, const struct ritz_shape *shape,
                                       double poisson)
{
    for (struct ritz_box **link = &store->boxes; *link; link = &(*link)->next) {
        struct ritz_box *box = *link;
        if (box->poisson != poisson || !same_shape(&box->shape, shape))
            continue;
        *link = box->next;
        return box;
    }
    return NULL;
}

static void put_first(struct ritz_store *store, struct ritz_box *box)
{
    box->next = store->boxes;
    store->boxes = box;
}

/* The box of these proportions. *mine: it is new, held, and the caller computes it. *ready: it is
 * computed and held. Neither: another thread computes it, and it is not held. NULL: out of memory.
 */
static struct ritz_box *store_find(struct ritz_store *store, const struct ritz_shape *shape,
                                   double poisson, bool *mine, bool *ready)
{
    store_take(store);
    struct ritz_box *box = store_take_out(store, shape, poisson);
    *mine = !box;
    if (!box && (box = calloc(1, sizeof *box))) {
        box->shape = *shape;
        box->poisson = poisson;
    }
    *ready = box && box->ritz;
    if (box) {
        box->holders += *mine || *ready;
        put_first(store, box);
    }
    store_give_back(store);
    return box;
}

/* Computes a new box. NULL: out of memory, or stopped; the box is gone. */
static struct ritz_box *store_compute(struct ritz_store *store, struct ritz_box *box,
                                      struct pace *pace)
{
    struct ritz *made = ritz_create(&box->shape, box->poisson, pace);
    store_take(store);
    if (made) {
        box->ritz = made;
        store->computed++;
        store_trim(store, store->bytes);
    } else {
        store_take_out(store, &box->shape, box->poisson);
    }
    store_give_back(store);
    if (made)
        return box;
    free_box(box);
    return NULL;
}

struct ritz_box *ritz_store_hold(struct ritz_store *store, const struct ritz_shape *shape,
                                 double poisson, struct pace *pace)
{
    const struct timespec millisecond = {.tv_nsec = 1000000};
    for (;;) {
        bool mine, ready;
        struct ritz_box *box = store_find(store, shape, poisson, &mine, &ready);
        if (!box || ready)
            return box;
        if (mine)
            return store_compute(store, box, pace);
        if (!pace_ask(pace, 0.0))
            return NULL;
        thrd_sleep(&millisecond, NULL);
    }
}

void ritz_store_release(struct ritz_store *store, struct ritz_box *box)
{
    store_take(store);
    box->holders--;
    store_trim(store, store->bytes);
    store_give_back(store);
}

const struct ritz *ritz_box_vibration(const struct ritz_box *box)
{
    return box->ritz;
}

/* With the store locked. */
static const struct place *box_find_place(const struct ritz_box *box, const struct place *like)
{
    for (size_t i = 0; i < PLACES; i++) {
        const struct place *place = &box->places[i];
        if ((place->axis || place->side) && place->all_ways == like->all_ways &&
            place->axis == like->axis && place->side == like->side &&
            memcmp(place->point, like->point, sizeof place->point) == 0)
            return place;
    }
    return NULL;
}

/* Writes down a place's numbers. */
static void box_add_place(struct ritz_store *store, struct ritz_box *box, const struct place *known)
{
    store_take(store);
    box->places[box->next_place++ % PLACES] = *known;
    store_give_back(store);
}

/* Completes a place by what is known of it; false: nothing. */
static bool box_know_place(struct ritz_store *store, const struct ritz_box *box,
                           struct place *place)
{
    store_take(store);
    const struct place *known = box_find_place(box, place);
    if (known)
        *place = *known;
    store_give_back(store);
    return known != NULL;
}

static struct place place_make(int axis, int side, const double point[3])
{
    return (struct place){.axis = axis, .side = side, .point = {point[0], point[1], point[2]}};
}

double ritz_box_flexibility(struct ritz_store *store, struct ritz_box *box, int axis, int side,
                            const double point[3])
{
    struct place place = place_make(axis, side, point);
    if (box_know_place(store, box, &place))
        return place.flexibility;
    place.flexibility = ritz_flexibility(box->ritz, axis, side, point);
    box_add_place(store, box, &place);
    return place.flexibility;
}

bool ritz_box_tensor(struct ritz_store *store, struct ritz_box *box, int axis, int side,
                     const double point[3], double tensor[6])
{
    struct place place = place_make(axis, side, point);
    bool good = true;
    place.all_ways = true;
    if (!box_know_place(store, box, &place)) {
        good = ritz_tensor(box->ritz, axis, side, point, place.tensor);
        if (good)
            box_add_place(store, box, &place);
    }
    memcpy(tensor, place.tensor, sizeof place.tensor);
    return good;
}

size_t ritz_store_bytes(struct ritz_store *store)
{
    size_t bytes = 0;
    store_take(store);
    for (const struct ritz_box *box = store->boxes; box; box = box->next)
        bytes += sizeof *box + (box->ritz ? ritz_size(box->ritz) : 0);
    store_give_back(store);
    return bytes;
}

unsigned long ritz_store_computed(struct ritz_store *store)
{
    store_take(store);
    unsigned long computed = store->computed;
    store_give_back(store);
    return computed;
}
