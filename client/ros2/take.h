/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A question from ROS 2 as a request of libpercuss. */
#ifndef PERCUSS_ROS2_TAKE_H
#define PERCUSS_ROS2_TAKE_H

#include <percuss/percuss.h>

#include "percuss_msgs.h"

enum { TAKE_PROBLEM_SIZE = 256 };

/* False with `problem` naming the field, its value and the allowed ones: the request has no room
 * for it. The server checks the rest. `request` borrows the numbers of the question's delassus. */
bool take_question(const percuss_msgs_msg_dds__Question_ *question, struct percuss_request *request,
                   char problem[TAKE_PROBLEM_SIZE]);

#endif
