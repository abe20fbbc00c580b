/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "tables/bar.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 40 };

struct bar bar_begin(const char *label)
{
    return (struct bar){label, -1, isatty(STDERR_FILENO), 0.0, 1.0};
}

bool bar_show(void *context, double done)
{
    struct bar *bar = context;
    int now = (int)(1000.0 * (bar->from + bar->share * done));
    if (!bar->wanted || now == bar->shown)
        return true;
    bar->shown = now;
    char line[WIDTH + 1];
    int full = now * WIDTH / 1000;
    memset(line, '#', (size_t)full);
    memset(line + full, '.', (size_t)(WIDTH - full));
    line[WIDTH] = '\0';
    fprintf(stderr, "\r[%s] %5.1f %%  %s", line, 0.1 * now, bar->label);
    return true;
}

void bar_clear(const struct bar *bar)
{
    if (bar->wanted)
        fprintf(stderr, "\r\033[K");
}
