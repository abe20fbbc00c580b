/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The parts of a trace, put together as they arrive. */
#ifndef PERCUSS_API_GATHER_H
#define PERCUSS_API_GATHER_H

#include <percuss/percuss.h>

#include "percuss_wire.h"

struct gather {
    struct percuss_contact_trace contacts[PERCUSS_MAX_CONTACTS];
    uint32_t next[PERCUSS_MAX_CONTACTS];  /* part awaited */
    uint32_t parts[PERCUSS_MAX_CONTACTS]; /* 0: none has come */
    size_t longest[PERCUSS_MAX_CONTACTS]; /* part, instants */
    size_t room[PERCUSS_MAX_CONTACTS];    /* instants */
    size_t columns[PERCUSS_MAX_CONTACTS]; /* with friction more */
    bool out_of_memory;
};

/* Adds a sample; one that is out of order, repeated or malformed is ignored. */
void gather_add(struct gather *gather, const percuss_v1_Trace *wire);

/* Whether the first `contacts` are complete (or never will be, for want of memory). */
bool gather_is_complete(const struct gather *gather, size_t contacts);

/* Hands the arrays over. NO_MEMORY leaves the trace empty. */
enum percuss_result gather_collect(struct gather *gather, size_t contacts,
                                   struct percuss_trace *trace);

/* Frees the histories not handed over. */
void gather_clear(struct gather *gather);

#endif
