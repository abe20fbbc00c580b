/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A copy of the store, made while it is in use. */
#ifndef PERCUSS_STORE_BACKUP_H
#define PERCUSS_STORE_BACKUP_H

#include "store/specimens.h"

/* Writes the store to that file: aside first, checked and on the disk, and then in its place.
 * Otherwise the former copy stays, and the fault says why: the file cannot be written, or the store
 * is damaged. */
enum percuss_status backup_write(struct specimen_store *store, const char *path,
                                 struct fault *fault);

#endif
