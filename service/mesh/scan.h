/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A file in memory, read from front to back. */
#ifndef PERCUSS_MESH_SCAN_H
#define PERCUSS_MESH_SCAN_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"

/* Where reading is. `text` ends with a zero after `size` bytes. */
struct scan {
    const char *file; /* for messages */
    char *text;
    size_t size, at;
    size_t line;  /* from 1: of what was read last */
    size_t ended; /* lines that end before `at` and are not counted yet */
    bool binary;  /* numbers are those of the machine */
    struct fault *fault;
};

/* Reads a whole file; PERCUSS_BAD_REQUEST: it cannot be read. Free it with scan_close. */
enum percuss_status scan_open(const char *path, struct scan *scan, struct fault *fault);
void scan_close(struct scan *scan);

/* "FILE:LINE: message" ("FILE: byte N: ..." of binary files) with PERCUSS_BAD_REQUEST. */
enum percuss_status scan_refuse(const struct scan *scan, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Copies the next line without its end, cut to fit, and goes beyond it; false: there is none. */
bool scan_line(struct scan *scan, char *line, size_t size);

/* Numbers, between white space or as bytes; false: there is none, or it is out of range, which
 * `what` is refused for. */
bool scan_integer(struct scan *scan, const char *what, int *value);
bool scan_size(struct scan *scan, const char *what, size_t *value);
bool scan_real(struct scan *scan, const char *what, double *value);

/* The same for a count of things that take at least one byte each: what is left of the file bounds
 * it. */
bool scan_count(struct scan *scan, const char *what, size_t *value);

#endif
