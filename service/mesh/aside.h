/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Files that are seen once they are whole. */
#ifndef PERCUSS_MESH_ASIDE_H
#define PERCUSS_MESH_ASIDE_H

#include <stdbool.h>

enum { ASIDE_SIZE = 4096 };

/* The name to write to: beside the file, or its own where it is a link or a device. False: too long
 * (errno says so). */
bool aside_begin(const char *path, char aside[ASIDE_SIZE]);

/* What is good has its name now, and is on the disk; otherwise it is gone, and what was there
 * before stays. False: it is not there, and errno says why where it was good. */
bool aside_end(const char *aside, const char *path, bool good);

#endif
