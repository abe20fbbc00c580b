/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* libpercuss: ask a percussd what an impact does.
 *
 * percuss_client_create, percuss_client_connect, then percuss_solve as often as you like. Functions
 * return PERCUSS_RESULT_OK or say in percuss_error_text what went wrong. A refusal by the server is
 * an answer: OK, with the reason in reply.status and reply.message. Timeouts are seconds from the
 * call, >= 0, INFINITY allowed.
 *
 * Every function may be called from several threads on one client at once, except that
 * percuss_client_free must be the last; and one outstanding request is waited for by one thread.
 * The library starts no thread of its own besides those of Cyclone DDS and installs no signal
 * handler. Without CYCLONEDDS_URI in the environment it talks to this machine only.
 *
 * A program that loaded the library with dlopen may dlclose it when its clients are freed; code and
 * threads of DDS stay. */
#ifndef PERCUSS_PERCUSS_H
#define PERCUSS_PERCUSS_H

#include <percuss/ensemble.h>
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

struct percuss_client;

struct percuss_client_config {
    uint32_t domain; /* DDS domain, 0..230 */
    uint8_t id[16];  /* all zero: random. A kept id lets a restarted client repeat requests */
    uint64_t first_sequence; /* of the first request, > 0; a kept id goes on where it stopped */
    unsigned window;         /* most outstanding requests, 1..1024 */
    char server[PERCUSS_SERVER_ID_SIZE]; /* hexadecimal digits with which the id of the server to
                                            stay with begins, or PERCUSS_LEAST_LOADED; empty: any */
};

/* Of the servers there are, the one that has least to do. */
#define PERCUSS_LEAST_LOADED "least-loaded"

/* The domain that PERCUSS_DOMAIN in the environment names, or else 0; random id, first sequence 1,
 * window 256, the server that PERCUSS_SERVER names, or else any. Where PERCUSS_DOMAIN is no domain
 * and no other one is put in, percuss_client_create says so (INVALID_ARGUMENT). */
PERCUSS_API struct percuss_client_config percuss_client_config_default(void);

/* Makes a client; NULL config: the default. The caller frees it. INVALID_ARGUMENT, NO_MEMORY or
 * TRANSPORT leave *client NULL. */
PERCUSS_API enum percuss_result percuss_client_create(const struct percuss_client_config *config,
                                                      struct percuss_client **client);

/* The same by DDS Security, as the identity whose folder `security` is, made by percuss-keys.sh and
 * read here. NULL: the one that PERCUSS_SECURITY in the environment names, if it names one, as
 * percuss_client_create does. INVALID_ARGUMENT for a folder that is not whole. */
PERCUSS_API enum percuss_result
percuss_client_create_secured(const struct percuss_client_config *config, const char *security,
                              struct percuss_client **client);

/* The same among the servers of a partition, percussd's setting `partition`: it sees no others, and
 * they do not see it. NULL: the one that PERCUSS_PARTITION in the environment names, if it names
 * one, as the other two do; empty: the servers that are in none. */
PERCUSS_API enum percuss_result percuss_client_create_in(const struct percuss_client_config *config,
                                                         const char *partition,
                                                         const char *security,
                                                         struct percuss_client **client);

/* Whether the permissions of its identity let it only see what servers announce: it can be
 * connected to none. */
PERCUSS_API bool percuss_client_observes(const struct percuss_client *client);

/* Forgets what is outstanding and leaves the domain; NULL is allowed. */
PERCUSS_API void percuss_client_free(struct percuss_client *client);

/* Pings every 5 ms until a server answers, and stays with it: no other one is asked from then on.
 * Of those found within a moment (0.05 s after the first answer, 0.2 s where more are in sight) it
 * takes the one that has been up longest, or the one that the configuration names. Least loaded is,
 * by what each announces once a second, the one with the fewest requests waiting for each of its
 * workers, where a long computation counts as one request for each; with equals, the one up
 * longest; it is chosen here, once. NO_SERVER: none within the time, or none of that name; TIMEOUT:
 * one is there but has not answered; INVALID_ARGUMENT: several have ids that begin so;
 * INCOMPATIBLE: one is there, but after 2 s a quality of service still does not fit, named in
 * percuss_error_text.
 *
 * When that server goes, whatever waits for it returns NO_SERVER with its name: at once when it
 * ends, within 2 s after it was killed. To be called again then, and after a restart, since a
 * restarted server is another one; what was outstanding is lost then and may be submitted again as
 * it was.
 * But where another process takes its place under its id (percussd's `standby`), percuss_solve asks
 * that one, with the same sequence, and nothing is to be called. */
PERCUSS_API enum percuss_result percuss_client_connect(struct percuss_client *client,
                                                       double timeout);

/* The id of the server that the client stays with; false, and all zero, before the first one. */
PERCUSS_API bool percuss_client_server(struct percuss_client *client, uint8_t server[16]);

/* The client's id: the one configured or drawn. */
PERCUSS_API void percuss_client_id(const struct percuss_client *client, uint8_t id[16]);

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
 * others that are known to read requests. More than one, with different catalogue_revision: who
 * connects to any gets answers that depend on which. */
PERCUSS_API enum percuss_result percuss_servers(struct percuss_client *client, double timeout,
                                                struct percuss_server_list *list);

/* The catalogue of the connected server, for percuss_body_list_free. */
PERCUSS_API enum percuss_result percuss_bodies(struct percuss_client *client, double timeout,
                                               struct percuss_body_list *list);

/* Releases the arrays and empties the reply; an empty reply is allowed. */
PERCUSS_API void percuss_reply_free(struct percuss_reply *reply);

#ifdef __cplusplus
}
#endif

#endif
