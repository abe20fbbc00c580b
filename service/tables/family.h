/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* `percuss-tables --family`: computes the family of tables for all metals. */
#ifndef PERCUSS_TABLES_FAMILY_H
#define PERCUSS_TABLES_FAMILY_H

#include "base/fault.h"

/* Into FOLDER/family.json, with a bar on a terminal; some 18 minutes of one core. */
enum percuss_status family_compute(const char *folder, struct fault *fault);

#endif
