/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Topic names, quality of service and the built-in configuration: what both ends must agree on. */
#ifndef PERCUSS_WIRE_H
#define PERCUSS_WIRE_H

#include <dds/dds.h>
#include <stdint.h>

#include "percuss_wire.h"
#include "wire_partition.h"

#define WIRE_TOPIC_REQUEST           "percuss/v1/Request"
#define WIRE_TOPIC_REPLY             "percuss/v1/Reply"
#define WIRE_TOPIC_BATCH_REQUEST     "percuss/v1/BatchRequest"
#define WIRE_TOPIC_BATCH_REPLY       "percuss/v1/BatchReply"
#define WIRE_TOPIC_ENSEMBLE_REQUEST  "percuss/v1/EnsembleRequest"
#define WIRE_TOPIC_ENSEMBLE_PROGRESS "percuss/v1/EnsembleProgress"
#define WIRE_TOPIC_ENSEMBLE_SAMPLES  "percuss/v1/EnsembleSamples"
#define WIRE_TOPIC_ENSEMBLE_REPLY    "percuss/v1/EnsembleReply"
#define WIRE_TOPIC_TRACE             "percuss/v1/Trace"
#define WIRE_TOPIC_SERVER_STATUS     "percuss/v1/ServerStatus"
#define WIRE_TOPIC_BODY              "percuss/v1/Body"
#define WIRE_TOPIC_DENTS             "percuss/v1/Dents"

enum { WIRE_WINDOW = 1024 };

/* Codes of a participant besides those of DDS: what it needs is checked first, as it would end the
 * process. */
enum {
    WIRE_NO_DESCRIPTORS = -9001,
    WIRE_NO_ADDRESS_SPACE = -9002,
    WIRE_NO_INDEX = -9003,         /* without CYCLONEDDS_URI: other processes have them all */
    WIRE_NO_LOOPBACK = -9004,      /* without CYCLONEDDS_URI: 127.0.0.1 is not up */
    WIRE_NO_SHARED_MEMORY = -9005, /* CYCLONEDDS_URI has it enabled, without its daemon */
    WIRE_CONFIGURED_BADLY = -9006  /* CYCLONEDDS_URI cannot be used */
};

/* A participant in `domain`. Without CYCLONEDDS_URI in the environment it uses a built-in
 * configuration: processes of this machine, which hear nobody else (wire_loopback.h), unless the
 * process has the domain already. Returns the entity or a negative DDS return code, for
 * wire_participant_problem. */
dds_entity_t wire_participant_create(uint32_t domain);

/* The same with DDS Security: as the identity whose folder `security` is, which wire_security_check
 * has found good; NULL: without. */
dds_entity_t wire_participant_create_secured(uint32_t domain, const char *security);

/* The same for a client, which asks servers and has nothing to do with other clients. */
dds_entity_t wire_participant_create_client(uint32_t domain, const char *security);

/* The same in Cyclone DDS's own configuration where CYCLONEDDS_URI states none: other machines are
 * heard. */
dds_entity_t wire_participant_create_open(uint32_t domain);

/* Whether CYCLONEDDS_URI configures the network, so that other machines may be heard. */
bool wire_is_configured(void);

/* What such a code means, in words that last until the thread asks again. */
const char *wire_participant_problem(dds_return_t code);

/* A topic whose readers drop every sample that is not a whole one of its type (wire_whole.h) before
 * DDS decodes it. `descriptor`: of an @appendable type with a key, which goes as XCDR2, or of a
 * @final one without, which goes as XCDR1. Returns the entity, a child of the participant, or a
 * negative DDS return code. */
dds_entity_t wire_topic_create(dds_entity_t participant, const dds_topic_descriptor_t *descriptor,
                               const char *name);

/* Quality of service of requests and replies of every kind: RELIABLE, VOLATILE, KEEP_LAST
 * WIRE_WINDOW per client, blocking at most 100 ms. `partition` NULL or empty: the default one.
 * The caller deletes the result with dds_delete_qos. */
dds_qos_t *wire_qos_exchange(const char *partition);

/* Quality of service of Body, ServerStatus and Dents: RELIABLE, TRANSIENT_LOCAL, KEEP_LAST 1. */
dds_qos_t *wire_qos_announcement(const char *partition);

#endif
