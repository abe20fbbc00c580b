/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_LIB_ERROR_H
#define PERCUSS_LIB_ERROR_H

#include <percuss/result.h>

/* Keeps the text for percuss_error_text of this thread and returns `result`. That of NO_MEMORY begins
 * with "out of memory: ", so that it only has to say for what. */
enum percuss_result error_set(enum percuss_result result, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* TRANSPORT with what failed and Cyclone's word for the negative return code. */
enum percuss_result error_dds(const char *what, int code);

/* NO_SERVER: the server of that name has gone. */
enum percuss_result error_lost(const char *server);

#endif
