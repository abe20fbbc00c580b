/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_CLI_BODY_JSON_H
#define PERCUSS_CLI_BODY_JSON_H

#include <percuss/server.h>

#include "json_writer.h"

/* A body of the catalogue; undefined and infinite numbers as null. The caller releases it. NULL:
 * out of memory. */
json_t *body_to_json(const struct percuss_body *body);

#endif
