/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Answers as a page for a browser, which needs no network. The page and its scripts are in
 * client/page; it shows what its data are, by their member "kind", an impact without. */
#ifndef PERCUSS_CLI_HTML_PAGE_H
#define PERCUSS_CLI_HTML_PAGE_H

#include <jansson.h>
#include <stdio.h>

#include "cli.h"

/* What --html says: a file that can be written, or "-", standard output; then all else that goes
 * there goes to standard error from now on. Otherwise ends the process with exit code 2. */
const char *html_page_file(const char *text, struct argp_state *state);

/* Writes more members of the data, each behind a comma. */
typedef void html_page_more(FILE *out, const void *context);

/* Writes numbers as an array, with fewer digits than JSON has elsewhere; null: undefined. */
void html_page_put_numbers(FILE *out, const double *values, size_t count);

/* Writes the page of the data, which it releases (NULL: there was no memory for them); `more` may
 * be NULL. The command line becomes the member "command". Exit code; complains in the name of
 * --html. */
int html_page_write(const char *file, json_t *data, html_page_more *more, const void *context,
                    const struct common *common);

/* `count` doubles, each `stride` bytes behind the one before, as an array; null: undefined. NULL:
 * out of memory. */
json_t *html_page_numbers(const void *first, size_t stride, size_t count);

#endif
