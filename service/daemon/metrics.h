/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Counters and histograms of the daemon's work, for a monitoring system. Any thread. */
#ifndef PERCUSS_DAEMON_METRICS_H
#define PERCUSS_DAEMON_METRICS_H

#include <stdatomic.h>
#include <stdio.h>

#include "base/fault.h"
#include "exchange/answer.h"

enum { METRICS_BUCKETS = 16 };

/* How often a number was at most a bound, for each bound; the last counts all. */
struct histogram {
    atomic_ullong counts[METRICS_BUCKETS + 1]; /* each its own share only */
    _Atomic double sum;
};

struct metrics {
    atomic_ullong replies[EXCHANGE_COUNT][PERCUSS_STATUS_COUNT]; /* of a batch each one */
    atomic_ullong pings, reloads, failed_reloads;
    struct histogram waits, solves, commits; /* s */
    struct histogram closures;               /* of the energy, shares of the available energy */
};

/* Counts a reply, and one that has a status alone. */
void metrics_count(struct metrics *metrics, const struct answer *answer);
void metrics_count_refusal(struct metrics *metrics, enum exchange exchange,
                           enum percuss_status status);

/* Times from 10 us on, s; shares from 1e-12 on. */
void metrics_note_time(struct histogram *histogram, double seconds);
void metrics_note_share(struct histogram *histogram, double share);

/* Writes a family of each, by the rules of OpenMetrics 1.0. */
void metrics_print_replies(const struct metrics *metrics, FILE *file);
void metrics_print_histograms(const struct metrics *metrics, FILE *file);

#endif
