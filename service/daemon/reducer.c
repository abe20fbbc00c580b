/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/reducer.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "daemon/log.h"

static const int NICE = 15; /* below the long lane, which somebody waits for */

enum { BODY, MESSAGES, MATERIAL };

void reducer_forget(struct reducer *reducer)
{
    static const char suffix[] = ".failed";
    struct dirent *entry;
    DIR *folder = reducer->folder[0] ? opendir(reducer->folder) : NULL;
    reducer->halted = false;
    while (folder && (entry = readdir(folder))) {
        size_t length = strlen(entry->d_name);
        if (length == 64 + strlen(suffix) && strcmp(entry->d_name + 64, suffix) == 0)
            unlinkat(dirfd(folder), entry->d_name, 0);
    }
    if (folder)
        closedir(folder);
}

void reducer_begin(struct reducer *reducer, const char *folder)
{
    *reducer = (struct reducer){.folder = folder};
    /* one level: what is above it is for an administrator to make */
    if (folder[0])
        mkdir(folder, 0755);
    reducer_forget(reducer);
}

static void drop_files(struct reducer *reducer)
{
    for (int i = 0; i < REDUCER_FILES; i++) {
        if (reducer->files[i])
            unlink(reducer->files[i]);
        free(reducer->files[i]);
        reducer->files[i] = NULL;
    }
}

/* PATH of a result in the folder, for free(); NULL: no memory. */
static char *result_path(const struct reducer *reducer, const char *name, const char *suffix)
{
    char *path;
    return asprintf(&path, "%s/%s%s", reducer->folder, name, suffix) < 0 ? NULL : path;
}

/* Files of this process alone, as several daemons may share the folder. */
static bool name_files(struct reducer *reducer)
{
    static const char *const kinds[REDUCER_FILES] = {"h5", "messages", "yaml"};
    for (int i = 0; i < REDUCER_FILES; i++) {
        char suffix[48];
        snprintf(suffix, sizeof suffix, ".%d.%s", (int)getpid(), kinds[i]);
        reducer->files[i] = result_path(reducer, reducer->name, suffix);
        if (!reducer->files[i])
            return false;
    }
    return true;
}

static bool write_text(const char *path, const char *text)
{
    FILE *file = path ? fopen(path, "we") : NULL;
    if (!file)
        return false;
    bool good = fputs(text, file) >= 0;
    return fclose(file) == 0 && good;
}

/* The program beside this one, else as PATH knows it. */
static void find_program(char path[PATH_MAX])
{
    static const char name[] = "percuss-reduce";
    ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - sizeof name);
    if (length > 0) {
        path[length] = '\0';
        char *slash = strrchr(path, '/');
        strcpy(slash ? slash + 1 : path, name);
        if (access(path, X_OK) == 0)
            return;
    }
    strcpy(path, name);
}

/* 0, or an error's number. Signals are as they were before this program blocked its own. */
static int spawn(struct reducer *reducer, char **arguments)
{
    char program[PATH_MAX];
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, pipe;
    find_program(program);
    /* messages to their file, and nothing else of ours */
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, reducer->files[MESSAGES],
                                     O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addclosefrom_np(&actions, 3);
    posix_spawnattr_init(&attributes);
    sigemptyset(&none);
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &pipe);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                              POSIX_SPAWN_SETPGROUP);
    int error = posix_spawnp(&reducer->child, program, &actions, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error)
        reducer->child = 0;
    else
        setpriority(PRIO_PROCESS, (id_t)reducer->child, NICE);
    return error;
}

static void start(struct reducer *reducer, const struct body_order *order)
{
    char name[] = "percuss-reduce", output[] = "-o", catalogue[] = "-C", files[] = "--";
    char *arguments[BODY_ORDER_ARGUMENTS + 8] = {name};
    size_t count = 1;
    snprintf(reducer->id, sizeof reducer->id, "%s", order->id);
    snprintf(reducer->name, sizeof reducer->name, "%s", order->name);
    int error = name_files(reducer) ? 0 : ENOMEM;
    /* the order's options, and the files */
    for (size_t i = 0; i < order->argument_count; i++)
        arguments[count++] = order->arguments[i];
    arguments[count++] = output;
    arguments[count++] = reducer->files[BODY];
    if (order->material[0]) {
        arguments[count++] = catalogue;
        arguments[count++] = reducer->files[MATERIAL];
        if (!error && !write_text(reducer->files[MATERIAL], order->material))
            error = errno;
    }
    arguments[count++] = files;
    arguments[count++] = order->mesh;
    if (!error)
        error = spawn(reducer, arguments);
    if (!error) {
        log_line(LEVEL_INFO, "%s: %s is being reduced by process %d, its messages in %s", order->id,
                 order->mesh, (int)reducer->child, reducer->files[MESSAGES]);
        return;
    }
    log_line(LEVEL_ERROR, "%s: %s cannot be reduced: percuss-reduce or %s: %s; SIGHUP tries again",
             order->id, order->mesh, reducer->folder, strerror(error));
    drop_files(reducer);
    reducer->halted = true;
}

/* The last line of the child's messages. */
static void last_message(const char *path, char text[400])
{
    char line[400];
    FILE *file = fopen(path, "re");
    strcpy(text, "percuss-reduce ended without a message");
    if (!file)
        return;
    while (fgets(line, sizeof line, file)) {
        line[strcspn(line, "\n")] = '\0';
        if (line[0])
            strcpy(text, line);
    }
    fclose(file);
}

/* Puts what the child has made, or why it has made nothing, where the catalogue finds it. */
static void conclude(struct reducer *reducer, int status)
{
    char reason[400];
    bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    char *path = result_path(reducer, reducer->name, good ? ".h5" : ".failed");
    if (good) {
        good = path && rename(reducer->files[BODY], path) == 0;
        reducer->halted = !good;
    } else {
        if (WIFSIGNALED(status))
            snprintf(reason, sizeof reason, "percuss-reduce was ended by signal %d",
                     WTERMSIG(status));
        else
            last_message(reducer->files[MESSAGES], reason);
        log_line(LEVEL_ERROR, "%s: could not be reduced: %s", reducer->id, reason);
        reducer->halted = !path || !write_text(path, reason);
    }
    if (good)
        log_line(LEVEL_INFO, "%s: reduced", reducer->id);
    else if (reducer->halted)
        log_line(LEVEL_ERROR, "%s: cannot be written: nothing more is reduced until SIGHUP",
                 reducer->folder);
    free(path);
    drop_files(reducer);
}

/* Whether the folder lacks an order's body and knows no reason why. */
static bool is_open(const struct reducer *reducer, const struct body_order *order)
{
    char *body = result_path(reducer, order->name, ".h5");
    char *failed = result_path(reducer, order->name, ".failed");
    bool open = body && failed && access(body, F_OK) != 0 && access(failed, F_OK) != 0;
    free(body);
    free(failed);
    return open;
}

bool reducer_look(struct reducer *reducer, const struct body_set *set)
{
    int status;
    /* the one that runs */
    if (reducer->child) {
        pid_t ended = waitpid(reducer->child, &status, WNOHANG);
        if (ended != reducer->child)
            return false;
        reducer->child = 0;
        conclude(reducer, status);
        return true;
    }
    /* or the next */
    for (size_t i = 0; !reducer->halted && i < set->order_count; i++)
        if (is_open(reducer, &set->orders[i])) {
            start(reducer, &set->orders[i]);
            break;
        }
    return false;
}

void reducer_end(struct reducer *reducer)
{
    reducer->halted = true;
    if (!reducer->child)
        return;
    /* it keeps nothing that it would have to put away; Gmsh, which it may run, goes with it */
    kill(-reducer->child, SIGKILL);
    waitpid(reducer->child, NULL, 0);
    reducer->child = 0;
    drop_files(reducer);
}
