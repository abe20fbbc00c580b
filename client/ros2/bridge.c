/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "bridge.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "say.h"
#include "service.h"
#include "wire.h"

static const double BODIES_TIMEOUT = 1.0; /* s; they are there already, once connected */

static bool is_silent(struct bridge_silent *silent, dds_instance_handle_t writer)
{
    bool found = false;
    pthread_mutex_lock(&silent->lock);
    for (unsigned i = 0; i < silent->count && i < BRIDGE_MOST_SILENT && !found; i++)
        found = silent->writers[i] == writer;
    pthread_mutex_unlock(&silent->lock);
    return found;
}

/* Waits for the reader of who asks, but once for somebody who has none. */
static void await_reader(struct bridge *bridge, dds_instance_handle_t client)
{
    struct bridge_silent *silent = &bridge->silent;
    if (is_silent(silent, client) ||
        service_await(bridge->request_reader, bridge->reply_writer, client))
        return;
    pthread_mutex_lock(&silent->lock);
    silent->writers[silent->count++ % BRIDGE_MOST_SILENT] = client;
    pthread_mutex_unlock(&silent->lock);
}

/* A question on the topic: the reply has the same client and number. */
static void answer_topic(struct bridge *bridge, struct ask *ask, const void *sample,
                         dds_instance_handle_t client)
{
    const percuss_msgs_msg_dds__Request_ *request = sample;
    percuss_msgs_msg_dds__Reply_ reply = {.sequence_number = request->sequence_number};
    memcpy(reply.client, request->client, sizeof reply.client);
    ask_answer(&bridge->line, ask, &request->question);
    reply.answer = ask->answer;
    await_reader(bridge, client);
    dds_return_t written = dds_write(bridge->reply_writer, &reply);
    if (written < 0)
        say("a reply was not written: %s", dds_strretcode(-written));
    ask_clear(ask);
}

/* One of the service: the reply begins with what the request began with. */
static void answer_service(struct bridge *bridge, struct ask *ask, const void *sample,
                           dds_instance_handle_t client)
{
    const percuss_msgs_srv_dds__Impact_Request_ *request = sample;
    percuss_msgs_srv_dds__Impact_Response_ response = {.header_guid = request->header_guid,
                                                       .header_number = request->header_number};
    ask_answer(&bridge->line, ask, &request->question);
    response.answer = ask->answer;
    service_await(bridge->service_reader, bridge->service_writer, client);
    dds_return_t written = dds_write(bridge->service_writer, &response);
    if (written < 0)
        say("a response was not written: %s", dds_strretcode(-written));
    ask_clear(ask);
}

/* Takes and answers one question of that reader, if there is one. */
static void serve(struct bridge *bridge, struct ask *ask, dds_entity_t reader)
{
    void *sample = NULL;
    dds_sample_info_t info;
    if (dds_take(reader, &sample, &info, 1, 1) != 1)
        return;
    if (info.valid_data && reader == bridge->request_reader)
        answer_topic(bridge, ask, sample, info.publication_handle);
    else if (info.valid_data)
        answer_service(bridge, ask, sample, info.publication_handle);
    dds_return_loan(reader, &sample, 1);
}

static void *work(void *argument)
{
    struct bridge *bridge = argument;
    struct ask *ask = calloc(1, sizeof *ask);
    dds_entity_t waitset = dds_create_waitset(bridge->participant);
    const dds_entity_t readers[] = {bridge->request_reader, bridge->service_reader};
    bool stopped = !ask || waitset < 0 || dds_waitset_attach(waitset, bridge->stop, 0) < 0;
    /* conditions, which hold while there are samples: each take leaves the others */
    for (size_t i = 0; i < 2 && !stopped; i++) {
        dds_entity_t unread = dds_create_readcondition(readers[i], DDS_ANY_STATE);
        stopped = unread < 0 || dds_waitset_attach(waitset, unread, unread) < 0;
    }
    if (stopped)
        say("a thread could not begin");
    /* every thread is woken, one gets the sample */
    while (!stopped) {
        dds_attach_t woken[3];
        dds_waitset_wait(waitset, woken, 3, DDS_INFINITY);
        for (size_t i = 0; i < 2; i++)
            serve(bridge, ask, readers[i]);
        bool triggered = false;
        stopped = dds_read_guardcondition(bridge->stop, &triggered) < 0 || triggered;
    }
    if (waitset > 0)
        dds_delete(waitset);
    free(ask);
    return NULL;
}

/* A reader or a writer of a topic named `kind`/`prefix`/`name`; 0 after a message. */
static dds_entity_t create_end(struct bridge *bridge, const dds_topic_descriptor_t *type,
                               const char *kind, const char *name, dds_qos_t *qos)
{
    char topic_name[BRIDGE_NAME_SIZE + 32];
    bool reads = strstr(name, "equest") != NULL;
    snprintf(topic_name, sizeof topic_name, "%s/%s/%s", kind, bridge->config.prefix, name);
    dds_entity_t topic = wire_topic_create(bridge->participant, type, topic_name);
    dds_entity_t end = topic;
    if (topic > 0)
        end = reads ? dds_create_reader(bridge->participant, topic, qos, NULL)
                    : dds_create_writer(bridge->participant, topic, qos, NULL);
    if (end < 0)
        say("%s: %s", topic_name, dds_strretcode(-end));
    return end < 0 ? 0 : end;
}

static bool create_ends(struct bridge *bridge)
{
    dds_qos_t *topics = wire_qos_exchange(NULL), *service = wire_qos_exchange(NULL);
    dds_qos_t *announced = wire_qos_announcement(NULL);
    service_name(bridge->participant, service);
    bridge->reply_writer =
        create_end(bridge, &percuss_msgs_msg_dds__Reply__desc, "rt", "reply", topics);
    bridge->request_reader =
        create_end(bridge, &percuss_msgs_msg_dds__Request__desc, "rt", "request", topics);
    bridge->service_writer = create_end(bridge, &percuss_msgs_srv_dds__Impact_Response__desc, "rr",
                                        "impactReply", service);
    bridge->service_reader = create_end(bridge, &percuss_msgs_srv_dds__Impact_Request__desc, "rq",
                                        "impactRequest", service);
    bridge->body_writer =
        create_end(bridge, &percuss_msgs_msg_dds__BodyList__desc, "rt", "bodies", announced);
    dds_delete_qos(announced);
    dds_delete_qos(service);
    dds_delete_qos(topics);
    return bridge->reply_writer && bridge->request_reader && bridge->service_writer &&
           bridge->service_reader && bridge->body_writer;
}

bool bridge_open(struct bridge *bridge, const struct bridge_config *config)
{
    *bridge = (struct bridge){
        .config = *config, .line = {.domain = config->client.domain, .timeout = config->timeout}};
    pthread_mutex_init(&bridge->line.lock, NULL);
    pthread_mutex_init(&bridge->silent.lock, NULL);
    /* percussd's side first: where both are in one domain, its participant makes it */
    char warning[PERCUSS_WARNING_SIZE];
    if (percuss_client_create(&config->client, &bridge->line.client) != PERCUSS_RESULT_OK) {
        say("%s", percuss_error_text());
        return false;
    }
    if (percuss_client_observes(bridge->line.client)) {
        say("PERCUSS_SECURITY: the permissions of that identity do not allow asking");
        return false;
    }
    if (percuss_client_warning(bridge->line.client, warning))
        say("warning: %s", warning);
    bridge->participant = config->network ? dds_create_participant(config->ros_domain, NULL, NULL)
                                          : wire_participant_create(config->ros_domain);
    if (bridge->participant < 0) {
        say("DDS domain %u: %s", config->ros_domain, wire_participant_problem(bridge->participant));
        return false;
    }
    if (!create_ends(bridge))
        return false;
    bridge->stop = dds_create_guardcondition(bridge->participant);
    while (bridge->running < config->threads) {
        if (bridge->stop < 0 ||
            pthread_create(&bridge->threads[bridge->running], NULL, work, bridge)) {
            say("a thread cannot be made");
            return false;
        }
        bridge->running++;
    }
    return true;
}

static bool same_bodies(const struct percuss_body_list *a, const struct percuss_body_list *b)
{
    return a->count == b->count &&
           (a->count == 0 || memcmp(a->bodies, b->bodies, a->count * sizeof *a->bodies) == 0);
}

void bridge_tend(struct bridge *bridge)
{
    struct percuss_body_list list = {0};
    struct give_pieces pieces = {0};
    percuss_msgs_msg_dds__BodyList_ bodies = {0};
    /* a server that is lost is looked for when somebody asks, the first one at once */
    if (percuss_bodies(bridge->line.client, BODIES_TIMEOUT, &list) != PERCUSS_RESULT_OK) {
        if (!ask_connect(&bridge->line, ask_connections(&bridge->line)) ||
            percuss_bodies(bridge->line.client, BODIES_TIMEOUT, &list) != PERCUSS_RESULT_OK)
            return;
    }
    if (same_bodies(&list, &bridge->announced)) {
        percuss_body_list_free(&list);
        return;
    }
    if (give_bodies(&pieces, &list, &bodies) && dds_write(bridge->body_writer, &bodies) >= 0) {
        percuss_body_list_free(&bridge->announced);
        bridge->announced = list;
    } else {
        percuss_body_list_free(&list);
    }
    give_pieces_free(&pieces);
}

void bridge_free(struct bridge *bridge)
{
    if (bridge->stop > 0)
        dds_set_guardcondition(bridge->stop, true);
    for (unsigned i = 0; i < bridge->running; i++)
        pthread_join(bridge->threads[i], NULL);
    if (bridge->participant > 0)
        dds_delete(bridge->participant);
    percuss_body_list_free(&bridge->announced);
    percuss_client_free(bridge->line.client);
    pthread_mutex_destroy(&bridge->line.lock);
    pthread_mutex_destroy(&bridge->silent.lock);
}
