/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The participants of the endpoints that DDS has matched with ours. */
#ifndef PERCUSS_LIB_MATCHED_H
#define PERCUSS_LIB_MATCHED_H

#include <dds/dds.h>
#include <stdbool.h>

/* dds_get_matched_publication_data for a reader's match, ..._subscription_data for a writer's. */
typedef dds_builtintopic_endpoint_t *matched_data(dds_entity_t, dds_instance_handle_t);

/* The participant behind a match of our endpoint; false when it has gone. */
bool matched_participant(matched_data *data, dds_entity_t endpoint, dds_instance_handle_t match,
                         dds_guid_t *participant);

/* Whether the participant has a reader matched with our `writer` and a writer matched with our
 * `reader`. */
bool matched_both(dds_entity_t writer, dds_entity_t reader, const dds_guid_t *participant);

#endif
