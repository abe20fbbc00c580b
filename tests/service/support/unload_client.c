/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A program that loads libpercuss as a plugin does, asks with two clients, and unloads it: several
 * times, at last from a thread that then ends. usage: unload_client LIBRARY DOMAIN */
#include <dlfcn.h>
#include <percuss/percuss.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { CLIENTS = 2, ROUNDS = 3 };
static const double patience = 20.0; /* s */

static const char *library;
static uint32_t domain;

#define FIND(handle, function) ((__typeof__(&(function)))find(handle, #function))

static void *find(void *handle, const char *name)
{
    void *address = dlsym(handle, name);
    if (!address) {
        fprintf(stderr, "%s\n", dlerror());
        exit(EXIT_FAILURE);
    }
    return address;
}

static void check(enum percuss_result result, const char *what)
{
    if (result == PERCUSS_RESULT_OK)
        return;
    fprintf(stderr, "%s: result %d\n", what, (int)result);
    exit(EXIT_FAILURE);
}

static void ask(void *handle)
{
    struct percuss_client *clients[CLIENTS];
    struct percuss_client_config config = FIND(handle, percuss_client_config_default)();
    config.domain = domain;
    for (int i = 0; i < CLIENTS; i++) {
        check(FIND(handle, percuss_client_create)(&config, &clients[i]), "create");
        check(FIND(handle, percuss_client_connect)(clients[i], patience), "connect");
    }
    for (int i = 0; i < CLIENTS; i++) {
        double seconds;
        check(FIND(handle, percuss_ping)(clients[i], patience, &seconds), "ping");
        FIND(handle, percuss_client_free)(clients[i]);
    }
}

static void *load_and_unload(void *nothing)
{
    void *handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
        fprintf(stderr, "%s\n", dlerror());
        exit(EXIT_FAILURE);
    }
    ask(handle);
    if (dlclose(handle) != 0)
        exit(EXIT_FAILURE);
    return nothing;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: unload_client LIBRARY DOMAIN\n");
        return 2;
    }
    library = argv[1];
    domain = (uint32_t)strtoul(argv[2], NULL, 10);
    for (int i = 0; i < ROUNDS; i++)
        load_and_unload(NULL);
    pthread_t thread;
    if (pthread_create(&thread, NULL, load_and_unload, NULL) != 0 ||
        pthread_join(thread, NULL) != 0)
        return EXIT_FAILURE;
    /* threads of DDS that were left without their code would have run by now */
    struct timespec while_they_run = {.tv_nsec = 300000000};
    nanosleep(&while_they_run, NULL);
    printf("%d times loaded and unloaded\n", ROUNDS + 1);
    return EXIT_SUCCESS;
}
