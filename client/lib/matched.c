/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "matched.h"

#include <string.h>

enum { MOST_MATCHES = 64 };

bool matched_participant(matched_data *data, dds_entity_t endpoint, dds_instance_handle_t match,
                         dds_guid_t *participant)
{
    dds_builtintopic_endpoint_t *remote = data(endpoint, match);
    if (!remote)
        return false;
    *participant = remote->participant_key;
    dds_builtintopic_free_endpoint(remote);
    return true;
}

/* Whether one of `count` matches of an endpoint is that participant's. */
static bool is_among(matched_data *data, dds_entity_t endpoint,
                     const dds_instance_handle_t *matches, int count, const dds_guid_t *participant)
{
    dds_guid_t other;
    for (int i = 0; i < count && i < MOST_MATCHES; i++)
        if (matched_participant(data, endpoint, matches[i], &other) &&
            memcmp(&other, participant, sizeof other) == 0)
            return true;
    return false;
}

bool matched_both(dds_entity_t writer, dds_entity_t reader, const dds_guid_t *participant)
{
    dds_instance_handle_t takers[MOST_MATCHES], givers[MOST_MATCHES];
    int taker_count = dds_get_matched_subscriptions(writer, takers, MOST_MATCHES);
    int giver_count = dds_get_matched_publications(reader, givers, MOST_MATCHES);
    return is_among(dds_get_matched_subscription_data, writer, takers, taker_count, participant) &&
           is_among(dds_get_matched_publication_data, reader, givers, giver_count, participant);
}
