/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Samples that were taken and not yet decoded, by their writers: these take turns, so that one with
 * many samples delays only its own. Of one thread. */
#ifndef PERCUSS_ENDPOINT_WRITER_QUEUES_H
#define PERCUSS_ENDPOINT_WRITER_QUEUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct writer_queues;

/* For `most` samples (>= 1) of each writer; it frees samples by `release`. NULL: no memory. */
struct writer_queues *writer_queues_create(size_t most, void (*release)(void *sample));
void writer_queues_free(struct writer_queues *queues); /* NULL is allowed */

/* Takes the sample over. If its writer has too many in it the oldest is released, as in a history
 * of DDS; without memory the new one is. */
void writer_queues_put(struct writer_queues *queues, uint64_t writer, void *sample);

/* The next sample, the caller's from now on, and its writer; NULL: none is left. */
void *writer_queues_take(struct writer_queues *queues, uint64_t *writer);

bool writer_queues_is_empty(const struct writer_queues *queues);

#endif
