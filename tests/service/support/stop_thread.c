/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Stops the threads of a process that have a name, as a bug would, and lets them go on when its
 * standard input ends. Prints "stopped". Exit code 77: this machine does not allow it.
 *
 * usage: stop_thread PROCESS NAME */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NOT_ALLOWED = 77, MOST_THREADS = 256 };

/* Their ids; returns how many there are. */
static int find(const char *process, const char *name, pid_t threads[MOST_THREADS])
{
    char path[300], line[64];
    int count = 0;
    const struct dirent *entry;
    snprintf(path, sizeof path, "/proc/%s/task", process);
    DIR *tasks = opendir(path);
    while (tasks && count < MOST_THREADS && (entry = readdir(tasks))) {
        snprintf(path, sizeof path, "/proc/%s/task/%s/comm", process, entry->d_name);
        FILE *file = fopen(path, "r");
        if (file && fgets(line, sizeof line, file) && strncmp(line, name, strlen(name)) == 0 &&
            line[strlen(name)] == '\n')
            threads[count++] = (pid_t)strtol(entry->d_name, NULL, 10);
        if (file)
            fclose(file);
    }
    if (tasks)
        closedir(tasks);
    return count;
}

static int stop(pid_t thread)
{
    int status;
    return ptrace(PTRACE_SEIZE, thread, NULL, NULL) == 0 &&
           ptrace(PTRACE_INTERRUPT, thread, NULL, NULL) == 0 &&
           waitpid(thread, &status, __WALL) > 0;
}

int main(int argc, char **argv)
{
    char byte;
    pid_t threads[MOST_THREADS];
    int count = argc == 3 ? find(argv[1], argv[2], threads) : 0;
    if (count == 0) {
        fprintf(stderr, "no such thread\n");
        return EXIT_FAILURE;
    }
    for (int i = 0; i < count; i++)
        if (!stop(threads[i])) {
            perror("ptrace");
            return NOT_ALLOWED;
        }
    puts("stopped");
    fflush(stdout);
    while (read(STDIN_FILENO, &byte, 1) > 0)
        continue;
    /* they go on at the latest when this process ends */
    int code = EXIT_SUCCESS;
    for (int i = 0; i < count; i++)
        if (ptrace(PTRACE_DETACH, threads[i], NULL, NULL) != 0)
            code = EXIT_FAILURE;
    return code;
}
