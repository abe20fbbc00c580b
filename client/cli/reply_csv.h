/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A reply as comma-separated values. */
#ifndef PERCUSS_CLI_REPLY_CSV_H
#define PERCUSS_CLI_REPLY_CSV_H

#include <percuss/percuss.h>

/* Prints the names of the columns on stdout, behind `lead`: others with a comma after each. */
void reply_csv_head(const char *lead, bool units);

/* Prints a line for each sub-impact that is listed, with what is of its contact before it (a
 * contact without one has a line too), on stdout, behind `lead`; message and warnings to stderr. */
void reply_csv_print(const char *lead, const struct percuss_request *request,
                     const struct percuss_reply *reply);

#endif
