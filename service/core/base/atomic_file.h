/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Files that are written as PATH.part and renamed to PATH when they are complete. No link is
 * followed: other users with write access to the folder must not choose which file is written. */
#ifndef PERCUSS_BASE_ATOMIC_FILE_H
#define PERCUSS_BASE_ATOMIC_FILE_H

#include <stdbool.h>

#include "base/fault.h"

enum { ATOMIC_FILE_SIZE = 4096 };

struct atomic_file {
    const char *path;             /* borrowed */
    char aside[ATOMIC_FILE_SIZE]; /* PATH.part */
};

/* Removes the name PATH.part, which an interrupted writer may have left or which may be a link. The
 * caller creates that file and must refuse one that exists (O_EXCL). PERCUSS_BAD_REQUEST with
 * "NAME: cannot be written: reason", where NAME is the file, its .part or the folder; errno is the
 * reason's. */
enum percuss_status atomic_file_begin(struct atomic_file *file, const char *path,
                                      struct fault *fault);

/* The same, and creates the file with this mode less the process's mask. Returns its descriptor,
 * or -1 with the fault. */
int atomic_file_create(struct atomic_file *file, const char *path, unsigned mode,
                       struct fault *fault);

/* Renames PATH.part to PATH, which replaces a file or link of that name. `durable`: the file and
 * its name are on the disk when it returns. After a fault PATH.part is removed and the former file
 * is unchanged, except where only the folder could not be synchronised. PERCUSS_BAD_REQUEST, as
 * above. */
enum percuss_status atomic_file_finish(const struct atomic_file *file, bool durable,
                                       struct fault *fault);

/* Removes PATH.part; the former file is unchanged. */
void atomic_file_abandon(const struct atomic_file *file);

/* Renames a complete file durably. */
enum percuss_status atomic_file_rename(const char *from, const char *path, struct fault *fault);

/* Writes the names in a file's folder to the disk: before, a loss of power may undo a rename. */
enum percuss_status atomic_file_sync_folder(const char *path, struct fault *fault);

#endif
