/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/crew.h"

#include <pthread.h>
#include <stdatomic.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

enum { MOST_MEMBERS = 64, CHUNK = 16, NICE = 10 };
static const long long watch_nanoseconds = 100000000;

struct crew {
    const struct crew_job *job;
    atomic_ullong next; /* first item nobody has taken */
    atomic_bool stopped;
    pthread_mutex_t lock;
    pthread_cond_t finished;
    unsigned running; /* under the lock */
};

struct member {
    struct crew *crew;
    unsigned number;
    atomic_ullong at; /* all its items below are done */
    pthread_t thread;
};

static void work_off(struct member *member)
{
    struct crew *crew = member->crew;
    const struct crew_job *job = crew->job;
    while (!atomic_load(&crew->stopped)) {
        uint64_t first = atomic_fetch_add(&crew->next, CHUNK);
        atomic_store(&member->at, first);
        if (first >= job->end)
            return;
        for (uint64_t i = first; i < first + CHUNK && i < job->end; i++) {
            atomic_store(&member->at, i);
            if (!job->work(job->context, member->number, i))
                return;
        }
    }
    /* what was taken is done */
    atomic_store(&member->at, UINT64_MAX);
}

static void *run(void *argument)
{
    struct member *member = argument;
    struct crew *crew = member->crew;
    setpriority(PRIO_PROCESS, (id_t)gettid(), NICE);
    work_off(member);
    pthread_mutex_lock(&crew->lock);
    crew->running--;
    pthread_cond_signal(&crew->finished);
    pthread_mutex_unlock(&crew->lock);
    return NULL;
}

/* Items below this are all done. Every member says first how far it is and then takes more, except
 * between taking and saying: the least it has said counts. */
static uint64_t done_by_all(const struct crew *crew, struct member *members, unsigned count)
{
    uint64_t least = atomic_load(&crew->next);
    for (unsigned i = 0; i < count; i++) {
        uint64_t at = atomic_load(&members[i].at);
        least = at < least ? at : least;
    }
    return least < crew->job->end ? least : crew->job->end;
}

/* Until all members have ended. */
static void attend(struct crew *crew, struct member *members, unsigned count)
{
    struct timespec wake;
    clock_gettime(CLOCK_MONOTONIC, &wake);
    pthread_mutex_lock(&crew->lock);
    while (crew->running > 0) {
        long long nanoseconds = wake.tv_nsec + watch_nanoseconds;
        wake.tv_sec += nanoseconds / 1000000000;
        wake.tv_nsec = nanoseconds % 1000000000;
        while (crew->running > 0 &&
               pthread_cond_timedwait(&crew->finished, &crew->lock, &wake) == 0)
            ;
        if (crew->running == 0)
            break;
        pthread_mutex_unlock(&crew->lock);
        if (!crew->job->watch(crew->job->context, done_by_all(crew, members, count)))
            atomic_store(&crew->stopped, true);
        pthread_mutex_lock(&crew->lock);
    }
    pthread_mutex_unlock(&crew->lock);
}

static unsigned start(struct crew *crew, struct member *members, unsigned wanted)
{
    unsigned count = 0;
    crew->running = wanted;
    for (; count < wanted; count++) {
        members[count].crew = crew;
        members[count].number = count;
        atomic_init(&members[count].at, crew->job->first);
        if (pthread_create(&members[count].thread, NULL, run, &members[count]) != 0)
            break;
    }
    pthread_mutex_lock(&crew->lock);
    crew->running -= wanted - count;
    pthread_mutex_unlock(&crew->lock);
    return count;
}

uint64_t crew_run(const struct crew_job *job)
{
    struct crew crew = {.job = job};
    struct member members[MOST_MEMBERS];
    pthread_condattr_t monotonic;
    atomic_init(&crew.next, job->first);
    atomic_init(&crew.stopped, false);
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&crew.lock, NULL);
    pthread_cond_init(&crew.finished, &monotonic);
    pthread_condattr_destroy(&monotonic);
    unsigned wanted = job->members < MOST_MEMBERS ? job->members : MOST_MEMBERS;
    unsigned count = start(&crew, members, wanted);
    attend(&crew, members, count);
    for (unsigned i = 0; i < count; i++)
        pthread_join(members[i].thread, NULL);
    pthread_cond_destroy(&crew.finished);
    pthread_mutex_destroy(&crew.lock);
    return count == 0 ? job->first : done_by_all(&crew, members, count);
}
