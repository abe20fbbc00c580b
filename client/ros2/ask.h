/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The side of percussd. */
#ifndef PERCUSS_ROS2_ASK_H
#define PERCUSS_ROS2_ASK_H

#include <percuss/percuss.h>
#include <pthread.h>
#include <stdatomic.h>

#include "give.h"

/* A client that several threads ask by, and whoever answers it. */
struct ask_line {
    struct percuss_client *client;
    uint32_t domain;
    double timeout;                /* s for an answer */
    atomic_uint_fast64_t sequence; /* of the last question */
    pthread_mutex_t lock;          /* of `connections` and of connecting */
    unsigned connections;          /* so far */
    atomic_uint failures;          /* to connect */
};

/* An answer and what it borrows; zeroed before the first. */
struct ask {
    struct percuss_request request; /* large */
    struct percuss_reply reply;
    struct give_pieces pieces;
    char message[512];
    percuss_msgs_msg_dds__Answer_ answer;
};

/* Fills ask->answer, whatever happens: with a status where it cannot be had. */
void ask_answer(struct ask_line *line, struct ask *ask,
                const percuss_msgs_msg_dds__Question_ *question);

/* Releases what the answer borrows. */
void ask_clear(struct ask *ask);

unsigned ask_connections(struct ask_line *line);

/* Connects unless that has been done after `seen` connections. */
bool ask_connect(struct ask_line *line, unsigned seen);

#endif
