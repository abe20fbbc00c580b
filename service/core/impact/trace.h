/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Time histories of an impact: contact forces and indentations, and how both bodies move at each
 * contact. Made from the logged forces by going through the exact motion of the modes once more. */
#ifndef PERCUSS_IMPACT_TRACE_H
#define PERCUSS_IMPACT_TRACE_H

#include "impact/force_log.h"
#include "impact/impact.h"

/* How the scene's rigid coupling and residual flexibility divide between the two bodies of each
 * contact; [0]: the body that the normal points to. Matrices are rows^2. NULL `w`: unknown. */
struct trace_sides {
    const double *w[2];        /* 1/kg; both together are the scene's */
    const double *residual[2]; /* m/N */
    const double *velocity[2]; /* [contact]: along the normal at the stated instant, m/s */
    const size_t *body[2];     /* [contact] */
};

/* One contact, arrays over the instants. Displacements are along the normal, zero for the rigid
 * bodies at the stated instant; those of the contact point without its local indentation. The
 * acceleration of a gap counts as the first body's. NAN where the sides are unknown. */
struct trace_contact {
    double *force, *indentation; /* N, m; 0 while open */
    double *gap, *gap_rate;      /* rigid */
    double *displacement[2], *velocity[2];
    double *tangential[2]; /* N, on the first body along both tangents; NULL without friction */
    double *slip[2];       /* m/s, of its point against the other's, with vibration; the same */
};

struct trace {
    size_t count, contacts;
    double *time; /* s from the stated instant, ascending */
    struct trace_contact *contact;
};

struct trace_task {
    const struct scene *scene;
    const struct force_log *log;
    const struct trace_sides *sides;
    double shift;    /* s; < 0: the motion starts before the stated instant */
    double end;      /* s */
    double max_work; /* see impact_settings; the histories end when it is spent */
    struct pace *pace;
};

/* Samples the motion of the log: contact phases in eighths of the solution's steps, flights by
 * the length of the phase before; not more than some thousand instants, the first one always.
 * Memory from the arena. PERCUSS_OK, PERCUSS_INTERNAL or PERCUSS_TIMEOUT. */
enum percuss_status trace_make(const struct trace_task *task, struct arena *arena,
                               struct trace *trace);

#endif
