/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Where callgrind begins (--instr-atstart=no): what comes before, the preparation of bodies, takes
 * more than twice as long while it is instrumented, and is not counted. */
#ifndef PERCUSS_BENCH_COUNTING_H
#define PERCUSS_BENCH_COUNTING_H

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>

static inline void counting_begins(void)
{
    CALLGRIND_START_INSTRUMENTATION;
}
#else
static inline void counting_begins(void)
{
}
#endif

#endif
