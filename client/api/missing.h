/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Pointers that a caller must give, and has not given. */
#ifndef PERCUSS_API_MISSING_H
#define PERCUSS_API_MISSING_H

#include <stddef.h>
#include <string.h>

/* A name within a list of names; NULL: no pointer is missing. */
struct missing {
    const char *name;
    int length;
};

/* The first NULL among pointers with their names listed as "client, pair->a". */
static inline struct missing missing_find(const char *names, const void *const *pointers,
                                          size_t count)
{
    size_t first = 0;
    while (first < count && pointers[first])
        first++;
    /* names cost nothing where all is there */
    if (first == count)
        return (struct missing){NULL, 0};
    for (size_t i = 0; i < first; i++)
        names += strcspn(names, ",") + strlen(", ");
    return (struct missing){names, (int)strcspn(names, ",")};
}

#define MISSING_LIST(...)                                                                          \
    (const void *const[])                                                                          \
    {                                                                                              \
        __VA_ARGS__                                                                                \
    }
#define MISSING(...)                                                                               \
    missing_find(#__VA_ARGS__, MISSING_LIST(__VA_ARGS__),                                          \
                 sizeof MISSING_LIST(__VA_ARGS__) / sizeof(void *))

/* Arguments of a printf by this format. */
#define MISSING_FORMAT        "%.*s: NULL: a pointer is needed"
#define MISSING_TEXT(missing) (missing).length, (missing).name

#endif
