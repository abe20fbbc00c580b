/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/progress.h"

#include <stdio.h>
#include <unistd.h>

#include "reduce/rates.h"

/* s between lines: on a terminal, elsewhere; and before a guess of the time left is worth a word */
static const double TERMINAL_PAUSE = 0.2, OTHER_PAUSE = 30.0, FIRST_GUESS = 2.0;

struct progress progress_begin(double pause)
{
    double start = rates_clock();
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
    return rates_clock() - progress->start;
}

/* Time left, s: as expected at first, then more and more as the work goes; < 0: not known. */
static double progress_left(const struct progress *progress, double done)
{
    /* the part of the work that the expectation is worth */
    static const double FAITH = 0.05;
    if (!(progress->expected > 0.0))
        return -1.0;
    double elapsed = rates_clock() - progress->work;
    return (1.0 - done) * (elapsed + FAITH * progress->expected) / (done + FAITH);
}

static void write_progress(struct progress *progress, double done)
{
    double left = progress_left(progress, done);
    fprintf(stderr, "%s%5.1f %%  %s", progress->terminal ? "\r" : "percuss-reduce: ", 100.0 * done,
            progress->label);
    if (progress_seconds(progress) > FIRST_GUESS && left >= 0.0) {
        if (left < 100.0)
            fprintf(stderr, ", %.0f s left", left);
        else
            fprintf(stderr, ", %.0f min left", left / 60.0);
    }
    fputs(progress->terminal ? "\033[K" : "\n", stderr);
    progress->told = rates_clock();
}

void progress_stage(struct progress *progress, const char *label, double from, double share)
{
    progress->label = label;
    progress->from = from;
    progress->share = share;
    if (progress->stages)
        write_progress(progress, from);
}

bool progress_show(void *context, double done)
{
    struct progress *progress = context;
    if (rates_clock() - progress->told >= progress->pause)
        write_progress(progress, progress->from + progress->share * done);
    return true;
}

void progress_clear(const struct progress *progress)
{
    if (progress->terminal)
        fputs("\r\033[K", stderr);
}
