/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Who gets what arrives at an endpoint. */
#ifndef PERCUSS_ENDPOINT_HANDLER_H
#define PERCUSS_ENDPOINT_HANDLER_H

#include "endpoint/reply_writers.h"

/* What happens with arriving samples, all in the thread of endpoint_run. The samples are borrowed.
 * `alone`: no other request came with this one, so there is time to answer it on the spot. */
struct endpoint_handler {
    void *context;
    void (*single)(void *context, const percuss_v1_Request *request, bool alone);
    void (*batch)(void *context, const percuss_v1_BatchRequest *batch);
    void (*ensemble)(void *context, const percuss_v1_EnsembleRequest *request);
    void (*clear)(void *context,
                  const char *specimen); /* of this server; see endpoint_open_dents */
    presence_function *presence;
    void (*alive)(void *context); /* after endpoint_nudge; NULL: nobody wants to know */
};

#endif
