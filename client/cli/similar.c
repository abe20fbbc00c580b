/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "similar.h"

#include <string.h>

static unsigned least(unsigned a, unsigned b)
{
    return a < b ? a : b;
}

unsigned similar_distance(const char *one, const char *other)
{
    /* row[j]: distance between what was read of `one` and the first j letters of `other` */
    unsigned row[PERCUSS_ID_SIZE];
    size_t rows = strnlen(one, PERCUSS_ID_SIZE - 1), columns = strnlen(other, PERCUSS_ID_SIZE - 1);
    for (size_t j = 0; j <= columns; j++)
        row[j] = (unsigned)j;
    for (size_t i = 1; i <= rows; i++) {
        unsigned diagonal = row[0];
        row[0] = (unsigned)i;
        for (size_t j = 1; j <= columns; j++) {
            unsigned replaced = diagonal + (one[i - 1] != other[j - 1]);
            diagonal = row[j];
            row[j] = least(replaced, 1 + least(row[j], row[j - 1]));
        }
    }
    return row[columns];
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
