/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A progress bar on standard error, where that is a terminal. */
#ifndef PERCUSS_TABLES_BAR_H
#define PERCUSS_TABLES_BAR_H

#include <stdbool.h>

struct bar {
    const char *label;
    int shown; /* per mille */
    bool wanted;
    double from, share; /* of the whole: before what is told now, and its own */
};

struct bar bar_begin(const char *label);
/* `proceed` of struct watch; always true. */
bool bar_show(void *bar, double done);
void bar_clear(const struct bar *bar);

#endif
