/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Samples out of an input: for each a type, a byte order, a size (2 bytes, little-endian) and so
 * many bytes of XCDR2, as they come from the network. */
#ifndef PERCUSS_FUZZ_SAMPLES_H
#define PERCUSS_FUZZ_SAMPLES_H

#include "fuzz.h"
#include "unit/wire/any_sample.h"

/* One sample as DDS hands it on, where the check in front of DDS and DDS itself let it pass. */
typedef void samples_visit(void *context, int type, const void *sample);

/* Gives those whose type is in `types`, each an index into any_types. */
void samples_give(const uint8_t *data, size_t size, uint32_t types, samples_visit *visit,
                  void *context);

#endif
