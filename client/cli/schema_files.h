/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The texts of config/catalogue.schema.json and config/percussd.schema.json. */
#ifndef PERCUSS_CLI_SCHEMA_FILES_H
#define PERCUSS_CLI_SCHEMA_FILES_H

extern const char SCHEMA_OF_catalogue[], SCHEMA_OF_percussd[];

#endif
