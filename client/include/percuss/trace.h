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
    double
        *force_tangential_1; /* N, on body a along both tangents; NULL without friction, as the */
    double *force_tangential_2; /* slip is */
    double *slip_1;             /* m/s, of body a's point against b's along both, with vibration */
    double *slip_2;
};

struct percuss_trace {
    size_t contact_count;
    struct percuss_contact_trace *contacts;
};

#ifdef __cplusplus
extern "C" {
#endif

struct percuss_client;

/* As percuss_solve, with the time histories of the answer (options.trace is set). `trace` is to be
 * freed with percuss_trace_free after OK; a refusal has none. */
PERCUSS_API enum percuss_result percuss_solve_traced(struct percuss_client *client,
                                                     const struct percuss_request *request,
                                                     double timeout, struct percuss_reply *reply,
                                                     struct percuss_trace *trace);

/* Releases the arrays and empties the trace; an empty trace is allowed. */
PERCUSS_API void percuss_trace_free(struct percuss_trace *trace);

#ifdef __cplusplus
}
#endif

#endif
