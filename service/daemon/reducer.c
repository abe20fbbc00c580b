/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/reducer.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "daemon/limits.h"
#include "daemon/log.h"

/* The folder of reduced bodies, which daemons with different catalogues may share. */

enum { NAME_LENGTH = 64 }; /* of an order: a hash in hexadecimal */

static const double DAY = 86400.0; /* s */
/* A reduction by another machine's process, which is not visible here, may take that long. */
static const double LEFT_BEHIND_DAYS = 2.0;

static const struct body_order *cache_find_order(const struct body_set *set, const char *name)
{
    for (size_t i = 0; i < set->order_count; i++)
        if (strncmp(set->orders[i].name, name, NAME_LENGTH) == 0)
            return &set->orders[i];
    return NULL;
}

/* "1234.messages": a file of a process that has ended. */
static bool cache_is_orphan(const char *suffix)
{
    static const char *const kinds[] = {".h5", ".h5.part", ".messages", ".yaml"};
    char *end;
    long process = strtol(suffix, &end, 10);
    bool known = false;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        known = known || strcmp(end, kinds[i]) == 0;
    return known && process > 0 && kill((pid_t)process, 0) != 0 && errno == ESRCH;
}

/* The days without use after which a file is deleted; negative: never. */
static double cache_days_of(const char *name, const struct body_set *set, double days)
{
    if (strspn(name, "0123456789abcdef") != NAME_LENGTH || name[NAME_LENGTH] != '.')
        return -1.0;
    const char *suffix = name + NAME_LENGTH + 1;
    static const char *const results[] = {"h5", "h5.sites", "h5.sites.part", "failed", "killed"};
    for (size_t i = 0; i < sizeof results / sizeof *results; i++)
        if (strcmp(suffix, results[i]) == 0)
            return cache_find_order(set, name) ? -1.0 : days;
    return cache_is_orphan(suffix) ? LEFT_BEHIND_DAYS : -1.0;
}

static void cache_mark(int folder, const struct body_set *set)
{
    for (size_t i = 0; i < set->order_count; i++) {
        static const char *const suffixes[] = {"h5", "h5.sites"};
        for (size_t k = 0; set->orders[i].made && k < sizeof suffixes / sizeof *suffixes; k++) {
            char name[NAME_LENGTH + 16];
            snprintf(name, sizeof name, "%.64s.%s", set->orders[i].name, suffixes[k]);
            utimensat(folder, name, NULL, 0);
        }
    }
}

void reducer_tidy(const char *folder, const struct body_set *set, double days)
{
    struct dirent *entry;
    struct stat file;
    DIR *stream = opendir(folder);
    if (!stream)
        return;
    cache_mark(dirfd(stream), set);
    time_t now = time(NULL);
    while ((entry = readdir(stream))) {
        double stays = cache_days_of(entry->d_name, set, days);
        if (stays < 0.0 || fstatat(dirfd(stream), entry->d_name, &file, AT_SYMLINK_NOFOLLOW) != 0)
            continue;
        double unused = difftime(now, file.st_mtime) / DAY;
        if (S_ISREG(file.st_mode) && unused > stays &&
            unlinkat(dirfd(stream), entry->d_name, 0) == 0)
            log_line(LEVEL_INFO, "%s/%s: unused for %.0f days: deleted", folder, entry->d_name,
                     unused);
    }
    closedir(stream);
}

/* The child process. */

static const int NICE = 15; /* below the long lane, for which clients wait */

enum { BODY, MESSAGES, MATERIAL };

static const char REFUSED[] = ".failed", KILLED[] = ".killed"; /* files with the reason */

/* Whether a file of the folder has the reason of a failure of that kind. */
static bool reducer_is_reason(const char *name, const char *kind)
{
    return strlen(name) == 64 + strlen(kind) && strcmp(name + 64, kind) == 0;
}

static void reducer_forget(const struct reducer *reducer, bool refusals)
{
    struct dirent *entry;
    DIR *folder = reducer->folder[0] ? opendir(reducer->folder) : NULL;
    while (folder && (entry = readdir(folder)))
        if (reducer_is_reason(entry->d_name, KILLED) ||
            (refusals && reducer_is_reason(entry->d_name, REFUSED)))
            unlinkat(dirfd(folder), entry->d_name, 0);
    if (folder)
        closedir(folder);
}

void reducer_begin(struct reducer *reducer, const char *folder)
{
    *reducer = (struct reducer){.folder = folder};
    /* one level: an administrator makes the folders above it */
    if (folder[0])
        mkdir(folder, 0755);
    reducer_forget(reducer, true);
}

void reducer_retry(struct reducer *reducer)
{
    reducer->halted[0] = '\0';
    reducer_forget(reducer, false);
}

static void reducer_drop_files(struct reducer *reducer)
{
    for (int i = 0; i < REDUCER_FILES; i++) {
        if (reducer->files[i])
            unlink(reducer->files[i]);
        free(reducer->files[i]);
        reducer->files[i] = NULL;
    }
}

/* Sets the message to clients that ask for the body; two bodies may be of one mesh. */
static void __attribute__((format(printf, 4, 5)))
reducer_tell(const struct reducer *reducer, const struct body_set *set, enum percuss_status status,
             const char *format, ...)
{
    char text[BODY_NEWS_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (size_t i = 0; i < set->order_count; i++)
        if (strcmp(set->orders[i].name, reducer->name) == 0)
            body_order_tell(&set->orders[i], status, "%s", text);
}

static void __attribute__((format(printf, 2, 3)))
reducer_halt(struct reducer *reducer, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reducer->halted, sizeof reducer->halted, format, arguments);
    va_end(arguments);
}

/* PATH of a result in the folder, for free(); NULL: no memory. */
static char *result_path(const struct reducer *reducer, const char *name, const char *suffix)
{
    char *path;
    return asprintf(&path, "%s/%s%s", reducer->folder, name, suffix) < 0 ? NULL : path;
}

/* Files of this process alone, as several daemons may share the folder. */
static bool reducer_name_files(struct reducer *reducer)
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

static bool reducer_write_text(const char *path, const char *text)
{
    struct atomic_file aside;
    int file = path ? atomic_file_create(&aside, path, 0666, NULL) : -1;
    if (file < 0)
        return false;
    /* less than all is written where there is no more room */
    errno = ENOSPC;
    bool good = write(file, text, strlen(text)) == (ssize_t)strlen(text);
    int reason = errno;
    close(file);
    if (good)
        return !atomic_file_finish(&aside, false, NULL);
    atomic_file_abandon(&aside);
    errno = reason;
    return false;
}

/* The program beside this one, else the one that PATH finds. */
static void reducer_find_program(char path[PATH_MAX])
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

/* 0, or an error's number. The child blocks and ignores no signals. */
static int reducer_spawn(struct reducer *reducer, char **arguments)
{
    char program[PATH_MAX];
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, pipe;
    reducer_find_program(program);
    unlink(reducer->files[MESSAGES]);
    /* messages go to their file; the child has no other descriptor of ours */
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, reducer->files[MESSAGES],
                                     O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0644);
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

/* What the child does, for those who wait for it. */
static const char *reducer_work(const struct reducer *reducer)
{
    return reducer->adding ? "its flexibility there is being solved for"
                           : "its mesh is being reduced";
}

/* Runs percuss-reduce for the order with these arguments, unless an error's number says why not. */
static void reducer_run(struct reducer *reducer, const struct body_set *set,
                        const struct body_order *order, char **arguments, int error)
{
    reducer->done = 0.0;
    if (!error)
        error = reducer_spawn(reducer, arguments);
    if (!error) {
        log_line(LEVEL_INFO, "%s: %s%s %s by process %d, its messages in %s", order->id,
                 reducer->adding ? "flexibility of " : "", order->mesh,
                 reducer->adding ? "is being solved for" : "is being reduced", (int)reducer->child,
                 reducer->files[MESSAGES]);
        reducer_tell(reducer, set, PERCUSS_BUSY, "%s: ask again later", reducer_work(reducer));
        return;
    }
    reducer_halt(reducer, "percuss-reduce or %.300s: %s", reducer->folder, strerror(error));
    log_line(LEVEL_ERROR, "%s: %s cannot be reduced: %s; SIGHUP tries again", order->id,
             order->mesh, reducer->halted);
    reducer_drop_files(reducer);
}

/* Names the child's order and its files: 0, or an error's number. */
static int reducer_prepare(struct reducer *reducer, const struct body_order *order, bool adding)
{
    reducer->adding = adding;
    snprintf(reducer->id, sizeof reducer->id, "%s", order->id);
    snprintf(reducer->name, sizeof reducer->name, "%s", order->name);
    return reducer_name_files(reducer) ? 0 : ENOMEM;
}

static void reducer_start(struct reducer *reducer, const struct body_set *set,
                          const struct body_order *order)
{
    char name[] = "percuss-reduce", progress[] = "--progress=1";
    char output[] = "-o", catalogue[] = "-C", files[] = "--";
    char *arguments[BODY_ORDER_ARGUMENTS + 9] = {name, progress};
    size_t count = 2;
    int error = reducer_prepare(reducer, order, false);
    /* the order's options, and the files */
    for (size_t i = 0; i < order->argument_count; i++)
        arguments[count++] = order->arguments[i];
    arguments[count++] = output;
    arguments[count++] = reducer->files[BODY];
    if (order->material[0]) {
        arguments[count++] = catalogue;
        arguments[count++] = reducer->files[MATERIAL];
        if (!error && !reducer_write_text(reducer->files[MATERIAL], order->material))
            error = errno;
    }
    arguments[count++] = files;
    arguments[count++] = order->mesh;
    reducer_run(reducer, set, order, arguments, error);
}

/* Has the places that requests wait for added to the order's body, which is there. */
static void reducer_start_adding(struct reducer *reducer, const struct body_set *set,
                                 const struct body_order *order, size_t place_count,
                                 double places[][3])
{
    char name[] = "percuss-reduce", progress[] = "--progress=1";
    char add[] = "--add-sites", files[] = "--", sites[BODY_ORDER_PLACES][96];
    char *body = result_path(reducer, order->name, ".h5");
    char *arguments[BODY_ORDER_PLACES + 8] = {name, progress, add, body};
    size_t count = 4;
    int error = reducer_prepare(reducer, order, true);
    for (size_t i = 0; i < place_count; i++) {
        snprintf(sites[i], sizeof sites[i], "--site=%.17g,%.17g,%.17g", places[i][0], places[i][1],
                 places[i][2]);
        arguments[count++] = sites[i];
    }
    arguments[count++] = files;
    arguments[count++] = order->mesh;
    reducer_run(reducer, set, order, arguments, body ? error : ENOMEM);
    free(body);
}

/* Reads the child's progress: its last line, "percuss-reduce:  43.2 %  modes, 12 s left". */
static void reducer_follow(struct reducer *reducer, const struct body_set *set)
{
    char text[2048], *line, *rest = text, stage[120] = "";
    double percent;
    int read;
    FILE *file = fopen(reducer->files[MESSAGES], "re");
    if (!file)
        return;
    /* the end of its messages, which may begin within a line */
    fseek(file, -(long)(sizeof text - 1), SEEK_END);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    while ((line = strsep(&rest, "\n"))) {
        read = 0;
        if (rest && sscanf(line, "percuss-reduce: %lf %% %n", &percent, &read) == 1 && read > 0) {
            snprintf(stage, sizeof stage, "%s", line + read);
            reducer->done = percent / 100.0;
        }
    }
    if (stage[0])
        reducer_tell(reducer, set, PERCUSS_BUSY, "%s, %.0f %% (%s): ask again later",
                     reducer_work(reducer), 100.0 * reducer->done, stage);
    else
        reducer_tell(reducer, set, PERCUSS_BUSY, "%s: ask again later", reducer_work(reducer));
}

/* The last line of the child's messages. */
static void reducer_last_message(const char *path, char text[400])
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

/* The reason why the child failed. */
static void reducer_reason(const struct reducer *reducer, int status, char reason[400])
{
    if (WIFSIGNALED(status))
        snprintf(reason, 400, "percuss-reduce was ended by signal %d", WTERMSIG(status));
    else
        reducer_last_message(reducer->files[MESSAGES], reason);
}

/* The child has added sites to the body's file itself, or failed: true where the catalogue is to be
 * loaded again. Requests have the reason of a failure until then. */
static bool reducer_conclude_adding(struct reducer *reducer, const struct body_set *set, int status)
{
    char reason[400];
    bool made = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (made) {
        log_line(LEVEL_INFO, "%s: sites added", reducer->id);
        reducer_tell(reducer, set, PERCUSS_BUSY,
                     "its flexibility there is solved for and being loaded: ask again");
    } else {
        reducer_reason(reducer, status, reason);
        log_line(LEVEL_ERROR, "%s: sites could not be added: %s; SIGHUP tries again", reducer->id,
                 reason);
        reducer_tell(
            reducer, set, PERCUSS_UNSUPPORTED_GEOMETRY,
            "its flexibility could not be solved for at places on it: %s; SIGHUP to percussd "
            "tries again",
            reason);
    }
    reducer_drop_files(reducer);
    return made;
}

/* Puts the child's body, or the reason of its failure, where the catalogue finds it. */
static void reducer_conclude(struct reducer *reducer, const struct body_set *set, int status)
{
    char reason[400];
    bool made = WIFEXITED(status) && WEXITSTATUS(status) == 0, noted;
    char *path = result_path(reducer, reducer->name,
                             made                  ? ".h5"
                             : WIFSIGNALED(status) ? KILLED
                                                   : REFUSED);
    if (made) {
        /* a body under its final name is whole, even after a crash of the machine */
        noted = path && !atomic_file_rename(reducer->files[BODY], path, NULL);
        reducer_tell(reducer, set, PERCUSS_BUSY, "its mesh is reduced and being loaded: ask again");
    } else {
        reducer_reason(reducer, status, reason);
        log_line(LEVEL_ERROR, "%s: could not be reduced: %s", reducer->id, reason);
        noted = path && reducer_write_text(path, reason);
        reducer_tell(reducer, set, PERCUSS_UNKNOWN_BODY, "its mesh could not be reduced: %s",
                     reason);
    }
    if (made && noted)
        log_line(LEVEL_INFO, "%s: reduced", reducer->id);
    if (!noted) {
        reducer_halt(reducer, "%.300s: cannot be written", reducer->folder);
        log_line(LEVEL_ERROR, "%s: nothing more is reduced until SIGHUP", reducer->halted);
    }
    free(path);
    reducer_drop_files(reducer);
}

void reducer_unloaded(const struct reducer *reducer, const struct body_set *set,
                      const struct fault *fault)
{
    for (size_t i = 0; i < set->order_count; i++) {
        const struct body_order *order = &set->orders[i];
        /* with the body, or with more places of one that it has */
        if (order->made && order->later)
            body_order_tell(order, PERCUSS_UNSUPPORTED_GEOMETRY,
                            "the catalogue cannot be loaded with places on it that were solved "
                            "for: %.380s",
                            fault->text);
        char *path =
            order->made || order->missing ? NULL : result_path(reducer, order->name, ".h5");
        if (path && access(path, F_OK) == 0)
            body_order_tell(
                order, PERCUSS_UNKNOWN_BODY,
                "its mesh is reduced, but the catalogue cannot be loaded with it: %.380s",
                fault->text);
        free(path);
    }
}

/* Whether the folder has neither an order's body nor the reason of its failure. */
static bool reducer_order_is_open(const struct reducer *reducer, const struct body_order *order)
{
    static const char *const suffixes[] = {".h5", REFUSED, KILLED};
    bool open = !order->missing;
    for (size_t i = 0; open && i < sizeof suffixes / sizeof *suffixes; i++) {
        char *path = result_path(reducer, order->name, suffixes[i]);
        open = path && access(path, F_OK) != 0;
        free(path);
    }
    return open;
}

/* Has the places that are wanted of a body solved for; the named sites of one that has none yet all
 * together. After a failure nothing more is tried. */
static void reducer_look_for_places(struct reducer *reducer, const struct body_set *set,
                                    const struct body_order *order)
{
    double places[BODY_ORDER_PLACES][3];
    const struct body *body = body_set_find(set, order->id);
    if (!order->made || !order->later || !body || !body->mesh ||
        body_order_news(order).status != PERCUSS_BUSY)
        return;
    if (body->mesh->added_count == 0)
        body_order_want_sites(order, body);
    size_t count = body_order_take(order, places);
    if (count == 0)
        return;
    if (!reducer->halted[0])
        reducer_start_adding(reducer, set, order, count, places);
    if (!reducer->child)
        body_order_tell(order, PERCUSS_UNSUPPORTED_GEOMETRY,
                        "its flexibility at further places cannot be solved for: %s; the server's "
                        "log says more",
                        reducer->halted);
}

bool reducer_look(struct reducer *reducer, const struct body_set *set)
{
    int status;
    /* the running child */
    if (reducer->child) {
        pid_t ended = waitpid(reducer->child, &status, WNOHANG);
        if (ended != reducer->child) {
            reducer_follow(reducer, set);
            return false;
        }
        reducer->child = 0;
        if (reducer->adding)
            return reducer_conclude_adding(reducer, set, status);
        reducer_conclude(reducer, set, status);
        return true;
    }
    /* sites, for which requests wait */
    for (size_t i = 0; !reducer->child && i < set->order_count; i++)
        reducer_look_for_places(reducer, set, &set->orders[i]);
    /* or the next one */
    for (size_t i = 0; !reducer->child && i < set->order_count; i++) {
        const struct body_order *order = &set->orders[i];
        if (!reducer_order_is_open(reducer, order))
            continue;
        if (!reducer->halted[0])
            reducer_start(reducer, set, order);
        if (reducer->child)
            break;
        body_order_tell(order, PERCUSS_UNKNOWN_BODY,
                        "its mesh cannot be reduced: %s; the server's log says more",
                        reducer->halted);
    }
    return false;
}

void reducer_end(struct reducer *reducer)
{
    reducer_halt(reducer, "the server is shutting down");
    if (!reducer->child)
        return;
    /* it leaves no state behind; the signal ends Gmsh, which it may run, too */
    kill(-reducer->child, SIGKILL);
    waitpid(reducer->child, NULL, 0);
    reducer->child = 0;
    reducer_drop_files(reducer);
}

enum percuss_status reducer_check_folder(const char *folder, struct fault *fault)
{
    return limits_check_place(folder, W_OK | X_OK, fault);
}
