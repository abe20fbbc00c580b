/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Time histories of an impact as a picture and as comma-separated values. */
#ifndef PERCUSS_CLI_PLOT_IMPACT_H
#define PERCUSS_CLI_PLOT_IMPACT_H

#include <percuss/percuss.h>

#include "history.h"

/* What stands in one picture. */
struct impact_picture {
    const struct percuss_request *request;
    const struct percuss_reply *reply;
    const struct percuss_trace *trace;
    const struct history_motion *measured; /* laid over; NULL: nothing */
};

/* Displacement and velocity of both bodies with the contact force over time, of the contact with
 * the largest impulse. Exit code; complains. */
int plot_impact(const char *file, const struct impact_picture *picture);

/* All contacts: contact, time, force, indentation, gap, gap_rate, displacement_a, velocity_a,
 * displacement_b, velocity_b; "-" is standard output. Exit code; complains. */
int write_trace_csv(const char *file, const struct percuss_trace *trace, bool units);

#endif
