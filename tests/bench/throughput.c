/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "throughput.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include "children.h"
#include "samples.h"

static const double patience = 20.0; /* s */

/* What one client does, in a thread of its own. */
struct runner {
    const struct load *load;
    unsigned index;
    bool batches;
    bool good;
    pthread_barrier_t *start;
    struct percuss_client *client;
    struct samples times; /* of a request, or of a batch */
    unsigned long busy;   /* requests refused for the load, and asked again */
    pthread_t thread;
};

/* A speed that no other request of the run has. */
static void fill(const struct runner *runner, unsigned long number, struct percuss_request *request)
{
    unsigned long block = runner->load->requests;
    query_fill(runner->load->query, 1 + runner->index * block + number, request);
}

static bool failed(const char *what)
{
    fprintf(stderr, "%s: %s\n", what, percuss_error_text());
    return false;
}

static bool all_good(const struct percuss_reply *replies, size_t count)
{
    size_t i = 0;
    while (i < count && replies[i].status == PERCUSS_OK)
        i++;
    if (i < count)
        fprintf(stderr, "a reply of the batch: %s\n", replies[i].message);
    return i == count;
}

static bool ask_batches(struct runner *runner)
{
    unsigned size = runner->load->outstanding;
    struct percuss_request *requests = malloc(size * sizeof *requests);
    struct percuss_reply *replies = malloc(size * sizeof *replies);
    bool good = requests && replies;
    for (unsigned done = 0; good && done < runner->load->requests; done += size) {
        for (unsigned i = 0; i < size; i++)
            fill(runner, done + i, &requests[i]);
        double start = samples_now();
        if (percuss_solve_batch(runner->client, requests, size, patience, replies)) {
            good = failed("a batch");
            break;
        }
        samples_add(&runner->times, samples_now() - start);
        good = all_good(replies, size);
        for (unsigned i = 0; i < size; i++)
            percuss_reply_free(&replies[i]);
    }
    free(requests);
    free(replies);
    return good;
}

/* `sequence` 0: a new request, otherwise one that was refused. */
static bool submit(struct runner *runner, uint64_t sequence, unsigned long number)
{
    struct percuss_request request;
    fill(runner, number, &request);
    request.sequence = sequence;
    return percuss_submit(runner->client, &request, NULL) == PERCUSS_RESULT_OK ||
           failed("a request");
}

/* The client counts its requests from 1, so that a sequence tells which one it was. */
static bool ask_pipelined(struct runner *runner)
{
    unsigned all = runner->load->requests, sent = 0, done = 0;
    double *starts = malloc((all + 1) * sizeof *starts);
    bool good = starts != NULL;
    while (good && done < all) {
        for (; good && sent < all && sent - done < runner->load->outstanding; sent++) {
            starts[sent + 1] = samples_now();
            good = submit(runner, 0, sent);
        }
        struct percuss_reply reply;
        if (good && percuss_wait(runner->client, 0, patience, &reply))
            good = failed("a reply");
        if (!good)
            break;
        if (reply.status == PERCUSS_BUSY) {
            runner->busy++;
            good = submit(runner, reply.sequence, reply.sequence - 1);
        } else {
            good = all_good(&reply, 1);
            samples_add(&runner->times, samples_now() - starts[reply.sequence]);
            done++;
        }
        percuss_reply_free(&reply);
    }
    free(starts);
    return good;
}

static void *run(void *argument)
{
    struct runner *runner = argument;
    pthread_barrier_wait(runner->start);
    runner->good = runner->batches ? ask_batches(runner) : ask_pipelined(runner);
    return NULL;
}

/* Connects, and warms the service up by what opens the way for batches too. */
static bool prepare(struct runner *runner)
{
    struct percuss_client_config config = percuss_client_config_default();
    struct percuss_request request;
    struct percuss_reply reply;
    config.domain = runner->load->domain;
    config.window = 1024;
    if (percuss_client_create(&config, &runner->client) ||
        percuss_client_connect(runner->client, patience))
        return failed("a client");
    query_fill(runner->load->query, 0, &request);
    if (!runner->batches)
        return true;
    if (percuss_solve_batch(runner->client, &request, 1, patience, &reply))
        return failed("the first batch");
    percuss_reply_free(&reply);
    return true;
}

static void print(const struct load *load, const struct runner *runners, double seconds, double cpu)
{
    size_t per_client = load->requests, all = per_client * load->clients;
    struct samples times = samples_create(all);
    unsigned long busy = 0;
    for (unsigned i = 0; i < load->clients; i++) {
        for (size_t j = 0; j < runners[i].times.count; j++)
            samples_add(&times, runners[i].times.values[j]);
        busy += runners[i].busy;
    }
    const char *format = load->csv ? "%s,%s,%u,%u,%.6g,%.6e,%.6e,%.6e,%lu\n"
                                   : "%-14s %-9s %7u %11u %11.0f %10.3e %10.3e %11.3e %5lu\n";
    printf(format, load->query->name, runners[0].batches ? "batch" : "pipeline", load->clients,
           load->outstanding, (double)all / seconds, samples_quantile(&times, 0.50),
           samples_quantile(&times, 0.99), cpu / (double)all, busy);
    fflush(stdout);
    samples_free(&times);
}

static bool measure(const struct load *load, struct runner *runners)
{
    pthread_barrier_t start;
    bool good = true;
    pthread_barrier_init(&start, NULL, load->clients + 1);
    for (unsigned i = 0; i < load->clients; i++) {
        runners[i].start = &start;
        if (pthread_create(&runners[i].thread, NULL, run, &runners[i]) != 0) {
            fprintf(stderr, "a thread cannot be started\n");
            exit(EXIT_FAILURE);
        }
    }
    double cpu = children_cpu(load->service), begin = samples_now();
    pthread_barrier_wait(&start);
    for (unsigned i = 0; i < load->clients; i++) {
        pthread_join(runners[i].thread, NULL);
        good = good && runners[i].good;
    }
    if (good)
        print(load, runners, samples_now() - begin, children_cpu(load->service) - cpu);
    pthread_barrier_destroy(&start);
    return good;
}

static bool throughput(const struct load *load, bool batches)
{
    struct runner *runners = calloc(load->clients, sizeof *runners);
    bool good = runners != NULL;
    for (unsigned i = 0; good && i < load->clients; i++) {
        runners[i] = (struct runner){.load = load, .index = i, .batches = batches};
        runners[i].times = samples_create(load->requests);
        good = prepare(&runners[i]);
    }
    good = good && measure(load, runners);
    for (unsigned i = 0; runners && i < load->clients; i++) {
        percuss_client_free(runners[i].client);
        samples_free(&runners[i].times);
    }
    free(runners);
    return good;
}

bool throughput_batches(const struct load *load)
{
    return throughput(load, true);
}

bool throughput_pipelines(const struct load *load)
{
    return throughput(load, false);
}

void throughput_header(const struct load *load)
{
    if (load->csv)
        printf("scene,mode,clients,outstanding,requests_per_second,p50,p99,service_cpu,busy\n");
    else
        printf("%-14s %-9s %7s %11s %11s %10s %10s %11s %5s\n", "scene", "mode", "clients",
               "outstanding", "requests/s", "p50/s", "p99/s", "CPU s/req", "busy");
}
