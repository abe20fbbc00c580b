/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/forked.h"

#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* more copies wait for memory, not for processors */
enum { MOST_PROCESSES = 16 };

/* shared by the copies */
struct forked_state {
    atomic_size_t next;     /* part that nobody has begun */
    atomic_size_t done;     /* how many */
    atomic_bool finished[]; /* [parts] */
};

void *forked_memory(size_t bytes)
{
    void *memory = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? NULL : memory;
}

void forked_memory_free(void *memory, size_t bytes)
{
    if (memory)
        munmap(memory, bytes);
}

size_t forked_processors(void)
{
    cpu_set_t set;
    int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return count > 0 ? (size_t)count : 1;
}

static enum percuss_status do_part(const struct forked_work *work, struct forked_state *state,
                                   size_t part, struct fault *fault)
{
    enum percuss_status status = work->part(work->context, part, fault);
    if (status == PERCUSS_OK) {
        atomic_store(&state->finished[part], true);
        atomic_fetch_add(&state->done, 1);
    }
    return status;
}

/* Parts from the heap of all; a copy has no watch. */
static enum percuss_status take_parts(const struct forked_work *work, struct forked_state *state,
                                      struct pace *pace, struct fault *fault)
{
    enum percuss_status status = PERCUSS_OK;
    while (status == PERCUSS_OK) {
        double done = (double)atomic_load(&state->done) / (double)work->parts;
        if (pace && !pace_ask(pace, done))
            return pace_fault(fault, PERCUSS_TIMEOUT);
        size_t part = atomic_fetch_add(&state->next, 1);
        if (part >= work->parts)
            break;
        status = do_part(work, state, part, fault);
    }
    return status;
}

pid_t forked_begin(bool (*work)(void *context), void *context)
{
    pid_t parent = getpid(), copy = fork();
    if (copy != 0)
        return copy;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    _exit(getppid() == parent && work(context) ? 0 : 1);
}

bool forked_end(pid_t copy)
{
    int status;
    return copy > 0 && waitpid(copy, &status, 0) == copy && WIFEXITED(status) &&
           WEXITSTATUS(status) == 0;
}

void forked_drop(pid_t copy)
{
    if (copy <= 0)
        return;
    kill(copy, SIGKILL);
    waitpid(copy, NULL, 0);
}

/* What a copy takes parts of. */
struct forked_share {
    const struct forked_work *work;
    struct forked_state *state;
};

static bool take_share(void *context)
{
    const struct forked_share *share = context;
    struct fault fault = {""};
    return take_parts(share->work, share->state, NULL, &fault) == PERCUSS_OK;
}

enum percuss_status forked_run(const struct forked_work *work, struct fault *fault)
{
    size_t bytes = sizeof(struct forked_state) + work->parts * sizeof(atomic_bool);
    struct forked_state *state = forked_memory(bytes);
    struct pace pace = {.watch = work->watch};
    struct forked_share share = {work, state};
    pid_t copies[MOST_PROCESSES];
    size_t count = 0;
    if (!state)
        return pace_fault(fault, PERCUSS_INTERNAL);
    while (count + 1 < work->processes && count + 1 < work->parts && count + 1 < MOST_PROCESSES) {
        copies[count] = forked_begin(take_share, &share);
        if (copies[count] < 0)
            break;
        count++;
    }
    enum percuss_status status = take_parts(work, state, work->watch ? &pace : NULL, fault);
    /* the rest of the copies' parts is waited for, or of no use */
    for (size_t i = 0; i < count; i++) {
        if (status != PERCUSS_OK)
            forked_drop(copies[i]);
        else
            forked_end(copies[i]);
    }
    /* and what a copy has left */
    for (size_t part = 0; part < work->parts && status == PERCUSS_OK; part++)
        if (!atomic_load(&state->finished[part]))
            status = do_part(work, state, part, fault);
    forked_memory_free(state, bytes);
    return status;
}
