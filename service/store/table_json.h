/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A computed contact table as JSON text; see table_file.h for files. */
#ifndef PERCUSS_STORE_TABLE_JSON_H
#define PERCUSS_STORE_TABLE_JSON_H

#include <stddef.h>

#include "fe/indentation.h"

/* How a table came about, beyond its inputs. */
struct table_origin {
    const char *program; /* name and version */
    double seconds;      /* processor time it took */
};

/* Text for free(); NULL: out of memory. An infinite yield is null, as JSON has no infinity. */
char *table_json_write(const struct indentation_table *table, const struct table_origin *origin);

/* OK and a table for indentation_table_free; otherwise BAD_REQUEST with what is wrong. */
enum percuss_status table_json_read(const char *text, size_t size, struct indentation_table *table,
                                    struct fault *fault);

#endif
