/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Of libpercuss-measured: its error text, and the twins asked for by its functions. */
#ifndef PERCUSS_TWINS_REPORT_H
#define PERCUSS_TWINS_REPORT_H

#include <percuss/measured.h>

#include "missing.h"
#include "tally.h"
#include "twin.h"

struct percuss_measured {
    struct measured_set set;
    struct measured_remarks remarks; /* on the file */
};

/* Keeps the text for percuss_measured_error_text of this thread and returns `result`. */
enum percuss_result report_set(enum percuss_result result, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* INVALID_ARGUMENT, with its name in the text, where one of these pointers is NULL; else OK. */
#define REPORT_NULL(...) report_null(MISSING(__VA_ARGS__))
enum percuss_result report_null(struct missing missing);

/* A call of the library: its own copy of the impacts, which is completed, and their twins. */
struct report {
    const struct percuss_measured_question *asked;
    struct twin_question question;
    struct measured_set set;
    struct twin *list;
    struct tally warnings;
    struct twin_listener listener;
};

/* The question's members but for those that the client checks. */
enum percuss_result report_check(const struct percuss_measured_question *asked);

/* Of a question that was checked: copies the impacts, asks for their twins and completes the
 * measured impacts. To be ended in any case; not to be moved. */
enum percuss_result report_begin(const struct percuss_measured *measured,
                                 const struct percuss_measured_question *asked,
                                 struct report *report);
void report_end(struct report *report);

/* The result of a twin_ask of the report's listener, with its text. */
enum percuss_result report_result(enum percuss_result result);

/* The warnings of the twins asked for last, to be freed with report_free_warnings. NULL: out of
 * memory. */
char **report_warnings(const struct report *report);
void report_free_warnings(size_t count, char **warnings);

#endif
