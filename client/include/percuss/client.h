/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A client: its identity, and the server that it stays with. Included by percuss.h. */
#ifndef PERCUSS_CLIENT_H
#define PERCUSS_CLIENT_H

#include <percuss/result.h>
#include <percuss/server.h>
#include <stdbool.h>
#include <stdint.h>

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

/* The same by DDS Security, as the identity in the folder `security`, made by percuss-keys.sh and
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

/* Whether the permissions of its identity let it only see announcements of servers: it can be
 * connected to none. */
PERCUSS_API bool percuss_client_observes(const struct percuss_client *client);

enum { PERCUSS_WARNING_SIZE = 512 };

/* Whether its identity is about to stand in its way: `text` says that it ends within 30 days, or
 * has ended since the client was made, as "security: DIR/cert.pem: ends in 3 days, on 2026-11-20:
 * make the folder anew before". False, and empty: not, or there is none. */
PERCUSS_API bool percuss_client_warning(const struct percuss_client *client,
                                        char text[PERCUSS_WARNING_SIZE]);

/* Forgets outstanding requests and leaves the domain; NULL is allowed. */
PERCUSS_API void percuss_client_free(struct percuss_client *client);

/* Pings every 5 ms until a server answers, and stays with it: no other one is asked from then on.
 * Of those found within a moment (0.05 s after the first answer, 0.2 s where more are in sight) it
 * takes the one that has been up longest, or the one that the configuration names. Least loaded is,
 * by the announcements of each once a second, the one with the fewest requests waiting for each of
 * its workers, where a long computation counts as one request for each; with equals, the one up
 * longest; it is chosen here, once. NO_SERVER: none within the time, or none of that name; TIMEOUT:
 * one is there but has not answered; INVALID_ARGUMENT: several have ids that begin so;
 * INCOMPATIBLE: one is there, but after 2 s a quality of service still does not fit, named in
 * percuss_error_text. It prints nothing: percuss_client_watch lets a program say that it looks.
 *
 * When that server goes, each waiting call returns NO_SERVER with its name: at once when it
 * ends, within 2 s after it was killed. To be called again then, and after a restart, since a
 * restarted server is another one; outstanding requests are lost then and may be submitted again as
 * they were. But where another process takes its place under its id (percussd's `standby`),
 * percuss_solve asks that one, with the same sequence, and nothing is to be called. */
PERCUSS_API enum percuss_result percuss_client_connect(struct percuss_client *client,
                                                       double timeout);

/* The id of the server that the client stays with; false, and all zero, before the first one. */
PERCUSS_API bool percuss_client_server(struct percuss_client *client, uint8_t server[16]);

/* The client's id: the one configured or drawn. */
PERCUSS_API void percuss_client_id(const struct percuss_client *client, uint8_t id[16]);

#ifdef __cplusplus
}
#endif

#endif
