/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The warnings of many replies: each kind once, with how many replies give it. Texts that differ in
 * numbers only are of one kind. */
#ifndef PERCUSS_TWINS_TALLY_H
#define PERCUSS_TWINS_TALLY_H

#include <percuss/percuss.h>

enum { TALLY_LINE = 1024 };

struct tally {
    const char *unit; /* the subjects of replies, in the plural; set by the caller */
    size_t asked;     /* replies taken */
    size_t count, room;
    struct tally_entry *entries;
};

/* Takes a reply's warnings, and its message where the status is a warning (TRUNCATED, ...); `place`
 * names it, as "at 0.3 m/s". False: out of memory. */
bool tally_take(struct tally *tally, const struct percuss_reply *reply, const char *place);
void tally_clear(struct tally *tally);

/* "UNIT: COUNT of ASKED, first PLACE: the first's text" of the i-th kind, in the order of their
 * first occurrence. */
void tally_line(const struct tally *tally, size_t i, char line[TALLY_LINE]);

#endif
