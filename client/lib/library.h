/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The public functions (api/operations.h) for a client of this library. */
#ifndef PERCUSS_LIB_LIBRARY_H
#define PERCUSS_LIB_LIBRARY_H

#include "operations.h"

extern const struct client_operations LIBRARY_OPERATIONS;

void client_free(struct percuss_client *client);
void client_id(const struct percuss_client *client, uint8_t id[16]);
bool client_observes(const struct percuss_client *client);
bool client_warning(const struct percuss_client *client, char text[PERCUSS_WARNING_SIZE]);
bool client_server(struct percuss_client *client, uint8_t server[16]);
enum percuss_result connect_find(struct percuss_client *client, double timeout);
enum percuss_result connect_ping(struct percuss_client *client, double timeout, double *round_trip);
enum percuss_result exchange_ask(struct percuss_client *client,
                                 const struct percuss_request *request, double timeout,
                                 struct percuss_reply *reply);
enum percuss_result solve_traced(struct percuss_client *client,
                                 const struct percuss_request *request, double timeout,
                                 struct percuss_reply *reply, struct percuss_trace *trace);
enum percuss_result solve_batch(struct percuss_client *client,
                                const struct percuss_request *requests, size_t count,
                                double timeout, struct percuss_reply *replies);
enum percuss_result solve_ensemble(struct percuss_client *client,
                                   const struct percuss_ensemble_request *request, double timeout,
                                   percuss_progress_function *progress, void *context,
                                   struct percuss_ensemble_reply *reply);
enum percuss_result exchange_submit(struct percuss_client *client,
                                    const struct percuss_request *request, uint64_t *sequence);
enum percuss_result exchange_wait(struct percuss_client *client, uint64_t sequence, double timeout,
                                  struct percuss_reply *reply);
enum percuss_result exchange_poll(struct percuss_client *client, uint64_t sequence,
                                  struct percuss_reply *reply);
enum percuss_result exchange_cancel(struct percuss_client *client, uint64_t sequence);
enum percuss_result servers_list(struct percuss_client *client, double timeout,
                                 struct percuss_server_list *list);
enum percuss_result bodies_list(struct percuss_client *client, double timeout,
                                struct percuss_body_list *list);
enum percuss_result specimens_list(struct percuss_client *client, double timeout,
                                   struct percuss_specimen_list *list);
enum percuss_result specimens_clear(struct percuss_client *client, const char *name,
                                    double timeout);
void client_watch(struct percuss_client *client, percuss_watch_function *watch, void *context);

#endif
