/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A computed contact table as a file: JSON with all inputs, versions, errors and numbers to the
 * last bit. */
#ifndef PERCUSS_STORE_TABLE_FILE_H
#define PERCUSS_STORE_TABLE_FILE_H

#include <stddef.h>

#include "store/table_json.h"

enum { TABLE_FILE_MAX_BYTES = 16 * 1024 * 1024, TABLE_PATH_SIZE = 4096 };

/* Writes FOLDER/KEY.json, aside first and then in its place, so that readers see all of it or
 * nothing; makes the folder where it is missing. `path` is filled. BAD_REQUEST
 * with the path and the system's reason, INTERNAL without memory. */
enum percuss_status table_file_save(const char *folder, const struct indentation_table *table,
                                    const struct table_origin *origin, char path[TABLE_PATH_SIZE],
                                    struct fault *fault);

/* Reads one, for indentation_table_free. BAD_REQUEST with the path and what is wrong: no table,
 * damaged (its hashes tell), or of another INDENTATION_VERSION. */
enum percuss_status table_file_load(const char *path, struct indentation_table *table,
                                    struct fault *fault);

/* What they are made of: text into a file PATH in FOLDER as above, and a whole file as text for
 * free(); BAD_REQUEST: it cannot be read, INTERNAL without memory. */
enum percuss_status table_file_write(const char *folder, const char *text, const char *path,
                                     struct fault *fault);
enum percuss_status table_file_read(const char *path, char **text, size_t *size,
                                    struct fault *fault);

#endif
