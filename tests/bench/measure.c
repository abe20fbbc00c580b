/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MAX_RUNS = 2001, MIN_RUNS = 3 };

/* Processor time: on a busy machine wall time would charge others' work to the long solves only. */
static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

double measure(solver_run *run, void *solver, double budget)
{
    static double seconds[MAX_RUNS];
    double begin = now();
    if (!run(solver))
        return -1.0;
    seconds[0] = now() - begin;
    /* the first run only warms up, unless it is so long that this does not matter */
    int runs = seconds[0] > budget ? 1 : 0;
    begin = now();
    while (runs < MIN_RUNS || (runs < MAX_RUNS && now() - begin < budget)) {
        double start = now();
        if (!run(solver))
            return -1.0;
        seconds[runs++] = now() - start;
    }
    qsort(seconds, (size_t)runs, sizeof seconds[0], ascending);
    return runs % 2 ? seconds[runs / 2] : 0.5 * (seconds[runs / 2 - 1] + seconds[runs / 2]);
}

void report_header(const struct report *report)
{
    if (report->csv)
        printf("scene,method,setting,restitution,error,seconds\n");
    else
        printf("%-13s %-15s %-30s %18s %9s %10s\n", "scene", "method", "setting", "restitution",
               "error", "seconds");
}

void report_line(const struct report *report, const char *method, const char *setting,
                 double restitution, double seconds)
{
    double error = fabs(restitution - report->expected);
    if (seconds < 0.0) {
        fprintf(stderr, "  %s, %s: no solution\n", method, setting);
        return;
    }
    if (report->csv)
        printf("%s,%s,%s,%.15g,%.3e,%.4e\n", report->scene, method, setting, restitution, error,
               seconds);
    else
        printf("%-13s %-15s %-30s %18.15f %9.1e %10.3e\n", report->scene, method, setting,
               restitution, error, seconds);
    fflush(stdout);
}
