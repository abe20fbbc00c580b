/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The results of a sweep on stdout. Columns: speed (m/s), restitution, its estimated error, impulse
 * (N s), sub-impacts, significant ones, end time (s), status. */
#ifndef PERCUSS_CLI_SWEEP_OUTPUT_H
#define PERCUSS_CLI_SWEEP_OUTPUT_H

#include <percuss/reply.h>

struct sweep_points {
    unsigned count;
    const double *speeds;
    const struct percuss_reply *replies;
};

void sweep_print_table(const struct sweep_points *points);

/* 17 significant digits, nan where undefined. */
void sweep_print_csv(const struct sweep_points *points);

/* {"points": [{the columns, "reply": the whole reply}]} */
void sweep_print_json(const struct sweep_points *points);

#endif
