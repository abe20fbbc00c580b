/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Files of measurements on the command line. */
#ifndef PERCUSS_CLI_MEASURED_FILE_H
#define PERCUSS_CLI_MEASURED_FILE_H

#include <argp.h>
#include <jansson.h>

#include "impact.h"

/* Parses --column, --scale, --rate, --gravity and --uncertainty into the `struct column_map` that
 * is its input. */
extern const struct argp measured_file_argp;

/* The children of commands that ask for a scene, plot it and read files of measurements: scene,
 * common, plot, measured file. And their inputs, in that order, at ARGP_KEY_INIT. */
extern const struct argp_child measured_scene_children[5];
void measured_scene_inputs(struct argp_state *state, void *const inputs[4]);

/* Prints all that is to be said of a file to stderr, an error or a note a line; `option` stands
 * before each, or "". */
void measured_file_complain(const char *option, const struct measured_remarks *remarks);

/* Reads a file of impacts. Exit code; complains. */
int measured_file_read(const char *file, const struct column_map *map, struct measured_set *set);

/* The rows that were left out. */
json_t *measured_file_left_to_json(const struct measured_set *set);

#endif
