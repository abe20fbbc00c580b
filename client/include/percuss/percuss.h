/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* libpercuss: ask a percussd about an impact.
 *
 * percuss_client_create, percuss_client_connect, then percuss_solve as often as you like. Functions
 * return PERCUSS_RESULT_OK or leave the error in percuss_error_text. A refusal by the server is
 * an answer: OK, with the reason in reply.status and reply.message. Timeouts are seconds from the
 * call, >= 0, INFINITY allowed.
 *
 * A pointer may be NULL only where its function says so. Otherwise NULL is INVALID_ARGUMENT; a
 * function without a result does nothing then and returns false, 0, NAN or NULL. In both cases the
 * error text names the argument. All functions that free take NULL, and callbacks' contexts may be
 * NULL. An array of no elements may be NULL.
 *
 * Every function may be called from several threads on one client at once, except that
 * percuss_client_free must be the last; and one outstanding request is waited for by one thread.
 * The library starts no thread of its own besides those of Cyclone DDS and installs no signal
 * handler. Without CYCLONEDDS_URI in the environment it talks to this machine only.
 *
 * In the child of a fork() by a process that has made a client, every call with a client and
 * percuss_client_create give TRANSPORT, and percuss_client_free frees: the threads of Cyclone DDS
 * are in the parent only. Children make their clients where the parent has made none.
 *
 * A program that loaded the library with dlopen may dlclose it when its clients are freed; code and
 * threads of DDS stay. */
#ifndef PERCUSS_PERCUSS_H
#define PERCUSS_PERCUSS_H

#include <percuss/client.h>
#include <percuss/ensemble.h>
#include <percuss/quantity.h>
#include <percuss/reply.h>
#include <percuss/request.h>
#include <percuss/result.h>
#include <percuss/server.h>
#include <percuss/specimen.h>
#include <percuss/trace.h>
#include <percuss/watch.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Asks and waits. `reply` is overwritten; free it with percuss_reply_free after OK, any other
 * result leaves it empty. After TIMEOUT the server gives it up, unless request.sequence was set
 * before the first try: sent again, the question is then answered once. */
PERCUSS_API enum percuss_result percuss_solve(struct percuss_client *client,
                                              const struct percuss_request *request, double timeout,
                                              struct percuss_reply *reply);

/* Sends a request and returns its sequence (may be NULL); nothing of `request` is kept. WINDOW_FULL
 * until replies are collected or cancelled. Sending a sequence that is outstanding repeats it. */
PERCUSS_API enum percuss_result percuss_submit(struct percuss_client *client,
                                               const struct percuss_request *request,
                                               uint64_t *sequence);

/* Waits for the reply of that sequence, or with 0 for any reply of percuss_submit (reply.sequence
 * says which). OK hands the reply over and forgets the request; after TIMEOUT it stays outstanding.
 * UNKNOWN_SEQUENCE: never sent, collected, cancelled or waited for by another thread; with 0:
 * nothing is outstanding. */
PERCUSS_API enum percuss_result percuss_wait(struct percuss_client *client, uint64_t sequence,
                                             double timeout, struct percuss_reply *reply);

/* As percuss_wait, without waiting: PENDING if the reply is not there. */
PERCUSS_API enum percuss_result percuss_poll(struct percuss_client *client, uint64_t sequence,
                                             struct percuss_reply *reply);

/* Forgets an outstanding request; its reply is dropped, and the server gives it up: sent again it
 * begins anew. UNKNOWN_SEQUENCE as for percuss_wait. */
PERCUSS_API enum percuss_result percuss_cancel(struct percuss_client *client, uint64_t sequence);

/* Asks up to PERCUSS_MAX_BATCH questions in one sample and waits for all: replies[i] answers
 * requests[i], their sequences are drawn by the client. OK: all `count` replies are to be freed; a
 * batch refused as a whole gives every reply that status. Lists up to 16 sub-impacts a contact. */
PERCUSS_API enum percuss_result percuss_solve_batch(struct percuss_client *client,
                                                    const struct percuss_request *requests,
                                                    size_t count, double timeout,
                                                    struct percuss_reply *replies);

/* Sends an empty request and returns the time until it is answered, s. */
PERCUSS_API enum percuss_result percuss_ping(struct percuss_client *client, double timeout,
                                             double *round_trip);

/* The servers of the domain, longest up first, for percuss_server_list_free; need not be connected.
 * Waits until the connected server, or else any, has announced itself, and then up to 0.2 s for
 * others that are known to read requests. More than one, with different catalogue_revision: a
 * client that connects to any gets answers that depend on the choice. */
PERCUSS_API enum percuss_result percuss_servers(struct percuss_client *client, double timeout,
                                                struct percuss_server_list *list);

/* The catalogue of the connected server, for percuss_body_list_free; to a client that only
 * observes, of the server up longest, or of the one that its configuration names. */
PERCUSS_API enum percuss_result percuss_bodies(struct percuss_client *client, double timeout,
                                               struct percuss_body_list *list);

/* Releases the arrays and empties the reply; an empty reply is allowed. */
PERCUSS_API void percuss_reply_free(struct percuss_reply *reply);

#ifdef __cplusplus
}
#endif

#endif
