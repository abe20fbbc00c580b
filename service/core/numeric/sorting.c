/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/sorting.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { DIGITS = 8, DIGIT_BITS = 8, DIGIT_VALUES = 1 << DIGIT_BITS };

static const uint64_t SIGN = UINT64_C(1) << 63;

struct entry {
    uint64_t key;
    size_t origin;
};

/* An integer that is ordered as the numbers are: those below 0 with all bits turned over, as their
 * size counts the other way round, the others above them. */
static uint64_t key_of(double value)
{
    uint64_t bits;
    value += 0.0; /* -0 is 0 */
    memcpy(&bits, &value, sizeof bits);
    return bits & SIGN ? ~bits : bits | SIGN;
}

static double value_of(uint64_t key)
{
    double value;
    uint64_t bits = key & SIGN ? key & ~SIGN : ~key;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static size_t digit_of(const struct entry *entry, int digit)
{
    return entry->key >> (digit * DIGIT_BITS) & (DIGIT_VALUES - 1);
}

/* Entries by one digit, those that share it in the order they have. */
static void distribute(const struct entry *from, struct entry *to, size_t count, int digit,
                       const size_t counts[DIGIT_VALUES])
{
    size_t next[DIGIT_VALUES], sum = 0;
    for (size_t v = 0; v < DIGIT_VALUES; v++) {
        next[v] = sum;
        sum += counts[v];
    }
    for (size_t i = 0; i < count; i++)
        to[next[digit_of(&from[i], digit)]++] = from[i];
}

/* Radix sort from the last digit to the first (Knuth, The Art of Computer Programming 3, 5.2.5).
 * Returns which of the two arrays has the result. */
static const struct entry *sort_entries(struct entry *entries, struct entry *spare, size_t count)
{
    size_t counts[DIGITS][DIGIT_VALUES] = {{0}};
    for (size_t i = 0; i < count; i++)
        for (int digit = 0; digit < DIGITS; digit++)
            counts[digit][digit_of(&entries[i], digit)]++;
    for (int digit = 0; digit < DIGITS; digit++) {
        /* a digit that all share changes nothing */
        if (counts[digit][digit_of(&entries[0], digit)] == count)
            continue;
        distribute(entries, spare, count, digit, counts[digit]);
        struct entry *sorted = spare;
        spare = entries;
        entries = sorted;
    }
    return entries;
}

bool sorting_ascend(double *values, size_t *origin, size_t count)
{
    if (count == 0)
        return true;
    struct entry *entries = malloc(2 * count * sizeof *entries);
    if (!entries)
        return false;
    for (size_t i = 0; i < count; i++)
        entries[i] = (struct entry){key_of(values[i]), origin ? origin[i] : 0};
    const struct entry *sorted = sort_entries(entries, entries + count, count);
    for (size_t i = 0; i < count; i++) {
        values[i] = value_of(sorted[i].key);
        if (origin)
            origin[i] = sorted[i].origin;
    }
    free(entries);
    return true;
}
