/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One value at a time out of a YAML document, with messages that say where it stands. Every
 * function with a status returns PERCUSS_OK, or PERCUSS_BAD_REQUEST with the fault written. */
#ifndef PERCUSS_CATALOGUE_READER_H
#define PERCUSS_CATALOGUE_READER_H

#include <stdbool.h>
#include <stddef.h>
#include <yaml.h>

#include "base/fault.h"
#include "base/units.h"

enum { READER_NAME_BYTES = 200 }; /* of a file's name in a message: its end */

struct reader {
    yaml_document_t *document;
    const char *name;   /* of the file */
    const char *folder; /* of bodies reduced from meshes; NULL: none */
    bool lenient;       /* a body without its file is left out, with an order that says so */
    struct fault *fault;
    char path[256]; /* of the value being read: bodies.al-rod.radius */
};

/* A key of a mapping with its value; `value` is NULL where there is no such key. */
struct entry {
    const yaml_node_t *key, *value;
};

/* The part of a file's name that messages show. */
const char *reader_short_name(const char *name);

/* Adds a key, or an index like "[1]", to the path. Returns the mark for reader_leave, which drops
 * it; after a failure it may stay. */
size_t reader_enter(struct reader *reader, const char *key);
void reader_leave(struct reader *reader, size_t mark);

/* "FILE:LINE: PATH: " and the message; always PERCUSS_BAD_REQUEST. */
enum percuss_status reader_refuse(const struct reader *reader, const yaml_node_t *at,
                                  const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The same as "VALUE: must be ALLOWED". */
enum percuss_status reader_refuse_value(const struct reader *reader, const yaml_node_t *value,
                                        const char *allowed);

/* A value in words for a message: at most 63 bytes, without control characters. */
struct excerpt {
    char text[64];
};
struct excerpt reader_excerpt(const yaml_node_t *value);

/* Number of entries of a mapping or elements of a list; 0 for a scalar. */
size_t reader_count(const yaml_node_t *node);
struct entry reader_entry(const struct reader *reader, const yaml_node_t *mapping, size_t i);
const yaml_node_t *reader_element(const struct reader *reader, const yaml_node_t *list, size_t i);

/* The first entry of that key. */
struct entry reader_find(const struct reader *reader, const yaml_node_t *mapping, const char *key);

/* Whether a node is exactly this word. */
bool reader_is(const yaml_node_t *node, const char *word);

/* A finite decimal number with a unit of the quantity or in SI units, the whole scalar, not quoted.
 * False if it is none. */
bool reader_quantity(const yaml_node_t *node, enum quantity quantity, double *number);

/* As reader_refuse_value, or the message about a wrong unit of the number. */
enum percuss_status reader_refuse_quantity(const struct reader *reader, const yaml_node_t *value,
                                           enum quantity quantity, const char *allowed);

/* The same of a number without a unit. */
bool reader_number(const yaml_node_t *node, double *number);

/* A whole number 1 .. most, digits only. */
bool reader_whole(const yaml_node_t *node, unsigned most, unsigned *number);

#endif
