/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A tally's lines: on standard error, or as an array for JSON. */
#ifndef PERCUSS_CLI_TALLY_OUTPUT_H
#define PERCUSS_CLI_TALLY_OUTPUT_H

#include <jansson.h>

#include "tally.h"

void tally_complain(const struct tally *tally);
json_t *tally_to_json(const struct tally *tally);

#endif
