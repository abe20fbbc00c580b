/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A copy of the store, made while it is in use. */
#ifndef PERCUSS_STORE_BACKUP_H
#define PERCUSS_STORE_BACKUP_H

#include "store/specimens.h"

/* Writes the store to a temporary file, checks it, syncs it to the disk and renames it to `path`.
 * Otherwise the former copy stays, and the fault has the reason: the file cannot be written, or the
 * store is damaged. */
enum percuss_status backup_write(struct specimen_store *store, const char *path,
                                 struct fault *fault);

#endif
