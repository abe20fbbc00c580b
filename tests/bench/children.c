/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "children.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "domain.h"

static pid_t children[CHILDREN_MOST];
static int count;

uint32_t children_domain(void)
{
    unsetenv("CYCLONEDDS_URI");
    return domain_draw();
}

pid_t children_start(char *const arguments[])
{
    if (count == 0)
        atexit(children_stop);
    pid_t parent = getpid(), child = count < CHILDREN_MOST ? fork() : -1;
    if (child < 0) {
        fprintf(stderr, "%s: cannot be started\n", arguments[0]);
        exit(EXIT_FAILURE);
    }
    if (child == 0) {
        /* if the benchmark is killed, they are too */
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() == parent)
            execv(arguments[0], arguments);
        perror(arguments[0]);
        _exit(127);
    }
    children[count++] = child;
    return child;
}

void children_check(void)
{
    int status;
    pid_t ended = waitpid(-1, &status, WNOHANG);
    if (ended <= 0)
        return;
    for (int i = 0; i < count; i++) {
        if (children[i] == ended)
            children[i] = children[--count];
    }
    fprintf(stderr, "a process of the benchmark ended by itself (status %d)\n", status);
    exit(EXIT_FAILURE);
}

void children_stop(void)
{
    for (int i = 0; i < count; i++)
        kill(children[i], SIGTERM);
    for (int i = 0; i < count; i++)
        waitpid(children[i], NULL, 0);
    count = 0;
}

double children_cpu(pid_t child)
{
    clockid_t clock;
    struct timespec used = {0};
    if (clock_getcpuclockid(child, &clock) == 0)
        clock_gettime(clock, &used);
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}
