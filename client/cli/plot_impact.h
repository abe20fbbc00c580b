/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Time histories of impacts as a picture and as comma-separated values. */
#ifndef PERCUSS_CLI_PLOT_IMPACT_H
#define PERCUSS_CLI_PLOT_IMPACT_H

#include <percuss/percuss.h>

#include "history_motion.h"
#include "plot.h"

/* One answer, with histories. */
struct impact_run {
    struct percuss_request request;
    struct percuss_reply reply;
    struct percuss_trace trace;
};

/* A measured history, and its file. */
struct impact_measured {
    struct history_motion motion;
    const char *file;
};

/* One picture: beside each other `speed_count` impacts, each by `model_count` contact models over
 * each other. */
struct impact_picture {
    size_t speed_count, model_count;
    const struct impact_run *runs; /* of the first speed all models, then of the next */
    const double *speeds;          /* m/s; NULL: not told */
    const char *title;             /* NULL: the names of the bodies */
    size_t measured_count;         /* laid over the first speeds */
    const struct impact_measured *measured;
};

/* Displacement and velocity of both bodies and the contact force over time, of the contact with the
 * largest impulse. Exit code; complains. */
int plot_impact(const struct plot_output *output, const struct impact_picture *picture);

/* All contacts: contact, time, force, indentation, gap, gap_rate, displacement_a, velocity_a,
 * displacement_b, velocity_b; where any has friction force_tangential_1, force_tangential_2,
 * slip_1, slip_2, nan of one without. "-" is standard output. Exit code; complains. */
int write_trace_csv(const char *file, const struct percuss_trace *trace, bool units);

#endif
