/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The tasks of a server: running, or waiting for their turn. */
#ifndef PERCUSS_TASK_H
#define PERCUSS_TASK_H

#include <percuss/result.h>
#include <stdbool.h>
#include <stdint.h>

/* An impact, a batch of them, an ensemble, a request for which contact tables are computed first,
 * or a mesh that is reduced. */
#define PERCUSS_TASK_KIND_LIST(X)                                                                  \
    X(REQUEST, "request")                                                                          \
    X(BATCH, "batch")                                                                              \
    X(ENSEMBLE, "ensemble")                                                                        \
    X(TABLES, "tables")                                                                            \
    X(MESH, "mesh")

#define PERCUSS_TASK_MEMBER(name, text) PERCUSS_TASK_##name,
enum percuss_task_kind { PERCUSS_TASK_KIND_LIST(PERCUSS_TASK_MEMBER) PERCUSS_TASK_COUNT };

/* Most that a server lists. */
enum { PERCUSS_MAX_TASKS = 16 };

struct percuss_task {
    uint8_t client[16];          /* id of the client that waits for it; zeros: none */
    uint64_t sequence;           /* its number, of that client */
    enum percuss_task_kind kind; /* PERCUSS_TASK_... */
    bool running;                /* false: it waits for its turn */
    double age;                  /* s since it was asked for */
    double done;                 /* share of it, 0..1; NAN: not known */
};

#ifdef __cplusplus
extern "C" {
#endif

/* As percuss_status_name. */
PERCUSS_API const char *percuss_task_kind_name(unsigned kind);

#ifdef __cplusplus
}
#endif

#endif
