/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a reduction found, on standard output. */
#ifndef PERCUSS_REDUCE_REPORT_H
#define PERCUSS_REDUCE_REPORT_H

#include "reduce/reduction.h"

void report_text(const struct reduction *reduction);

/* One JSON object, numbers with 17 digits. */
void report_json(const struct reduction *reduction);

#endif
