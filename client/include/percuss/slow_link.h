/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The slow scale asks a percussd through libpercuss. */
#ifndef PERCUSS_SLOW_LINK_H
#define PERCUSS_SLOW_LINK_H

#include <percuss/percuss.h>
#include <percuss/slow_engine.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Belongs to the caller, and is kept with the client as long as the service is used. */
struct percuss_slow_link {
    struct percuss_client *client;
    double timeout;   /* s, for an answer, with all attempts */
    double reconnect; /* s, for a server to be found: at first, and whenever it was lost */
    bool connected;   /* the link's */
};

/* A link by a client (NULL: every question is refused), connected or not yet: 60 s for an answer,
 * 10 s for a server. Answers take milliseconds and a server is found within a second or two; the
 * limits are long because reaching one changes the results, which a loaded machine must not: they
 * only end a hang. */
PERCUSS_API struct percuss_slow_link percuss_slow_link_default(struct percuss_client *client);

/* The service for struct percuss_slow_config; by a link that is NULL it refuses every question. A
 * busy server is asked again; a server that was lost is looked for, and asked again. A question
 * that is not answered in time is given up. */
PERCUSS_API struct percuss_slow_service percuss_slow_link_service(struct percuss_slow_link *link);

#ifdef __cplusplus
}
#endif

#endif
