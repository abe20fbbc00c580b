/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Memory that runs out at the n-th call. The linker puts these functions in place of malloc,
 * calloc, realloc, aligned_alloc, free and the arena's in whatever is linked with them (see
 * tests/CMakeLists.txt); libraries that come as shared ones keep the system's. One thread. */
#ifndef PERCUSS_TEST_FAILING_H
#define PERCUSS_TEST_FAILING_H

#include "base/fault.h"
#include "check.h"

/* What is tried begins and ends: in between memory runs out as planned. */
void failing_begin(void);
void failing_end(void);

/* For libraries that are told whom to ask for memory. */
void *failing_malloc(size_t size);
void *failing_realloc(void *old, size_t size);
void failing_free(void *memory);

/* What is tried: calls failing_begin, the functions under test, failing_end, and gives everything
 * back. True: it did what it does with memory enough; false: it said that it was out of memory. It
 * fails the test itself where neither is so. */
typedef bool failing_trial(void *context);

/* Tries with memory that lacks once, at the first call, the second, ..., until a trial makes no
 * such call; then with memory that is out from that call on. Beyond the first `dense` calls the
 * next one tried is a dense-th part further. Fails the test where memory is lost. Returns the
 * number of calls. */
unsigned long fail_each(const char *what, failing_trial *trial, void *context, unsigned dense);

/* Fails the test: says so, and where the call that failed comes from. */
void fail_by_memory(const char *what);

/* Whether a status is the one of memory that ran out, and says so; fails the test at any other but
 * PERCUSS_OK and PERCUSS_TRUNCATED. */
bool is_out_of_memory(enum percuss_status status, const char *text);

#endif
