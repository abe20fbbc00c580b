/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The public functions that take a client. */

#include <string.h>

#include "error.h"
#include "operations.h"

/* Whatever a library puts into its clients, this comes first. */
static const struct client_operations *operations_of(const struct percuss_client *client)
{
    return *(const struct client_operations *const *)(const void *)client;
}

/* Takes over the error text of another library. */
static enum percuss_result report(const struct percuss_client *client, enum percuss_result result)
{
    const char *(*error_text)(void) = operations_of(client)->error_text;
    if (result != PERCUSS_RESULT_OK && error_text != error_last)
        error_copy(error_text());
    return result;
}

/* The end of a call without a pointer that it needs: its output is empty. */
static enum percuss_result dispatch_refuse(void *output, size_t size)
{
    if (output)
        memset(output, 0, size);
    return PERCUSS_RESULT_INVALID_ARGUMENT;
}

void percuss_client_free(struct percuss_client *client)
{
    if (client)
        operations_of(client)->free(client);
}

void percuss_client_id(const struct percuss_client *client, uint8_t id[16])
{
    if (ERROR_NULL(client, id))
        dispatch_refuse(id, 16);
    else
        operations_of(client)->id(client, id);
}

bool percuss_client_observes(const struct percuss_client *client)
{
    return !ERROR_NULL(client) && operations_of(client)->observes(client);
}

bool percuss_client_warning(const struct percuss_client *client, char text[PERCUSS_WARNING_SIZE])
{
    if (ERROR_NULL(client, text)) {
        dispatch_refuse(text, 1);
        return false;
    }
    return operations_of(client)->warning(client, text);
}

bool percuss_client_server(struct percuss_client *client, uint8_t server[16])
{
    if (ERROR_NULL(client, server)) {
        dispatch_refuse(server, 16);
        return false;
    }
    return operations_of(client)->server(client, server);
}

enum percuss_result percuss_client_connect(struct percuss_client *client, double timeout)
{
    if (ERROR_NULL(client))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    return report(client, operations_of(client)->connect(client, timeout));
}

enum percuss_result percuss_ping(struct percuss_client *client, double timeout, double *round_trip)
{
    if (ERROR_NULL(client, round_trip))
        return dispatch_refuse(round_trip, sizeof *round_trip);
    return report(client, operations_of(client)->ping(client, timeout, round_trip));
}

enum percuss_result percuss_solve(struct percuss_client *client,
                                  const struct percuss_request *request, double timeout,
                                  struct percuss_reply *reply)
{
    if (ERROR_NULL(client, request, reply))
        return dispatch_refuse(reply, sizeof *reply);
    return report(client, operations_of(client)->solve(client, request, timeout, reply));
}

enum percuss_result percuss_solve_traced(struct percuss_client *client,
                                         const struct percuss_request *request, double timeout,
                                         struct percuss_reply *reply, struct percuss_trace *trace)
{
    if (ERROR_NULL(client, request, reply, trace)) {
        dispatch_refuse(trace, sizeof *trace);
        return dispatch_refuse(reply, sizeof *reply);
    }
    return report(client,
                  operations_of(client)->solve_traced(client, request, timeout, reply, trace));
}

enum percuss_result percuss_solve_batch(struct percuss_client *client,
                                        const struct percuss_request *requests, size_t count,
                                        double timeout, struct percuss_reply *replies)
{
    if (ERROR_NULL(client, requests, replies))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    return report(client,
                  operations_of(client)->solve_batch(client, requests, count, timeout, replies));
}

enum percuss_result percuss_solve_ensemble(struct percuss_client *client,
                                           const struct percuss_ensemble_request *request,
                                           double timeout, percuss_progress_function *progress,
                                           void *context, struct percuss_ensemble_reply *reply)
{
    if (ERROR_NULL(client, request, reply))
        return dispatch_refuse(reply, sizeof *reply);
    return report(client, operations_of(client)->solve_ensemble(client, request, timeout, progress,
                                                                context, reply));
}

enum percuss_result percuss_submit(struct percuss_client *client,
                                   const struct percuss_request *request, uint64_t *sequence)
{
    if (ERROR_NULL(client, request))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    return report(client, operations_of(client)->submit(client, request, sequence));
}

enum percuss_result percuss_wait(struct percuss_client *client, uint64_t sequence, double timeout,
                                 struct percuss_reply *reply)
{
    if (ERROR_NULL(client, reply))
        return dispatch_refuse(reply, sizeof *reply);
    return report(client, operations_of(client)->wait(client, sequence, timeout, reply));
}

enum percuss_result percuss_poll(struct percuss_client *client, uint64_t sequence,
                                 struct percuss_reply *reply)
{
    if (ERROR_NULL(client, reply))
        return dispatch_refuse(reply, sizeof *reply);
    return report(client, operations_of(client)->poll(client, sequence, reply));
}

enum percuss_result percuss_cancel(struct percuss_client *client, uint64_t sequence)
{
    if (ERROR_NULL(client))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    return report(client, operations_of(client)->cancel(client, sequence));
}

enum percuss_result percuss_servers(struct percuss_client *client, double timeout,
                                    struct percuss_server_list *list)
{
    if (ERROR_NULL(client, list))
        return dispatch_refuse(list, sizeof *list);
    return report(client, operations_of(client)->servers(client, timeout, list));
}

enum percuss_result percuss_bodies(struct percuss_client *client, double timeout,
                                   struct percuss_body_list *list)
{
    if (ERROR_NULL(client, list))
        return dispatch_refuse(list, sizeof *list);
    return report(client, operations_of(client)->bodies(client, timeout, list));
}

enum percuss_result percuss_specimens(struct percuss_client *client, double timeout,
                                      struct percuss_specimen_list *list)
{
    if (ERROR_NULL(client, list))
        return dispatch_refuse(list, sizeof *list);
    return report(client, operations_of(client)->specimens(client, timeout, list));
}

enum percuss_result percuss_clear_specimen(struct percuss_client *client, const char *name,
                                           double timeout)
{
    if (ERROR_NULL(client, name))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    return report(client, operations_of(client)->clear_specimen(client, name, timeout));
}

void percuss_client_watch(struct percuss_client *client, percuss_watch_function *watch,
                          void *context)
{
    if (!ERROR_NULL(client))
        operations_of(client)->watch(client, watch, context);
}
