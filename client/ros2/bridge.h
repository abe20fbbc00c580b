/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Topics and a service of ROS 2 on the one side, a percussd on the other. Threads take what is
 * asked, each a question at a time, and wait for the answer. */
#ifndef PERCUSS_ROS2_BRIDGE_H
#define PERCUSS_ROS2_BRIDGE_H

#include <dds/dds.h>
#include <percuss/percuss.h>
#include <pthread.h>

#include "ask.h"

enum { BRIDGE_NAME_SIZE = 128, BRIDGE_MOST_THREADS = 64, BRIDGE_MOST_SILENT = 64 };

struct bridge_config {
    struct percuss_client_config client;
    uint32_t ros_domain;
    bool network;       /* the side of ROS 2 hears other machines */
    const char *prefix; /* of all names: letters, digits, _ and / */
    double timeout;     /* s for an answer */
    unsigned threads;
};

/* Who asks on the topic and reads no replies: others do. The latest ones. */
struct bridge_silent {
    pthread_mutex_t lock;
    dds_instance_handle_t writers[BRIDGE_MOST_SILENT];
    unsigned count;
};

struct bridge {
    struct bridge_config config;
    struct ask_line line;
    dds_entity_t participant, stop;
    dds_entity_t request_reader, reply_writer;   /* topics */
    dds_entity_t service_reader, service_writer; /* rmw_cyclonedds */
    dds_entity_t body_writer;
    struct percuss_body_list announced;
    struct bridge_silent silent;
    pthread_t threads[BRIDGE_MOST_THREADS];
    unsigned running;
};

/* False, with what is wrong on standard error; bridge_free in any case. */
bool bridge_open(struct bridge *bridge, const struct bridge_config *config);

/* To be called now and then: connects where no server is known, and announces its bodies where they
 * are others than before. */
void bridge_tend(struct bridge *bridge);

/* What is being asked is answered first. */
void bridge_free(struct bridge *bridge);

#endif
