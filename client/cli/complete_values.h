/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the value of an option may be. */
#ifndef PERCUSS_CLI_COMPLETE_VALUES_H
#define PERCUSS_CLI_COMPLETE_VALUES_H

#include "complete_line.h"

/* Offers the values of the line's option: names that are fixed, files, and what the server knows
 * that the line names, or this process: nothing of that where none answers at once. */
void complete_values(const struct line *line);

#endif
