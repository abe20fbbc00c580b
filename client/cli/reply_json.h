/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_CLI_REPLY_JSON_H
#define PERCUSS_CLI_REPLY_JSON_H

#include <percuss/reply.h>

#include "json_writer.h"

/* The reply with the wire's names and nesting; choices as their names, undefined and infinite
 * numbers as null. The caller releases it. NULL: out of memory. */
json_t *reply_to_json(const struct percuss_reply *reply);

/* Its JSON Schema; the caller releases it. */
json_t *reply_schema(void);

#endif
