/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A computed contact table as a file: JSON with all inputs, versions, errors and numbers to the
 * last bit. */
#ifndef PERCUSS_STORE_TABLE_FILE_H
#define PERCUSS_STORE_TABLE_FILE_H

#include <stdbool.h>
#include <stddef.h>

#include "fe/indentation.h"

enum { TABLE_FILE_MAX_BYTES = 16 * 1024 * 1024, TABLE_PATH_SIZE = 4096 };

/* How a table came about, beyond its inputs. */
struct table_origin {
    const char *program; /* name and version */
    double seconds;      /* processor time it took */
};

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

/* Text for free(); NULL: out of memory. An infinite yield is null, as JSON has no infinity. */
char *table_json_write(const struct indentation_table *table, const struct table_origin *origin);

/* OK and a table for indentation_table_free; otherwise BAD_REQUEST with what is wrong. */
enum percuss_status table_json_read(const char *text, size_t size, struct indentation_table *table,
                                    struct fault *fault);

/* The folder of contact tables of one's own, which stand beside the shipped ones: PERCUSS_TABLES;
 * of a service of systemd `tables` in its folder for state; of a user percuss/tables in
 * XDG_DATA_HOME or ~/.local/share. It need not exist. False: PERCUSS_TABLES is empty, or nothing
 * says where. */
bool folder_own_tables(char *path, size_t size);

#endif
