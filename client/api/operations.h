/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The public functions that take a client leave their work to the library that made it: each client
 * begins with a pointer to a table of functions, so that a client of one library serves the
 * functions of another. A table only grows, at its end: its maker may be of another version. */
#ifndef PERCUSS_API_OPERATIONS_H
#define PERCUSS_API_OPERATIONS_H

#include <percuss/percuss.h>

/* As the functions percuss_... of these names say. */
struct client_operations {
    /* error text of this thread, as percuss_error_text returns it */
    const char *(*error_text)(void);
    void (*free)(struct percuss_client *client);
    void (*id)(const struct percuss_client *client, uint8_t id[16]);
    bool (*observes)(const struct percuss_client *client);
    bool (*server)(struct percuss_client *client, uint8_t server[16]);
    enum percuss_result (*connect)(struct percuss_client *client, double timeout);
    enum percuss_result (*ping)(struct percuss_client *client, double timeout, double *round_trip);
    enum percuss_result (*solve)(struct percuss_client *client,
                                 const struct percuss_request *request, double timeout,
                                 struct percuss_reply *reply);
    enum percuss_result (*solve_traced)(struct percuss_client *client,
                                        const struct percuss_request *request, double timeout,
                                        struct percuss_reply *reply, struct percuss_trace *trace);
    enum percuss_result (*solve_batch)(struct percuss_client *client,
                                       const struct percuss_request *requests, size_t count,
                                       double timeout, struct percuss_reply *replies);
    enum percuss_result (*solve_ensemble)(struct percuss_client *client,
                                          const struct percuss_ensemble_request *request,
                                          double timeout, percuss_progress_function *progress,
                                          void *context, struct percuss_ensemble_reply *reply);
    enum percuss_result (*submit)(struct percuss_client *client,
                                  const struct percuss_request *request, uint64_t *sequence);
    enum percuss_result (*wait)(struct percuss_client *client, uint64_t sequence, double timeout,
                                struct percuss_reply *reply);
    enum percuss_result (*poll)(struct percuss_client *client, uint64_t sequence,
                                struct percuss_reply *reply);
    enum percuss_result (*cancel)(struct percuss_client *client, uint64_t sequence);
    enum percuss_result (*servers)(struct percuss_client *client, double timeout,
                                   struct percuss_server_list *list);
    enum percuss_result (*bodies)(struct percuss_client *client, double timeout,
                                  struct percuss_body_list *list);
    enum percuss_result (*specimens)(struct percuss_client *client, double timeout,
                                     struct percuss_specimen_list *list);
    enum percuss_result (*clear_specimen)(struct percuss_client *client, const char *name,
                                          double timeout);
    void (*watch)(struct percuss_client *client, percuss_watch_function *watch, void *context);
    bool (*warning)(const struct percuss_client *client, char text[PERCUSS_WARNING_SIZE]);
};

#endif
