/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests a second: batches of one client, and several clients with many requests outstanding. */
#ifndef PERCUSS_BENCH_THROUGHPUT_H
#define PERCUSS_BENCH_THROUGHPUT_H

#include <stdbool.h>
#include <sys/types.h>

#include "queries.h"

struct load {
    uint32_t domain;
    pid_t service;
    const struct query *query;
    unsigned clients;
    unsigned outstanding; /* requests of each client, or of its batch */
    unsigned requests;    /* of each client, in all */
    bool csv;
};

void throughput_header(const struct load *load);

/* Measure and print a line; false: a request failed. A batch's time is that of all its requests. */
bool throughput_batches(const struct load *load);
bool throughput_pipelines(const struct load *load);

#endif
