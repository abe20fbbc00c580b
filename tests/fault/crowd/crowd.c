/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Clients that burden a service, and one that finds out how it bears it.
 *
 * usage: crowd DOMAIN probe|flood KIND SECONDS [--clients N] [--outstanding N] [--samples N]
 *        crowd DOMAIN steady|pass REQUESTS [--clients N] [--outstanding N] [--specimens N]
 *              [--record FILE]
 *
 * KIND: ping, cheap, slow, long, ensemble. */
#include "crowd.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double PATIENCE = 600.0;  /* s, for an answer: longer than any story */
static const double CONNECTING = 60.0; /* s */

/* Between two questions of a probe, s: short against what is measured, long against what it costs.
 */
static const long PAUSE_NANOSECONDS = 5000000;

double crowd_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

struct percuss_client *crowd_connect(const struct crowd *crowd, const uint8_t *id)
{
    struct percuss_client_config config = percuss_client_config_default();
    struct percuss_client *client;
    config.domain = crowd->domain;
    config.window = 1024;
    if (id)
        memcpy(config.id, id, sizeof config.id);
    if (percuss_client_create(&config, &client) == PERCUSS_RESULT_OK &&
        percuss_client_connect(client, CONNECTING) == PERCUSS_RESULT_OK)
        return client;
    fprintf(stderr, "a client: %s\n", percuss_error_text());
    percuss_client_free(client);
    return NULL;
}

static int compare(const void *a, const void *b)
{
    double difference = *(const double *)a - *(const double *)b;
    return (difference > 0.0) - (difference < 0.0);
}

/* The share `p` of all takes no longer. */
static double quantile(const double *sorted, size_t count, double p)
{
    size_t rank = (size_t)(p * (double)count);
    return count ? sorted[rank < count ? rank : count - 1] : 0.0;
}

bool crowd_probe(const struct crowd *crowd)
{
    enum { MOST = 1000000 };
    static double times[MOST];
    struct percuss_client *client = crowd_connect(crowd, NULL);
    size_t count = 0, busy = 0;
    const char *problem = client ? NULL : "not connected";
    double end = crowd_now() + crowd->seconds;
    while (!problem && count + busy < MOST && (crowd_now() < end || count == 0)) {
        enum percuss_status status;
        double start = crowd_now();
        if (question_ask(client, crowd->kind, count + busy, crowd->samples, PATIENCE, &status))
            problem = percuss_error_text();
        else if (status == PERCUSS_BUSY)
            busy++;
        else if (status != PERCUSS_OK)
            problem = percuss_status_name(status);
        else
            times[count++] = crowd_now() - start;
        nanosleep(&(struct timespec){.tv_nsec = PAUSE_NANOSECONDS}, NULL);
    }
    qsort(times, count, sizeof *times, compare);
    printf("%-8s %6zu answered, %4zu busy: p50 %8.2f ms, p99 %8.2f ms, max %8.2f ms\n",
           question_name(crowd->kind), count, busy, 1e3 * quantile(times, count, 0.5),
           1e3 * quantile(times, count, 0.99), 1e3 * quantile(times, count, 1.0));
    if (problem)
        fprintf(stderr, "%s\n", problem);
    percuss_client_free(client);
    return !problem;
}

/* One client of a flood. */
struct flooder {
    const struct crowd *crowd;
    unsigned number;
    double end;
    unsigned long answered, busy, others;
    double busy_longest; /* s from a question to its refusal */
    bool good;
    pthread_t thread;
};

static void tally(struct flooder *flooder, enum percuss_status status, double seconds)
{
    *(status == PERCUSS_OK     ? &flooder->answered
      : status == PERCUSS_BUSY ? &flooder->busy
                               : &flooder->others) += 1;
    if (status == PERCUSS_BUSY && seconds > flooder->busy_longest)
        flooder->busy_longest = seconds;
}

/* Keeps requests outstanding; the client counts them from 1. */
static bool pour(struct flooder *flooder, struct percuss_client *client)
{
    enum { MOST = 1024 };
    static _Thread_local struct percuss_request request;
    double sent[MOST];
    unsigned outstanding = 0;
    unsigned long block = 100000ul * (1 + flooder->number), count = 0;
    while (crowd_now() < flooder->end) {
        for (; outstanding < flooder->crowd->outstanding; outstanding++) {
            question_fill(flooder->crowd->kind, block + count++, &request);
            sent[count % MOST] = crowd_now();
            if (percuss_submit(client, &request, NULL))
                return false;
        }
        struct percuss_reply reply;
        enum percuss_result result =
            percuss_wait(client, 0, fmax(0.0, flooder->end - crowd_now()), &reply);
        if (result == PERCUSS_RESULT_TIMEOUT)
            return true;
        if (result)
            return false;
        tally(flooder, reply.status, crowd_now() - sent[reply.sequence % MOST]);
        outstanding--;
        percuss_reply_free(&reply);
    }
    return true;
}

static void *flood(void *argument)
{
    struct flooder *flooder = argument;
    const struct crowd *crowd = flooder->crowd;
    struct percuss_client *client = crowd_connect(crowd, NULL);
    flooder->end = crowd_now() + crowd->seconds;
    flooder->good = client != NULL;
    if (client && crowd->kind == QUESTION_ENSEMBLE) {
        enum percuss_status status = PERCUSS_OK;
        flooder->good = question_ask(client, crowd->kind, flooder->number, crowd->samples, PATIENCE,
                                     &status) == PERCUSS_RESULT_OK;
        tally(flooder, status, 0.0);
    } else if (client) {
        flooder->good = pour(flooder, client);
    }
    if (!flooder->good)
        fprintf(stderr, "%s\n", percuss_error_text());
    percuss_client_free(client);
    return NULL;
}

bool crowd_flood(const struct crowd *crowd)
{
    struct flooder *all = calloc(crowd->clients, sizeof *all);
    struct flooder sum = {.good = all != NULL};
    for (unsigned i = 0; all && i < crowd->clients; i++) {
        all[i] = (struct flooder){.crowd = crowd, .number = i};
        if (pthread_create(&all[i].thread, NULL, flood, &all[i]))
            abort();
    }
    for (unsigned i = 0; all && i < crowd->clients; i++) {
        pthread_join(all[i].thread, NULL);
        sum.good = sum.good && all[i].good;
        sum.answered += all[i].answered;
        sum.busy += all[i].busy;
        sum.others += all[i].others;
        sum.busy_longest = fmax(sum.busy_longest, all[i].busy_longest);
    }
    printf("%u clients, %u outstanding each: %.0f answered/s, %.0f BUSY/s (the slowest after %.1f "
           "ms), %lu others\n",
           crowd->clients, crowd->outstanding, (double)sum.answered / crowd->seconds,
           (double)sum.busy / crowd->seconds, 1e3 * sum.busy_longest, sum.others);
    free(all);
    return sum.good;
}

static const struct {
    const char *name;
    bool (*act)(const struct crowd *crowd);
    bool counts; /* requests, not seconds of a kind */
} acts[] = {{"probe", crowd_probe, false},
            {"flood", crowd_flood, false},
            {"steady", crowd_steady, true},
            {"pass", crowd_pass, true}};
enum { ACT_COUNT = sizeof acts / sizeof *acts };

static bool read_option(struct crowd *crowd, const char *name, const char *value)
{
    unsigned long number = strtoul(value, NULL, 10);
    if (strcmp(name, "--clients") == 0)
        crowd->clients = (unsigned)number;
    else if (strcmp(name, "--outstanding") == 0)
        crowd->outstanding = (unsigned)number;
    else if (strcmp(name, "--specimens") == 0)
        crowd->specimens = (unsigned)number;
    else if (strcmp(name, "--samples") == 0)
        crowd->samples = number;
    else if (strcmp(name, "--record") == 0)
        crowd->record = value;
    else
        return false;
    return true;
}

int main(int argc, char **argv)
{
    struct crowd crowd = {.clients = 1, .outstanding = 1, .samples = 1000};
    size_t act = 0;
    while (argc > 3 && act < ACT_COUNT && strcmp(acts[act].name, argv[2]) != 0)
        act++;
    bool good = argc > 3 && act < ACT_COUNT && (acts[act].counts || argc > 4);
    int next = good ? (acts[act].counts ? 4 : 5) : argc;
    if (good) {
        crowd.domain = (uint32_t)strtoul(argv[1], NULL, 10);
        crowd.requests = strtoul(argv[3], NULL, 10);
        crowd.kind = acts[act].counts ? QUESTION_CHEAP : question_find(argv[3]);
        crowd.seconds = acts[act].counts ? 0.0 : strtod(argv[4], NULL);
    }
    for (; good && next < argc; next += 2)
        good = next + 1 < argc && read_option(&crowd, argv[next], argv[next + 1]);
    if (!good || crowd.kind == QUESTION_COUNT) {
        fprintf(stderr, "usage: see the head of crowd.c\n");
        return 2;
    }
    return acts[act].act(&crowd) ? EXIT_SUCCESS : EXIT_FAILURE;
}
