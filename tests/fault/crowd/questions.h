/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The questions of a crowd, by what they cost the service. */
#ifndef PERCUSS_CROWD_QUESTIONS_H
#define PERCUSS_CROWD_QUESTIONS_H

#include <percuss/percuss.h>

enum question_kind {
    QUESTION_PING,
    QUESTION_CHEAP,    /* two spheres: a tenth of a millisecond */
    QUESTION_SLOW,     /* a soft beam: a sixth of a second, though nothing in the request says so */
    QUESTION_LONG,     /* by CVODE: a moment of the long lane */
    QUESTION_ENSEMBLE, /* as many samples as are asked for */
    QUESTION_COUNT
};

/* QUESTION_COUNT: no such kind. */
enum question_kind question_find(const char *name);
const char *question_name(enum question_kind kind);

/* The request of a kind that has one; each `variation` has a speed of its own. */
void question_fill(enum question_kind kind, unsigned long variation,
                   struct percuss_request *request);

/* Asks once and waits; the status of the answer, or the result of the call. `samples`: of an
 * ensemble. */
enum percuss_result question_ask(struct percuss_client *client, enum question_kind kind,
                                 unsigned long variation, unsigned long samples, double patience,
                                 enum percuss_status *status);

#endif
