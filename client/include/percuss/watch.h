/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Whoever looks on while a call waits: to end it, or to tell how long it takes. */
#ifndef PERCUSS_WATCH_H
#define PERCUSS_WATCH_H

#include <percuss/result.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

struct percuss_client;

/* Asked some ten times a second while a call waits, in the calling thread; a call that is answered
 * sooner does not ask. False gives it up. Of a client that asks a server it may call
 * percuss_servers; no other function that takes the client. */
typedef bool percuss_watch_function(void *context);

/* From now on `watch` is asked while calls of this thread on that client wait for an answer; NULL:
 * nobody is. What is given up returns CANCELLED, and the server is told that nobody waits for it;
 * but what percuss_wait waits for stays outstanding, see percuss_cancel. A client has one watch:
 * the one set last, for the thread that has set it. */
PERCUSS_API void percuss_client_watch(struct percuss_client *client, percuss_watch_function *watch,
                                      void *context);

#ifdef __cplusplus
}
#endif

#endif
