/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Reading. There is no reader thread: a thread that waits for a reply waits for arrivals itself and
 * takes it, so that a reply costs one hand-over (Cyclone's receive thread to the caller) and
 * not two. Only one thread at a time does so, the leader; it files what arrives for the others,
 * which sleep on the client's condition variable, and when its own wait is over another takes its
 * place. */
#ifndef PERCUSS_LIB_RECEIVE_H
#define PERCUSS_LIB_RECEIVE_H

#include "client.h"

typedef bool receive_condition(const struct percuss_client *client, const void *subject);

/* Receives until `done` or the deadline; looks at least once at arrived samples. The lock is held
 * at entry and return, and whenever `done` is called. OK, TIMEOUT, TRANSPORT, CANCELLED by the
 * watch, or NO_SERVER: the server of a connected client has gone, or has a successor, which does
 * not know the request. */
enum percuss_result receive_until(struct percuss_client *client, receive_condition *done,
                                  const void *subject, double deadline);

/* The same for a client without its server, which has gone: for its successor. */
enum percuss_result receive_regardless(struct percuss_client *client, receive_condition *done,
                                       const void *subject, double deadline);

/* Calls the watch, if it is time, without the lock, which is held otherwise. False: it gives the
 * call up. */
bool receive_is_watched_on(struct percuss_client *client, const struct watching *watching,
                           double *next);

/* Looks whether the server still writes to us; the lock is held. */
void receive_note_loss(struct percuss_client *client);

#endif
