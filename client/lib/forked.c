/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "forked.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "library.h"

/* Of the process, as its threads are. */
static LIST_HEAD(, forked_entry) all = LIST_HEAD_INITIALIZER(all);
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* of all */
static pthread_once_t once = PTHREAD_ONCE_INIT;
static bool is_used, is_forked;

static enum percuss_result forked_refuse(void)
{
    return error_set(PERCUSS_RESULT_TRANSPORT,
                     "this process is the child of a fork() by one that used DDS, whose threads "
                     "are not in it: make clients after the fork only, or exec() a program");
}

static void free_memory(struct percuss_client *client)
{
    /* what it owns stays: DDS has it, or a thread of the parent was about to change it */
    free(client);
}

static bool has_none(const struct percuss_client *client)
{
    (void)client;
    return false;
}

static bool has_no_warning(const struct percuss_client *client, char text[PERCUSS_WARNING_SIZE])
{
    (void)client;
    text[0] = '\0';
    return false;
}

static bool has_no_server(struct percuss_client *client, uint8_t server[16])
{
    (void)client;
    memset(server, 0, 16);
    return false;
}

static enum percuss_result connect_nobody(struct percuss_client *client, double timeout)
{
    (void)client, (void)timeout;
    return forked_refuse();
}

static enum percuss_result ping_nobody(struct percuss_client *client, double timeout,
                                       double *round_trip)
{
    (void)client, (void)timeout;
    *round_trip = 0.0;
    return forked_refuse();
}

static enum percuss_result solve_nothing(struct percuss_client *client,
                                         const struct percuss_request *request, double timeout,
                                         struct percuss_reply *reply)
{
    (void)client, (void)request, (void)timeout;
    *reply = (struct percuss_reply){0};
    return forked_refuse();
}

static enum percuss_result trace_nothing(struct percuss_client *client,
                                         const struct percuss_request *request, double timeout,
                                         struct percuss_reply *reply, struct percuss_trace *trace)
{
    *trace = (struct percuss_trace){0};
    return solve_nothing(client, request, timeout, reply);
}

static enum percuss_result solve_no_batch(struct percuss_client *client,
                                          const struct percuss_request *requests, size_t count,
                                          double timeout, struct percuss_reply *replies)
{
    (void)client, (void)requests, (void)timeout;
    memset(replies, 0, count * sizeof *replies);
    return forked_refuse();
}

static enum percuss_result solve_no_ensemble(struct percuss_client *client,
                                             const struct percuss_ensemble_request *request,
                                             double timeout, percuss_progress_function *progress,
                                             void *context, struct percuss_ensemble_reply *reply)
{
    (void)client, (void)request, (void)timeout, (void)progress, (void)context;
    *reply = (struct percuss_ensemble_reply){0};
    return forked_refuse();
}

static enum percuss_result submit_nothing(struct percuss_client *client,
                                          const struct percuss_request *request, uint64_t *sequence)
{
    (void)client, (void)request;
    if (sequence)
        *sequence = 0;
    return forked_refuse();
}

static enum percuss_result wait_for_nothing(struct percuss_client *client, uint64_t sequence,
                                            double timeout, struct percuss_reply *reply)
{
    (void)sequence;
    return solve_nothing(client, NULL, timeout, reply);
}

static enum percuss_result poll_nothing(struct percuss_client *client, uint64_t sequence,
                                        struct percuss_reply *reply)
{
    (void)sequence;
    return solve_nothing(client, NULL, 0.0, reply);
}

static enum percuss_result cancel_nothing(struct percuss_client *client, uint64_t sequence)
{
    (void)client, (void)sequence;
    return forked_refuse();
}

static enum percuss_result no_servers(struct percuss_client *client, double timeout,
                                      struct percuss_server_list *list)
{
    (void)client, (void)timeout;
    *list = (struct percuss_server_list){0};
    return forked_refuse();
}

static enum percuss_result no_bodies(struct percuss_client *client, double timeout,
                                     struct percuss_body_list *list)
{
    (void)client, (void)timeout;
    *list = (struct percuss_body_list){0};
    return forked_refuse();
}

static enum percuss_result no_specimens(struct percuss_client *client, double timeout,
                                        struct percuss_specimen_list *list)
{
    (void)client, (void)timeout;
    *list = (struct percuss_specimen_list){0};
    return forked_refuse();
}

static enum percuss_result clear_nothing(struct percuss_client *client, const char *name,
                                         double timeout)
{
    (void)client, (void)name, (void)timeout;
    return forked_refuse();
}

static void watch_nothing(struct percuss_client *client, percuss_watch_function *watch,
                          void *context)
{
    (void)client, (void)watch, (void)context;
}

static const struct client_operations FORKED_OPERATIONS = {
    .error_text = error_last,
    .free = free_memory,
    .id = client_id,
    .observes = has_none,
    .server = has_no_server,
    .connect = connect_nobody,
    .ping = ping_nobody,
    .solve = solve_nothing,
    .solve_traced = trace_nothing,
    .solve_batch = solve_no_batch,
    .solve_ensemble = solve_no_ensemble,
    .submit = submit_nothing,
    .wait = wait_for_nothing,
    .poll = poll_nothing,
    .cancel = cancel_nothing,
    .servers = no_servers,
    .bodies = no_bodies,
    .specimens = no_specimens,
    .clear_specimen = clear_nothing,
    .watch = watch_nothing,
    .warning = has_no_warning,
};

/* No thread changes the list while the process is copied. */
static void before_fork(void)
{
    pthread_mutex_lock(&lock);
}

static void in_parent(void)
{
    pthread_mutex_unlock(&lock);
}

static void in_child(void)
{
    struct forked_entry *entry;
    LIST_FOREACH(entry, &all, others)
    *entry->operations = &FORKED_OPERATIONS;
    is_forked = is_used;
    pthread_mutex_unlock(&lock);
}

static void watch_forks(void)
{
    pthread_atfork(before_fork, in_parent, in_child);
}

enum percuss_result forked_check(void)
{
    pthread_once(&once, watch_forks);
    pthread_mutex_lock(&lock);
    bool forked = is_forked;
    is_used = true;
    pthread_mutex_unlock(&lock);
    return forked ? forked_refuse() : PERCUSS_RESULT_OK;
}

void forked_add(struct forked_entry *entry, const struct client_operations **operations)
{
    entry->operations = operations;
    pthread_mutex_lock(&lock);
    LIST_INSERT_HEAD(&all, entry, others);
    pthread_mutex_unlock(&lock);
}

void forked_remove(struct forked_entry *entry)
{
    pthread_mutex_lock(&lock);
    LIST_REMOVE(entry, others);
    pthread_mutex_unlock(&lock);
}
