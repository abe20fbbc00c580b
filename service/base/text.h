/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A text put together in a buffer, by pieces and numbers: what every answer says, without the cost
 * of formats. What does not fit is cut off; the text always ends. */
#ifndef PERCUSS_BASE_TEXT_H
#define PERCUSS_BASE_TEXT_H

#include <stddef.h>

struct text {
    char *at;    /* its end */
    size_t left; /* room there, that of the final zero included */
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
