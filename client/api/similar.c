/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "similar.h"

#include <stdbool.h>
#include <string.h>

static unsigned least(unsigned a, unsigned b)
{
    return a < b ? a : b;
}

unsigned similar_distance(const char *one, const char *other)
{
    /* rows[i % 3][j]: distance between the first i letters of `one` and the first j of `other` */
    unsigned rows[3][PERCUSS_ID_SIZE];
    size_t height = strnlen(one, PERCUSS_ID_SIZE - 1), width = strnlen(other, PERCUSS_ID_SIZE - 1);
    for (size_t j = 0; j <= width; j++)
        rows[0][j] = (unsigned)j;
    for (size_t i = 1; i <= height; i++) {
        const unsigned *last = rows[(i - 1) % 3], *before = rows[(i + 1) % 3];
        unsigned *row = rows[i % 3];
        row[0] = (unsigned)i;
        for (size_t j = 1; j <= width; j++) {
            unsigned replaced = last[j - 1] + (one[i - 1] != other[j - 1]);
            row[j] = least(replaced, 1 + least(last[j], row[j - 1]));
            bool swapped =
                i > 1 && j > 1 && one[i - 1] == other[j - 2] && one[i - 2] == other[j - 1];
            if (swapped)
                row[j] = least(row[j], before[j - 2] + 1);
        }
    }
    return rows[height % 3][width];
}

const struct percuss_body *similar_body(const struct percuss_body_list *list, const char *id)
{
    const struct percuss_body *nearest = NULL;
    unsigned best = (unsigned)(strlen(id) + 1) / 2;
    for (size_t i = 0; i < list->count; i++) {
        unsigned distance = similar_distance(id, list->bodies[i].id);
        if (distance < best) {
            best = distance;
            nearest = &list->bodies[i];
        }
    }
    return nearest;
}
