/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Arrays that grow while a file is read, without trust in its stated counts. */
#ifndef PERCUSS_MESH_GROW_H
#define PERCUSS_MESH_GROW_H

#include <stdbool.h>
#include <stdlib.h>

/* Makes room for one more element of `size` bytes after `count`; doubles the array. False: out of
 * memory. */
static inline bool grow_array(void **array, size_t count, size_t *room, size_t size)
{
    if (count < *room)
        return true;
    size_t more = *room ? 2 * *room : 16;
    void *larger = realloc(*array, more * size);
    if (!larger)
        return false;
    *array = larger;
    *room = more;
    return true;
}

#define GROW(array, count, room) grow_array((void **)&(array), count, &(room), sizeof *(array))

#endif
