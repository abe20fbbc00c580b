/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/memory.h"

#include <limits.h>
#include <malloc.h>
#include <stdlib.h>
#include <string.h>

/* What is asked for at a time: more than this has a mapping of its own, which goes when it is
 * freed (M_MMAP_THRESHOLD, mallopt(3)). */
static const size_t PIECE = 64 * 1024;

void memory_keep(size_t bytes)
{
    /* free memory at a heap's end stays */
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    size_t count = bytes / PIECE;
    void **pieces = calloc(count, sizeof *pieces);
    for (size_t i = 0; pieces && i < count; i++) {
        pieces[i] = malloc(PIECE);
        if (pieces[i])
            memset(pieces[i], 1, PIECE);
    }
    for (size_t i = 0; pieces && i < count; i++)
        free(pieces[i]);
    free(pieces);
}
