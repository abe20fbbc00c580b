/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Files that are written as PATH.part and get their name when they are whole. No link is followed:
 * users who may write in the folder must not choose which file is written. */
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

/* The same, and creates the file, with that mode less the process's mask: its descriptor, or -1
 * with the fault. */
int atomic_file_create(struct atomic_file *file, const char *path, unsigned mode,
                       struct fault *fault);

/* The file as it is written gets its name, in place of a file or link that has it. `durable`: file
 * and name are on the disk first. After a fault PATH.part is removed; the former file is left,
 * unless only the name may be lost with the power. PERCUSS_BAD_REQUEST, as above. */
enum percuss_status atomic_file_finish(const struct atomic_file *file, bool durable,
                                       struct fault *fault);

/* Removes PATH.part; the former file is left. */
void atomic_file_abandon(const struct atomic_file *file);

/* Gives a whole file its name, durably. */
enum percuss_status atomic_file_rename(const char *from, const char *path, struct fault *fault);

/* Has the names in a file's folder on the disk: until then a loss of power may undo a rename. */
enum percuss_status atomic_file_sync_folder(const char *path, struct fault *fault);

#endif
