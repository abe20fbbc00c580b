/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the daemon does for a question between DDS's two ends, in this process: digest, admission,
 * checks, solution, reply, and its keeping. */
#ifndef PERCUSS_BENCH_ANSWERING_H
#define PERCUSS_BENCH_ANSWERING_H

#include <stdbool.h>
#include <stddef.h>

#include "queries.h"

struct answering;

/* By the settings of a file. NULL: they cannot be read, says stderr. */
struct answering *answering_create(const char *settings);
void answering_free(struct answering *answering); /* NULL is allowed */

/* Puts a question as DDS would hand it over. False: it cannot be. */
bool answering_put(struct answering *answering, const struct query *query, unsigned long variation);

/* Answers it as the daemon does. False: the reply is no answer. */
bool answering_answer(struct answering *answering);

/* The same, counted by callgrind --toggle-collect=counted_answer. */
bool answering_count(struct answering *answering);

/* Its solution alone: what the library does of it. Answered before. */
bool answering_solve(struct answering *answering);

/* Octets of the question and of its last reply on the wire, serialised. */
void answering_sizes(const struct answering *answering, size_t *question, size_t *reply);

#endif
