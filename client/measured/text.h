/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The text of a file as UTF-8, from any of the usual encodings. */
#ifndef PERCUSS_MEASURED_TEXT_H
#define PERCUSS_MEASURED_TEXT_H

#include "remarks.h"

/* The whole file, "-": standard input, with a zero behind it and without a byte order mark. UTF-16
 * is known by its mark; other text than UTF-8 is taken for Windows-1252. Lines end with '\n',
 * whether they did by CR, LF or both. The caller frees it. NULL with the reason. */
char *text_read(const char *file, struct measured_fault *fault);

/* Whether it has a size, as no terminal, pipe or device has: a file that is named in another one
 * must, so that reading it comes to an end. False with the reason. */
bool text_is_file(const char *file, struct measured_fault *fault);

/* The file's name in messages. */
const char *text_name(const char *file);

#endif
