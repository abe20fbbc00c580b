/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The results of a sweep: a curve for every body B and contact model asked for. Columns: speed
 * (m/s), restitution, its estimated error by time steps and modes, impulse (N s), sub-impacts,
 * significant ones, end time (s), status; before them b and contact_model where there are several
 * curves; behind them, where friction or an angle was asked for, the angle (degrees) and what
 * friction did; at the end the restitution's total error, that of the models with it. */
#ifndef PERCUSS_CLI_SWEEP_OUTPUT_H
#define PERCUSS_CLI_SWEEP_OUTPUT_H

#include <argp.h>
#include <jansson.h>
#include <percuss/reply.h>
#include <stdio.h>

#include "impact.h"
#include "plot.h"
#include "scene.h"
#include "tally_output.h"

/* Measured restitutions, laid over the picture and the page of a sweep. */
enum { SWEEP_MEASURED_MOST = 8 };

struct sweep_measured {
    const char *file;
    char *b; /* on this body; NULL: on any */
    struct measured_set set;
};

struct sweep_measurements {
    size_t count;
    struct sweep_measured list[SWEEP_MEASURED_MOST];
    struct column_map columns; /* of all files */
};

/* Takes "FILE" or "ID=FILE". A fault ends the process through argp_error, here and below. */
void sweep_measured_add(struct sweep_measurements *measurements, const char *text,
                        struct argp_state *state);

/* Once the whole command line is known: reads the files, of bodies that are asked for, which a
 * picture is made to hold. */
void sweep_measured_read(struct sweep_measurements *measurements, const struct scene *scene,
                         bool is_drawn, struct argp_state *state);

void sweep_measured_free(struct sweep_measurements *measurements);

/* NAN where undefined. */
struct sweep_row {
    double speed, restitution, error, error_total, impulse;
    unsigned sub_impacts, significant;
    double end_time;
    const char *status;
    double angle, impulse_tangential[2], slip_after[2];
    double tangential_restitution, restitution_kinematic;
    const char *friction_state;
};

struct sweep_curve {
    const char *b;
    const char *contact_model;           /* asked for */
    struct sweep_row *rows;              /* one a speed */
    const struct percuss_reply *replies; /* likewise; empty where the row was read from a file */
    unsigned done;                       /* rows that are there, from the first on */
};

struct sweep_points {
    const char *a;
    const char *title;             /* of a picture of a single body B */
    unsigned count;                /* points of a curve */
    const double *speeds, *angles; /* of each; degrees */
    bool by_angle;                 /* these differ, else the speeds */
    bool logarithmic;              /* the axis of the speeds */
    bool askew;                    /* there are columns of the angle and of friction */
    double friction;               /* the coefficient that was given, else NAN */
    size_t curve_count;
    const struct sweep_curve *curves;
    const struct tally *warnings; /* of all points */
    size_t measured_count;
    const struct sweep_measured *measured;
    bool units; /* in the head of CSV */
};

/* Whether the curves are of several bodies B. */
bool sweep_bodies_differ(const struct sweep_points *points);

/* Of point i, by its reply. */
struct sweep_row sweep_row_of(const struct sweep_points *points, unsigned i,
                              const struct percuss_reply *reply);

/* Row i of curve k as a line of a table, with a heading before the first. */
void sweep_print_row(const struct sweep_points *points, size_t k, unsigned i);

/* A line of CSV, and the names above all: 17 significant digits, nan where undefined. Two rows are
 * the same to the last bit where their lines are. */
void sweep_csv_head(const struct sweep_points *points, FILE *file);
void sweep_csv_row(const struct sweep_points *points, size_t k, unsigned i, FILE *file);

/* On standard output, with the points that are there: */
/* {"points": [{the columns, "reply": the whole reply}], "warnings": [...]}; of several curves
 * {"curves": [{"b", "contact_model", "points"}], "warnings": [...]} */
void sweep_print_json(const struct sweep_points *points);

/* What the page of a sweep shows, but its command and a request; the caller releases it. NULL: out
 * of memory. */
json_t *sweep_to_page(const struct sweep_points *points);

/* The restitution against the speed, or the angle, with its total error, the number of
 * sub-impacts below; with friction the tangential impulse and restitution between them. Exit code;
 * complains. */
int sweep_plot(const struct plot_output *output, const struct sweep_points *points);

#endif
