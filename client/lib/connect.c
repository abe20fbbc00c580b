/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Finding a server. A volatile request or reply that is written before both ends know each other is
 * lost, so a client asks only after both directions are matched and a ping came back. */

#include <math.h>
#include <string.h>

#include "connect.h"
#include "error.h"
#include "exchange.h"
#include "receive.h"

enum { MOST_MATCHES = 64 };
static const double match_poll = 1e-3;    /* s */
static const double ping_interval = 5e-3; /* s */
static const double grace = 2.0; /* s until incompatible qualities of service are a verdict */

/* The participant behind a matched endpoint; false when it has just gone. */
typedef dds_builtintopic_endpoint_t *matched_data(dds_entity_t, dds_instance_handle_t);

static bool participant_of(matched_data *data, dds_entity_t endpoint, dds_instance_handle_t match,
                           dds_guid_t *participant)
{
    dds_builtintopic_endpoint_t *remote = data(endpoint, match);
    if (!remote)
        return false;
    *participant = remote->participant_key;
    dds_builtintopic_free_endpoint(remote);
    return true;
}

/* Whether some participant both reads our requests and writes to our partition. */
static bool same_server_matched(dds_entity_t writer, dds_entity_t reader)
{
    dds_instance_handle_t readers[MOST_MATCHES], writers[MOST_MATCHES];
    int reader_count = dds_get_matched_subscriptions(writer, readers, MOST_MATCHES);
    int writer_count = dds_get_matched_publications(reader, writers, MOST_MATCHES);
    for (int i = 0; i < reader_count && i < MOST_MATCHES; ++i) {
        dds_guid_t taker, giver;
        if (!participant_of(dds_get_matched_subscription_data, writer, readers[i], &taker))
            continue;
        for (int j = 0; j < writer_count && j < MOST_MATCHES; ++j)
            if (participant_of(dds_get_matched_publication_data, reader, writers[j], &giver) &&
                memcmp(&taker, &giver, sizeof taker) == 0)
                return true;
    }
    return false;
}

static const char *policy_name(uint32_t policy)
{
    static const struct {
        dds_qos_policy_id_t policy;
        const char *name;
    } names[] = {
        {DDS_DURABILITY_QOS_POLICY_ID, "durability"},
        {DDS_PRESENTATION_QOS_POLICY_ID, "presentation"},
        {DDS_DEADLINE_QOS_POLICY_ID, "deadline"},
        {DDS_OWNERSHIP_QOS_POLICY_ID, "ownership"},
        {DDS_LIVELINESS_QOS_POLICY_ID, "liveliness"},
        {DDS_RELIABILITY_QOS_POLICY_ID, "reliability"},
        {DDS_DESTINATIONORDER_QOS_POLICY_ID, "destination order"},
        {DDS_TYPE_CONSISTENCY_ENFORCEMENT_QOS_POLICY_ID, "type consistency"},
        {DDS_DATA_REPRESENTATION_QOS_POLICY_ID, "data representation"},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
        if (names[i].policy == policy)
            return names[i].name;
    return "a policy unknown to this library";
}

/* INCOMPATIBLE with the policy in words if Cyclone has refused a match, else OK. */
static enum percuss_result check_compatible(dds_entity_t writer, dds_entity_t reader)
{
    dds_offered_incompatible_qos_status_t offered = {0};
    dds_requested_incompatible_qos_status_t requested = {0};
    dds_get_offered_incompatible_qos_status(writer, &offered);
    dds_get_requested_incompatible_qos_status(reader, &requested);
    if (offered.total_count == 0 && requested.total_count == 0)
        return PERCUSS_RESULT_OK;
    bool requests = offered.total_count > 0;
    uint32_t policy = requests ? offered.last_policy_id : requested.last_policy_id;
    return error_set(PERCUSS_RESULT_INCOMPATIBLE,
                     "a server is there, but its %s do not match ours: %s (policy %u)",
                     requests ? "requests" : "replies", policy_name(policy), policy);
}

enum percuss_result connect_match(struct percuss_client *client, dds_entity_t writer,
                                  dds_entity_t reader, double deadline)
{
    double verdict = fmin(deadline, receive_now() + grace);
    while (!same_server_matched(writer, reader)) {
        double now = receive_now();
        enum percuss_result result =
            now < verdict ? PERCUSS_RESULT_OK : check_compatible(writer, reader);
        if (result != PERCUSS_RESULT_OK)
            return result;
        if (now >= deadline)
            return error_set(PERCUSS_RESULT_NO_SERVER, "no percussd in DDS domain %u",
                             client->domain);
        dds_sleepfor((dds_duration_t)(1e9 * match_poll));
    }
    return PERCUSS_RESULT_OK;
}

static bool ping_is_answered(const struct percuss_client *client, const void *subject)
{
    const uint64_t *before = subject;
    return client->pings_answered > *before;
}

/* Pings every `interval` until answered; the lock is held. */
static enum percuss_result ping_until_answered(struct percuss_client *client, double interval,
                                               double deadline)
{
    percuss_v2_Request ping = {0};
    memcpy(ping.client, client->id, sizeof ping.client);
    uint64_t before = client->pings_answered;
    enum percuss_result result = PERCUSS_RESULT_TIMEOUT;
    while (result == PERCUSS_RESULT_TIMEOUT) {
        dds_return_t code = dds_write(client->request_writer, &ping);
        if (code < 0 && code != DDS_RETCODE_TIMEOUT)
            return error_dds("writing a ping", code);
        double until = fmin(deadline, receive_now() + interval);
        result = receive_until(client, ping_is_answered, &before, until);
        if (result == PERCUSS_RESULT_TIMEOUT && until >= deadline)
            return error_set(result, "the server does not answer pings");
    }
    return result;
}

enum percuss_result percuss_client_connect(struct percuss_client *client, double timeout)
{
    double deadline;
    enum percuss_result result = receive_deadline(timeout, &deadline);
    if (result == PERCUSS_RESULT_OK)
        result = connect_match(client, client->request_writer, client->reply_reader, deadline);
    if (result != PERCUSS_RESULT_OK)
        return result;
    pthread_mutex_lock(&client->lock);
    result = ping_until_answered(client, ping_interval, deadline);
    client->connected = result == PERCUSS_RESULT_OK;
    pthread_mutex_unlock(&client->lock);
    return result == PERCUSS_RESULT_TIMEOUT ? PERCUSS_RESULT_NO_SERVER : result;
}

static bool never(const struct percuss_client *client, const void *subject)
{
    (void)client, (void)subject;
    return false;
}

enum percuss_result percuss_ping(struct percuss_client *client, double timeout, double *round_trip)
{
    double deadline;
    enum percuss_result result = receive_deadline(timeout, &deadline);
    if (result != PERCUSS_RESULT_OK)
        return result;
    pthread_mutex_lock(&client->lock);
    result = exchange_check_connected(client);
    if (result == PERCUSS_RESULT_OK) {
        // answers to earlier pings, which look the same, must not count
        receive_until(client, never, NULL, 0.0);
        double start = receive_now();
        result = ping_until_answered(client, timeout, deadline);
        *round_trip = receive_now() - start;
    }
    pthread_mutex_unlock(&client->lock);
    return result;
}
