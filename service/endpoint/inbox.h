/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Samples that were taken and not yet decoded, by their writers: these take turns, so that one with
 * many samples delays only its own. Of one thread. */
#ifndef PERCUSS_ENDPOINT_INBOX_H
#define PERCUSS_ENDPOINT_INBOX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct inbox;

/* For `most` samples (>= 1) of each writer; it frees samples by `release`. NULL: no memory. */
struct inbox *inbox_create(size_t most, void (*release)(void *sample));
void inbox_free(struct inbox *inbox); /* NULL is allowed */

/* Takes the sample over. If its writer has too many in it the oldest is released, as in a history
 * of DDS; without memory the new one is. */
void inbox_put(struct inbox *inbox, uint64_t writer, void *sample);

/* The next sample, the caller's from now on, and its writer; NULL: none is left. */
void *inbox_take(struct inbox *inbox, uint64_t *writer);

bool inbox_is_empty(const struct inbox *inbox);

#endif
