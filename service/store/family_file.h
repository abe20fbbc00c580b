/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A family of contact tables as a file: JSON with its places, errors, origin, and numbers of seven
 * digits. */
#ifndef PERCUSS_STORE_FAMILY_FILE_H
#define PERCUSS_STORE_FAMILY_FILE_H

#include "contact/family.h"
#include "store/table_file.h"

#define FAMILY_FILE_NAME "family.json"

/* Origin of a family. */
struct family_origin {
    const char *program; /* name and version */
    double seconds;      /* processor time it took */
    size_t coarse, fine; /* resolutions */
};

/* Writes FOLDER/FAMILY_FILE_NAME as table_file_save does; `path` is filled. */
enum percuss_status family_file_save(const char *folder,
                                     const struct contact_family_samples *samples,
                                     const struct family_origin *origin, char path[TABLE_PATH_SIZE],
                                     struct fault *fault);

/* Reads one, for contact_family_free. NULL with the path and the reason in the fault: no family,
 * damaged (its hash differs), or of another INDENTATION_VERSION. */
struct contact_family *family_file_load(const char *path, struct fault *fault);

#endif
