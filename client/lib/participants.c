/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "participants.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/queue.h>
#include <time.h>

#include "wire_validity.h"

struct shared_participant {
    uint32_t domain;
    char *security; /* empty: none */
    struct wire_validity validity;
    dds_entity_t entity;
    unsigned holders;
    LIST_ENTRY(shared_participant) others;
};

/* As a process has one of each DDS domain. */
static LIST_HEAD(, shared_participant) all = LIST_HEAD_INITIALIZER(all);
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* of all */

/* Not one whose identity has ended: its folder may have been made anew since. */
static struct shared_participant *find(uint32_t domain, const char *security)
{
    struct shared_participant *shared;
    LIST_FOREACH(shared, &all, others)
    if (shared->domain == domain && strcmp(shared->security, security) == 0 &&
        !wire_validity_is_over(&shared->validity, time(NULL)))
        return shared;
    return NULL;
}

/* NULL: out of memory. */
static struct shared_participant *create(uint32_t domain, const char *security)
{
    struct shared_participant *shared = calloc(1, sizeof *shared);
    char *copy = strdup(security);
    if (!shared || !copy) {
        free(shared);
        free(copy);
        return NULL;
    }
    shared->domain = domain;
    shared->security = copy;
    if (*security)
        wire_validity_read(security, &shared->validity);
    LIST_INSERT_HEAD(&all, shared, others);
    return shared;
}

static void discard(struct shared_participant *shared)
{
    LIST_REMOVE(shared, others);
    free(shared->security);
    free(shared);
}

dds_entity_t participants_hold(uint32_t domain, const char *security)
{
    const char *identity = security ? security : "";
    dds_entity_t entity = DDS_RETCODE_OUT_OF_RESOURCES;
    pthread_mutex_lock(&lock);
    struct shared_participant *shared = find(domain, identity);
    if (!shared)
        shared = create(domain, identity);
    if (shared && shared->holders == 0)
        shared->entity = wire_participant_create_secured(domain, security);
    if (shared) {
        entity = shared->entity;
        if (entity > 0)
            shared->holders++;
        else
            discard(shared);
    }
    pthread_mutex_unlock(&lock);
    return entity;
}

void participants_release(dds_entity_t participant)
{
    struct shared_participant *shared;
    pthread_mutex_lock(&lock);
    LIST_FOREACH(shared, &all, others)
    if (shared->entity == participant)
        break;
    if (shared && --shared->holders == 0) {
        dds_delete(participant);
        discard(shared);
    }
    pthread_mutex_unlock(&lock);
}
