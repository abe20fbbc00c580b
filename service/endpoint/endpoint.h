/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The service's place in the DDS domain: reads requests, writes replies, announces the server and
 * its bodies. */
#ifndef PERCUSS_ENDPOINT_ENDPOINT_H
#define PERCUSS_ENDPOINT_ENDPOINT_H

#include "base/fault.h"
#include "contact/body_state.h"
#include "endpoint/reply_writers.h"
#include "model/body.h"
#include "wire.h"

struct endpoint;

/* Functions for arriving samples, all called in the thread of endpoint_run. The samples are
 * borrowed. `alone`: no other request came with this one, so there is time to answer it on the
 * spot. */
struct endpoint_handler {
    void *context;
    void (*single)(void *context, const percuss_v1_Request *request, bool alone);
    void (*batch)(void *context, const percuss_v1_BatchRequest *batch);
    void (*ensemble)(void *context, const percuss_v1_EnsembleRequest *request);
    void (*clear)(void *context,
                  const char *specimen); /* of this server; see endpoint_open_dents */
    presence_function *presence;
    void (*alive)(void *context); /* after endpoint_nudge; may be NULL */
};

/* Joins the domain: when this returns, requests are received. `partition` (borrowed): for clients
 * in it alone; empty: for clients in none. `security`: the folder of its identity
 * (wire_security.h); NULL: without DDS Security. Replies are for at most so many `clients`.
 * `server`: the id to answer under; NULL: it is drawn. NULL with a fault if DDS refuses. */
struct endpoint *endpoint_create(uint32_t domain, const char *partition, const char *security,
                                 size_t clients, const uint8_t *server, struct fault *fault);

/* Whether that folder has the files of an identity, without joining. False with a fault. */
bool endpoint_check_security(const char *security, struct fault *fault);

/* Leaves the domain. No other thread may be using the endpoint. */
void endpoint_free(struct endpoint *endpoint);

/* 16 octets that name this server. */
const uint8_t *endpoint_server(const struct endpoint *endpoint);

/* Reads until endpoint_stop, which any thread may call. */
void endpoint_run(struct endpoint *endpoint, const struct endpoint_handler *handler);
void endpoint_stop(struct endpoint *endpoint);

/* Wakes the thread of endpoint_run, which then calls handler->alive. Any thread. */
void endpoint_nudge(struct endpoint *endpoint);

/* Wakes threads of DDS that sleep until a time that was set back (wire_clock.h). Any thread. */
void endpoint_rouse(struct endpoint *endpoint);

/* Writes the answer to its client. Thread-safe. */
enum delivery endpoint_reply(struct endpoint *endpoint, const uint8_t client[16],
                             const struct answer *answer);

/* Writes a sample to a client, see reply_writers_publish. Thread-safe. */
enum delivery endpoint_publish(struct endpoint *endpoint, const uint8_t client[16],
                               unsigned channel, const void *sample, unsigned patience);

/* Requests since the last call that bore the id of another client and were ignored. Thread-safe. */
unsigned long long endpoint_strange(struct endpoint *endpoint);

/* Waits until the clients have all written samples, at most `seconds`. */
void endpoint_flush(struct endpoint *endpoint, double seconds);

/* Number of clients that read replies. Thread-safe. */
size_t endpoint_clients(struct endpoint *endpoint);

/* Announces the bodies of `set` and withdraws those that only `before` (may be NULL) has. One
 * thread at a time. False: not all were announced. */
bool endpoint_announce_bodies(struct endpoint *endpoint, const struct body_set *set,
                              const struct body_set *before);

/* Opens the topic of specimens; before endpoint_run. False with a fault. */
bool endpoint_open_dents(struct endpoint *endpoint, struct fault *fault);

/* An announcement of a specimen. */
struct dents_notice {
    const char *specimen, *body;
    uint64_t impacts;
    const struct body_state *state; /* NULL: no dents */
};

/* Announces a specimen, or that it is no more. Thread-safe. */
void endpoint_announce_dents(struct endpoint *endpoint, const struct dents_notice *notice);
void endpoint_withdraw_dents(struct endpoint *endpoint, const char *specimen);

/* Borrowed during the visit. */
typedef void server_visitor(void *context, const percuss_v1_ServerStatus *status);

/* Shows the other servers of the domain. One thread at a time. */
void endpoint_visit_servers(struct endpoint *endpoint, server_visitor *visitor, void *context);

/* Announces the state of the server; fills status->server. Thread-safe. */
void endpoint_announce_status(struct endpoint *endpoint, percuss_v1_ServerStatus *status);

#endif
