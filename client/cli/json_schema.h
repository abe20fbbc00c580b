/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* JSON Schema (draft 2020-12) of the JSON that is read and written by tables of members. */
#ifndef PERCUSS_CLI_JSON_SCHEMA_H
#define PERCUSS_CLI_JSON_SCHEMA_H

#include <jansson.h>

#include "json_fields.h"

/* The schema of an object. `read`: it is one that we read: members may be left out and no others
 * are allowed; otherwise all are there and newer versions may add others. The caller releases it.
 */
json_t *json_schema(const struct json_member *members, bool read);

#endif
