/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Numbers with units, as people type them. */
#ifndef PERCUSS_QUANTITY_H
#define PERCUSS_QUANTITY_H

#include <percuss/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Reads a number as the command line and catalogues do, in SI units: "300mm/s" is 0.3, "70 GPa"
 * 7e10, and a number by itself is in SI units already. `quantity`: "length", "stress", "density",
 * "curvature", "frequency", "speed", "time" or "impulse"; "number" bears no unit. Blanks before the
 * number are skipped. INVALID_ARGUMENT leaves `value` as it is: no finite number, a unit that is
 * not known or of another quantity, a quantity of another name. Needs no client. */
PERCUSS_API enum percuss_result percuss_quantity_parse(const char *text, const char *quantity,
                                                       double *value);

#ifdef __cplusplus
}
#endif

#endif
