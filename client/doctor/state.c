/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "state.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "watched.h"

enum { MOST_ARGUMENTS = 32, LINE_SIZE = 900 };
static const char SUBJECT[] = "state";
static const double SECONDS = 20.0; /* every contact table is read */

/* What is not the machine's, or is looked at elsewhere: remarks on bodies, and the domain. */
static bool is_left_out(const char *line)
{
    static const char *const beginnings[] = {"materials.", "bodies.", "no settings are given",
                                             "domain: "};
    for (size_t i = 0; i < sizeof beginnings / sizeof *beginnings; i++)
        if (strncmp(line, beginnings[i], strlen(beginnings[i])) == 0)
            return true;
    return false;
}

/* Of a running daemon: it has its store, and its limits are not those of this shell. */
static bool is_of_running(const char *line, long process)
{
    char held[64];
    snprintf(held, sizeof held, "in use by another process (%ld)", process);
    return strstr(line, held) || strncmp(line, "file descriptors: ", 18) == 0 ||
           strncmp(line, "address space: ", 15) == 0;
}

/* One of its lines. True: it tells of something wrong. */
static bool look_at_line(const char *line, long running, bool good, struct findings *findings)
{
    static const char NAME[] = "percussd: ", WARNING[] = "warning: ";
    if (strncmp(line, NAME, sizeof NAME - 1) != 0)
        return false;
    line += sizeof NAME - 1;
    bool warning = strncmp(line, WARNING, sizeof WARNING - 1) == 0;
    if (warning)
        line += sizeof WARNING - 1;
    /* what is no warning is a remark where nothing is wrong */
    if (is_left_out(line) || (running && is_of_running(line, running)) || (!warning && good))
        return false;
    findings_add(findings, warning ? FINDING_WARNING : FINDING_PROBLEM, SUBJECT,
                 strstr(line, "Permission denied")
                     ? "give the daemon's user that right; where it is not this user: sudo -E "
                       "percuss doctor"
                     : NULL,
                 "%s", line);
    return true;
}

/* Runs it without CYCLONEDDS_URI, which is looked at elsewhere. */
static void run_check(char *const argv[], struct watched *end)
{
    const char *uri = getenv("CYCLONEDDS_URI");
    char *kept = uri ? strdup(uri) : NULL;
    unsetenv("CYCLONEDDS_URI");
    watched_program(argv, SECONDS, end);
    if (kept)
        setenv("CYCLONEDDS_URI", kept, 1);
    free(kept);
}

/* Runs the check and reads what it says. `running`: the daemon's process; 0: none. */
static void check(char *const argv[], long running, struct findings *findings)
{
    struct watched end;
    char line[LINE_SIZE];
    bool wrong = false;
    run_check(argv, &end);
    for (const char *at = end.log ? end.log : ""; *at;) {
        size_t length = strcspn(at, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, at);
        wrong = look_at_line(line, running, end.code == 0, findings) || wrong;
        at += length + (at[length] == '\n');
    }
    free(end.log);
    if (end.code < 0 || end.code > EXIT_FAILURE)
        findings_add(findings, FINDING_WARNING, SUBJECT, NULL, "%s --check-config %s", argv[0],
                     end.late       ? "has not ended in time"
                     : end.code < 0 ? "was ended by a signal"
                                    : "cannot be run");
    else if (!wrong)
        findings_add(findings, FINDING_OK, SUBJECT, NULL,
                     "settings, catalogue, tables, store and its room: %s --check-config finds "
                     "nothing wrong",
                     argv[0]);
}

void state_look_at_start(const char *program, const char *settings, uint32_t domain,
                         struct findings *findings)
{
    char number[16];
    snprintf(number, sizeof number, "%u", domain);
    char *const argv[] = {(char *)program,  "--config", (char *)settings, "--domain", number,
                          "--check-config", NULL};
    check(argv, 0, findings);
}

/* Its arguments in `text`, with room for two more; their number, 0: unknown. */
static size_t read_arguments(long process, char *text, size_t size, char *argv[MOST_ARGUMENTS])
{
    char path[64];
    size_t count = 0;
    snprintf(path, sizeof path, "/proc/%ld/cmdline", process);
    FILE *file = fopen(path, "re");
    size_t length = file ? fread(text, 1, size - 1, file) : 0;
    if (file)
        fclose(file);
    text[length] = '\0';
    for (size_t at = 0; at < length && count < MOST_ARGUMENTS - 2; at += strlen(text + at) + 1)
        argv[count++] = text + at;
    return count;
}

static bool follow(long process, const char *name, char target[PATH_MAX])
{
    char path[64];
    snprintf(path, sizeof path, "/proc/%ld/%s", process, name);
    ssize_t length = readlink(path, target, PATH_MAX - 1);
    target[length > 0 ? length : 0] = '\0';
    return length > 0;
}

/* Whether the process runs this file. Any process may call itself percussd: what it runs is not to
 * be run by another user, least of all by root. */
static bool runs(long process, const char *program)
{
    char path[64];
    struct stat its, ours;
    snprintf(path, sizeof path, "/proc/%ld/exe", process);
    return stat(path, &its) == 0 && stat(program, &ours) == 0 && its.st_dev == ours.st_dev &&
           its.st_ino == ours.st_ino;
}

void state_look_at_running(const struct wire_daemon *daemon, const char *program,
                           struct findings *findings)
{
    char text[4 * PATH_MAX], folder[PATH_MAX], here[PATH_MAX];
    char *argv[MOST_ARGUMENTS];
    size_t count = read_arguments(daemon->process, text, sizeof text, argv);
    if ((geteuid() == 0 || geteuid() == daemon->user) && !runs(daemon->process, program)) {
        findings_add(findings, FINDING_OK, SUBJECT, NULL,
                     "settings and store of process %ld are not looked at: it does not run %s "
                     "(a container's daemon: percuss doctor in the container looks at them)",
                     daemon->process, program);
        return;
    }
    if (count == 0 || !follow(daemon->process, "cwd", folder) ||
        (geteuid() != 0 && geteuid() != daemon->user)) {
        findings_add(
            findings, FINDING_OK, SUBJECT, NULL,
            "settings and store of process %ld are its user's: sudo -E percuss doctor looks "
            "at them",
            daemon->process);
        return;
    }
    if (!getcwd(here, sizeof here) || chdir(folder) != 0)
        return;
    argv[0] = (char *)program;
    argv[count++] = "--check-config";
    argv[count] = NULL;
    check(argv, daemon->process, findings);
    if (chdir(here) != 0)
        fprintf(stderr, "%s: cannot be gone back to\n", here);
}
