/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_STORE_FOLDER_H
#define PERCUSS_STORE_FOLDER_H

#include "base/fault.h"

/* Has the names in a file's folder on the disk: until then a loss of power may undo a rename.
 * PERCUSS_BAD_REQUEST with the system's reason. */
enum percuss_status folder_sync(const char *path, struct fault *fault);

#endif
