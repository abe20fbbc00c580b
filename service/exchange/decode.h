/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A request from the wire, validated number by number, as the solver takes it. */
#ifndef PERCUSS_EXCHANGE_DECODE_H
#define PERCUSS_EXCHANGE_DECODE_H

#include "percuss_wire.h"
#include "solve/request.h"

/* Fills `request` (what is not used of its arrays stays as it was). PERCUSS_OK, or
 * PERCUSS_BAD_REQUEST with a message like "contacts[0].normal: (0, 0, 2): must be a unit vector
 * (norm within 0.0001 of 1)". `request->delassus` points into `wire`. The states of the bodies are
 * NULL: state tokens and specimens are looked up by whoever has the stores. */
enum percuss_status decode_request(const percuss_v1_Request *wire, struct solve_request *request,
                                   struct fault *fault);

#endif
