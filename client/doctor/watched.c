/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "watched.h"

#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* All of the file from its beginning; NULL: unknown. */
static char *read_all(int file)
{
    struct stat about;
    if (file < 0 || fstat(file, &about) != 0)
        return NULL;
    char *text = malloc((size_t)about.st_size + 1);
    ssize_t length = text ? pread(file, text, (size_t)about.st_size, 0) : -1;
    if (length >= 0)
        text[length] = '\0';
    return text;
}

/* Reads findings until the child has closed the pipe. False: its time is over. */
static bool collect(int from, double end, struct findings *findings)
{
    struct finding finding;
    struct pollfd ready = {.fd = from, .events = POLLIN};
    for (;;) {
        double left = end - now();
        if (left <= 0.0 || poll(&ready, 1, (int)ceil(1e3 * left)) <= 0)
            return false;
        if (read(from, &finding, sizeof finding) != sizeof finding)
            return true;
        if (findings)
            findings_keep(findings, &finding);
    }
}

/* The child's beginning: it goes with its parent, and its words to the log. */
static void begin_child(int log)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (log >= 0)
        dup2(log, STDERR_FILENO);
}

/* Waits for a child, which holds the other end of `from`. */
static void finish(pid_t child, int from, int log, double seconds, struct findings *findings,
                   struct watched *end)
{
    int status = 0;
    end->late = !collect(from, now() + seconds, findings);
    if (end->late)
        kill(child, SIGKILL);
    waitpid(child, &status, 0);
    end->code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    end->signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    end->log = read_all(log);
}

void watched_run(watched_function *function, void *context, double seconds,
                 struct findings *findings, struct watched *end)
{
    int ends[2], log = memfd_create("log", MFD_CLOEXEC);
    *end = (struct watched){.code = -1};
    if (pipe2(ends, O_CLOEXEC) == 0) {
        fflush(NULL);
        pid_t child = fork();
        if (child == 0) {
            struct findings to_parent = {.pipe = ends[1]};
            begin_child(log);
            _exit(function(context, &to_parent));
        }
        close(ends[1]);
        if (child > 0)
            finish(child, ends[0], log, seconds, findings, end);
        close(ends[0]);
    }
    if (log >= 0)
        close(log);
}

void watched_program(char *const argv[], double seconds, struct watched *end)
{
    enum { NO_PROGRAM = 127, HELD = 3 };
    int ends[2], log = memfd_create("log", MFD_CLOEXEC);
    *end = (struct watched){.code = -1};
    if (pipe2(ends, O_CLOEXEC) == 0) {
        pid_t child = fork();
        if (child == 0) {
            int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
            begin_child(log);
            dup2(nothing, STDOUT_FILENO);
            /* the pipe is closed by the program's end */
            if (ends[1] != HELD)
                dup2(ends[1], HELD);
            else
                fcntl(HELD, F_SETFD, 0);
            execv(argv[0], argv);
            _exit(NO_PROGRAM);
        }
        close(ends[1]);
        if (child > 0)
            finish(child, ends[0], log, seconds, NULL, end);
        close(ends[0]);
    }
    if (log >= 0)
        close(log);
}
