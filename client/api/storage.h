/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Memory that goes as a whole: the arrays of a reply. */
#ifndef PERCUSS_API_STORAGE_H
#define PERCUSS_API_STORAGE_H

#include <stdbool.h>
#include <stddef.h>

struct storage {
    struct storage_block *blocks; /* for storage_free */
    bool failed;                  /* memory ran out */
};

/* Zeroed room for `count` elements, aligned for any; NULL, and `failed`, when memory runs out. */
void *storage_take(struct storage *storage, size_t count, size_t size);

/* The same with a copy of `count` elements; `source` may be NULL for none. */
void *storage_copy(struct storage *storage, const void *source, size_t count, size_t size);

/* Gives the blocks back; NULL is allowed. */
void storage_free(struct storage_block *blocks);

#endif
