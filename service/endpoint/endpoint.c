/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/endpoint.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "endpoint/intake.h"
#include "exchange/describe.h"
#include "wire_clock.h"
#include "wire_security.h"

enum { WRITE_ATTEMPTS = 20 };

/* What wakes the reading thread: the kinds of requests, and these. */
enum {
    SOURCE_SUBSCRIPTIONS = EXCHANGE_COUNT,
    SOURCE_STOP,
    SOURCE_NUDGE,
    SOURCE_DENTS,
    SOURCE_COUNT
};

struct endpoint {
    /* never changed once it is made; DDS lets any thread use its entities */
    uint8_t server[16];
    const char *partition;
    dds_entity_t participant, waitset, stop, nudge;
    dds_entity_t status_writer, body_writer;
    struct dents_topic dents;
    struct reply_writers *writers; /* thread-safe, but for what its header says */
    /* of the thread that runs it */
    struct intake intakes[EXCHANGE_COUNT];
    /* of the thread that looks for other servers */
    dds_entity_t servers;  /* the reader of what they announce */
    atomic_bool stopped;   /* any thread sets it */
    atomic_ullong strange; /* requests from others than the client whose id they bore */
};

/* The entity, or a fault that says what it was for. */
static bool created(dds_entity_t entity, const char *what, struct fault *fault)
{
    if (entity < 0)
        fault_set(fault, PERCUSS_INTERNAL, "DDS: %s: %s", what, dds_strretcode(entity));
    return entity > 0;
}

static bool open_intakes(struct endpoint *endpoint, struct fault *fault)
{
    bool good = true;
    for (int i = 0; good && i < EXCHANGE_COUNT; i++)
        good = intake_open(&endpoint->intakes[i], i, endpoint->participant, endpoint->partition,
                           fault);
    return good;
}

static bool create_announcer(struct endpoint *endpoint, const dds_topic_descriptor_t *type,
                             const char *name, dds_entity_t *writer, struct fault *fault)
{
    dds_entity_t topic = wire_topic_create(endpoint->participant, type, name);
    if (!created(topic, name, fault))
        return false;
    dds_qos_t *qos = wire_qos_announcement(endpoint->partition);
    *writer = dds_create_writer(endpoint->participant, topic, qos, NULL);
    dds_delete_qos(qos);
    return created(*writer, name, fault);
}

static bool create_waitset(struct endpoint *endpoint, struct fault *fault)
{
    fault_set(fault, PERCUSS_INTERNAL, "DDS: waitset: cannot be attached to");
    endpoint->waitset = dds_create_waitset(endpoint->participant);
    endpoint->stop = dds_create_guardcondition(endpoint->participant);
    endpoint->nudge = dds_create_guardcondition(endpoint->participant);
    if (!created(endpoint->waitset, "waitset", fault) ||
        !created(endpoint->stop, "guard condition", fault) ||
        !created(endpoint->nudge, "guard condition", fault) ||
        dds_waitset_attach(endpoint->waitset, endpoint->stop, SOURCE_STOP) != DDS_RETCODE_OK ||
        dds_waitset_attach(endpoint->waitset, endpoint->nudge, SOURCE_NUDGE) != DDS_RETCODE_OK)
        return false;
    dds_entity_t subscriptions =
        dds_create_readcondition(reply_writers_source(endpoint->writers), DDS_ANY_STATE);
    bool good = created(subscriptions, "read condition", fault) &&
                dds_waitset_attach(endpoint->waitset, subscriptions, SOURCE_SUBSCRIPTIONS) ==
                    DDS_RETCODE_OK;
    for (int i = 0; good && i < EXCHANGE_COUNT; i++)
        good = intake_attach(&endpoint->intakes[i], endpoint->waitset);
    return good;
}

/* The given id, or one that nobody has. */
static bool adopt_id(struct endpoint *endpoint, const uint8_t *server)
{
    if (server)
        memcpy(endpoint->server, server, sizeof endpoint->server);
    return server || getrandom(endpoint->server, sizeof endpoint->server, 0) >= 0;
}

bool endpoint_check_security(const char *security, struct fault *fault)
{
    char problem[sizeof fault->text];
    if (wire_security_check(security, problem, sizeof problem))
        return true;
    fault_set(fault, PERCUSS_BAD_REQUEST, "%s", problem);
    return false;
}

struct endpoint *endpoint_create(uint32_t domain, const char *partition, const char *security,
                                 size_t clients, const uint8_t *server, struct fault *fault)
{
    if (security && !endpoint_check_security(security, fault))
        return NULL;
    struct endpoint *endpoint = calloc(1, sizeof *endpoint);
    if (!endpoint || !adopt_id(endpoint, server)) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory or of random numbers");
        free(endpoint);
        return NULL;
    }
    /* the domain */
    endpoint->partition = partition;
    endpoint->participant = wire_participant_create_secured(domain, security);
    if (endpoint->participant < 0) {
        fault_set(fault, PERCUSS_INTERNAL, "DDS: participant: %s",
                  wire_participant_problem(endpoint->participant));
        goto failed;
    }
    /* readers, writers, and what wakes the reading thread */
    endpoint->writers = reply_writers_create(endpoint->participant, partition, clients, fault);
    if (!endpoint->writers || !open_intakes(endpoint, fault) ||
        !create_announcer(endpoint, &percuss_v1_ServerStatus_desc, WIRE_TOPIC_SERVER_STATUS,
                          &endpoint->status_writer, fault) ||
        !create_announcer(endpoint, &percuss_v1_Body_desc, WIRE_TOPIC_BODY, &endpoint->body_writer,
                          fault) ||
        !create_waitset(endpoint, fault))
        goto failed;
    endpoint->servers = servers_open(endpoint->participant, partition, fault);
    if (!endpoint->servers)
        goto failed;
    return endpoint;
failed:
    endpoint_free(endpoint);
    return NULL;
}

void endpoint_free(struct endpoint *endpoint)
{
    if (!endpoint)
        return;
    for (int i = 0; i < EXCHANGE_COUNT; i++)
        intake_close(&endpoint->intakes[i]);
    /* with its domain, which runs threads of its own: a process has one endpoint */
    if (endpoint->participant > 0)
        dds_delete(dds_get_parent(endpoint->participant));
    reply_writers_free(endpoint->writers);
    free(endpoint);
}

const uint8_t *endpoint_server(const struct endpoint *endpoint)
{
    return endpoint->server;
}

static void tell_alive(struct endpoint *endpoint, const struct endpoint_handler *handler)
{
    dds_set_guardcondition(endpoint->nudge, false);
    if (handler->alive)
        handler->alive(handler->context);
}

void endpoint_run(struct endpoint *endpoint, const struct endpoint_handler *handler)
{
    bool ready[SOURCE_COUNT] = {false};
    bool left = false; /* requests that no wake-up will tell of */
    struct intake_desk desk = {endpoint->server, reply_writers_owners(endpoint->writers),
                               &endpoint->strange, handler};
    while (!atomic_load(&endpoint->stopped)) {
        /* who has something, since the last time or now */
        dds_attach_t woken[SOURCE_COUNT];
        dds_return_t count =
            dds_waitset_wait(endpoint->waitset, woken, SOURCE_COUNT, left ? 0 : DDS_INFINITY);
        for (dds_return_t i = 0; i < count && i < SOURCE_COUNT; i++)
            ready[woken[i]] = true;
        if (ready[SOURCE_NUDGE])
            tell_alive(endpoint, handler);
        /* readers of replies first, so that there is a writer for the replies to come */
        if (ready[SOURCE_SUBSCRIPTIONS])
            reply_writers_follow(endpoint->writers, handler->presence, handler->context);
        if (ready[SOURCE_DENTS])
            dents_topic_take(&endpoint->dents, handler->clear, handler->context);
        ready[SOURCE_SUBSCRIPTIONS] = ready[SOURCE_DENTS] = ready[SOURCE_NUDGE] = left = false;
        /* then the requests, some of each kind */
        for (int i = 0; i < EXCHANGE_COUNT; i++) {
            ready[i] = ready[i] && intake_take(&endpoint->intakes[i], &desk);
            left = intake_serve(&endpoint->intakes[i], &desk) || ready[i] || left;
        }
    }
}

void endpoint_stop(struct endpoint *endpoint)
{
    atomic_store(&endpoint->stopped, true);
    dds_set_guardcondition(endpoint->stop, true);
}

void endpoint_nudge(struct endpoint *endpoint)
{
    dds_set_guardcondition(endpoint->nudge, true);
}

void endpoint_rouse(struct endpoint *endpoint)
{
    wire_clock_rouse(endpoint->status_writer);
}

enum delivery endpoint_reply(struct endpoint *endpoint, const uint8_t client[16],
                             const struct answer *answer)
{
    return reply_writers_write(endpoint->writers, client, answer);
}

enum delivery endpoint_publish(struct endpoint *endpoint, const uint8_t client[16],
                               unsigned channel, const void *sample, unsigned patience)
{
    return reply_writers_publish(endpoint->writers, client, channel, sample, patience);
}

unsigned long long endpoint_strange(struct endpoint *endpoint)
{
    return atomic_exchange(&endpoint->strange, 0);
}

void endpoint_flush(struct endpoint *endpoint, double seconds)
{
    reply_writers_flush(endpoint->writers, seconds);
}

size_t endpoint_clients(struct endpoint *endpoint)
{
    return reply_writers_count(endpoint->writers);
}

/* Large catalogues outrun readers of the announcements; a write then gives up after 100 ms. */
static bool write_patiently(dds_entity_t writer, const void *sample)
{
    dds_return_t result = DDS_RETCODE_TIMEOUT;
    for (int i = 0; result == DDS_RETCODE_TIMEOUT && i < WRITE_ATTEMPTS; i++)
        result = dds_write(writer, sample);
    return result == DDS_RETCODE_OK;
}

bool endpoint_announce_bodies(struct endpoint *endpoint, const struct body_set *set,
                              const struct body_set *before)
{
    bool good = true;
    percuss_v1_Body body;
    percuss_v1_BodySite sites[BODY_MOST_SITES];
    for (size_t i = 0; before && i < before->count; i++) {
        if (body_set_find(set, before->bodies[i].id))
            continue;
        describe_body(&before->bodies[i], &body, sites);
        memcpy(body.server, endpoint->server, sizeof body.server);
        dds_dispose(endpoint->body_writer, &body);
    }
    for (size_t i = 0; i < set->count; i++) {
        describe_body(&set->bodies[i], &body, sites);
        memcpy(body.server, endpoint->server, sizeof body.server);
        good = write_patiently(endpoint->body_writer, &body) && good;
    }
    return good;
}

bool endpoint_open_dents(struct endpoint *endpoint, struct fault *fault)
{
    if (!dents_topic_open(&endpoint->dents, endpoint->participant, endpoint->partition,
                          endpoint->server, fault))
        return false;
    dds_return_t attached =
        dds_waitset_attach(endpoint->waitset, endpoint->dents.reader, SOURCE_DENTS);
    if (attached != DDS_RETCODE_OK)
        fault_set(fault, PERCUSS_INTERNAL, "DDS: waitset: %s", dds_strretcode(attached));
    return attached == DDS_RETCODE_OK;
}

void endpoint_announce_dents(struct endpoint *endpoint, const struct dents_notice *notice)
{
    dents_topic_announce(&endpoint->dents, notice);
}

void endpoint_withdraw_dents(struct endpoint *endpoint, const char *specimen)
{
    dents_topic_withdraw(&endpoint->dents, specimen);
}

void endpoint_visit_servers(struct endpoint *endpoint, server_visitor *visitor, void *context)
{
    servers_visit(endpoint->servers, visitor, context);
}

void endpoint_announce_status(struct endpoint *endpoint, percuss_v1_ServerStatus *status)
{
    memcpy(status->server, endpoint->server, sizeof status->server);
    dds_write(endpoint->status_writer, status);
}
