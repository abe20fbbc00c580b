/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_daemons.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_SIZE = 64, MOST_SOCKETS = 256 };

static const char NAME[] = "percussd";
static const char VARIABLE[] = "CYCLONEDDS_URI";

static FILE *open_of(long process, const char *file)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "/proc/%ld/%s", process, file);
    return fopen(path, "re");
}

static bool is_daemon(long process)
{
    char name[sizeof NAME + 1] = "";
    FILE *file = open_of(process, "comm");
    bool found = file && fgets(name, sizeof name, file) && strcspn(name, "\n") == strlen(NAME) &&
                 strncmp(name, NAME, strlen(NAME)) == 0;
    if (file)
        fclose(file);
    return found;
}

static bool is_stopped(long process)
{
    char line[64], state = 0;
    FILE *file = open_of(process, "status");
    while (file && !state && fgets(line, sizeof line, file))
        (void)sscanf(line, "State: %c", &state);
    if (file)
        fclose(file);
    return state == 'T' || state == 't';
}

/* The variable of its environment, as it began. False: it may not be read. */
static bool read_configuration(struct wire_daemon *daemon)
{
    char *entry = NULL;
    size_t room = 0, length = strlen(VARIABLE);
    FILE *file = open_of(daemon->process, "environ");
    if (!file)
        return false;
    while (getdelim(&entry, &room, '\0', file) > 0)
        if (strncmp(entry, VARIABLE, length) == 0 && entry[length] == '=')
            snprintf(daemon->configuration, sizeof daemon->configuration, "%s", entry + length + 1);
    free(entry);
    fclose(file);
    return true;
}

/* Inodes of its sockets; false: they may not be read. */
static bool list_sockets(long process, unsigned long sockets[MOST_SOCKETS], size_t *count)
{
    char path[PATH_SIZE], target[PATH_SIZE];
    *count = 0;
    snprintf(path, sizeof path, "/proc/%ld/fd", process);
    DIR *files = opendir(path);
    if (!files)
        return false;
    for (struct dirent *entry; (entry = readdir(files)) && *count < MOST_SOCKETS;) {
        ssize_t length = readlinkat(dirfd(files), entry->d_name, target, sizeof target - 1);
        target[length > 0 ? length : 0] = '\0';
        *count += sscanf(target, "socket:[%lu]", &sockets[*count]) == 1;
    }
    closedir(files);
    return true;
}

static bool is_elsewhere(long process)
{
    char path[PATH_SIZE], own[PATH_SIZE] = "", its[PATH_SIZE] = "";
    snprintf(path, sizeof path, "/proc/%ld/ns/net", process);
    bool known = readlink("/proc/self/ns/net", own, sizeof own - 1) > 0 &&
                 readlink(path, its, sizeof its - 1) > 0;
    return known && strcmp(own, its) != 0;
}

static void find_domains(struct wire_daemon *daemon)
{
    unsigned long sockets[MOST_SOCKETS];
    struct wire_ports_owner owner = {.user = daemon->user};
    struct wire_ports *ports = malloc(sizeof *ports);
    if (list_sockets(daemon->process, sockets, &owner.socket_count))
        owner.sockets = sockets;
    FILE *table = open_of(daemon->process, "net/udp");
    if (table && ports) {
        wire_ports_read(table, &owner, ports);
        for (uint32_t domain = 0; domain < WIRE_PORTS_DOMAINS; domain++)
            daemon->domains[domain] = wire_ports_have(ports, domain);
    }
    if (table)
        fclose(table);
    free(ports);
}

/* False: it is none, or has gone meanwhile. */
static bool look_at(long process, struct wire_daemon *daemon)
{
    char path[PATH_SIZE];
    struct stat about;
    snprintf(path, sizeof path, "/proc/%ld", process);
    if (process == getpid() || !is_daemon(process) || stat(path, &about) != 0)
        return false;
    *daemon = (struct wire_daemon){.process = process, .user = about.st_uid};
    daemon->stopped = is_stopped(process);
    daemon->readable = read_configuration(daemon);
    daemon->elsewhere = is_elsewhere(process);
    find_domains(daemon);
    return true;
}

size_t wire_daemons_find(struct wire_daemon *daemons)
{
    size_t count = 0;
    DIR *processes = opendir("/proc");
    if (!processes)
        return 0;
    for (struct dirent *entry; (entry = readdir(processes)) && count < WIRE_DAEMONS_MOST;) {
        long process = strtol(entry->d_name, NULL, 10);
        count += process > 0 && look_at(process, &daemons[count]);
    }
    closedir(processes);
    return count;
}

static const char *own_configuration(void)
{
    const char *uri = getenv(VARIABLE);
    return uri ? uri : "";
}

enum wire_likeness wire_daemon_likeness(const struct wire_daemon *daemon)
{
    if (!daemon->readable)
        return WIRE_UNKNOWN;
    const char *own = own_configuration();
    return strncmp(daemon->configuration, own, sizeof daemon->configuration - 1) == 0 ? WIRE_ALIKE
                                                                                      : WIRE_UNLIKE;
}

/* The part of a configuration that a message has room for. */
#define SHOWN    "%.80s%s"
#define SHOW(of) of, strlen(of) > 80 ? "..." : ""

/* Of those that are not readable only a user's ports are known: each of his may be the one. */
static int name_processes(const struct wire_daemon *first, const struct wire_daemon *end,
                          uint32_t domain, char *text, size_t size)
{
    int length = snprintf(text, size, "; percussd (process %ld", first->process);
    for (const struct wire_daemon *next = first + 1; next < end && (size_t)length < size; next++)
        if (!first->readable && !next->readable && next->user == first->user &&
            next->domains[domain])
            length += snprintf(text + length, size - (size_t)length, " or %ld", next->process);
    if ((size_t)length < size)
        length += snprintf(text + length, size - (size_t)length, ") is there ");
    return length;
}

/* Why one that is there is not heard. */
static void explain_daemon(const struct wire_daemon *daemon, char *text, size_t size)
{
    const char *own = own_configuration(), *its = daemon->configuration;
    const enum wire_likeness likeness = wire_daemon_likeness(daemon);
    if (daemon->stopped)
        snprintf(text, size, "and stopped: kill -CONT %ld", daemon->process);
    else if (daemon->elsewhere)
        snprintf(text, size,
                 "in another network namespace, such as a container's, that is not "
                 "heard here");
    else if (likeness == WIRE_UNKNOWN)
        snprintf(
            text, size,
            "as user %u, whose CYCLONEDDS_URI only that user and root can read; here it is " SHOWN
            ": it must be the same for both",
            daemon->user, SHOW(*own ? own : "not set, so that 127.0.0.1 alone is heard"));
    else if (likeness == WIRE_ALIKE)
        snprintf(text, size,
                 "with the same CYCLONEDDS_URI, and does not announce itself to us (a secured "
                 "one does not, without --security)");
    else if (!*own)
        snprintf(text, size,
                 "with CYCLONEDDS_URI=" SHOWN ", which is not set here, where 127.0.0.1 alone is "
                 "heard: it must be the same for both",
                 SHOW(its));
    else if (!*its)
        snprintf(text, size,
                 "without CYCLONEDDS_URI and hears 127.0.0.1 alone, while here it is " SHOWN
                 ": it must be the same for both",
                 SHOW(own));
    else
        snprintf(text, size,
                 "with CYCLONEDDS_URI=" SHOWN ", while here it is " SHOWN
                 ": it must be the same for both",
                 SHOW(its), SHOW(own));
}

bool wire_daemons_are_in(uint32_t domain)
{
    struct wire_daemon *daemons = calloc(WIRE_DAEMONS_MOST, sizeof *daemons);
    size_t count = daemons ? wire_daemons_find(daemons) : 0;
    bool found = false;
    for (size_t i = 0; i < count; i++)
        found = found || daemons[i].domains[domain];
    free(daemons);
    return found;
}

void wire_daemons_explain(uint32_t domain, char *text, size_t size)
{
    const char *own = own_configuration();
    const struct wire_daemon *there = NULL;
    struct wire_daemon *daemons = calloc(WIRE_DAEMONS_MOST, sizeof *daemons);
    size_t count = daemons ? wire_daemons_find(daemons) : 0;
    /* one whose configuration is another one explains most */
    for (size_t i = 0; i < count; i++)
        if (daemons[i].domains[domain] &&
            (!there || (wire_daemon_likeness(there) == WIRE_ALIKE &&
                        wire_daemon_likeness(&daemons[i]) != WIRE_ALIKE)))
            there = &daemons[i];
    size_t length = 0;
    if (there)
        length = (size_t)name_processes(there, daemons + count, domain, text, size);
    if (there && length < size)
        explain_daemon(there, text + length, size - length);
    else if (*own)
        snprintf(text, size,
                 "; CYCLONEDDS_URI=" SHOWN " says who is heard here: a daemon that has another "
                 "one, or none, may be there",
                 SHOW(own));
    else
        snprintf(text, size, "; CYCLONEDDS_URI is not set: other machines are not heard");
    free(daemons);
}
