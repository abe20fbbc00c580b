/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Which of some names was meant by a word that is none of them: for messages of all programs. */
#ifndef PERCUSS_SIMILAR_H
#define PERCUSS_SIMILAR_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* Letters that are compared, and a final zero: of an id all. */
enum { SIMILAR_SIZE = 64 };

static inline unsigned similar_least(unsigned a, unsigned b)
{
    return a < b ? a : b;
}

/* Letters to insert, delete, replace or swap with the next to get from one text to the other, each
 * of them once at most (optimal string alignment; Damerau, 1964). */
static inline unsigned similar_distance(const char *one, const char *other)
{
    /* rows[i % 3][j]: distance between the first i letters of `one` and the first j of `other` */
    unsigned rows[3][SIMILAR_SIZE];
    size_t height = strnlen(one, SIMILAR_SIZE - 1), width = strnlen(other, SIMILAR_SIZE - 1);
    for (size_t j = 0; j <= width; j++)
        rows[0][j] = (unsigned)j;
    for (size_t i = 1; i <= height; i++) {
        const unsigned *last = rows[(i - 1) % 3], *before = rows[(i + 1) % 3];
        unsigned *row = rows[i % 3];
        row[0] = (unsigned)i;
        for (size_t j = 1; j <= width; j++) {
            unsigned replaced = last[j - 1] + (one[i - 1] != other[j - 1]);
            row[j] = similar_least(replaced, 1 + similar_least(last[j], row[j - 1]));
            bool swapped =
                i > 1 && j > 1 && one[i - 1] == other[j - 2] && one[i - 2] == other[j - 1];
            if (swapped)
                row[j] = similar_least(row[j], before[j - 2] + 1);
        }
    }
    return rows[height % 3][width];
}

/* The nearest of the names offered so far, if less than half of it is wrong; NULL: none. */
struct similar {
    const char *word, *nearest;
    unsigned best;
};

static inline struct similar similar_to(const char *word)
{
    return (struct similar){.word = word, .best = (unsigned)(strlen(word) + 1) / 2};
}

static inline void similar_offer(struct similar *similar, const char *name)
{
    unsigned distance = similar_distance(similar->word, name);
    if (distance >= similar->best)
        return;
    similar->best = distance;
    similar->nearest = name;
}

#endif
