/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The results of a sweep: a curve for every body B and contact model asked for. Columns: speed
 * (m/s), restitution, its estimated error, impulse (N s), sub-impacts, significant ones, end time
 * (s), status; before them b and contact_model where there are several curves. */
#ifndef PERCUSS_CLI_SWEEP_OUTPUT_H
#define PERCUSS_CLI_SWEEP_OUTPUT_H

#include <percuss/reply.h>

#include "impact.h"
#include "tally.h"

struct sweep_curve {
    const char *b;
    const char *contact_model;     /* asked for */
    struct percuss_reply *replies; /* one a speed */
};

/* Measured restitutions, laid over the picture. */
struct sweep_measured {
    const char *file;
    struct measured_set set;
};

struct sweep_points {
    const char *a;
    unsigned count; /* speeds */
    const double *speeds;
    size_t curve_count;
    const struct sweep_curve *curves;
    const struct tally *warnings; /* of all points */
    size_t measured_count;
    const struct sweep_measured *measured;
};

/* On standard output. */
void sweep_print_table(const struct sweep_points *points);

/* 17 significant digits, nan where undefined. */
void sweep_print_csv(const struct sweep_points *points);

/* {"points": [{the columns, "reply": the whole reply}], "warnings": [...]}; of several curves
 * {"curves": [{"b", "contact_model", "points"}], "warnings": [...]} */
void sweep_print_json(const struct sweep_points *points);

/* The restitution against the speed with its estimated error, the number of sub-impacts below.
 * Exit code; complains. */
int sweep_plot(const char *file, const struct sweep_points *points);

#endif
