/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Inner loops for more than one vector unit. */
#ifndef PERCUSS_BASE_VECTOR_CLONES_H
#define PERCUSS_BASE_VECTOR_CLONES_H

/* Attribute of a function that is compiled for the baseline and for AVX2; the program selects one
 * when it starts. Contraction is off, so both give the same bits. Sanitizers cannot run the
 * resolver, and clang 14 emits another symbol than the callers use: with these only the baseline is
 * compiled, as with PERCUSS_ONE_KERNEL. */
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&                \
    !defined(__SANITIZE_THREAD__) && !defined(PERCUSS_ONE_KERNEL)
#define VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
/* For code that is written for each width: the attribute of a function for AVX2, and the test
 * whether the processor has it. Not defined where only the baseline is compiled. */
#define VECTOR_WIDE    __attribute__((target("avx2")))
#define VECTOR_IS_WIDE __builtin_cpu_supports("avx2")
#else
#define VECTOR_CLONES
#endif

/* Before a loop over more arrays than a compiler tells apart while it runs: none of them overlap.
 */
#ifdef __clang__
#define VECTOR_APART
#else
#define VECTOR_APART _Pragma("GCC ivdep")
#endif

#endif
