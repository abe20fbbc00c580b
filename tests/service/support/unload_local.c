/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A program that loads libpercuss-local as a plugin does, asks two clients in two threads that
 * outlive the library, and unloads it, a hundred times: the memory of the process does not grow,
 * and nothing of the library stays. usage: unload_local LIBRARY CATALOGUE */
#include <dlfcn.h>
#include <percuss/local.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CLIENTS = 2, ROUNDS = 100, WARM = 20 };

/* kB; a round loses some hundred if it loses anything that matters, the allocator's disorder is
 * some thousand in all */
static const long MOST_GROWTH = 4000;

static const char *library, *catalogue;
static pthread_barrier_t asked, unloaded;

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

static void check(void *handle, enum percuss_result result, const char *what)
{
    if (result == PERCUSS_RESULT_OK)
        return;
    fprintf(stderr, "%s: %s\n", what, FIND(handle, percuss_error_text)());
    exit(EXIT_FAILURE);
}

/* One impact of the catalogue's bodies. */
static double ask(void *handle)
{
    struct percuss_client *client;
    struct percuss_body_list bodies;
    static _Thread_local struct percuss_request request;
    struct percuss_reply reply;
    struct percuss_local_config config = FIND(handle, percuss_local_config_default)();
    config.catalogue = catalogue;
    check(handle, FIND(handle, percuss_local_open)(&config, &client), "open");
    check(handle, FIND(handle, percuss_bodies)(client, 1.0, &bodies), "bodies");
    struct percuss_pair pair =
        FIND(handle, percuss_pair_default)(FIND(handle, percuss_body_find)(&bodies, "steel-sphere"),
                                           FIND(handle, percuss_body_find)(&bodies, "al-beam"));
    pair.speed = 0.3;
    check(handle, FIND(handle, percuss_contact_pair)(&pair, &request), "pair");
    check(handle, FIND(handle, percuss_solve)(client, &request, 60.0, &reply), "solve");
    double restitution = reply.status == PERCUSS_OK ? reply.contacts[0].restitution : -1.0;
    FIND(handle, percuss_reply_free)(&reply);
    FIND(handle, percuss_body_list_free)(&bodies);
    FIND(handle, percuss_client_free)(client);
    return restitution;
}

static void *handle;
static double restitution[CLIENTS];

/* Asks, and ends when the library is not there any more. */
static void *work(void *place)
{
    *(double *)place = ask(handle);
    pthread_barrier_wait(&asked);
    pthread_barrier_wait(&unloaded);
    return NULL;
}

static void load_and_unload(void)
{
    pthread_t threads[CLIENTS];
    handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
        fprintf(stderr, "%s\n", dlerror());
        exit(EXIT_FAILURE);
    }
    for (int i = 0; i < CLIENTS; i++)
        if (pthread_create(&threads[i], NULL, work, &restitution[i]) != 0)
            exit(EXIT_FAILURE);
    pthread_barrier_wait(&asked);
    if (dlclose(handle) != 0)
        exit(EXIT_FAILURE);
    pthread_barrier_wait(&unloaded);
    for (int i = 0; i < CLIENTS; i++)
        pthread_join(threads[i], NULL);
}

/* The memory of this process, kB, and whether a file of that name is mapped. */
static long resident(void)
{
    char line[256];
    long size = 0;
    FILE *status = fopen("/proc/self/status", "re");
    while (status && fgets(line, sizeof line, status))
        sscanf(line, "VmRSS: %ld", &size);
    fclose(status);
    return size;
}

static bool is_mapped(const char *name)
{
    char line[4096];
    bool found = false;
    FILE *maps = fopen("/proc/self/maps", "re");
    while (maps && fgets(line, sizeof line, maps))
        found = found || strstr(line, name);
    fclose(maps);
    return found;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: unload_local LIBRARY CATALOGUE\n");
        return 2;
    }
    library = argv[1];
    catalogue = argv[2];
    pthread_barrier_init(&asked, NULL, CLIENTS + 1);
    pthread_barrier_init(&unloaded, NULL, CLIENTS + 1);
    long before = 0;
    for (int i = 0; i < ROUNDS; i++) {
        load_and_unload();
        if (i == WARM)
            before = resident();
    }
    long growth = resident() - before;
    if (is_mapped("libpercuss")) {
        fprintf(stderr, "the library is still there\n");
        return EXIT_FAILURE;
    }
    if (growth > MOST_GROWTH) {
        fprintf(stderr, "the process has grown by %ld kB\n", growth);
        return EXIT_FAILURE;
    }
    printf("%d times loaded and unloaded, restitution %.17g %.17g\n", ROUNDS, restitution[0],
           restitution[1]);
    return EXIT_SUCCESS;
}
