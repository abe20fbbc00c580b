/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The ids of a mapping with free keys (materials, bodies), sorted for look-up. */
#ifndef PERCUSS_CATALOGUE_NAMES_H
#define PERCUSS_CATALOGUE_NAMES_H

#include "catalogue/reader.h"

/* Most bodies, and most materials. */
enum { NAMES_MOST = 100000 };

struct name {
    const char *text; /* in the document */
    size_t position;  /* of its entry in the mapping */
    size_t line;
};

struct names {
    struct name *sorted;
    size_t count;
};

/* PERCUSS_OK with names to free by names_free, if every key is an id (1 to 63 bytes, no control
 * characters) and stands once; PERCUSS_INTERNAL without memory. */
enum percuss_status names_read(struct reader *reader, const yaml_node_t *mapping,
                               struct names *names);
void names_free(struct names *names);

/* The position of that id in the mapping; `count` of the names if there is none. */
size_t names_find(const struct names *names, const char *text);

/* All ids, or the first ones and how many there are. */
struct name_list {
    char text[280];
};
struct name_list names_list(const struct names *names);

#endif
