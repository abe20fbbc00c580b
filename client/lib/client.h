/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The client's inside. */
#ifndef PERCUSS_LIB_CLIENT_H
#define PERCUSS_LIB_CLIENT_H

#include <percuss/percuss.h>
#include <pthread.h>
#include <stdatomic.h>

#include "arrivals.h"
#include "forked.h"
#include "operations.h"
#include "pending.h"
#include "watching.h"
#include "wire.h"
#include "wire_clock.h"
#include "wire_validity.h"

enum {
    CLIENT_TAKE_AT_ONCE = 4,
    CLIENT_MOST_SERVERS = 16,
    SERVERS_NAME_SIZE = 128,
    CLIENT_MOST_ENDPOINTS = 16
};

/* A server that has answered a ping. */
struct client_server {
    uint8_t id[16];
    dds_instance_handle_t writer; /* of its replies to us */
    dds_guid_t participant;       /* of the one that we stay with */
};

struct percuss_client {
    const struct client_operations *operations; /* first, see operations.h */
    /* constant once created */
    uint8_t id[16];
    uint32_t domain;
    char partition[WIRE_PARTITION_SIZE]; /* of the servers; empty: none */
    bool secured;                        /* by DDS Security */
    char *identity;                      /* its folder; NULL: none */
    struct wire_validity validity;       /* of its files as they were */
    bool observes; /* its permissions let it only see announcements of servers */
    char wanted[PERCUSS_SERVER_ID_SIZE]; /* beginning of the server's id; empty: any */
    bool least_loaded;                   /* of all: the one that has least to do */
    dds_entity_t participant; /* of all clients of the domain and identity, see client.c */
    dds_entity_t request_writer;
    dds_entity_t reply_reader;

    /* the last policy but partition for which DDS refused a match of our writer, of our reader; 0:
     * none. Told by threads of DDS. */
    atomic_uint refused_requests, refused_replies;

    struct arrivals arrivals; /* told by threads of DDS */
    struct wire_clock clock;  /* the leader's */
    double clock_looked;      /* s: when it looked at it */

    pthread_mutex_t lock; /* guards everything below */
    pthread_cond_t changed;
    bool leading; /* a thread waits for arrivals, see receive.h */
    /* Replies as they came, the leader's: kept, so that their lists need no memory each time. */
    percuss_v1_Reply taken[CLIENT_TAKE_AT_ONCE];
    bool connected;
    bool lost;             /* the server does not write to us any more */
    double lost_since;     /* s; where lost */
    double newcomer_until; /* s; until then a new writer of replies may be its successor's */
    uint64_t successions;  /* how often another process has taken the server's place */
    struct client_server
        server; /* the one that we stay with; its id is all zero before the first one */
    char server_name[SERVERS_NAME_SIZE];                 /* in words */
    struct client_server answering[CLIENT_MOST_SERVERS]; /* pings of percuss_client_connect */
    size_t answering_count;
    uint64_t next_sequence;
    uint64_t pings_answered;
    struct pending_table pending;
    dds_entity_t batch_writer, batch_reader;       /* 0 until the first batch */
    dds_entity_t ensemble_writer, ensemble_reader; /* 0 until the first ensemble */
    dds_entity_t progress_reader, samples_reader;
    dds_entity_t trace_reader;               /* 0 until the first trace */
    dds_entity_t server_reader, body_reader; /* 0 until asked for */
    dds_entity_t dents_reader, dents_writer;
    dds_entity_t endpoints[CLIENT_MOST_ENDPOINTS]; /* all of them, to be deleted */
    size_t endpoint_count;
    struct watching watching;
    struct forked_entry forked; /* among all of the process */
    int announcement_room;      /* of the largest read so far, see announcements.c */
};

/* NO_SERVER, in words, where its identity has ended since it was made: it must not create anything
 * then, and gets no answers. */
enum percuss_result client_check_identity(const struct percuss_client *client);

/* A reader or writer, which goes with the client. `qos` is released. A negative return is a DDS
 * code. */
dds_entity_t client_reader_create(struct percuss_client *client,
                                  const dds_topic_descriptor_t *descriptor, const char *topic,
                                  dds_qos_t *qos);
dds_entity_t client_writer_create(struct percuss_client *client,
                                  const dds_topic_descriptor_t *descriptor, const char *topic);

/* A reader of topic `topic` in the client's own partition, which tells of its samples. */
dds_entity_t client_reply_reader_create(struct percuss_client *client,
                                        const dds_topic_descriptor_t *descriptor,
                                        const char *topic);

/* Takes `count` consecutive sequences; the lock is held. */
uint64_t client_draw_sequences(struct percuss_client *client, size_t count);

#endif
