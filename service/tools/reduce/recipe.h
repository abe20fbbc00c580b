/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How a mesh was read, as a text that the body's file keeps: the options of the command line that
 * shape the mesh, a line each, "unit=0.001". Materials stand in the file by themselves. */
#ifndef PERCUSS_REDUCE_RECIPE_H
#define PERCUSS_REDUCE_RECIPE_H

#include "base/fault.h"
#include "reduce/options.h"

/* For free(); NULL: no memory. */
char *recipe_write(const struct options *options);

/* Sets these options, whose texts point into `text`, which is cut into its lines.
 * PERCUSS_BAD_REQUEST: a line that is no such option. */
enum percuss_status recipe_read(char *text, struct options *options, struct fault *fault);

#endif
