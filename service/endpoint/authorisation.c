/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/authorisation.h"

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

/* The participants with readers of a client's replies; the first one has the claim to its id. */
struct claim {
    struct key_node node; /* key: client */
    LIST_ENTRY(claim) all;
    TAILQ_HEAD(holder_list, holder) holders; /* in the order of arrival; never empty */
};

/* A writer's handle is never used again. */
struct writer {
    dds_instance_handle_t handle; /* 0: none */
    struct digest participant;
};

struct authorisation {
    struct key_map clients;
    LIST_HEAD(claim_list, claim) all;
    struct writer writers[REMEMBERED];
};

struct authorisation *authorisation_create(void)
{
    struct authorisation *authorisation = calloc(1, sizeof *authorisation);
    if (authorisation && key_map_create(&authorisation->clients, EXPECTED))
        return authorisation;
    free(authorisation);
    return NULL;
}

static void claim_forget(struct authorisation *authorisation, struct claim *claim)
{
    while (!TAILQ_EMPTY(&claim->holders)) {
        struct holder *holder = TAILQ_FIRST(&claim->holders);
        TAILQ_REMOVE(&claim->holders, holder, later);
        free(holder);
    }
    key_map_remove(&authorisation->clients, &claim->node);
    LIST_REMOVE(claim, all);
    free(claim);
}

void authorisation_free(struct authorisation *authorisation)
{
    if (!authorisation)
        return;
    while (!LIST_EMPTY(&authorisation->all))
        claim_forget(authorisation, LIST_FIRST(&authorisation->all));
    key_map_release(&authorisation->clients);
    free(authorisation);
}

struct digest authorisation_participant(struct digest guid)
{
    /* RTPS 9.3.1: twelve octets name the participant, four its entity */
    enum { OWN = 12 };
    uint8_t octets[16];
    memcpy(octets, &guid, sizeof octets);
    memset(octets + OWN, 0, sizeof octets - OWN);
    return digest_of_octets(octets);
}

static bool participant_is(struct digest a, struct digest b)
{
    return a.first == b.first && a.second == b.second;
}

static struct claim *claim_find(const struct authorisation *authorisation, const uint8_t client[16])
{
    struct key_node *node = key_map_find(&authorisation->clients, digest_of_octets(client));
    return node ? KEY_MAP_OWNER(node, struct claim, node) : NULL;
}

static struct holder *claim_holder(const struct claim *claim, struct digest participant)
{
    struct holder *holder;
    TAILQ_FOREACH(holder, &claim->holders, later)
    {
        if (participant_is(holder->participant, participant))
            return holder;
    }
    return NULL;
}

static struct claim *claim_create(struct authorisation *authorisation, const uint8_t client[16])
{
    struct claim *claim = calloc(1, sizeof *claim);
    if (!claim)
        return NULL;
    claim->node.key = digest_of_octets(client);
    TAILQ_INIT(&claim->holders);
    key_map_insert(&authorisation->clients, &claim->node);
    LIST_INSERT_HEAD(&authorisation->all, claim, all);
    return claim;
}

bool authorisation_add(struct authorisation *authorisation, const uint8_t client[16],
                       struct digest participant)
{
    struct claim *claim = claim_find(authorisation, client);
    struct holder *holder = claim ? claim_holder(claim, participant) : NULL;
    if (!holder) {
        holder = calloc(1, sizeof *holder);
        claim = claim || !holder ? claim : claim_create(authorisation, client);
        if (!holder || !claim) {
            free(holder);
            return false;
        }
        holder->participant = participant;
        TAILQ_INSERT_TAIL(&claim->holders, holder, later);
    }
    holder->readers++;
    return true;
}

void authorisation_remove(struct authorisation *authorisation, const uint8_t client[16],
                          struct digest participant)
{
    struct claim *claim = claim_find(authorisation, client);
    struct holder *holder = claim ? claim_holder(claim, participant) : NULL;
    if (!holder || --holder->readers > 0)
        return;
    TAILQ_REMOVE(&claim->holders, holder, later);
    free(holder);
    if (TAILQ_EMPTY(&claim->holders))
        claim_forget(authorisation, claim);
}

bool authorisation_allow(const struct authorisation *authorisation, const uint8_t client[16],
                         struct digest participant)
{
    const struct claim *claim = claim_find(authorisation, client);
    return !claim || participant_is(TAILQ_FIRST(&claim->holders)->participant, participant);
}

bool authorisation_allow_writer(struct authorisation *authorisation, const uint8_t client[16],
                                dds_entity_t reader, dds_instance_handle_t writer)
{
    struct writer *known = &authorisation->writers[writer % REMEMBERED];
    if (known->handle != writer) {
        dds_builtintopic_endpoint_t *about = dds_get_matched_publication_data(reader, writer);
        if (!about)
            return authorisation_allow(authorisation, client, (struct digest){0, 0});
        known->handle = writer;
        known->participant = authorisation_participant(digest_of_octets(about->key.v));
        dds_builtintopic_free_endpoint(about);
    }
    return authorisation_allow(authorisation, client, known->participant);
}
