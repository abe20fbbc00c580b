/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Stops one thread of a process, as a bug would, and lets it go on when its standard input ends.
 * Prints "stopped". Exit code 77: this machine does not allow it.
 *
 * usage: stop_thread PROCESS NAME */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NOT_ALLOWED = 77 };

/* The id of the thread; 0: there is none. */
static pid_t find(const char *process, const char *name)
{
    char path[300], line[64];
    pid_t found = 0;
    const struct dirent *entry;
    snprintf(path, sizeof path, "/proc/%s/task", process);
    DIR *tasks = opendir(path);
    while (tasks && !found && (entry = readdir(tasks))) {
        snprintf(path, sizeof path, "/proc/%s/task/%s/comm", process, entry->d_name);
        FILE *file = fopen(path, "r");
        if (file && fgets(line, sizeof line, file) && strncmp(line, name, strlen(name)) == 0 &&
            line[strlen(name)] == '\n')
            found = (pid_t)strtol(entry->d_name, NULL, 10);
        if (file)
            fclose(file);
    }
    if (tasks)
        closedir(tasks);
    return found;
}

int main(int argc, char **argv)
{
    char byte;
    int status;
    pid_t thread = argc == 3 ? find(argv[1], argv[2]) : 0;
    if (!thread) {
        fprintf(stderr, "no such thread\n");
        return EXIT_FAILURE;
    }
    if (ptrace(PTRACE_SEIZE, thread, NULL, NULL) != 0 ||
        ptrace(PTRACE_INTERRUPT, thread, NULL, NULL) != 0 || waitpid(thread, &status, __WALL) < 0) {
        perror("ptrace");
        return NOT_ALLOWED;
    }
    puts("stopped");
    fflush(stdout);
    while (read(STDIN_FILENO, &byte, 1) > 0)
        continue;
    return ptrace(PTRACE_DETACH, thread, NULL, NULL) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
