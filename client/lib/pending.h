/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests that are sent and not yet collected, by sequence. Not locked: the client's lock guards
 * it. */
#ifndef PERCUSS_LIB_PENDING_H
#define PERCUSS_LIB_PENDING_H

#include <percuss/percuss.h>

enum { PENDING_BUCKETS = 256 };

struct batch;
struct gather;
struct ensemble_exchange;

struct pending {
    uint64_t sequence;
    bool waited;   /* a thread waits for this one; percuss_wait(0) leaves it alone */
    bool orphaned; /* asked of a process that has gone and has a successor */
    bool ready;
    enum percuss_result result; /* ready: OK with a reply or a filled batch, or NO_MEMORY */
    struct percuss_reply reply;
    struct batch *batch;                /* borrowed; NULL: a single request */
    struct ensemble_exchange *ensemble; /* the same of an ensemble */
    struct gather *gather;              /* borrowed; NULL: no trace is wanted */
    struct pending *next;               /* in its bucket */
    struct pending *previous_ready;     /* in order of arrival */
    struct pending *next_ready;
};

struct pending_table {
    unsigned count, window;
    struct pending *buckets[PENDING_BUCKETS];
    struct pending *first_ready, *last_ready;
};

/* Enters a sequence that must not be in the table. WINDOW_FULL or NO_MEMORY. */
enum percuss_result pending_add(struct pending_table *table, uint64_t sequence,
                                struct pending **pending);

/* NULL: not in the table. */
struct pending *pending_find(const struct pending_table *table, uint64_t sequence);

/* The earliest answered one that no thread waits for; NULL: none. */
struct pending *pending_first_ready(const struct pending_table *table);

/* Whether there is any that no thread waits for. */
bool pending_has_unwaited(const struct pending_table *table);

/* Marks unanswered requests: their server has gone. */
void pending_orphan(struct pending_table *table);

/* One that was marked so and that no thread waits for; NULL: none. */
const struct pending *pending_first_orphan(const struct pending_table *table);

/* Marks it answered. */
void pending_set_ready(struct pending_table *table, struct pending *pending,
                       enum percuss_result result);

/* Takes it out and frees it with its reply. */
void pending_remove(struct pending_table *table, struct pending *pending);

/* Removes all. */
void pending_clear(struct pending_table *table);

#endif
