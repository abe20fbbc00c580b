/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A store of specimens, and what is done with it. */
#ifndef PERCUSS_TEST_SPECIMEN_LAB_H
#define PERCUSS_TEST_SPECIMEN_LAB_H

#include "check.h"
#include "store/specimens.h"
#include "unit/store/store_folder.h"

static inline struct body rod(void)
{
    return (struct body){.id = "rod",
                         .kind = &rod_kind,
                         .radius = 0.01,
                         .length = 1.0,
                         .tip_radius = INFINITY,
                         .material = {"al", 70e9, 0.33, 2700.0, 205e6, 0.0}};
}

/* A state with `count` dents whose numbers all differ and fill the mantissa. */
static inline struct body_state *dented(size_t count, double seed)
{
    struct body_state sizes = {.dents = count};
    struct body_state *state = malloc(body_state_size(&sizes));
    *state = sizes;
    double *numbers = (double *)body_state_dents(state);
    for (size_t i = 0; i < 8 * count; i++)
        numbers[i] = sin(seed + (double)i) * 1e-5;
    /* a specimen is at rest before each blow */
    for (size_t f = 0; f < BODY_MOST_FAMILIES; f++)
        state->known[f] = SIZE_MAX;
    return state;
}

static inline struct specimen_store *open_store(unsigned replies)
{
    struct fault fault;
    struct specimen_store *store;
    if (specimen_store_open(path, replies, &store, &fault))
        fail_msg("%s", fault.text);
    return store;
}

static inline struct stored_reply reply_of(uint8_t client, uint64_t sequence, char *bytes)
{
    return (struct stored_reply){.client = {client},
                                 .sequence = sequence,
                                 .content = {sequence * 3, ~sequence},
                                 .size = strlen(bytes),
                                 .bytes = bytes};
}

static inline enum percuss_status hit(struct specimen_store *store, const char *name,
                                      const struct body_state *after, uint8_t client,
                                      uint64_t sequence)
{
    struct body body = rod();
    struct fault fault;
    char text[64];
    snprintf(text, sizeof text, "reply %u %llu", client, (unsigned long long)sequence);
    struct specimen_change change = {name, &body, after};
    struct stored_reply reply = reply_of(client, sequence, text);
    return specimen_store_commit(store, &change, 1, &reply, &fault);
}

static inline void has_dents(struct specimen_store *store, const char *name,
                             const struct body_state *expected)
{
    struct body body = rod();
    struct fault fault;
    struct body_state *state;
    if (specimen_store_load(store, name, &body, &state, &fault))
        fail_msg("%s", fault.text);
    bool some = expected && expected->dents;
    assert_true(!state == !some);
    if (some)
        assert_memory_equal(state, expected, body_state_size(expected));
    free(state);
}

/* "": there is none. */
static inline void finds(struct specimen_store *store, uint8_t client, uint64_t sequence,
                         const char *expected)
{
    struct fault fault;
    struct stored_reply reply = {.client = {client}, .sequence = sequence};
    assert_int_equal(specimen_store_find(store, &reply, &fault), PERCUSS_OK);
    assert_true(!reply.bytes == !*expected);
    if (reply.bytes) {
        assert_int_equal(reply.size, strlen(expected));
        assert_memory_equal(reply.bytes, expected, reply.size);
        assert_true(reply.content[0] == sequence * 3 && reply.content[1] == ~sequence);
    }
    free(reply.bytes);
}

#endif
