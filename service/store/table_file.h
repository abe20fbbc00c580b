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

/* Origin of a table, beyond its inputs. */
struct table_origin {
    const char *program; /* name and version */
    double seconds;      /* processor time it took */
};

/* Writes a temporary file and renames it to FOLDER/KEY.json, so that readers see all of it or
 * nothing; makes a missing folder. Fills `path`. BAD_REQUEST with the path and the system's reason,
 * INTERNAL without memory. */
enum percuss_status table_file_save(const char *folder, const struct indentation_table *table,
                                    const struct table_origin *origin, char path[TABLE_PATH_SIZE],
                                    struct fault *fault);

/* Reads one, for indentation_table_free. BAD_REQUEST with the path and the reason: no table,
 * damaged (its hashes differ), or of another INDENTATION_VERSION. */
enum percuss_status table_file_load(const char *path, struct indentation_table *table,
                                    struct fault *fault);

/* The steps of both: writes text into a file PATH in FOLDER as above; reads a whole file as text
 * for free(). BAD_REQUEST: it cannot be read, INTERNAL without memory. */
enum percuss_status table_file_write(const char *folder, const char *text, const char *path,
                                     struct fault *fault);
enum percuss_status table_file_read(const char *path, char **text, size_t *size,
                                    struct fault *fault);

/* Text for free(); NULL: out of memory. An infinite yield is null, as JSON has no infinity. */
char *table_json_write(const struct indentation_table *table, const struct table_origin *origin);

/* OK and a table for indentation_table_free; otherwise BAD_REQUEST with the reason. */
enum percuss_status table_json_read(const char *text, size_t size, struct indentation_table *table,
                                    struct fault *fault);

/* The folder of the user's own contact tables, beside the shipped ones: PERCUSS_TABLES; for a
 * systemd service `tables` in its state folder; for a user percuss/tables in XDG_DATA_HOME or
 * ~/.local/share. It need not exist. False: PERCUSS_TABLES is empty, or no variable names a
 * folder. */
bool folder_own_tables(char *path, size_t size);

#endif
