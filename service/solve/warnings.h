/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What is to be said of a solution besides its numbers, by kinds that can be counted over many. */
#ifndef PERCUSS_SOLVE_WARNINGS_H
#define PERCUSS_SOLVE_WARNINGS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/text.h"

/* Of two in a row the first is of body a, the second of body b. */
enum warning_kind {
    WARNING_YIELD,
    WARNING_PATCH = 2,
    WARNING_DENT = 4,
    WARNING_EDGE = 6,
    WARNING_SPEED = 8,
    WARNING_TABLE_END = 10,
    WARNING_SLIDING,
    WARNING_DELASSUS,
    WARNING_COMPLIANCE,
    WARNING_NO_TOUCH,
    WARNING_LAW,
    WARNING_LOSS,
    WARNING_WAVES = 18,
    WARNING_BENDING,
    WARNING_UNSTATED = 21,
    WARNING_RIGID,
    WARNING_BREADTH = 24,
    WARNING_KINDS = 26
};
_Static_assert(WARNING_KINDS <= 32, "a set of kinds is 32 bits");

enum { WARNINGS_ROOM = 32, WARNING_SIZE = 1024 };

struct warnings {
    size_t count;
    uint32_t kinds; /* 1 << kind of each that was found, in the list or not */
    enum warning_kind kind[WARNINGS_ROOM];
    char text[WARNINGS_ROOM][WARNING_SIZE];
};

/* Adds one while there is room; of a kind found before (in another contact) only as long as every
 * other kind keeps its place. */
void warnings_add(struct warnings *warnings, enum warning_kind kind, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same of one that is put together by pieces, in *text; false: there is no room. */
bool warnings_begin(struct warnings *warnings, enum warning_kind kind, struct text *text);

/* The first text of a kind, or NULL. */
const char *warnings_text(const struct warnings *warnings, enum warning_kind kind);

#endif
