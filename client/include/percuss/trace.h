/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Time histories of an impact. SI units; arrays belong to the trace until percuss_trace_free. */
#ifndef PERCUSS_TRACE_H
#define PERCUSS_TRACE_H

#include <percuss/reply.h>

/* One contact; arrays of `count`, the instants ascend: dense in contacts, enough in flights. */
struct percuss_contact_trace {
    size_t count;
    double *time;           /* s from the stated instant */
    double *force;          /* N */
    double *indentation;    /* m; 0 while open */
    double *gap, *gap_rate; /* of the rigid bodies */
    double *displacement_a; /* m, of body a at the contact along the normal, since the stated */
    double *velocity_a;     /* instant; with vibration, without the local indentation. NAN */
    double *displacement_b; /* where the request brought its own delassus */
    double *velocity_b;
};

struct percuss_trace {
    size_t contact_count;
    struct percuss_contact_trace *contacts;
};

#endif
