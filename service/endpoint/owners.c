/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/owners.h"

#include <stdlib.h>
#include <string.h>
#include <sys/queue.h>

#include "exchange/key_map.h"

/* Expected number of clients, and number of writers with a remembered participant. */
enum { EXPECTED = 1024, REMEMBERED = 256 };

/* A participant that reads a client's replies. */
struct holder {
    TAILQ_ENTRY(holder) later;
    struct digest participant;
    unsigned readers;
};

struct owned {
    struct key_node node; /* key: client */
    LIST_ENTRY(owned) all;
    TAILQ_HEAD(holder_list, holder) holders; /* in the order in which they came; never empty */
};

/* A writer's handle is never used again. */
struct writer {
    dds_instance_handle_t handle; /* 0: none */
    struct digest participant;
};

struct owners {
    struct key_map clients;
    LIST_HEAD(owned_list, owned) all;
    struct writer writers[REMEMBERED];
};

struct owners *owners_create(void)
{
    struct owners *owners = calloc(1, sizeof *owners);
    if (owners && key_map_create(&owners->clients, EXPECTED))
        return owners;
    free(owners);
    return NULL;
}

static void forget(struct owners *owners, struct owned *owned)
{
    while (!TAILQ_EMPTY(&owned->holders)) {
        struct holder *holder = TAILQ_FIRST(&owned->holders);
        TAILQ_REMOVE(&owned->holders, holder, later);
        free(holder);
    }
    key_map_remove(&owners->clients, &owned->node);
    LIST_REMOVE(owned, all);
    free(owned);
}

void owners_free(struct owners *owners)
{
    if (!owners)
        return;
    while (!LIST_EMPTY(&owners->all))
        forget(owners, LIST_FIRST(&owners->all));
    key_map_release(&owners->clients);
    free(owners);
}

struct digest owners_participant(struct digest guid)
{
    /* RTPS 9.3.1: twelve octets name the participant, four its entity */
    enum { OWN = 12 };
    uint8_t octets[16];
    memcpy(octets, &guid, sizeof octets);
    memset(octets + OWN, 0, sizeof octets - OWN);
    return digest_of_octets(octets);
}

static bool is_same(struct digest a, struct digest b)
{
    return a.first == b.first && a.second == b.second;
}

static struct owned *find(const struct owners *owners, const uint8_t client[16])
{
    struct key_node *node = key_map_find(&owners->clients, digest_of_octets(client));
    return node ? KEY_MAP_OWNER(node, struct owned, node) : NULL;
}

static struct holder *find_holder(const struct owned *owned, struct digest participant)
{
    struct holder *holder;
    TAILQ_FOREACH(holder, &owned->holders, later)
    {
        if (is_same(holder->participant, participant))
            return holder;
    }
    return NULL;
}

static struct owned *create_owned(struct owners *owners, const uint8_t client[16])
{
    struct owned *owned = calloc(1, sizeof *owned);
    if (!owned)
        return NULL;
    owned->node.key = digest_of_octets(client);
    TAILQ_INIT(&owned->holders);
    key_map_insert(&owners->clients, &owned->node);
    LIST_INSERT_HEAD(&owners->all, owned, all);
    return owned;
}

bool owners_add(struct owners *owners, const uint8_t client[16], struct digest participant)
{
    struct owned *owned = find(owners, client);
    struct holder *holder = owned ? find_holder(owned, participant) : NULL;
    if (!holder) {
        holder = calloc(1, sizeof *holder);
        owned = owned || !holder ? owned : create_owned(owners, client);
        if (!holder || !owned) {
            free(holder);
            return false;
        }
        holder->participant = participant;
        TAILQ_INSERT_TAIL(&owned->holders, holder, later);
    }
    holder->readers++;
    return true;
}

void owners_remove(struct owners *owners, const uint8_t client[16], struct digest participant)
{
    struct owned *owned = find(owners, client);
    struct holder *holder = owned ? find_holder(owned, participant) : NULL;
    if (!holder || --holder->readers > 0)
        return;
    TAILQ_REMOVE(&owned->holders, holder, later);
    free(holder);
    if (TAILQ_EMPTY(&owned->holders))
        forget(owners, owned);
}

bool owners_allow(const struct owners *owners, const uint8_t client[16], struct digest participant)
{
    const struct owned *owned = find(owners, client);
    return !owned || is_same(TAILQ_FIRST(&owned->holders)->participant, participant);
}

bool owners_allow_writer(struct owners *owners, const uint8_t client[16], dds_entity_t reader,
                         dds_instance_handle_t writer)
{
    struct writer *known = &owners->writers[writer % REMEMBERED];
    if (known->handle != writer) {
        dds_builtintopic_endpoint_t *about = dds_get_matched_publication_data(reader, writer);
        if (!about)
            return owners_allow(owners, client, (struct digest){0, 0});
        known->handle = writer;
        known->participant = owners_participant(digest_of_octets(about->key.v));
        dds_builtintopic_free_endpoint(about);
    }
    return owners_allow(owners, client, known->participant);
}
