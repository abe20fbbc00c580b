/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Clients in the child of a fork(): the threads of DDS are left in the parent, so that whatever
 * waits for one of them waits for ever. There they say so and can be freed. */
#ifndef PERCUSS_LIB_FORKED_H
#define PERCUSS_LIB_FORKED_H

#include <percuss/result.h>
#include <sys/queue.h>

struct client_operations;

/* Of a client: where its table of functions stands. */
struct forked_entry {
    const struct client_operations **operations;
    LIST_ENTRY(forked_entry) others;
};

/* TRANSPORT, in words, where a parent of this process has used DDS: no client can be made. Notes
 * that this process is going to. */
enum percuss_result forked_check(void);

/* A client that a child of a fork() may inherit, and its end. */
void forked_add(struct forked_entry *entry, const struct client_operations **operations);
void forked_remove(struct forked_entry *entry);

#endif
