/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A watch over a waiting call: to end it, or to show its time. */
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
 * no watch. A call that is given up returns CANCELLED, and the server is told that no call waits
 * for it; but the request of percuss_wait stays outstanding, see percuss_cancel. A client has one
 * watch: the one set last, for the thread that has set it. */
PERCUSS_API void percuss_client_watch(struct percuss_client *client, percuss_watch_function *watch,
                                      void *context);

#ifdef __cplusplus
}
#endif

#endif
