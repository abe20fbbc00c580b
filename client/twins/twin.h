/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Simulated twins of measured impacts. */
#ifndef PERCUSS_TWINS_TWIN_H
#define PERCUSS_TWINS_TWIN_H

#include <percuss/percuss.h>

#include "impact.h"

/* The server's answer to an impact, in the terms of struct measured_impact. */
struct twin {
    enum percuss_status status;
    struct measured_impact impact;
    double inverse_mass; /* effective, 1/kg */
    double error_total;  /* of the restitution; NAN: not known */
    bool a_is_rigid, b_is_rigid;
};

/* The client to ask, and the scene. */
struct twin_question {
    struct percuss_client *client;
    struct percuss_pair pair; /* its speed is that of each impact; its place, where one has none */
    struct percuss_options options;
    double timeout; /* s for 64 impacts */
};

/* A parameter of one of the two bodies that differs from the catalogue's. */
struct twin_override {
    unsigned body; /* 0: A, 1: B */
    struct percuss_override override;
};

/* The differences of the twins from the measured scene. */
struct twin_changes {
    const struct twin_override *overrides;
    size_t count;
    double faster; /* all speeds times this */
};

/* Told of every answer, in order. False: no more of them are wanted. */
struct twin_listener {
    bool (*take)(void *context, const struct percuss_request *request,
                 const struct percuss_reply *reply, size_t index);
    void *context;
};

/* Asks for the twin of every impact, in batches; a busy server is asked again for some time.
 * PENDING: the listener had enough. NO_MEMORY leaves no text behind. */
enum percuss_result twin_ask(const struct twin_question *question, const struct measured_set *set,
                             const struct twin_changes *changes,
                             const struct twin_listener *listener, struct twin *list);

/* Completes the measured impacts with the masses that the server knows. Returns the number of
 * impacts completed: fewer than all where that one's momentum is of a body that vibrates, or is
 * held, which does not tell the impulse. */
size_t twin_complete(const struct twin_question *question, struct measured_set *set,
                     const struct twin *list);

#endif
