/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A client: its configuration, its DDS entities and their participant, its end. */

#include "client.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/queue.h>
#include <sys/random.h>
#include <time.h>

#include "error.h"
#include "failure.h"
#include "forked.h"
#include "library.h"
#include "wire_security.h"

/* The DDS participants of this process: one a domain and identity, for all its clients. Any thread.
 *
 * Cyclone DDS 0.10 lets only the first of several participants learn the earlier samples of a newly
 * found process (q_receive.c: readers of discovery after the first are in sync at once); when that
 * one is deleted before it has, the others never do. Clients with a participant each, one freed
 * while a server comes up, would not find that server until all of them were gone. */

struct shared_participant {
    uint32_t domain;
    char *security; /* empty: none */
    struct wire_validity validity;
    dds_entity_t entity;
    unsigned holders;
    LIST_ENTRY(shared_participant) others;
};

/* As a process has one of each DDS domain. */
static LIST_HEAD(, shared_participant) participants = LIST_HEAD_INITIALIZER(participants);
static pthread_mutex_t participants_lock = PTHREAD_MUTEX_INITIALIZER;

/* Not one with an identity that has ended: its folder may have been made anew since. */
static struct shared_participant *find_participant(uint32_t domain, const char *security)
{
    struct shared_participant *shared;
    LIST_FOREACH(shared, &participants, others)
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
    LIST_INSERT_HEAD(&participants, shared, others);
    return shared;
}

static void discard(struct shared_participant *shared)
{
    LIST_REMOVE(shared, others);
    free(shared->security);
    free(shared);
}

/* Reads the list of revoked certificates anew, which a new participant does by itself. False: it is
 * bad meanwhile. */
static bool is_list_read(const char *security)
{
    struct wire_revocation found;
    char problem[512];
    return !security || wire_security_revoke(security, &found, problem, sizeof problem);
}

/* The participant of that domain and identity (a folder; NULL: none), made by its first holder; or
 * a negative DDS code. */
static dds_entity_t participants_hold(uint32_t domain, const char *security)
{
    const char *identity = security ? security : "";
    dds_entity_t entity = DDS_RETCODE_OUT_OF_RESOURCES;
    pthread_mutex_lock(&participants_lock);
    struct shared_participant *shared = find_participant(domain, identity);
    if (!shared)
        shared = create(domain, identity);
    if (shared && shared->holders == 0)
        shared->entity = wire_participant_create_client(domain, security);
    if (shared) {
        entity = shared->holders && !is_list_read(security) ? DDS_RETCODE_NOT_ALLOWED_BY_SECURITY
                                                            : shared->entity;
        if (entity > 0)
            shared->holders++;
        else if (shared->holders == 0)
            discard(shared);
    }
    pthread_mutex_unlock(&participants_lock);
    return entity;
}

/* Deletes it after the last one. Its entities are to be deleted before. */
static void participants_release(dds_entity_t participant)
{
    struct shared_participant *shared;
    pthread_mutex_lock(&participants_lock);
    LIST_FOREACH(shared, &participants, others)
    if (shared->entity == participant)
        break;
    if (shared && --shared->holders == 0) {
        dds_delete(participant);
        discard(shared);
    }
    pthread_mutex_unlock(&participants_lock);
}

enum { DEFAULT_WINDOW = 256, HIGHEST_DOMAIN = 230 };

/* PERCUSS_DOMAIN holds no domain: kept until a function can report it. */
static const uint32_t NOT_A_DOMAIN = UINT32_MAX;

static uint32_t environment_domain(void)
{
    const char *text = getenv("PERCUSS_DOMAIN");
    if (!text || !*text)
        return 0;
    char *end;
    unsigned long domain = strtoul(text, &end, 10);
    bool good = isdigit((unsigned char)*text) && !*end && domain <= HIGHEST_DOMAIN;
    return good ? (uint32_t)domain : NOT_A_DOMAIN;
}

static const char *environment_security(void)
{
    const char *folder = getenv("PERCUSS_SECURITY");
    return folder && *folder ? folder : NULL;
}

static const char *environment_partition(void)
{
    const char *name = getenv("PERCUSS_PARTITION");
    return name ? name : "";
}

/* Too much for an id is kept as far as it goes, without an end, and refused later. */
static void environment_server(char server[PERCUSS_SERVER_ID_SIZE])
{
    const char *text = getenv("PERCUSS_SERVER");
    for (size_t i = 0; text && text[i] && i < PERCUSS_SERVER_ID_SIZE; i++)
        server[i] = (char)tolower((unsigned char)text[i]);
}

struct percuss_client_config percuss_client_config_default(void)
{
    struct percuss_client_config config = {
        .domain = environment_domain(), .first_sequence = 1, .window = DEFAULT_WINDOW};
    environment_server(config.server);
    return config;
}

/* The beginning of an id, or the name of a choice. */
static bool is_least_loaded(const struct percuss_client_config *config)
{
    return strncmp(config->server, PERCUSS_LEAST_LOADED, sizeof config->server) == 0;
}

static enum percuss_result check_config(const struct percuss_client_config *config)
{
    /* by default it is from the environment, where anything may stand */
    const char *domain = getenv("PERCUSS_DOMAIN");
    if (config->domain == NOT_A_DOMAIN && domain)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "PERCUSS_DOMAIN: '%s' is not a whole number of 0..%d", domain,
                         HIGHEST_DOMAIN);
    if (config->domain > HIGHEST_DOMAIN)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "domain: %u: 0..%d is allowed",
                         config->domain, HIGHEST_DOMAIN);
    /* how many questions may be outstanding, and the number of the first */
    if (config->window < 1 || config->window > WIRE_WINDOW)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "window: %u: 1..%d is allowed",
                         config->window, WIRE_WINDOW);
    if (config->first_sequence == 0)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "first_sequence: 0 means a ping");
    /* the beginning of a server's id */
    size_t length = strnlen(config->server, sizeof config->server);
    bool digits =
        length < sizeof config->server && strspn(config->server, "0123456789abcdef") == length;
    if (!digits && !is_least_loaded(config))
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "server: '%.33s': up to 32 of the digits 0..9, a..f are allowed, "
                         "or " PERCUSS_LEAST_LOADED,
                         config->server);
    return PERCUSS_RESULT_OK;
}

static enum percuss_result check_partition(const char *partition)
{
    if (!*partition || wire_partition_is_good(partition))
        return PERCUSS_RESULT_OK;
    return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                     "partition: '%.80s': " WIRE_PARTITION_RULE " are allowed", partition);
}

/* All of an identity, or none. */
static enum percuss_result check_security(const char *security)
{
    char problem[512];
    if (security && !wire_security_check(security, problem, sizeof problem))
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "%s", problem);
    return PERCUSS_RESULT_OK;
}

static enum percuss_result choose_id(const uint8_t configured[16], uint8_t id[16])
{
    static const uint8_t none[16];
    memcpy(id, configured, 16);
    if (memcmp(id, none, 16) == 0 && getrandom(id, 16, 0) != 16)
        return error_set(PERCUSS_RESULT_TRANSPORT, "random client id: %s", strerror(errno));
    return PERCUSS_RESULT_OK;
}

/* Partitions never fit: each client has its own, and each server writes to all of them. */
static void note_refusal(atomic_uint *refused, uint32_t policy)
{
    if (policy != DDS_PARTITION_QOS_POLICY_ID)
        atomic_store(refused, policy);
}

static void requests_refused(dds_entity_t writer, dds_offered_incompatible_qos_status_t status,
                             void *context)
{
    (void)writer;
    note_refusal(&((struct percuss_client *)context)->refused_requests, status.last_policy_id);
}

static void replies_refused(dds_entity_t reader, dds_requested_incompatible_qos_status_t status,
                            void *context)
{
    (void)reader;
    note_refusal(&((struct percuss_client *)context)->refused_replies, status.last_policy_id);
}

/* Notes from the beginning the matches that DDS makes, or refuses, to our requests and to replies
 * to us. */
static void watch_servers(struct percuss_client *client)
{
    dds_offered_incompatible_qos_status_t offered = {0};
    dds_requested_incompatible_qos_status_t requested = {0};
    dds_listener_t *listener = dds_create_listener(client);
    arrivals_hear_samples(listener, &client->arrivals);
    arrivals_hear_writers(listener, &client->arrivals);
    arrivals_hear_readers(listener, &client->arrivals);
    dds_lset_offered_incompatible_qos(listener, requests_refused);
    dds_lset_requested_incompatible_qos(listener, replies_refused);
    dds_set_listener(client->request_writer, listener);
    dds_set_listener(client->reply_reader, listener);
    dds_delete_listener(listener);
    /* and those before the listener */
    dds_get_offered_incompatible_qos_status(client->request_writer, &offered);
    dds_get_requested_incompatible_qos_status(client->reply_reader, &requested);
    if (offered.total_count > 0)
        requests_refused(client->request_writer, offered, client);
    if (requested.total_count > 0)
        replies_refused(client->reply_reader, requested, client);
}

/* Notes an endpoint that was made, or not, of a topic, which is from then on the endpoint's. */
static dds_entity_t own(struct percuss_client *client, dds_entity_t topic, dds_entity_t endpoint)
{
    if (topic > 0)
        dds_delete(topic);
    if (endpoint > 0 && client->endpoint_count == CLIENT_MOST_ENDPOINTS) {
        dds_delete(endpoint);
        return DDS_RETCODE_OUT_OF_RESOURCES;
    }
    if (endpoint > 0)
        client->endpoints[client->endpoint_count++] = endpoint;
    return endpoint;
}

dds_entity_t client_reader_create(struct percuss_client *client,
                                  const dds_topic_descriptor_t *descriptor, const char *topic,
                                  dds_qos_t *qos)
{
    dds_entity_t about = wire_topic_create(client->participant, descriptor, topic);
    dds_entity_t reader =
        about > 0 ? dds_create_reader(client->participant, about, qos, NULL) : about;
    dds_delete_qos(qos);
    return own(client, about, reader);
}

dds_entity_t client_writer_create(struct percuss_client *client,
                                  const dds_topic_descriptor_t *descriptor, const char *topic)
{
    dds_qos_t *qos = wire_qos_exchange(client->partition);
    dds_entity_t about = wire_topic_create(client->participant, descriptor, topic);
    dds_entity_t writer =
        about > 0 ? dds_create_writer(client->participant, about, qos, NULL) : about;
    dds_delete_qos(qos);
    return own(client, about, writer);
}

dds_entity_t client_reply_reader_create(struct percuss_client *client,
                                        const dds_topic_descriptor_t *descriptor, const char *topic)
{
    char name[WIRE_REPLIES_SIZE];
    wire_partition_of_replies(client->id, client->partition, name);
    dds_entity_t reader = client_reader_create(client, descriptor, topic, wire_qos_exchange(name));
    if (reader < 0)
        return reader;
    /* by then DDS does not hold the reader's lock any more; the woken thread takes all */
    dds_listener_t *listener = dds_create_listener(client);
    arrivals_hear_samples(listener, &client->arrivals);
    dds_return_t code = dds_set_listener(reader, listener);
    dds_delete_listener(listener);
    return code < 0 ? code : reader;
}

static enum percuss_result create_entities(struct percuss_client *client, const char *security)
{
    client->participant = participants_hold(client->domain, security);
    if (client->participant < 0)
        return error_set(PERCUSS_RESULT_TRANSPORT, "DDS participant: %s",
                         wire_participant_problem(client->participant));
    client->reply_reader =
        client_reply_reader_create(client, &percuss_v1_Reply_desc, WIRE_TOPIC_REPLY);
    client->observes = client->reply_reader == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY;
    if (client->observes)
        return PERCUSS_RESULT_OK;
    if (client->reply_reader < 0)
        return failure_dds("reader of " WIRE_TOPIC_REPLY, client->reply_reader);
    /* the writer of requests; and a waiting thread is woken when a server comes or goes */
    client->request_writer =
        client_writer_create(client, &percuss_v1_Request_desc, WIRE_TOPIC_REQUEST);
    if (client->request_writer < 0)
        return failure_dds("writer of " WIRE_TOPIC_REQUEST, client->request_writer);
    watch_servers(client);
    return PERCUSS_RESULT_OK;
}

static void delete_entities(struct percuss_client *client)
{
    for (size_t i = 0; i < client->endpoint_count; i++)
        dds_delete(client->endpoints[i]);
    if (client->participant > 0)
        participants_release(client->participant);
}

static void create_lock(struct percuss_client *client)
{
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&client->lock, NULL);
    pthread_cond_init(&client->changed, &monotonic);
    pthread_condattr_destroy(&monotonic);
}

enum percuss_result percuss_client_create(const struct percuss_client_config *config,
                                          struct percuss_client **client)
{
    return percuss_client_create_in(config, NULL, NULL, client);
}

enum percuss_result percuss_client_create_secured(const struct percuss_client_config *config,
                                                  const char *security,
                                                  struct percuss_client **client)
{
    return percuss_client_create_in(config, NULL, security, client);
}

enum percuss_result percuss_client_create_in(const struct percuss_client_config *config,
                                             const char *partition, const char *security,
                                             struct percuss_client **client)
{
    if (ERROR_NULL(client))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    struct percuss_client_config chosen = config ? *config : percuss_client_config_default();
    const char *identity = security ? security : environment_security();
    const char *among = partition ? partition : environment_partition();
    *client = NULL;
    enum percuss_result result = check_config(&chosen);
    if (result == PERCUSS_RESULT_OK)
        result = check_partition(among);
    if (result == PERCUSS_RESULT_OK)
        result = check_security(identity);
    if (result == PERCUSS_RESULT_OK)
        result = forked_check();
    if (result != PERCUSS_RESULT_OK)
        return result;
    struct percuss_client *created = calloc(1, sizeof *created);
    if (!created)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a client");
    created->operations = &LIBRARY_OPERATIONS;
    create_lock(created);
    arrivals_open(&created->arrivals);
    created->clock = wire_clock_start();
    forked_add(&created->forked, &created->operations);
    created->domain = chosen.domain;
    created->secured = identity != NULL;
    /* as DDS, which reads it once, too */
    created->identity = identity ? strdup(identity) : NULL;
    if (identity)
        wire_validity_read(identity, &created->validity);
    created->next_sequence = chosen.first_sequence;
    created->pending.window = chosen.window;
    created->least_loaded = is_least_loaded(&chosen);
    if (!created->least_loaded)
        memcpy(created->wanted, chosen.server, sizeof created->wanted);
    snprintf(created->partition, sizeof created->partition, "%s", among);

    /* its id, and its endpoints */
    result = choose_id(chosen.id, created->id);
    if (result == PERCUSS_RESULT_OK)
        result = create_entities(created, identity);
    if (result != PERCUSS_RESULT_OK) {
        client_free(created);
        return result;
    }
    *client = created;
    return PERCUSS_RESULT_OK;
}

void client_free(struct percuss_client *client)
{
    if (!client)
        return;
    forked_remove(&client->forked);
    delete_entities(client);
    pending_clear(&client->pending);
    for (int i = 0; i < CLIENT_TAKE_AT_ONCE; i++)
        dds_sample_free(&client->taken[i], &percuss_v1_Reply_desc, DDS_FREE_CONTENTS);
    arrivals_close(&client->arrivals);
    pthread_cond_destroy(&client->changed);
    pthread_mutex_destroy(&client->lock);
    free(client->identity);
    free(client);
}

void client_id(const struct percuss_client *client, uint8_t id[16])
{
    memcpy(id, client->id, 16);
}

bool client_observes(const struct percuss_client *client)
{
    return client->observes;
}

bool client_warning(const struct percuss_client *client, char text[PERCUSS_WARNING_SIZE])
{
    text[0] = '\0';
    return client->identity && wire_security_remark(client->identity, &client->validity, time(NULL),
                                                    text, PERCUSS_WARNING_SIZE);
}

enum percuss_result client_check_identity(const struct percuss_client *client)
{
    char remark[PERCUSS_WARNING_SIZE];
    if (!client->identity || !wire_validity_is_over(&client->validity, time(NULL)))
        return PERCUSS_RESULT_OK;
    client_warning(client, remark);
    return error_set(PERCUSS_RESULT_NO_SERVER, "%s", remark);
}

bool client_server(struct percuss_client *client, uint8_t server[16])
{
    static const uint8_t none[16];
    pthread_mutex_lock(&client->lock);
    memcpy(server, client->server.id, 16);
    pthread_mutex_unlock(&client->lock);
    return memcmp(server, none, sizeof none) != 0;
}

void client_watch(struct percuss_client *client, percuss_watch_function *watch, void *context)
{
    pthread_mutex_lock(&client->lock);
    client->watching = watching_begin(watch, context);
    pthread_mutex_unlock(&client->lock);
}

uint64_t client_draw_sequences(struct percuss_client *client, size_t count)
{
    uint64_t first = client->next_sequence;
    client->next_sequence += count;
    return first;
}
