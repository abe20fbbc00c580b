/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The questions asked of a running service, about bodies of the shipped catalogue. */
#ifndef PERCUSS_BENCH_QUERIES_H
#define PERCUSS_BENCH_QUERIES_H

#include <percuss/percuss.h>

struct query {
    const char *name;
    const char *b;   /* struck by steel-sphere; NULL: a ping */
    double point[3]; /* of the contact; the normal points the same way */
    double speed;    /* m/s */
    double tolerance;
};

enum { QUERY_COUNT = 5 };
extern const struct query queries[QUERY_COUNT];

/* NULL: no such query. */
const struct query *query_find(const char *name);

/* The request; no two values of `variation` >= 0 give the same speed: they differ by 1e-7 of it. */
void query_fill(const struct query *query, unsigned long variation,
                struct percuss_request *request);

#endif
