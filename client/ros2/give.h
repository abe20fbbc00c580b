/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Answers of libpercuss as messages of ROS 2. Texts are borrowed from the arguments. */
#ifndef PERCUSS_ROS2_GIVE_H
#define PERCUSS_ROS2_GIVE_H

#include <percuss/percuss.h>

#include "percuss_msgs.h"

/* The arrays of a message; zeroed: none. */
struct give_pieces {
    struct give_piece *last;
};

void give_pieces_free(struct give_pieces *pieces);

/* False: out of memory. */
bool give_answer(struct give_pieces *pieces, const struct percuss_reply *reply,
                 percuss_msgs_msg_dds__Answer_ *answer);
bool give_bodies(struct give_pieces *pieces, const struct percuss_body_list *list,
                 percuss_msgs_msg_dds__BodyList_ *bodies);

/* An answer that holds nothing but why it is refused. */
void give_refusal(uint32_t status, const char *message, percuss_msgs_msg_dds__Answer_ *answer);

#endif
