/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A file in memory, read from front to back. */
#ifndef PERCUSS_MESH_SCAN_H
#define PERCUSS_MESH_SCAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/fault.h"

/* State of reading. `text` ends with a zero after `size` bytes. */
struct scan {
    const char *file; /* for messages */
    char *text;
    size_t size, at;
    size_t line;  /* from 1: line of the last token */
    size_t ended; /* line ends before `at` that `line` does not count yet */
    bool binary;  /* numbers are bytes of this machine's types */
    struct fault *fault;
};

/* Reads a whole file; PERCUSS_BAD_REQUEST: it cannot be read. Free it with scan_close. */
enum percuss_status scan_open(const char *path, struct scan *scan, struct fault *fault);
void scan_close(struct scan *scan);

/* "FILE:LINE: message" ("FILE: byte N: ..." of binary files) with PERCUSS_BAD_REQUEST. */
enum percuss_status scan_refuse(const struct scan *scan, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Copies the next line without its end, cut to fit, and skips it; false: there is none. */
bool scan_line(struct scan *scan, char *line, size_t size);

/* The largest whole number that is taken: behind it there are labels for nodes that are made. */
#define SCAN_MOST ((size_t)INT64_MAX)

/* Numbers, between white space or as bytes; false: there is none, or it is out of range; the
 * refusal begins with `subject`. */
bool scan_integer(struct scan *scan, const char *subject, int *value);
bool scan_size(struct scan *scan, const char *subject, size_t *value);
bool scan_real(struct scan *scan, const char *subject, double *value);

/* The same for a count of items of at least one byte each: the rest of the file bounds it. */
bool scan_count(struct scan *scan, const char *subject, size_t *value);

#endif
