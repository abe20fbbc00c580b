/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/queue.h"

#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#include "exchange/key_map.h"
#include "exchange/reply_store.h"

/* Of a client whose item took long so many more are passed on untried: trying them all costs others
 * the time that each is given before. */
enum { EXPECTED_CLIENTS = 64, UNTRIED = 16 };

/* A client who has jobs that wait or are being done. */
struct party {
    struct key_node node; /* key: the owner of its jobs */
    TAILQ_HEAD(party_jobs, job) jobs;
    size_t waiting;          /* jobs */
    size_t running;          /* items handed out and not yet done */
    unsigned untried;        /* items to be passed on */
    TAILQ_ENTRY(party) turn; /* while jobs wait */
};

struct queue {
    pthread_mutex_t lock;
    pthread_cond_t filled, drained;
    size_t capacity, share;
    size_t length;  /* jobs that wait */
    size_t running; /* items handed out and not yet done */
    bool closed;
    struct key_map parties;
    TAILQ_HEAD(party_turns, party) turns; /* whose jobs wait; the first one is served next */
    LIST_HEAD(live_jobs, job) live;       /* that wait or are being done */
};

struct queue *queue_create(size_t capacity, size_t share)
{
    struct queue *queue = calloc(1, sizeof *queue);
    if (!queue)
        return NULL;
    if (!key_map_create(&queue->parties, EXPECTED_CLIENTS)) {
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

static struct party *party_find(const struct queue *queue, struct digest owner)
{
    struct key_node *node = key_map_find(&queue->parties, owner);
    return node ? KEY_MAP_OWNER(node, struct party, node) : NULL;
}

/* NULL: out of memory. */
static struct party *party_open(struct queue *queue, struct digest owner)
{
    struct party *party = party_find(queue, owner);
    if (party)
        return party;
    party = calloc(1, sizeof *party);
    if (!party)
        return NULL;
    party->node.key = owner;
    TAILQ_INIT(&party->jobs);
    key_map_insert(&queue->parties, &party->node);
    return party;
}

static void party_drop_if_idle(struct queue *queue, struct party *party)
{
    if (party->waiting > 0 || party->running > 0)
        return;
    key_map_remove(&queue->parties, &party->node);
    free(party);
}

void queue_free(struct queue *queue)
{
    if (!queue)
        return;
    key_map_release(&queue->parties);
    pthread_cond_destroy(&queue->drained);
    pthread_cond_destroy(&queue->filled);
    pthread_mutex_destroy(&queue->lock);
    free(queue);
}

/* The job waits, after all others of its client. */
static void push(struct queue *queue, struct party *party, struct job *job)
{
    TAILQ_INSERT_TAIL(&party->jobs, job, waiting);
    if (party->waiting++ == 0)
        TAILQ_INSERT_TAIL(&queue->turns, party, turn);
    queue->length++;
}

static void pull(struct queue *queue, struct party *party, struct job *job)
{
    TAILQ_REMOVE(&party->jobs, job, waiting);
    if (--party->waiting == 0)
        TAILQ_REMOVE(&queue->turns, party, turn);
    queue->length--;
}

/* Takes out the last job that has not begun of whoever has most waiting, if that is more than
 * `others`; NULL: nobody has. */
static struct job *displace(struct queue *queue, size_t others)
{
    struct party *party, *most = NULL;
    TAILQ_FOREACH(party, &queue->turns, turn)
    {
        if (!most || party->waiting > most->waiting)
            most = party;
    }
    if (!most || most->waiting <= others)
        return NULL;
    struct job *job = TAILQ_LAST(&most->jobs, party_jobs);
    while (job && job->next > 0)
        job = TAILQ_PREV(job, party_jobs, waiting);
    if (!job)
        return NULL;
    pull(queue, most, job);
    LIST_REMOVE(job, live);
    party_drop_if_idle(queue, most);
    return job;
}

/* The lock is held. */
static bool put(struct queue *queue, struct job *job, struct job **displaced)
{
    struct party *party = party_open(queue, job->owner);
    if (!party)
        return false;
    /* one more of this client must still be no more than the other one keeps */
    if (queue->length >= queue->capacity)
        *displaced = displace(queue, party->waiting + 1);
    if (queue->length >= queue->capacity) {
        party_drop_if_idle(queue, party);
        return false;
    }
    push(queue, party, job);
    job->queue = queue;
    LIST_INSERT_HEAD(&queue->live, job, live);
    return true;
}

bool queue_put(struct queue *queue, struct job *job, struct job **displaced)
{
    *displaced = NULL;
    pthread_mutex_lock(&queue->lock);
    bool accepted = !queue->closed && put(queue, job, displaced);
    if (accepted && job->items > 1)
        pthread_cond_broadcast(&queue->filled);
    else if (accepted)
        pthread_cond_signal(&queue->filled);
    pthread_mutex_unlock(&queue->lock);
    return accepted;
}

/* The client whose turn it is; NULL: nobody who waits may have more done at once. */
static struct party *find_next(const struct queue *queue)
{
    struct party *party;
    TAILQ_FOREACH(party, &queue->turns, turn)
    {
        if (party->running < queue->share)
            return party;
    }
    return NULL;
}

struct job *queue_take(struct queue *queue, size_t *item)
{
    struct party *party;
    struct job *job = NULL;
    pthread_mutex_lock(&queue->lock);
    while (!(party = find_next(queue)) && !(queue->closed && queue->length == 0))
        pthread_cond_wait(&queue->filled, &queue->lock);
    if (party) {
        job = TAILQ_FIRST(&party->jobs);
        *item = job->next++;
        party->running++;
        queue->running++;
        /* to the end of the turns, and the other items to the end of the client's jobs: others need
         * not wait for all of it */
        pull(queue, party, job);
        if (job->next < job->items)
            push(queue, party, job);
        if (party->waiting > 0) {
            TAILQ_REMOVE(&queue->turns, party, turn);
            TAILQ_INSERT_TAIL(&queue->turns, party, turn);
        }
    }
    pthread_mutex_unlock(&queue->lock);
    return job;
}

void queue_done(struct queue *queue, struct digest owner, struct job *ended)
{
    pthread_mutex_lock(&queue->lock);
    struct party *party = party_find(queue, owner);
    if (ended)
        LIST_REMOVE(ended, live);
    /* where a client had its share, one who waits may go on; and the last one ends all */
    if (party->running-- == queue->share || queue->closed)
        pthread_cond_broadcast(&queue->filled);
    party_drop_if_idle(queue, party);
    if (--queue->running == 0 && queue->length == 0)
        pthread_cond_broadcast(&queue->drained);
    pthread_mutex_unlock(&queue->lock);
}

void queue_retire(struct job *job)
{
    struct queue *queue = job->queue;
    pthread_mutex_lock(&queue->lock);
    LIST_REMOVE(job, live);
    pthread_mutex_unlock(&queue->lock);
}

static bool is_of(const struct job *job, struct digest owner)
{
    return job->owner.first == owner.first && job->owner.second == owner.second;
}

/* The lock is held. */
static bool others_wait(const struct queue *queue, const struct job *job)
{
    const struct party *first = TAILQ_FIRST(&queue->turns);
    return first && (TAILQ_NEXT(first, turn) || !is_of(job, first->node.key));
}

bool queue_others_wait(struct queue *queue, const struct job *job)
{
    pthread_mutex_lock(&queue->lock);
    bool others = others_wait(queue, job);
    pthread_mutex_unlock(&queue->lock);
    return others;
}

void queue_note_long(struct queue *queue, struct digest owner)
{
    pthread_mutex_lock(&queue->lock);
    party_find(queue, owner)->untried = UNTRIED;
    pthread_mutex_unlock(&queue->lock);
}

bool queue_is_long(struct queue *queue, const struct job *job)
{
    pthread_mutex_lock(&queue->lock);
    struct party *party = party_find(queue, job->owner);
    bool is_long = party->untried > 0 && others_wait(queue, job);
    if (is_long)
        party->untried--;
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
static void take_out(struct queue *queue, struct job *job)
{
    struct party *party = party_find(queue, job->owner);
    pull(queue, party, job);
    LIST_REMOVE(job, live);
    party_drop_if_idle(queue, party);
    if (queue->running == 0 && queue->length == 0)
        pthread_cond_broadcast(&queue->drained);
    /* whoever waits for more in a queue that is closed waits in vain */
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
        if (is_of(job, owner) && job->kind->withdraw && job->kind->withdraw(job, name))
            break;
    }
    if (job && job->next == 0) {
        take_out(queue, job);
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
