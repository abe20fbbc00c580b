/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the harnesses share. Each is one file with one entrance, which libFuzzer calls with inputs
 * that it makes (tests/fuzz.sh), and replay.c with those of tests/fuzz/corpus. */
#ifndef PERCUSS_FUZZ_H
#define PERCUSS_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"

/* The entrance; 0. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The path of a file that holds these bytes until the next call; `slot`, 0 to 3: several at once.
 */
const char *fuzz_file(int slot, const uint8_t *data, size_t size);

/* Ends the process with the words unless the condition holds: a finding. */
#define FUZZ_REQUIRE(condition, ...)                                                               \
    ((condition) ? (void)0 : (fprintf(stderr, __VA_ARGS__), fputc('\n', stderr), abort()))

/* A refusal is the caller's fault, has words, and these are text of one line. */
void fuzz_refused(enum percuss_status status, const char *text);

/* Numbers and choices out of the input's bytes; zeros behind its end. */
struct fuzz_bytes {
    const uint8_t *data;
    size_t left;
};
void fuzz_take(struct fuzz_bytes *bytes, void *value, size_t size);

/* The bytes up to the next occurrence of `mark`, which is passed over; all of them without one. */
struct fuzz_bytes fuzz_part(struct fuzz_bytes *bytes, const char *mark);

#endif
