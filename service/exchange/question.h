/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A key of the content of a request, without its client and number: two requests with the same key
 * are the same question. Also copies of requests that outlive their sample. */
#ifndef PERCUSS_EXCHANGE_QUESTION_H
#define PERCUSS_EXCHANGE_QUESTION_H

#include "base/hash.h"
#include "percuss_wire.h"

struct digest question_digest_single(const percuss_v1_Request *request);
struct digest question_digest_batch(const percuss_v1_BatchRequest *batch);
struct digest question_digest_ensemble(const percuss_v1_EnsembleRequest *request);

/* A copy of `count` requests in one block of memory for free(); NULL: out of memory. */
percuss_v1_Request *question_copy(const percuss_v1_Request *requests, size_t count);

/* The same of an ensemble, but the lists of its scene stay the sample's. */
percuss_v1_EnsembleRequest *question_copy_ensemble(const percuss_v1_EnsembleRequest *request);

#endif
