/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Whether a store could be opened, without a change to its file or beside it: a look at a database
 * by SQLite may leave files of its own there, which then belong to whoever looked. */
#ifndef PERCUSS_STORE_DATABASE_CHECK_H
#define PERCUSS_STORE_DATABASE_CHECK_H

#include "base/fault.h"

/* The file is ours, of version 1 to `version`, nobody has it open, and it can be written; or it is
 * not there and can be made. BAD_REQUEST with "FILE: ..." otherwise. */
enum percuss_status database_check(const char *path, int version, struct fault *fault);

/* Whether the volume of that file has the room that the next impact needs, with what is then
 * written back from the write-ahead log. PERCUSS_BUSY: "there is no room: ... KiB are free in
 * FOLDER, and 2048 are needed". A volume that does not tell has room. */
enum percuss_status database_room_check(const char *path, struct fault *fault);

/* Whether a file or folder of that path, which is not there, can be made; BAD_REQUEST names the
 * command that makes the folder it lacks. */
enum percuss_status database_folder_check(const char *path, struct fault *fault);

#endif
