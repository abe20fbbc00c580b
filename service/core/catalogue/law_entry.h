/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The files of a law of the catalogue. */
#ifndef PERCUSS_CATALOGUE_LAW_ENTRY_H
#define PERCUSS_CATALOGUE_LAW_ENTRY_H

#include "catalogue/reader.h"
#include "model/own_law.h"

/* Reads `points` and `unloading` of a law that keys_law have filled: CSV files whose
 * faults are told with their own line. Also after a failure the law is for own_law_clear.
 * PERCUSS_OK, PERCUSS_BAD_REQUEST or PERCUSS_INTERNAL. */
enum percuss_status law_entry_read(struct reader *reader, struct entry entry, struct own_law *law);

#endif
