/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_API_ERROR_H
#define PERCUSS_API_ERROR_H

#include <percuss/result.h>

#include "missing.h"

/* Keeps the text for percuss_error_text of this thread and returns `result`. That of NO_MEMORY
 * begins with "out of memory: ", so that `format` only names the object. */
enum percuss_result error_set(enum percuss_result result, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* INVALID_ARGUMENT, with its name in the text, where one of these pointers is NULL; else OK. */
#define ERROR_NULL(...) error_null(MISSING(__VA_ARGS__))
enum percuss_result error_null(struct missing missing);

/* Takes over the text of another library's copy of this module. */
void error_copy(const char *text);

/* The text of percuss_error_text; not to be replaced by another library's. */
const char *error_last(void);

#endif
