/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Comma-separated values as the commands write them: numbers in SI units, nan where undefined. */
#ifndef PERCUSS_CLI_CSV_H
#define PERCUSS_CLI_CSV_H

#include <stdbool.h>
#include <stdio.h>

/* Names of columns, "speed,restitution", without the end of the line; with units "speed
 * [m/s],restitution": a name without a unit stays as it is. Of "young@al-beam" the part before the
 * @ decides. */
void csv_head(FILE *file, const char *names, bool units);

/* A text, in quotes where it needs them. */
void csv_text(FILE *file, const char *text);

#endif
