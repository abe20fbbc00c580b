/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Inner loops for more than one vector unit. */
#ifndef PERCUSS_BASE_VECTOR_CLONES_H
#define PERCUSS_BASE_VECTOR_CLONES_H

/* Before a function: the same code for the baseline and for AVX2, chosen when the program starts;
 * contraction is off, so both give the same bits. Sanitizers cannot run the resolver, and what
 * clang 14 makes of the attribute has another name than the function's callers use: there
 * it is the baseline alone, as with PERCUSS_ONE_KERNEL. */
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&                \
    !defined(__SANITIZE_THREAD__) && !defined(PERCUSS_ONE_KERNEL)
#define VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
/* For code that is written for either width: what is before a function for AVX2, and whether there
 * is that. Not defined where there is the baseline alone. */
#define VECTOR_WIDE    __attribute__((target("avx2")))
#define VECTOR_IS_WIDE __builtin_cpu_supports("avx2")
#else
#define VECTOR_CLONES
#endif

#endif
