/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Other servers in the domain: whoever starts a second one by mistake, or with another catalogue,
 * finds it in the log. */
#ifndef PERCUSS_DAEMON_NEIGHBOURS_H
#define PERCUSS_DAEMON_NEIGHBOURS_H

#include "endpoint/endpoint.h"

/* More are not told of. */
enum { NEIGHBOURS_MOST = 16 };

struct neighbour {
    uint8_t server[16];
    char name[128]; /* in words */
    bool alike;     /* of the same catalogue as ours */
    bool there;
};

struct neighbours {
    struct neighbour each[NEIGHBOURS_MOST];
    size_t count;
    uint32_t others; /* of all of them, told of or not, those under other ids than ours */
};

/* This daemon, as the others are held against. */
struct neighbours_self {
    unsigned domain;
    const char *catalogue, *revision;
};

/* Logs who has come or gone, or changed his catalogue, or differs from ours by now. */
void neighbours_look(struct neighbours *neighbours, struct endpoint *endpoint,
                     const struct neighbours_self *self);

#endif
