/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a question costs its caller, against the bare round trip that carries it: see
 * docs/lab/latency.md. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "children.h"
#include "raw_link.h"
#include "samples.h"
#include "throughput.h"
#include "wire_size.h"

static const char usage[] =
    "usage: round_trip [--throughput] [--csv] [OPTION...]\n"
    "Starts a percussd and a bare Cyclone DDS echo for itself, loopback only in a random domain,\n"
    "and prints what a question costs against a bare round trip of equal size (seconds).\n"
    "  --csv            scene,raw_p50,raw_p99,service_p50,service_p99\n"
    "                   with --throughput: scene,mode,clients,outstanding,requests_per_second,\n"
    "                   p50,p99,service_cpu,busy (per request; p50 and p99 of a batch: of all)\n"
    "  --throughput     batches of one client, and several clients with many requests at once\n"
    "  --scene NAME     one scene only: ping, sphere-sphere, rod-1e-4, beam-1e-3, beam-1e-4\n"
    "  --trips N        round trips of each kind and scene (2000); with --throughput: requests of\n"
    "                   each client\n"
    "  --batch N        requests in a batch (64)\n"
    "  --clients N      clients at once (8)\n"
    "  --outstanding N  requests each of them has out (64)\n"
    "  --percussd FILE  the daemon; otherwise bin/percussd of the build this program is in\n"
    "  --config FILE    its settings; otherwise the shipped ones\n";

enum { WARM_UP = 50 };

static const double patience = 20.0; /* s */

struct options {
    bool csv, throughput;
    unsigned trips, batch, clients, outstanding;
    const char *scene, *percussd, *config; /* NULL: all; the default */
};

struct bench {
    struct options options;
    uint32_t domain;
    pid_t service;
    struct raw_link *raw;
    struct percuss_client *client;
};

static bool failed(const char *what)
{
    fprintf(stderr, "round_trip: %s\n", what);
    return false;
}

static void start_children(struct bench *bench)
{
    static char self[PATH_MAX], daemon[PATH_MAX + 32], domain[16];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    if (length < 0)
        exit(EXIT_FAILURE);
    /* this is BUILD/tests/bench/round_trip */
    char build[PATH_MAX];
    strcpy(build, self);
    for (int i = 0; i < 3 && strrchr(build, '/'); i++)
        *strrchr(build, '/') = '\0';
    snprintf(daemon, sizeof daemon, "%s/bin/percussd", build);
    const struct options *options = &bench->options;
    bench->domain = children_domain();
    snprintf(domain, sizeof domain, "%u", bench->domain);
    char *echo[] = {self, "--echo", domain, NULL};
    char *service[] = {options->percussd ? (char *)options->percussd : daemon,
                       "--config",
                       options->config ? (char *)options->config
                                       : PERCUSS_SOURCE_DIR "/config/percussd.yaml",
                       "--domain",
                       domain,
                       NULL};
    children_start(echo);
    bench->service = children_start(service);
}

static bool connect(struct bench *bench)
{
    struct percuss_client_config config = percuss_client_config_default();
    config.domain = bench->domain;
    bench->raw = raw_link_open(bench->domain);
    children_check();
    if (!bench->raw)
        return failed("the bare echo does not answer");
    if (percuss_client_create(&config, &bench->client) ||
        percuss_client_connect(bench->client, patience)) {
        children_check();
        return failed(percuss_error_text());
    }
    return true;
}

/* Times of one scene: the bare round trip, the same with as much computation at the other end as
 * the service says its last answer took, the service, and what it says. */
struct trips {
    struct samples raw, busy, service, solve;
};

static bool solve(struct bench *bench, const struct query *query, unsigned long variation,
                  struct trips *trips)
{
    struct percuss_request request;
    struct percuss_reply reply;
    query_fill(query, variation, &request);
    double start = samples_now();
    if (percuss_solve(bench->client, &request, patience, &reply))
        return failed(percuss_error_text());
    samples_add(&trips->service, samples_now() - start);
    samples_add(&trips->solve, reply.timing.solve);
    bool good = reply.status == PERCUSS_OK || failed(reply.message);
    percuss_reply_free(&reply);
    return good;
}

static bool ask(struct bench *bench, const struct query *query, unsigned long variation,
                struct trips *trips)
{
    double seconds;
    if (query->b)
        return solve(bench, query, variation, trips);
    if (percuss_ping(bench->client, patience, &seconds))
        return failed(percuss_error_text());
    samples_add(&trips->service, seconds);
    samples_add(&trips->solve, 0.0);
    return true;
}

static bool echo(struct bench *bench, const struct wire_size *size, double busy,
                 struct samples *samples)
{
    double seconds = raw_link_trip(bench->raw, size->request, size->reply, busy);
    if (seconds < 0.0)
        return failed("the bare echo does not answer");
    samples_add(samples, seconds);
    return true;
}

static void print(const struct options *options, const char *scene, const struct wire_size *size,
                  struct trips *trips)
{
    double raw = samples_quantile(&trips->raw, 0.50), raw_p99 = samples_quantile(&trips->raw, 0.99);
    double service = samples_quantile(&trips->service, 0.50);
    double service_p99 = samples_quantile(&trips->service, 0.99);
    double busy = samples_quantile(&trips->busy, 0.50);
    if (options->csv)
        printf("%s,%.6e,%.6e,%.6e,%.6e\n", scene, raw, raw_p99, service, service_p99);
    else
        printf("%-14s %6zu %6zu %8.1f %8.1f %8.1f %8.1f %6.2f %8.1f %8.1f %8.1f\n", scene,
               size->request, size->reply, 1e6 * raw, 1e6 * raw_p99, 1e6 * service,
               1e6 * service_p99, service / raw, 1e6 * samples_quantile(&trips->solve, 0.50),
               1e6 * busy, 1e6 * (service - busy));
    fflush(stdout);
}

/* One after the other, each in turn first: noise hits all alike. */
static bool alternate(struct bench *bench, const struct query *query, const struct wire_size *size,
                      struct trips *trips)
{
    bool good = true;
    double busy = 0.0;
    unsigned long count = bench->options.trips + WARM_UP;
    for (unsigned long i = 1; good && i <= count; i++) {
        if (i == WARM_UP + 1)
            trips->raw.count = trips->busy.count = trips->service.count = trips->solve.count = 0;
        for (unsigned long turn = i; good && turn < i + 3; turn++) {
            if (turn % 3 == 0)
                good = echo(bench, size, 0.0, &trips->raw);
            else if (turn % 3 == 1)
                good = echo(bench, size, busy, &trips->busy);
            else
                good = ask(bench, query, i, trips);
        }
        busy = good ? trips->solve.values[trips->solve.count - 1] : 0.0;
    }
    return good;
}

static bool measure(struct bench *bench, const struct query *query)
{
    struct wire_size size;
    if (!wire_size_find(bench->domain, bench->client, query, &size))
        return failed("the service does not answer");
    size_t room = bench->options.trips + WARM_UP;
    struct trips trips = {samples_create(room), samples_create(room), samples_create(room),
                          samples_create(room)};
    bool good = alternate(bench, query, &size, &trips);
    if (good)
        print(&bench->options, query->name, &size, &trips);
    samples_free(&trips.raw);
    samples_free(&trips.service);
    samples_free(&trips.solve);
    samples_free(&trips.busy);
    return good;
}

static bool run_trips(struct bench *bench)
{
    const char *chosen = bench->options.scene;
    bool good = connect(bench);
    if (bench->options.csv)
        printf("scene,raw_p50,raw_p99,service_p50,service_p99\n");
    else
        printf("us; busy: a bare round trip whose other end computes as long as the solve took;\n"
               "rest: service - busy. Medians but for the p99\n"
               "%-14s %6s %6s %8s %8s %8s %8s %6s %8s %8s %8s\n",
               "scene", "asks B", "gets B", "raw", "p99", "service", "p99", "ratio", "solve",
               "busy", "rest");
    for (int i = 0; good && i < QUERY_COUNT; i++) {
        if (!chosen || strcmp(chosen, queries[i].name) == 0)
            good = measure(bench, &queries[i]);
    }
    percuss_client_free(bench->client);
    raw_link_close(bench->raw);
    return good;
}

static bool run_throughput(const struct bench *bench)
{
    const struct options *options = &bench->options;
    struct load load = {.domain = bench->domain, .service = bench->service, .csv = options->csv};
    bool good = true;
    throughput_header(&load);
    for (int i = 0; good && i < QUERY_COUNT; i++) {
        load.query = &queries[i];
        if (!load.query->b || (options->scene && strcmp(options->scene, load.query->name) != 0))
            continue;
        load.clients = 1;
        load.outstanding = options->batch;
        load.requests = (options->trips + options->batch - 1) / options->batch * options->batch;
        good = throughput_batches(&load);
        load.clients = options->clients;
        load.outstanding = options->outstanding;
        load.requests = options->trips;
        good = good && throughput_pipelines(&load);
    }
    return good;
}

/* A whole number of 1 to `most`. */
static bool read_count(const char *text, unsigned most, unsigned *count)
{
    char *end;
    unsigned long value = strtoul(text, &end, 10);
    *count = (unsigned)value;
    return *text >= '0' && *text <= '9' && !*end && value >= 1 && value <= most;
}

/* An option with a value; false: there is no such one, or the value is not allowed. */
static bool read_option(struct options *options, const char *name, const char *value)
{
    if (strcmp(name, "--scene") == 0)
        return query_find(options->scene = value);
    if (strcmp(name, "--percussd") == 0)
        return *(options->percussd = value);
    if (strcmp(name, "--config") == 0)
        return *(options->config = value);
    if (strcmp(name, "--trips") == 0)
        return read_count(value, 1000000, &options->trips);
    if (strcmp(name, "--batch") == 0)
        return read_count(value, PERCUSS_MAX_BATCH, &options->batch);
    if (strcmp(name, "--clients") == 0)
        return read_count(value, 64, &options->clients);
    if (strcmp(name, "--outstanding") == 0)
        return read_count(value, 1024, &options->outstanding);
    return false;
}

int main(int argc, char **argv)
{
    struct bench bench = {.options = {.trips = 2000, .batch = 64, .clients = 8, .outstanding = 64}};
    if (argc == 3 && strcmp(argv[1], "--echo") == 0) {
        raw_echo((uint32_t)strtoul(argv[2], NULL, 10));
        return EXIT_FAILURE;
    }
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--csv") == 0) {
            bench.options.csv = true;
        } else if (strcmp(argv[i], "--throughput") == 0) {
            bench.options.throughput = true;
        } else if (i + 1 < argc && read_option(&bench.options, argv[i], argv[i + 1])) {
            i++;
        } else {
            bool help = strcmp(argv[i], "--help") == 0;
            if (!help)
                fprintf(stderr, "round_trip: %s: not understood\n", argv[i]);
            fputs(usage, help ? stdout : stderr);
            return help ? EXIT_SUCCESS : 2;
        }
    }
    start_children(&bench);
    bool good = bench.options.throughput ? run_throughput(&bench) : run_trips(&bench);
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
