/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Checks that a store could be opened, without a change to its file or folder: SQLite itself may
 * leave files there, which then belong to the user of the check. */
#ifndef PERCUSS_STORE_DATABASE_CHECK_H
#define PERCUSS_STORE_DATABASE_CHECK_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"

/* OK: the file is ours, of version 1 to `version`, writable and in no process's use; or it is
 * missing and can be made. BAD_REQUEST with "FILE: ..." otherwise. */
enum percuss_status database_check(const char *path, int version, struct fault *fault);

/* Whether the volume of that file has room for the next impact and for the write-ahead log that is
 * then written back. PERCUSS_BUSY: "there is no room: ... KiB are free in FOLDER, and 2048 are
 * needed". A volume without such figures counts as having room. */
enum percuss_status database_room_check(const char *path, struct fault *fault);

/* Whether the file, or its folder where there is none, lies on a file system that may be shared
 * with other machines, so that nothing but its locks keeps another daemon out. True: `remark` says
 * "lies on NFS: ...". */
bool database_remark_volume(const char *path, char *remark, size_t size);

/* Whether a missing file or folder of that path can be made; BAD_REQUEST names the command that
 * makes the folder above it. */
enum percuss_status database_folder_check(const char *path, struct fault *fault);

#endif
