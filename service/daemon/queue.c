/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/queue.h"

#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#include "exchange/key_map.h"
#include "exchange/reply_store.h"

void job_init(struct job *job, const struct job_kind *kind, size_t items, struct digest owner)
{
    job->kind = kind;
    job->items = items;
    job->owner = owner;
    job->next = 0;
    atomic_init(&job->left, items);
}

/* An item is settled. */
static enum job_end job_settle(struct job *job)
{
    if (atomic_fetch_sub(&job->left, 1) > 1)
        return JOB_GOES_ON;
    job->kind->report(job);
    return JOB_ENDED;
}

enum job_end job_run(struct job *job, size_t item, struct responder *responder)
{
    return job->kind->run(job, item, responder) ? job_settle(job) : JOB_LONG;
}

static enum job_end job_refuse_item(struct job *job, size_t item)
{
    job->kind->refuse(job, item);
    return job_settle(job);
}

void job_refuse(struct job *job)
{
    for (size_t i = 0; i < job->items; i++)
        job_refuse_item(job, i);
    job->kind->release(job);
}

/* After an item that took long, so many more of its client are passed on untried: a trial of each
 * costs other clients the time until it is given up. */
enum { EXPECTED_CLIENTS = 64, UNTRIED = 16 };

/* The queue of a client that has jobs that wait or are being done. */
struct client_queue {
    struct key_node node; /* key: the owner of its jobs */
    TAILQ_HEAD(waiting_jobs, job) jobs;
    size_t waiting;                 /* jobs */
    size_t running;                 /* items handed out and not yet done */
    unsigned untried;               /* items to be passed on */
    TAILQ_ENTRY(client_queue) turn; /* while jobs wait */
};

struct queue {
    pthread_mutex_t lock;
    pthread_cond_t filled, drained;
    size_t capacity, share;
    size_t length;  /* jobs that wait */
    size_t running; /* items handed out and not yet done */
    bool closed;
    struct key_map clients;
    TAILQ_HEAD(client_turns, client_queue)
    turns;                          /* clients with waiting jobs; the first is served next */
    LIST_HEAD(live_jobs, job) live; /* jobs that wait or are being done */
};

struct queue *queue_create(size_t capacity, size_t share)
{
    struct queue *queue = calloc(1, sizeof *queue);
    if (!queue)
        return NULL;
    if (!key_map_create(&queue->clients, EXPECTED_CLIENTS)) {
        free(queue);
        return NULL;
    }
    queue->capacity = capacity;
    queue->share = share;
    TAILQ_INIT(&queue->turns);
    LIST_INIT(&queue->live);
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&queue->lock, NULL);
    pthread_cond_init(&queue->filled, NULL);
    pthread_cond_init(&queue->drained, &monotonic);
    pthread_condattr_destroy(&monotonic);
    return queue;
}

static struct client_queue *client_queue_find(const struct queue *queue, struct digest owner)
{
    struct key_node *node = key_map_find(&queue->clients, owner);
    return node ? KEY_MAP_OWNER(node, struct client_queue, node) : NULL;
}

/* NULL: out of memory. */
static struct client_queue *client_queue_open(struct queue *queue, struct digest owner)
{
    struct client_queue *client = client_queue_find(queue, owner);
    if (client)
        return client;
    client = calloc(1, sizeof *client);
    if (!client)
        return NULL;
    client->node.key = owner;
    TAILQ_INIT(&client->jobs);
    key_map_insert(&queue->clients, &client->node);
    return client;
}

static void client_queue_drop_if_idle(struct queue *queue, struct client_queue *client)
{
    if (client->waiting > 0 || client->running > 0)
        return;
    key_map_remove(&queue->clients, &client->node);
    free(client);
}

void queue_free(struct queue *queue)
{
    if (!queue)
        return;
    key_map_release(&queue->clients);
    pthread_cond_destroy(&queue->drained);
    pthread_cond_destroy(&queue->filled);
    pthread_mutex_destroy(&queue->lock);
    free(queue);
}

/* The job waits, after all others of its client. */
static void client_queue_push(struct queue *queue, struct client_queue *client, struct job *job)
{
    TAILQ_INSERT_TAIL(&client->jobs, job, waiting);
    if (client->waiting++ == 0)
        TAILQ_INSERT_TAIL(&queue->turns, client, turn);
    queue->length++;
}

static void client_queue_pull(struct queue *queue, struct client_queue *client, struct job *job)
{
    TAILQ_REMOVE(&client->jobs, job, waiting);
    if (--client->waiting == 0)
        TAILQ_REMOVE(&queue->turns, client, turn);
    queue->length--;
}

/* Takes out the last job that has not begun of the client with most waiting jobs, if it has more
 * than `others`; otherwise NULL. */
static struct job *queue_displace(struct queue *queue, size_t others)
{
    struct client_queue *client, *most = NULL;
    TAILQ_FOREACH(client, &queue->turns, turn)
    {
        if (!most || client->waiting > most->waiting)
            most = client;
    }
    if (!most || most->waiting <= others)
        return NULL;
    struct job *job = TAILQ_LAST(&most->jobs, waiting_jobs);
    while (job && job->next > 0)
        job = TAILQ_PREV(job, waiting_jobs, waiting);
    if (!job)
        return NULL;
    client_queue_pull(queue, most, job);
    LIST_REMOVE(job, live);
    client_queue_drop_if_idle(queue, most);
    return job;
}

/* The lock is held. */
static bool queue_put_locked(struct queue *queue, struct job *job, struct job **displaced)
{
    struct client_queue *client = client_queue_open(queue, job->owner);
    if (!client)
        return false;
    /* the other client must keep at least as many jobs as this one then has */
    if (queue->length >= queue->capacity)
        *displaced = queue_displace(queue, client->waiting + 1);
    if (queue->length >= queue->capacity) {
        client_queue_drop_if_idle(queue, client);
        return false;
    }
    client_queue_push(queue, client, job);
    job->queue = queue;
    LIST_INSERT_HEAD(&queue->live, job, live);
    return true;
}

bool queue_put(struct queue *queue, struct job *job, struct job **displaced)
{
    *displaced = NULL;
    pthread_mutex_lock(&queue->lock);
    bool accepted = !queue->closed && queue_put_locked(queue, job, displaced);
    if (accepted && job->items > 1)
        pthread_cond_broadcast(&queue->filled);
    else if (accepted)
        pthread_cond_signal(&queue->filled);
    pthread_mutex_unlock(&queue->lock);
    return accepted;
}

/* The client that is served next; NULL: each waiting client has its share of workers. */
static struct client_queue *queue_find_next(const struct queue *queue)
{
    struct client_queue *client;
    TAILQ_FOREACH(client, &queue->turns, turn)
    {
        if (client->running < queue->share)
            return client;
    }
    return NULL;
}

struct job *queue_take(struct queue *queue, size_t *item)
{
    struct client_queue *client;
    struct job *job = NULL;
    pthread_mutex_lock(&queue->lock);
    while (!(client = queue_find_next(queue)) && !(queue->closed && queue->length == 0))
        pthread_cond_wait(&queue->filled, &queue->lock);
    if (client) {
        job = TAILQ_FIRST(&client->jobs);
        *item = job->next++;
        client->running++;
        queue->running++;
        /* to the end of the turns, and the other items to the end of the client's jobs: others need
         * not wait for all of it */
        client_queue_pull(queue, client, job);
        if (job->next < job->items)
            client_queue_push(queue, client, job);
        if (client->waiting > 0) {
            TAILQ_REMOVE(&queue->turns, client, turn);
            TAILQ_INSERT_TAIL(&queue->turns, client, turn);
        }
    }
    pthread_mutex_unlock(&queue->lock);
    return job;
}

void queue_done(struct queue *queue, struct digest owner, struct job *ended)
{
    pthread_mutex_lock(&queue->lock);
    struct client_queue *client = client_queue_find(queue, owner);
    if (ended)
        LIST_REMOVE(ended, live);
    /* a client that had its share may be served again; the last item of a closed queue ends all
     * workers */
    if (client->running-- == queue->share || queue->closed)
        pthread_cond_broadcast(&queue->filled);
    client_queue_drop_if_idle(queue, client);
    if (--queue->running == 0 && queue->length == 0)
        pthread_cond_broadcast(&queue->drained);
    pthread_mutex_unlock(&queue->lock);
}

static void queue_retire(struct job *job)
{
    struct queue *queue = job->queue;
    pthread_mutex_lock(&queue->lock);
    LIST_REMOVE(job, live);
    pthread_mutex_unlock(&queue->lock);
}

static bool job_is_of(const struct job *job, struct digest owner)
{
    return job->owner.first == owner.first && job->owner.second == owner.second;
}

/* The lock is held. */
static bool queue_others_wait_locked(const struct queue *queue, const struct job *job)
{
    const struct client_queue *first = TAILQ_FIRST(&queue->turns);
    return first && (TAILQ_NEXT(first, turn) || !job_is_of(job, first->node.key));
}

bool queue_others_wait(struct queue *queue, const struct job *job)
{
    pthread_mutex_lock(&queue->lock);
    bool others = queue_others_wait_locked(queue, job);
    pthread_mutex_unlock(&queue->lock);
    return others;
}

void queue_note_long(struct queue *queue, struct digest owner)
{
    pthread_mutex_lock(&queue->lock);
    client_queue_find(queue, owner)->untried = UNTRIED;
    pthread_mutex_unlock(&queue->lock);
}

bool queue_is_long(struct queue *queue, const struct job *job)
{
    pthread_mutex_lock(&queue->lock);
    struct client_queue *client = client_queue_find(queue, job->owner);
    bool is_long = client->untried > 0 && queue_others_wait_locked(queue, job);
    if (is_long)
        client->untried--;
    pthread_mutex_unlock(&queue->lock);
    return is_long;
}

void queue_close(struct queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    queue->closed = true;
    pthread_cond_broadcast(&queue->filled);
    pthread_mutex_unlock(&queue->lock);
}

void queue_cancel(struct queue *queue)
{
    struct job *job;
    queue_close(queue);
    pthread_mutex_lock(&queue->lock);
    LIST_FOREACH(job, &queue->live, live)
    {
        if (job->kind->cancel)
            job->kind->cancel(job);
    }
    pthread_mutex_unlock(&queue->lock);
}

bool queue_drain(struct queue *queue, double seconds)
{
    struct timespec end;
    clock_gettime(CLOCK_MONOTONIC, &end);
    long long nanoseconds = end.tv_nsec + (long long)(seconds * 1e9);
    end.tv_sec += nanoseconds / 1000000000;
    end.tv_nsec = nanoseconds % 1000000000;
    int expired = 0;
    pthread_mutex_lock(&queue->lock);
    while (!expired && (queue->length > 0 || queue->running > 0))
        expired = pthread_cond_timedwait(&queue->drained, &queue->lock, &end);
    bool drained = queue->length == 0 && queue->running == 0;
    pthread_mutex_unlock(&queue->lock);
    return drained;
}

/* Takes out a job that has not begun; the lock is held. */
static void queue_take_out(struct queue *queue, struct job *job)
{
    struct client_queue *client = client_queue_find(queue, job->owner);
    client_queue_pull(queue, client, job);
    LIST_REMOVE(job, live);
    client_queue_drop_if_idle(queue, client);
    if (queue->running == 0 && queue->length == 0)
        pthread_cond_broadcast(&queue->drained);
    /* workers that wait at a closed queue end */
    if (queue->closed)
        pthread_cond_broadcast(&queue->filled);
}

bool queue_withdraw(struct queue *queue, const struct request_name *name, struct job **withdrawn)
{
    const struct digest owner = digest_of_octets(name->client);
    struct job *job;
    *withdrawn = NULL;
    pthread_mutex_lock(&queue->lock);
    LIST_FOREACH(job, &queue->live, live)
    {
        if (job_is_of(job, owner) && job->kind->withdraw && job->kind->withdraw(job, name))
            break;
    }
    if (job && job->next == 0) {
        queue_take_out(queue, job);
        *withdrawn = job;
    }
    pthread_mutex_unlock(&queue->lock);
    return job;
}

void queue_visit(struct queue *queue, void (*visit)(void *context, const struct job *job),
                 void *context)
{
    const struct job *job;
    pthread_mutex_lock(&queue->lock);
    LIST_FOREACH(job, &queue->live, live)
    {
        visit(context, job);
    }
    pthread_mutex_unlock(&queue->lock);
}

size_t queue_length(struct queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    size_t length = queue->length;
    pthread_mutex_unlock(&queue->lock);
    return length;
}

/* Demoted items: an item that takes long while others wait becomes a job by itself, for the workers
 * of a slower queue. */

struct demoted {
    struct job job;
    struct job *parent;
    size_t item;
    bool was_last; /* the parent has ended with it */
};

static bool demoted_run(struct job *job, size_t item, struct responder *responder)
{
    struct demoted *demoted = (struct demoted *)job;
    (void)item;
    enum job_end end = job_run(demoted->parent, demoted->item, responder);
    demoted->was_last = end == JOB_ENDED;
    return end != JOB_LONG;
}

static void demoted_refuse(struct job *job, size_t item)
{
    struct demoted *demoted = (struct demoted *)job;
    (void)item;
    demoted->was_last = job_refuse_item(demoted->parent, demoted->item) == JOB_ENDED;
}

/* The parent has reported. */
static void demoted_report(struct job *job)
{
    (void)job;
}

static void demoted_cancel(struct job *job)
{
    struct job *parent = ((struct demoted *)job)->parent;
    parent->kind->cancel(parent);
}

/* The parent stays until here: a cancelled demoted item uses it. */
static void demoted_release(struct job *job)
{
    struct demoted *demoted = (struct demoted *)job;
    if (demoted->was_last) {
        queue_retire(demoted->parent);
        demoted->parent->kind->release(demoted->parent);
    }
    free(demoted);
}

/* The status lists its parent, and withdraws that. */
static const struct job_kind demoted_kind = {
    demoted_run, demoted_refuse, demoted_report, demoted_cancel, demoted_release, NULL, NULL};

enum job_end queue_demote(struct queue *slower, struct job *job, size_t item)
{
    struct job *displaced = NULL;
    struct demoted *demoted = calloc(1, sizeof *demoted);
    if (!demoted)
        return job_refuse_item(job, item);
    demoted->parent = job;
    demoted->item = item;
    job_init(&demoted->job, &demoted_kind, 1, job->owner);
    /* once it is there, it and its parent may end at any time */
    bool accepted = queue_put(slower, &demoted->job, &displaced);
    if (displaced)
        job_refuse(displaced);
    if (accepted)
        return JOB_GOES_ON;
    free(demoted);
    return job_refuse_item(job, item);
}
