/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A program that forks with a client that is connected: in the child the client and a new one say
 * that they cannot work, and are freed at once; the parent's goes on. A child that was forked
 * before has clients of its own. usage: forked_client DOMAIN */
#include <percuss/percuss.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* s; what waits for a thread that is not there waits for ever */
enum { CHILD_SECONDS = 20 };
static const double patience = 20.0;

static void check(int good, const char *what)
{
    if (good)
        return;
    fprintf(stderr, "%s: %s\n", what, percuss_error_text());
    exit(EXIT_FAILURE);
}

static struct percuss_client *connect_client(uint32_t domain)
{
    struct percuss_client *client;
    struct percuss_client_config config = percuss_client_config_default();
    config.domain = domain;
    check(percuss_client_create(&config, &client) == PERCUSS_RESULT_OK, "create");
    check(percuss_client_connect(client, patience) == PERCUSS_RESULT_OK, "connect");
    return client;
}

static int is_refused(enum percuss_result result)
{
    return result == PERCUSS_RESULT_TRANSPORT && strstr(percuss_error_text(), "child of a fork()");
}

static void live_as_child(struct percuss_client *client, uint32_t domain)
{
    double seconds;
    struct percuss_server_list servers;
    struct percuss_reply reply;
    uint64_t sequence = 9;
    struct percuss_request *request = calloc(1, sizeof *request);
    struct percuss_client_config config = percuss_client_config_default();
    alarm(CHILD_SECONDS);
    check(is_refused(percuss_ping(client, patience, &seconds)), "ping");
    check(is_refused(percuss_solve(client, request, patience, &reply)), "solve");
    check(is_refused(percuss_submit(client, request, &sequence)) && sequence == 0, "submit");
    check(is_refused(percuss_wait(client, 1, patience, &reply)), "wait");
    check(is_refused(percuss_servers(client, patience, &servers)) && servers.count == 0, "servers");
    percuss_client_free(client);
    config.domain = domain;
    check(is_refused(percuss_client_create(&config, &client)) && !client, "create");
    free(request);
    exit(EXIT_SUCCESS);
}

static void is_well(pid_t child, const char *what)
{
    int status;
    if (waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return;
    fprintf(stderr, "%s: status %#x\n", what, (unsigned)status);
    exit(EXIT_FAILURE);
}

int main(int argc, char **argv)
{
    uint32_t domain = argc == 2 ? (uint32_t)strtoul(argv[1], NULL, 10) : 0;
    double seconds;
    /* before there is a client */
    pid_t child = fork();
    if (child == 0) {
        alarm(CHILD_SECONDS);
        percuss_client_free(connect_client(domain));
        exit(EXIT_SUCCESS);
    }
    is_well(child, "a child before");
    struct percuss_client *client = connect_client(domain);
    child = fork();
    if (child == 0)
        live_as_child(client, domain);
    is_well(child, "a child of a client");
    check(percuss_ping(client, patience, &seconds) == PERCUSS_RESULT_OK, "ping of the parent");
    percuss_client_free(client);
    /* DDS stays in a process that has freed its clients */
    child = fork();
    if (child == 0) {
        struct percuss_client_config config = percuss_client_config_default();
        alarm(CHILD_SECONDS);
        config.domain = domain;
        check(is_refused(percuss_client_create(&config, &client)), "create");
        exit(EXIT_SUCCESS);
    }
    is_well(child, "a child after");
    puts("ok");
    return EXIT_SUCCESS;
}
