/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A sweep's CSV in a file that is gone on with after an end before its time. */
#ifndef PERCUSS_CLI_SWEEP_FILE_H
#define PERCUSS_CLI_SWEEP_FILE_H

#include "sweep_output.h"

/* Opens the file, or begins it, for the rows that it lacks. What it holds becomes `rows` and `done`
 * of the curves: it must be the beginning of this very sweep, row by row; a last line that was cut
 * is taken away. Exit code; complains. The caller closes *file. */
int sweep_file_open(const char *name, const struct sweep_points *points, struct sweep_curve *curves,
                    FILE **file);

/* Whether row i of curve k, asked for again, is to the last bit what the file holds. False: the
 * file has the answers to another question; complains. */
bool sweep_file_agrees(const char *name, const struct sweep_points *points, size_t k, unsigned i,
                       const struct percuss_reply *again);

#endif
