/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "guarded.h"

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

void *guarded_memory(size_t size)
{
    void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) {
        perror("mmap");
        exit(EXIT_FAILURE);
    }
    return memory;
}

static double clock_of(clockid_t clock)
{
    struct timespec now = {0};
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double guarded_clock(void)
{
    return clock_of(CLOCK_PROCESS_CPUTIME_ID);
}

/* Waits until the child ends or one job has taken too long. The signal that ended it, 0 when the
 * guard did, -1 when it came to its end. */
static int watch_child(const struct guarded *guarded, const struct guarded_place *place,
                       pid_t child)
{
    const struct timespec pause = {.tv_nsec = 20000000};
    clockid_t clock;
    int status;
    bool late = false;
    clock_getcpuclockid(child, &clock);
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (clock_of(clock) - place->started > guarded->patience && !late) {
            late = true;
            kill(child, SIGKILL);
        }
        nanosleep(&pause, NULL);
    }
    if (late)
        return 0;
    if (WIFSIGNALED(status))
        return WTERMSIG(status);
    return WEXITSTATUS(status) == EXIT_SUCCESS ? -1 : SIGABRT; /* a sanitizer ends by exit */
}

void guarded_run(struct guarded *guarded, uint64_t first, uint64_t end)
{
    struct guarded_place *place = guarded_memory(sizeof *place);
    place->resume = first;
    guarded->lost_count = 0;
    while (place->resume < end) {
        fflush(NULL);
        place->started = 0.0;
        place->job = place->resume; /* a child that does not even start has lost the next job */
        pid_t child = fork();
        if (child == 0) {
            guarded->work(guarded->context, place, end);
            exit(EXIT_SUCCESS);
        }
        int how = child < 0 ? SIGABRT : watch_child(guarded, place, child);
        if (how < 0)
            break;
        if (guarded->lost_count < GUARDED_MOST_LOST) {
            guarded->lost[guarded->lost_count].job = place->job;
            guarded->lost[guarded->lost_count].signal = how;
        }
        guarded->lost_count++;
        place->resume = place->job + 1;
    }
    munmap(place, sizeof *place);
}
