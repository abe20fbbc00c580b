/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The inner loops' vectors, and the ends of their sums: lanes 0 to 3 are added as
 * (0 + 2) + (1 + 3), however wide the vectors were. */
#ifndef PERCUSS_IMPACT_SIMD_H
#define PERCUSS_IMPACT_SIMD_H

#include "base/vector_clones.h"
#include "impact/step_table.h"

/* Four modes, and two. gcc keeps sums that are wider than the vector unit's in memory during a
 * loop: inner loops with sums are written for either width (VECTOR, WIDTH of its lanes). */
typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));
typedef double half __attribute__((vector_size(2 * sizeof(double))));

#define AT(array, k) (*(const lanes *)((array) + (k)))
#define TOTAL(x)     (((x)[0] + (x)[2]) + ((x)[1] + (x)[3]))

/* A contact's four nodes, at any address. */
typedef double quad __attribute__((vector_size(NODES * sizeof(double)), aligned(8)));
#define QUAD(at)       (*(quad *)(at))
#define CONST_QUAD(at) (*(const quad *)(at))

/* Lanes 0 + 2 and 1 + 3 of a sum that is two halves, or that is one. */
#define FOLD_HALVES(x) ((x)[0] + (x)[1])
#define FOLD_LANES(x)                                                                              \
    (__builtin_shufflevector((x)[0], (x)[0], 0, 1) + __builtin_shufflevector((x)[0], (x)[0], 2, 3))

/* Two folded sums. */
#define FOLD_BOTH(x, y) (__builtin_shufflevector(x, y, 0, 2) + __builtin_shufflevector(x, y, 1, 3))

/* The function of a name for the processor's width, of passes that simd_widths.h includes. */
#ifdef VECTOR_WIDE
#define FOLD_EITHER(name) (VECTOR_IS_WIDE ? name##_wide : name##_narrow)
#else
#define FOLD_EITHER(name) name##_narrow
#endif

#endif
