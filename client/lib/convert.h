/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Between the public structs and those of the wire. */
#ifndef PERCUSS_LIB_CONVERT_H
#define PERCUSS_LIB_CONVERT_H

#include <percuss/percuss.h>

#include "percuss_wire.h"

/* Where a wire request's sequences live while it is written. */
struct request_storage {
    percuss_v1_BodyMotion bodies[PERCUSS_MAX_BODIES];
    percuss_v1_Override overrides[PERCUSS_MAX_BODIES][PERCUSS_PARAMETER_COUNT];
    percuss_v1_Contact contacts[PERCUSS_MAX_CONTACTS];
};

/* Fills `wire` with pointers into `storage` and to the request's delassus; neither is to be freed
 * through `wire`. The client and sequence stay zero. INVALID_ARGUMENT, naming the field, for what
 * does not fit the wire: too many bodies or contacts, unterminated strings. Whether the numbers
 * make sense is the server's judgement. */
enum percuss_result convert_request(const struct percuss_request *request,
                                    struct request_storage *storage, percuss_v1_Request *wire);

/* Copies a wire reply; the arrays share one block, `reply->storage`. NO_MEMORY leaves it empty. */
enum percuss_result convert_reply(const percuss_v1_Reply *wire, struct percuss_reply *reply);

#endif
