/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The source of answers: the solver in this process, or a percussd. */
#ifndef PERCUSS_FMI_SOURCE_H
#define PERCUSS_FMI_SOURCE_H

#include <percuss/percuss.h>

#include "shared.h"

struct source {
    struct source_choice choice;
    struct percuss_client *client;
    struct percuss_body_list bodies;
};

/* The fault, in words. */
enum { SOURCE_MESSAGE_SIZE = 1280 };

/* Opens the chosen source; `resources` is the folder inside the FMU. NULL with a message. */
struct source *source_open(const struct source_choice *choice, const char *resources,
                           char message[SOURCE_MESSAGE_SIZE]);
void source_close(struct source *source);

/* Whether the catalogue has bodies A and B. False with a message. */
bool source_find(const struct source *source, const struct shared *shared,
                 const struct percuss_body *bodies[2], char message[SOURCE_MESSAGE_SIZE]);

/* Bodies A and B at their sites, A coming with that speed. False with a message. */
bool source_pair(const struct source *source, const struct shared *shared, double speed,
                 struct percuss_request *request, char message[SOURCE_MESSAGE_SIZE]);

/* Answers a request of one contact. `warning` is empty, or has the answer's warnings, a line each.
 * False with a message. */
bool source_ask(const struct source *source, const struct percuss_request *request,
                struct impact *impact, char warning[SOURCE_MESSAGE_SIZE],
                char message[SOURCE_MESSAGE_SIZE]);

#endif
