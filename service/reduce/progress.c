/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

/* s between lines: on a terminal, elsewhere; and before a guess of the time left is worth a word */
static const double TERMINAL_PAUSE = 0.2, OTHER_PAUSE = 30.0, FIRST_GUESS = 2.0;

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

struct progress progress_begin(double pause)
{
    double start = now();
    bool terminal = isatty(STDERR_FILENO);
    return (struct progress){.label = "",
                             .terminal = terminal,
                             .stages = terminal || pause > 0.0,
                             .pause = pause > 0.0 ? pause
                                      : terminal  ? TERMINAL_PAUSE
                                                  : OTHER_PAUSE,
                             .start = start,
                             .told = start,
                             .share = 1.0};
}

double progress_seconds(const struct progress *progress)
{
    return now() - progress->start;
}

static void write_line(struct progress *progress, double done)
{
    double elapsed = progress_seconds(progress);
    fprintf(stderr, "%s%5.1f %%  %s", progress->terminal ? "\r" : "percuss-reduce: ", 100.0 * done,
            progress->label);
    if (elapsed > FIRST_GUESS && done > 0.01) {
        double left = elapsed * (1.0 - done) / done;
        if (left < 100.0)
            fprintf(stderr, ", %.0f s left", left);
        else
            fprintf(stderr, ", %.0f min left", left / 60.0);
    }
    fputs(progress->terminal ? "\033[K" : "\n", stderr);
    progress->told = now();
}

void progress_stage(struct progress *progress, const char *label, double from, double share)
{
    progress->label = label;
    progress->from = from;
    progress->share = share;
    if (progress->stages)
        write_line(progress, from);
}

bool progress_show(void *context, double done)
{
    struct progress *progress = context;
    if (now() - progress->told >= progress->pause)
        write_line(progress, progress->from + progress->share * done);
    return true;
}

void progress_clear(const struct progress *progress)
{
    if (progress->terminal)
        fputs("\r\033[K", stderr);
}
