/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Between the public structs and those of the wire. */
#ifndef PERCUSS_API_CONVERT_H
#define PERCUSS_API_CONVERT_H

#include <percuss/percuss.h>
#include <percuss/specimen.h>

#include "percuss_wire.h"

/* Where a wire request's sequences live while it is written. */
struct request_storage {
    percuss_v1_BodyMotion bodies[PERCUSS_MAX_BODIES];
    percuss_v1_Override overrides[PERCUSS_MAX_BODIES][PERCUSS_PARAMETER_COUNT];
    percuss_v1_Contact contacts[PERCUSS_MAX_CONTACTS];
};

/* Fills `wire` with pointers into `storage` and to the request's delassus; neither is to be freed
 * through `wire`. The client and sequence stay zero. INVALID_ARGUMENT, naming the field, for data
 * that do not fit the wire: too many bodies or contacts, unterminated strings. Whether the numbers
 * make sense is the server's judgement. */
enum percuss_result convert_request(const struct percuss_request *request,
                                    struct request_storage *storage, percuss_v1_Request *wire);

/* Copies a wire reply; the arrays share one block, `reply->storage`. NO_MEMORY leaves it empty. */
enum percuss_result convert_reply(const percuss_v1_Reply *wire, struct percuss_reply *reply);

/* Where a wire ensemble's sequences live while it is written. */
struct ensemble_storage {
    struct request_storage scene;
    percuss_v1_EnsembleInput inputs[PERCUSS_MAX_INPUTS];
    percuss_v1_EnsembleCorrelation correlations[PERCUSS_MAX_CORRELATIONS];
};

/* As convert_request; lists and quantiles stay the request's. */
enum percuss_result convert_ensemble_request(const struct percuss_ensemble_request *request,
                                             struct ensemble_storage *storage,
                                             percuss_v1_EnsembleRequest *wire);

/* Copies a wire reply, but for the listed samples. NO_MEMORY leaves it empty. */
enum percuss_result convert_ensemble_reply(const percuss_v1_EnsembleReply *wire,
                                           struct percuss_ensemble_reply *reply);

/* Copies of servers' announcements. False: no memory, for the tasks, which are the caller's. */
bool convert_announced_server(const percuss_v1_ServerStatus *from, struct percuss_server *to);
void convert_announced_body(const percuss_v1_Body *wire, struct percuss_body *body);
void convert_announced_pair(const percuss_v1_MaterialPair *from, struct percuss_material_pair *to);
bool convert_announced_specimen(const percuss_v1_Dents *wire, struct percuss_specimen *specimen);

#endif
