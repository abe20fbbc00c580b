/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_REDUCE_PROGRAM_H
#define PERCUSS_REDUCE_PROGRAM_H

/* The program from its arguments to its exit code. */
int program_run(int argc, char **argv);

#endif
