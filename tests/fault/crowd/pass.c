/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Clients that come, each a process of its own, ask once and vanish: every other one is killed with
 * a question open. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "crowd.h"

static const double PATIENCE = 60.0; /* s, for an answer */

static int live(const struct crowd *crowd, unsigned long number)
{
    static struct percuss_request request;
    enum percuss_status status;
    struct percuss_client *client = crowd_connect(crowd, NULL);
    if (!client || question_ask(client, QUESTION_CHEAP, number, 0, PATIENCE, &status) ||
        status != PERCUSS_OK)
        return EXIT_FAILURE;
    if (number % 2 == 0) {
        percuss_client_free(client);
        return EXIT_SUCCESS;
    }
    question_fill(QUESTION_CHEAP, number + 1, &request);
    percuss_submit(client, &request, NULL);
    return kill(getpid(), SIGKILL);
}

/* Waits for the end of one of them. */
static bool bury(void)
{
    int status;
    return wait(&status) > 0 && ((WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS) ||
                                 (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL));
}

bool crowd_pass(const struct crowd *crowd)
{
    unsigned long failed = 0;
    unsigned there = 0;
    for (unsigned long i = 0; i < crowd->requests; i++) {
        if (there == crowd->clients) {
            failed += !bury();
            there--;
        }
        pid_t child = fork();
        if (child == 0)
            _exit(live(crowd, i));
        if (child > 0)
            there++;
        else
            failed++;
    }
    for (; there > 0; there--)
        failed += !bury();
    printf("%lu clients came and went, %lu failed\n", crowd->requests, failed);
    return failed == 0;
}
