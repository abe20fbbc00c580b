/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A text that is assembled in a buffer from strings and numbers, without the cost of printf. It is
 * cut at the buffer's end and always zero-terminated. */
#ifndef PERCUSS_BASE_TEXT_H
#define PERCUSS_BASE_TEXT_H

#include <stddef.h>

struct text {
    char *at;    /* end of the text */
    size_t left; /* room there, with that of the final zero */
};

/* An empty text in a buffer of at least a byte. */
struct text text_begin(char *buffer, size_t size);

void text_add(struct text *text, const char *words);

/* As printf's %zu. */
void text_add_count(struct text *text, size_t count);

/* As printf's %.*g, byte for byte; digits > 0. */
void text_add_number(struct text *text, double value, int digits);

/* As printf. */
__attribute__((format(printf, 2, 3))) void text_format(struct text *text, const char *format, ...);

#endif
