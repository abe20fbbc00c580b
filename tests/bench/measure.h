/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Median time of repeated solves, and one line of the report for each. */
#ifndef PERCUSS_BENCH_MEASURE_H
#define PERCUSS_BENCH_MEASURE_H

#include <stdbool.h>

struct report {
    bool csv;
    double budget; /* s to spend on repeating one solve */
    const char *scene;
    double expected; /* restitution of the converged solution */
};

typedef bool solver_run(void *solver);

/* Median seconds of a run once everything is warm; 3 runs at least. Negative: a run failed. */
double measure(solver_run *run, void *solver, double budget);

void report_header(const struct report *report);
void report_line(const struct report *report, const char *method, const char *setting,
                 double restitution, double seconds);

#endif
