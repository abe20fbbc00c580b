/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_STORE_FOLDER_H
#define PERCUSS_STORE_FOLDER_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"

/* Makes a folder and its parents as far as they are missing. False: errno says why it is not there.
 */
bool folder_make(const char *path);

/* The folder of contact tables of one's own, which stand beside the shipped ones: PERCUSS_TABLES;
 * of a service of systemd `tables` in its folder for state; of a user percuss/tables in
 * XDG_DATA_HOME or ~/.local/share. It need not exist. False: PERCUSS_TABLES is empty, or nothing
 * says where. */
bool folder_own_tables(char *path, size_t size);

#endif
