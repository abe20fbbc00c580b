/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The public functions (api/operations.h) for a client of this library. */
#ifndef PERCUSS_LOCAL_LIBRARY_H
#define PERCUSS_LOCAL_LIBRARY_H

#include "operations.h"

extern const struct client_operations LIBRARY_OPERATIONS;

void local_free(struct percuss_client *client);
void local_id(const struct percuss_client *client, uint8_t id[16]);
bool local_observes(const struct percuss_client *client);
bool local_warning(const struct percuss_client *client, char text[PERCUSS_WARNING_SIZE]);
bool local_server(struct percuss_client *client, uint8_t server[16]);
enum percuss_result local_connect(struct percuss_client *client, double timeout);
enum percuss_result local_ping(struct percuss_client *client, double timeout, double *round_trip);
enum percuss_result local_solve(struct percuss_client *client,
                                const struct percuss_request *request, double timeout,
                                struct percuss_reply *reply);
enum percuss_result local_solve_traced(struct percuss_client *client,
                                       const struct percuss_request *request, double timeout,
                                       struct percuss_reply *reply, struct percuss_trace *trace);
enum percuss_result local_solve_batch(struct percuss_client *client,
                                      const struct percuss_request *requests, size_t count,
                                      double timeout, struct percuss_reply *replies);
enum percuss_result local_solve_ensemble(struct percuss_client *client,
                                         const struct percuss_ensemble_request *request,
                                         double timeout, percuss_progress_function *progress,
                                         void *context, struct percuss_ensemble_reply *reply);
enum percuss_result local_submit(struct percuss_client *client,
                                 const struct percuss_request *request, uint64_t *sequence);
enum percuss_result local_wait(struct percuss_client *client, uint64_t sequence, double timeout,
                               struct percuss_reply *reply);
enum percuss_result local_poll(struct percuss_client *client, uint64_t sequence,
                               struct percuss_reply *reply);
enum percuss_result local_cancel(struct percuss_client *client, uint64_t sequence);
enum percuss_result local_servers(struct percuss_client *client, double timeout,
                                  struct percuss_server_list *list);
enum percuss_result local_bodies(struct percuss_client *client, double timeout,
                                 struct percuss_body_list *list);
enum percuss_result local_specimens(struct percuss_client *client, double timeout,
                                    struct percuss_specimen_list *list);
enum percuss_result local_clear_specimen(struct percuss_client *client, const char *name,
                                         double timeout);
void local_watch(struct percuss_client *client, percuss_watch_function *watch, void *context);

#endif
