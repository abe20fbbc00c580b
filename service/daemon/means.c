/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/means.h"

#include "daemon/log.h"
#include "daemon/pulse.h"

enum percuss_status means_table_goes_on(void *context, const struct table_maker *maker, double done,
                                        struct fault *fault)
{
    struct shared *shared = context;
    pulse_beat();
    activity_set(&shared->activity, maker, done, "computing a contact table");
    if (atomic_load(&shared->draining))
        return fault_set(fault, PERCUSS_BUSY, SHARED_SHUTTING_DOWN);
    if (reply_store_is_gone(shared->replies, maker->client))
        return fault_set(fault, PERCUSS_TIMEOUT, SHARED_CLIENT_GONE);
    return PERCUSS_OK;
}

void means_table_ended(void *context, const struct table_maker *maker)
{
    struct shared *shared = context;
    activity_clear(&shared->activity, maker);
}

static void complain(const struct envelope *envelope, const char *text)
{
    log_about(LEVEL_ERROR, &(struct log_request){envelope->client, envelope->sequence},
              "internal: %s", text);
}

struct responder *means_responder(struct shared *shared, enum lane lane)
{
    struct respond_means means = {
        .tokens = shared->tokens,
        .limit = shared->settings->limit_seconds,
        .beat = pulse_beat,
        .complain = complain,
    };
    if (lane == LANE_TABLES)
        means.tables = (struct table_wait){means_table_goes_on, means_table_ended, shared};
    struct responder *responder = responder_create(&means);
    if (responder)
        responder->lane = lane;
    return responder;
}
