/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The system's files and its clock, put in place of the C library's by being in the program or by
 * LD_PRELOAD. Operations on files whose path contains a given text are counted, and one of them
 * fails or is the end of the process; calls for memory likewise (interpose_memory.c, only by
 * LD_PRELOAD); the time of day is what a file says. With LD_PRELOAD the environment says what to
 * do: PERCUSS_FAULT_PROGRAM  the program that is meant, if not all that are started
 *   PERCUSS_FAULT_PATH  text in the path of the files that count; none: no operation on files does
 *   PERCUSS_FAULT_MEMORY  calls for memory count: those of the program itself and of libraries
 * whose path contains one of these texts, with a colon between them PERCUSS_FAULT_AT    the
 * operation, 1, 2, ...; 0 or none: only count PERCUSS_FAULT_DO    fail: once; fail-on: and all
 * after it; break, break-on: the same, with EIO for writes, too; kill: the process ends by SIGKILL,
 * half way through a write PERCUSS_FAULT_COUNT file
 * that gets the number of operations at the end of the process PERCUSS_FAULT_READ_ONLY file: while
 * it is there, nothing can be written (EROFS) PERCUSS_FAULT_CLOCK file of 16
 * letters: the seconds that the time of day is off, looked at every time */
#ifndef PERCUSS_TEST_INTERPOSE_H
#define PERCUSS_TEST_INTERPOSE_H

#include <stdbool.h>

/* From now on operations on such files count (NULL: none), and that one fails: with ENOSPC where it
 * needs room, otherwise with EIO. */
void interpose_files(const char *path, unsigned long at, bool for_good);

/* Since then. */
unsigned long interpose_count(void);
bool interpose_has_failed(void);

/* Counts one more, and whether it is to fail. */
bool interpose_fails(void);

/* Whether this process is the program that the environment means. */
bool interpose_is_meant(void);

#endif
