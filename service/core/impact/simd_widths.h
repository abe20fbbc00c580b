/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Includes the passes of the file SIMD_PASSES for each width of vectors (simd.h): two lanes, and
 * four where the compiler can make them. Lanes have sums of their own and are added in the order of
 * simd.h, so that every width gives the same bits. No guard: each user includes it once. */
#define VECTOR     half
#define WIDTH      2
#define FOLD       FOLD_HALVES
#define PASS(name) name##_narrow
#define PASS_UNIT
#include SIMD_PASSES
#ifdef VECTOR_WIDE
#undef VECTOR
#undef WIDTH
#undef FOLD
#undef PASS
#undef PASS_UNIT
#define VECTOR     lanes
#define WIDTH      LANES
#define FOLD       FOLD_LANES
#define PASS(name) name##_wide
#define PASS_UNIT  VECTOR_WIDE
#include SIMD_PASSES
#endif
