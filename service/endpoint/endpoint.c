/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/endpoint.h"

#include <dds/ddsi/ddsi_serdata.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "endpoint/authorisation.h"
#include "endpoint/writer_queues.h"
#include "exchange/describe.h"
#include "exchange/text.h"
#include "wire_clock.h"
#include "wire_security.h"

/* Requests of one kind: taken from DDS, put in the order of turns, decoded and handed on. Of the
 * thread that runs the endpoint. */

/* All samples are taken before any is decoded, so that many writers can take turns; a few are
 * decoded before the next look for new events. */
enum { TAKEN_AT_ONCE = 32, TAKEN_BEFORE = 32 * TAKEN_AT_ONCE, SERVED_AT_ONCE = 16 };

struct intake {
    enum exchange exchange;
    dds_entity_t reader;
    void *sample;                 /* the one at hand; its memory serves the next one */
    struct writer_queues *queues; /* of serialised data */
};

/* The means to decide about a request, and its handler. */
struct intake_context {
    const uint8_t *server;               /* this one's id */
    struct authorisation *authorisation; /* of clients' ids */
    atomic_ullong *strange; /* counts requests with the id of a client that did not send them */
    const struct endpoint_handler *handler;
};

static const struct {
    const char *topic;
    const dds_topic_descriptor_t *type;
} requests[EXCHANGE_COUNT] = {
    [EXCHANGE_SINGLE] = {WIRE_TOPIC_REQUEST, &percuss_v1_Request_desc},
    [EXCHANGE_BATCH] = {WIRE_TOPIC_BATCH_REQUEST, &percuss_v1_BatchRequest_desc},
    [EXCHANGE_ENSEMBLE] = {WIRE_TOPIC_ENSEMBLE_REQUEST, &percuss_v1_EnsembleRequest_desc},
};

static void intake_drop(void *taken)
{
    ddsi_serdata_unref(taken);
}

/* Makes the reader, a child of the participant. False with a fault; intake_close is due all the
 * same, before the participant's end. */
static bool intake_open(struct intake *intake, enum exchange exchange, dds_entity_t participant,
                        const char *partition, struct fault *fault)
{
    const dds_topic_descriptor_t *type = requests[exchange].type;
    *intake = (struct intake){.exchange = exchange,
                              .sample = dds_alloc(type->m_size),
                              .queues = writer_queues_create(WIRE_WINDOW, intake_drop)};
    if (!intake->queues) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        return false;
    }
    dds_entity_t topic = wire_topic_create(participant, type, requests[exchange].topic);
    dds_qos_t *qos = wire_qos_exchange(partition);
    intake->reader = topic > 0 ? dds_create_reader(participant, topic, qos, NULL) : topic;
    dds_delete_qos(qos);
    if (intake->reader < 0)
        fault_set(fault, PERCUSS_INTERNAL, "DDS: reader of %s: %s", requests[exchange].topic,
                  dds_strretcode(intake->reader));
    return intake->reader > 0;
}

static void intake_close(struct intake *intake)
{
    writer_queues_free(intake->queues);
    if (intake->sample)
        dds_sample_free(intake->sample, requests[intake->exchange].type, DDS_FREE_ALL);
}

/* Requests wake by the status of their reader. A read condition would do so while DDS still holds
 * the reader's lock, so that taking them costs another sleep, some 8 us. The status tells of new
 * samples only: the woken thread takes until none is left. */
static bool intake_attach(const struct intake *intake, dds_entity_t waitset)
{
    return dds_set_status_mask(intake->reader, DDS_DATA_AVAILABLE_STATUS) == DDS_RETCODE_OK &&
           dds_waitset_attach(waitset, intake->reader, intake->exchange) == DDS_RETCODE_OK;
}

/* The ids of the server and of the client in the sample at hand. */
static const uint8_t *intake_addressee(const struct intake *intake, const uint8_t **client)
{
    if (intake->exchange == EXCHANGE_BATCH) {
        const percuss_v1_BatchRequest *batch = intake->sample;
        *client = batch->client;
        return batch->server;
    }
    if (intake->exchange == EXCHANGE_ENSEMBLE) {
        const percuss_v1_EnsembleRequest *ensemble = intake->sample;
        *client = ensemble->client;
        return ensemble->server;
    }
    const percuss_v1_Request *request = intake->sample;
    *client = request->client;
    return request->server;
}

/* Whether the sample at hand is for this server, or any, and its client's own. A stranger gets no
 * reply: it would go to the client. */
static bool intake_is_due(struct intake *intake, const struct intake_context *context,
                          dds_instance_handle_t writer)
{
    static const uint8_t anybody[16];
    const uint8_t *client, *server = intake_addressee(intake, &client);
    if (memcmp(server, anybody, sizeof anybody) != 0 &&
        memcmp(server, context->server, sizeof anybody) != 0)
        return false;
    bool own = authorisation_allow_writer(context->authorisation, client, intake->reader, writer);
    if (!own)
        atomic_fetch_add(context->strange, 1);
    return own;
}

static void intake_hand_on(const struct intake *intake, const struct endpoint_handler *handler,
                           bool alone)
{
    if (intake->exchange == EXCHANGE_SINGLE)
        handler->single(handler->context, intake->sample, alone);
    else if (intake->exchange == EXCHANGE_BATCH)
        handler->batch(handler->context, intake->sample);
    else
        handler->ensemble(handler->context, intake->sample);
}

/* Decodes a taken sample, hands it on if it is due here, and releases it. */
static void intake_serve_one(struct intake *intake, const struct intake_context *context,
                             struct ddsi_serdata *taken, dds_instance_handle_t writer, bool alone)
{
    if (ddsi_serdata_to_sample(taken, intake->sample, NULL, NULL) &&
        intake_is_due(intake, context, writer))
        intake_hand_on(intake, context->handler, alone);
    ddsi_serdata_unref(taken);
}

/* Takes the samples of the reader, up to a bound; true: more may be left. One that comes alone is
 * served at once. */
static bool intake_take(struct intake *intake, const struct intake_context *context)
{
    struct ddsi_serdata *taken[TAKEN_AT_ONCE];
    dds_sample_info_t infos[TAKEN_AT_ONCE];
    dds_return_t count = TAKEN_AT_ONCE;
    for (int all = 0; count == TAKEN_AT_ONCE && all < TAKEN_BEFORE; all += TAKEN_AT_ONCE) {
        count = dds_takecdr(intake->reader, taken, TAKEN_AT_ONCE, infos, DDS_ANY_STATE);
        bool alone = count == 1 && writer_queues_is_empty(intake->queues);
        /* samples without data only tell that a client's writer has gone */
        for (dds_return_t i = 0; i < count; i++) {
            if (!infos[i].valid_data)
                ddsi_serdata_unref(taken[i]);
            else if (alone)
                intake_serve_one(intake, context, taken[i], infos[i].publication_handle, true);
            else
                writer_queues_put(intake->queues, infos[i].publication_handle, taken[i]);
        }
    }
    return count == TAKEN_AT_ONCE;
}

/* Serves a few of the samples taken; true: some are left. */
static bool intake_serve(struct intake *intake, const struct intake_context *context)
{
    for (int i = 0; i < SERVED_AT_ONCE && !writer_queues_is_empty(intake->queues); i++) {
        uint64_t writer;
        struct ddsi_serdata *taken = writer_queues_take(intake->queues, &writer);
        intake_serve_one(intake, context, taken, writer, false);
    }
    return !writer_queues_is_empty(intake->queues);
}

/* The topic of specimens. Clients write volatile samples, which the readers of announcements do not
 * get. */

enum { DENTS_AT_ONCE = 8 };

struct dents_topic {
    dds_entity_t reader, writer; /* 0: not open */
    uint8_t server[16];
};

/* Opens it for that server. The participant's end closes it. False with a fault. */
static bool dents_topic_open(struct dents_topic *topic, dds_entity_t participant,
                             const char *partition, const uint8_t server[16], struct fault *fault)
{
    memcpy(topic->server, server, sizeof topic->server);
    dds_entity_t name = wire_topic_create(participant, &percuss_v1_Dents_desc, WIRE_TOPIC_DENTS);
    dds_qos_t *announces = wire_qos_announcement(partition), *hears = wire_qos_exchange(partition);
    dds_qset_ignorelocal(hears, DDS_IGNORELOCAL_PARTICIPANT);
    topic->writer = dds_create_writer(participant, name, announces, NULL);
    topic->reader = dds_create_reader(participant, name, hears, NULL);
    dds_delete_qos(announces);
    dds_delete_qos(hears);
    if (topic->writer > 0 && topic->reader > 0 &&
        dds_set_status_mask(topic->reader, DDS_DATA_AVAILABLE_STATUS) == DDS_RETCODE_OK)
        return true;
    fault_set(fault, PERCUSS_INTERNAL, "DDS: " WIRE_TOPIC_DENTS ": %s",
              dds_strretcode(topic->reader < 0 ? topic->reader : topic->writer));
    return false;
}

static void fill_patches(percuss_v1_Dent *patches, const struct body_state *state)
{
    const struct dent *dents = body_state_dents(state);
    for (size_t i = 0; i < state->dents; i++) {
        memcpy(patches[i].point, dents[i].point, sizeof patches[i].point);
        patches[i].size = dents[i].size;
        patches[i].max_indentation = dents[i].history.max_indentation;
        patches[i].max_force = dents[i].history.max_force;
        patches[i].residual_indentation = dents[i].history.dent;
        patches[i].contact_radius = dents[i].history.contact_radius;
    }
}

static void dents_topic_announce(const struct dents_topic *topic, const struct dents_notice *notice)
{
    percuss_v1_Dent patches[BODY_STATE_MAX_DENTS];
    percuss_v1_Dents wire = {.impacts = notice->impacts};
    uint32_t count = notice->state ? (uint32_t)notice->state->dents : 0;
    COPY_TEXT(wire.specimen, notice->specimen);
    COPY_TEXT(wire.body, notice->body);
    memcpy(wire.server, topic->server, sizeof wire.server);
    if (count)
        fill_patches(patches, notice->state);
    wire.patches._buffer = patches;
    wire.patches._length = wire.patches._maximum = count;
    dds_write(topic->writer, &wire);
}

static void dents_topic_withdraw(const struct dents_topic *topic, const char *specimen)
{
    percuss_v1_Dents wire = {0};
    COPY_TEXT(wire.specimen, specimen);
    memcpy(wire.server, topic->server, sizeof wire.server);
    dds_dispose(topic->writer, &wire);
}

/* Shows the specimens of this server that clients want cleared. */
static void dents_topic_take(const struct dents_topic *topic,
                             void (*clear)(void *context, const char *specimen), void *context)
{
    void *samples[DENTS_AT_ONCE] = {NULL};
    dds_sample_info_t infos[DENTS_AT_ONCE];
    dds_return_t count;
    while ((count = dds_take(topic->reader, samples, infos, DENTS_AT_ONCE, DENTS_AT_ONCE)) > 0) {
        for (dds_return_t i = 0; i < count; i++) {
            const percuss_v1_Dents *wire = samples[i];
            if (infos[i].valid_data && wire->clear &&
                memcmp(wire->server, topic->server, sizeof wire->server) == 0)
                clear(context, wire->specimen);
        }
        dds_return_loan(topic->reader, samples, count);
    }
}

/* The other servers of the domain. */

/* Always the same room: Cyclone DDS 0.10.2 fills that of the loan of an earlier read. */
enum { SERVERS_AT_ONCE = 64 };

/* A reader of their announcements, which the participant's end closes; 0 with a fault. */
static dds_entity_t servers_open(dds_entity_t participant, const char *partition,
                                 struct fault *fault)
{
    dds_qos_t *qos = wire_qos_announcement(partition);
    dds_qset_ignorelocal(qos, DDS_IGNORELOCAL_PARTICIPANT);
    dds_entity_t reader =
        wire_topic_create(participant, &percuss_v1_ServerStatus_desc, WIRE_TOPIC_SERVER_STATUS);
    if (reader > 0)
        reader = dds_create_reader(participant, reader, qos, NULL);
    dds_delete_qos(qos);
    if (reader > 0)
        return reader;
    fault_set(fault, PERCUSS_INTERNAL, "DDS: reader of " WIRE_TOPIC_SERVER_STATUS ": %s",
              dds_strretcode(reader));
    return 0;
}

/* Shows each of them that is alive. */
static void servers_visit(dds_entity_t reader, server_visitor *visitor, void *context)
{
    void *samples[SERVERS_AT_ONCE] = {NULL};
    dds_sample_info_t infos[SERVERS_AT_ONCE];
    dds_return_t count =
        dds_read_mask(reader, samples, infos, SERVERS_AT_ONCE, SERVERS_AT_ONCE,
                      DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE);
    for (dds_return_t i = 0; i < count; i++) {
        if (infos[i].valid_data)
            visitor(context, samples[i]);
    }
    if (count > 0)
        dds_return_loan(reader, samples, count);
}

/* The endpoint. */

enum { WRITE_ATTEMPTS = 20 };

/* Events that wake the reading thread: requests of each kind, and these. */
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
    struct reply_writers *writers; /* thread-safe, with the exceptions that its header names */
    /* of the thread that runs it */
    struct intake intakes[EXCHANGE_COUNT];
    /* of the thread that looks for other servers */
    dds_entity_t servers;  /* the reader of their announcements */
    atomic_bool stopped;   /* any thread sets it */
    atomic_ullong strange; /* requests with the id of a client that did not send them */
};

/* Whether the entity was created; else the fault names its purpose. */
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

/* The given id, or a random one. */
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
    /* readers, writers, and the waitset of the reading thread */
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
    bool left = false; /* requests are left, without a further wake-up */
    struct intake_context context = {endpoint->server,
                                     reply_writers_authorisation(endpoint->writers),
                                     &endpoint->strange, handler};
    while (!atomic_load(&endpoint->stopped)) {
        /* sources with events, left from the last time or new */
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
            ready[i] = ready[i] && intake_take(&endpoint->intakes[i], &context);
            left = intake_serve(&endpoint->intakes[i], &context) || ready[i] || left;
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
    percuss_v1_Body body = {0};
    memcpy(body.server, endpoint->server, sizeof body.server);
    for (size_t i = 0; before && i < before->count; i++) {
        if (body_set_find(set, before->bodies[i].id))
            continue;
        memcpy(body.id, before->bodies[i].id, sizeof body.id);
        dds_dispose(endpoint->body_writer, &body);
    }
    struct describer describer;
    if (!describe_begin(&describer, set))
        return false;
    bool good = true;
    for (size_t i = 0; i < set->count; i++) {
        describe_body(&describer, &set->bodies[i], &body);
        memcpy(body.server, endpoint->server, sizeof body.server);
        COPY_TEXT(body.catalogue_revision, set->revision);
        good = write_patiently(endpoint->body_writer, &body) && good;
    }
    describe_end(&describer);
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
