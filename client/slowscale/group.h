/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Contacts that are asked about together. */
#ifndef PERCUSS_SLOW_GROUP_H
#define PERCUSS_SLOW_GROUP_H

#include "slow.h"

/* Contacts with the engine's data about them. */
struct group {
    size_t count;
    double start; /* s: the instant that is asked about; before now if lists were revoked */
    struct percuss_slow_contact *contacts;
    double *moved; /* [3 count]: impulses taken back, along each contact's normal and tangents,
                      times how long they had been there, N s^2 */
    double *gap_rate, *delassus, *impulse, *restitution;
    double *oblique; /* [3 count x 3 count], of normals and tangents; NULL: not asked for */
    struct percuss_body_motion *bodies; /* [bodies of the configuration] */
    struct percuss_reply answer;
    const struct percuss_reply *reply; /* the answer; NULL: declared */
    char message[512];
    char why[1100]; /* the last question of this group that had no usable answer */
};

struct group *group_create(const struct percuss_slow *slow, size_t count); /* NULL: no memory */
void group_free(struct group *group);                                      /* NULL is allowed */

/* Asks the engine about the group's contacts: rates, and all else if `everything`. */
enum percuss_result group_probe(const struct percuss_slow *slow, struct group *group,
                                bool everything);

/* Asks the engine how the group's bodies move along its tangents too. */
enum percuss_result group_probe_oblique(const struct percuss_slow *slow, struct group *group);

/* Appends to the message of a group. */
void group_note(struct group *group, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
