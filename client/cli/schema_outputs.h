/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* JSON Schemas of what commands print with --json besides replies and reports of ensembles; the
 * caller releases them. */
#ifndef PERCUSS_CLI_SCHEMA_OUTPUTS_H
#define PERCUSS_CLI_SCHEMA_OUTPUTS_H

#include <jansson.h>

json_t *query_schema(void); /* of several answers */
json_t *sweep_schema(void);
json_t *compare_schema(void);
json_t *calibrate_schema(void);
json_t *bodies_schema(void);
json_t *remarks_schema(void); /* bodies --check */
json_t *dents_schema(void);
json_t *status_schema(void);
json_t *ping_schema(void);

#endif
