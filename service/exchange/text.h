/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Copies of texts. Every reply needs them, and snprintf would cost as much as DDS does. */
#ifndef PERCUSS_EXCHANGE_TEXT_H
#define PERCUSS_EXCHANGE_TEXT_H

#include <string.h>

/* Copies as much of a terminated text as fits into `size` > 0 bytes, always terminated. */
static inline void text_copy(char *target, size_t size, const char *source)
{
    size_t length = strlen(source);
    if (length >= size)
        length = size - 1;
    memcpy(target, source, length);
    target[length] = '\0';
}

/* The same into an array. */
#define COPY_TEXT(array, text) text_copy(array, sizeof(array), text)

#endif
