/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What clients cost that ask nothing: processor time of clients that are connected or wait for a
 * server, and of their server. See docs/lab/reliability.md. */
#include <limits.h>
#include <percuss/percuss.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "children.h"

static const char usage[] =
    "usage: idle_clients [--clients N] [--seconds S] [--absent] [--most CORES]\n"
    "Starts a percussd and clients for itself, loopback only in a random domain, one process "
    "each,\n"
    "and prints what they take of a processor while nobody asks anything.\n"
    "  --clients N   processes (100)\n"
    "  --seconds S   for which the processor time is counted (20)\n"
    "  --absent      no percussd: the clients wait for one\n"
    "  --most CORES  fails where all of them take more\n"
    "  --percussd FILE, --settings FILE  otherwise those of this build\n";

enum { MOST_CLIENTS = CHILDREN_MOST - 1 };
static const double patience = 300.0; /* s until the last one is connected */

struct options {
    int clients;
    double seconds, most;
    bool absent;
    char *percussd, *settings; /* NULL: the default */
};

static _Noreturn void fail(const char *what)
{
    fprintf(stderr, "idle_clients: %s\n", what);
    exit(EXIT_FAILURE);
}

/* The life of a client: says on `ready` that it is connected, or begins to wait, and stays. */
static _Noreturn void be_client(const char *domain, int ready, bool absent)
{
    struct percuss_client_config config = percuss_client_config_default();
    struct percuss_client *client;
    config.domain = (uint32_t)strtoul(domain, NULL, 10);
    if (percuss_client_create(&config, &client) != PERCUSS_RESULT_OK)
        fail(percuss_error_text());
    if (!absent && percuss_client_connect(client, patience) != PERCUSS_RESULT_OK)
        fail(percuss_error_text());
    if (write(ready, "", 1) != 1)
        fail("nobody waits for it");
    if (absent)
        percuss_client_connect(client, 1e6);
    for (;;)
        pause();
}

/* The path of this program, BUILD/tests/bench/idle_clients, without its last `parts`. */
static const char *own_path(int parts)
{
    static char path[PATH_MAX];
    ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
    if (length < 0)
        fail("/proc/self/exe cannot be read");
    path[length] = '\0';
    while (parts-- > 0 && strrchr(path, '/'))
        *strrchr(path, '/') = '\0';
    return path;
}

static pid_t start_daemon(const struct options *options, char *domain)
{
    static char daemon[PATH_MAX + 32];
    snprintf(daemon, sizeof daemon, "%s/bin/percussd", own_path(3));
    char *arguments[] = {options->percussd ? options->percussd : daemon,
                         "--config",
                         options->settings ? options->settings
                                           : PERCUSS_SOURCE_DIR "/config/percussd.yaml",
                         "--domain",
                         domain,
                         NULL};
    return children_start(arguments);
}

/* Starts the clients; returns when the last one is connected, or waits. */
static void start_clients(const struct options *options, char *domain, pid_t clients[])
{
    char self[PATH_MAX], ready[16], byte;
    int pipes[2];
    if (pipe(pipes) != 0)
        fail("no pipe");
    snprintf(self, sizeof self, "%s", own_path(0));
    snprintf(ready, sizeof ready, "%d", pipes[1]);
    char *arguments[] = {self, "--be", domain, ready, options->absent ? "absent" : NULL, NULL};
    for (int i = 0; i < options->clients; i++)
        clients[i] = children_start(arguments);
    close(pipes[1]);
    for (int i = 0; i < options->clients; i++)
        if (read(pipes[0], &byte, 1) != 1)
            fail("the clients ended");
    close(pipes[0]);
}

static double sum_cpu(const pid_t processes[], int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++)
        sum += children_cpu(processes[i]);
    return sum;
}

static bool read_options(int argc, char **argv, struct options *options)
{
    *options = (struct options){.clients = 100, .seconds = 20.0};
    for (int i = 1; i < argc; i++) {
        bool valued = i + 1 < argc;
        if (strcmp(argv[i], "--absent") == 0)
            options->absent = true;
        else if (valued && strcmp(argv[i], "--clients") == 0)
            options->clients = atoi(argv[++i]);
        else if (valued && strcmp(argv[i], "--seconds") == 0)
            options->seconds = strtod(argv[++i], NULL);
        else if (valued && strcmp(argv[i], "--most") == 0)
            options->most = strtod(argv[++i], NULL);
        else if (valued && strcmp(argv[i], "--percussd") == 0)
            options->percussd = argv[++i];
        else if (valued && strcmp(argv[i], "--settings") == 0)
            options->settings = argv[++i];
        else
            return false;
    }
    return options->clients > 0 && options->clients <= MOST_CLIENTS && options->seconds > 0.0;
}

int main(int argc, char **argv)
{
    struct options options;
    pid_t daemon = 0, clients[MOST_CLIENTS];
    char domain[16];
    if (argc >= 4 && strcmp(argv[1], "--be") == 0)
        be_client(argv[2], atoi(argv[3]), argc > 4);
    if (!read_options(argc, argv, &options)) {
        fputs(usage, stderr);
        return 2;
    }
    snprintf(domain, sizeof domain, "%u", children_domain());
    if (!options.absent)
        daemon = start_daemon(&options, domain);
    start_clients(&options, domain, clients);
    /* what finding each other costs is over by then */
    sleep(5);
    const double before = sum_cpu(clients, options.clients),
                 own = daemon ? children_cpu(daemon) : 0;
    usleep((useconds_t)(1e6 * options.seconds));
    const double after = sum_cpu(clients, options.clients);
    const double all = (after - before) / options.seconds;
    const double server = daemon ? (children_cpu(daemon) - own) / options.seconds : 0.0;
    children_check();
    printf("%d clients %s: %.4f of a processor, percussd %.4f\n", options.clients,
           options.absent ? "that wait for a server" : "that ask nothing", all, server);
    if (options.most > 0.0 && all + server > options.most)
        fail("that is more than allowed");
    return EXIT_SUCCESS;
}
