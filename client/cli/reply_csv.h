/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A reply as comma-separated values. */
#ifndef PERCUSS_CLI_REPLY_CSV_H
#define PERCUSS_CLI_REPLY_CSV_H

#include <percuss/percuss.h>

/* Prints a line for each sub-impact that is listed, with what is of its contact before it (a
 * contact without one has a line too), on stdout; message and warnings to stderr. */
void reply_csv_print(const struct percuss_request *request, const struct percuss_reply *reply,
                     bool units);

#endif
