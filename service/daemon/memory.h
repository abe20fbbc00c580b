/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Memory of a thread that answers. */
#ifndef PERCUSS_DAEMON_MEMORY_H
#define PERCUSS_DAEMON_MEMORY_H

#include <stddef.h>

/* Has the allocator keep so many bytes for the calling thread that the system has mapped already.
 * A thread's heap grows page by page otherwise, by a system call and a page fault each: two or
 * three microseconds of each of a client's first thousand questions, whose replies are kept.
 * Without the memory nothing happens. */
void memory_keep(size_t bytes);

#endif
