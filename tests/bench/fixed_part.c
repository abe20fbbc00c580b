/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the daemon does for a question beside its solution, DDS left out: see docs/lab/latency.md. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "answering.h"
#include "children.h"
#include "raw_link.h"
#include "samples.h"

static const char usage[] =
    "usage: fixed_part [--csv] [--scene NAME] [--trips N]\n"
    "       fixed_part --once NAME\n"
    "Answers questions in this process as percussd does between DDS's two ends (digest, "
    "admission,\n"
    "checks, solution, reply, its keeping), and solves them alone; prints both and what is "
    "between\n"
    "them against the bare round trip of this run (us, medians): right after a trip, as in the\n"
    "service, and one after the other.\n"
    "  --csv          scene,raw,answer,solve,fixed,answer_warm,solve_warm,fixed_warm (seconds)\n"
    "  --scene NAME   one scene only: sphere-sphere, rod-1e-4, beam-1e-3, beam-1e-4\n"
    "  --trips N      of each kind and scene (1000)\n"
    "  --once NAME    answers one question warm, for callgrind (--toggle-collect=counted_answer)\n";

struct options {
    bool csv;
    unsigned trips;
    const char *scene, *once; /* NULL: all; none */
};

/* Of one scene, s. */
struct times {
    struct samples raw, answer[2], solve[2]; /* [0]: after a trip, [1]: warm */
};

static struct times times_create(size_t room)
{
    struct times times = {.raw = samples_create(room)};
    for (int i = 0; i < 2; i++) {
        times.answer[i] = samples_create(room);
        times.solve[i] = samples_create(room);
    }
    return times;
}

static void times_free(struct times *times)
{
    samples_free(&times->raw);
    for (int i = 0; i < 2; i++) {
        samples_free(&times->answer[i]);
        samples_free(&times->solve[i]);
    }
}

/* Answers a question of its own speed. */
static bool answer(struct answering *answering, const struct query *query, unsigned long variation,
                   struct samples *samples)
{
    if (!answering_put(answering, query, variation))
        return false;
    double start = samples_now();
    bool good = answering_answer(answering);
    samples_add(samples, samples_now() - start);
    return good;
}

/* Solves the one that was answered last. */
static bool solve(struct answering *answering, struct samples *samples)
{
    double start = samples_now();
    bool good = answering_solve(answering);
    samples_add(samples, samples_now() - start);
    return good;
}

/* A bare round trip of the question's sizes. */
static bool trip(struct raw_link *raw, const struct answering *answering, struct samples *samples)
{
    size_t question, reply;
    answering_sizes(answering, &question, &reply);
    double seconds = raw_link_trip(raw, question, reply, 0.0);
    samples_add(samples, seconds);
    return seconds >= 0.0;
}

/* Answers and solutions in turn, each right after a trip: as in the service, something else was on
 * this processor meanwhile. */
static bool measure_after_trips(struct answering *answering, struct raw_link *raw,
                                const struct query *query, unsigned trips, struct times *times)
{
    bool good = answer(answering, query, 0, &times->answer[0]);
    times->answer[0].count = 0;
    for (unsigned i = 1; good && i <= trips; i++) {
        good = trip(raw, answering, &times->raw) &&
               answer(answering, query, i, &times->answer[0]) &&
               trip(raw, answering, &times->raw) && solve(answering, &times->solve[0]);
    }
    return good;
}

/* So many one after the other, and again. */
static bool measure_warm(struct answering *answering, const struct query *query, unsigned trips,
                         struct times *times)
{
    bool good = true;
    for (unsigned i = 1; good && i <= trips; i++)
        good = answer(answering, query, trips + i, &times->answer[1]);
    for (unsigned i = 0; good && i < trips; i++)
        good = solve(answering, &times->solve[1]);
    return good;
}

static void print(const struct options *options, const char *scene, struct times *times)
{
    double raw = samples_quantile(&times->raw, 0.5), whole[2], alone[2];
    for (int i = 0; i < 2; i++) {
        whole[i] = samples_quantile(&times->answer[i], 0.5);
        alone[i] = samples_quantile(&times->solve[i], 0.5);
    }
    if (options->csv)
        printf("%s,%.6e,%.6e,%.6e,%.6e,%.6e,%.6e,%.6e\n", scene, raw, whole[0], alone[0],
               whole[0] - alone[0], whole[1], alone[1], whole[1] - alone[1]);
    else
        printf("%-14s %7.1f %9.2f %7.2f %7.2f %7.3f %9.2f %7.2f %7.2f %7.3f\n", scene, 1e6 * raw,
               1e6 * whole[0], 1e6 * alone[0], 1e6 * (whole[0] - alone[0]),
               (whole[0] - alone[0]) / raw, 1e6 * whole[1], 1e6 * alone[1],
               1e6 * (whole[1] - alone[1]), (whole[1] - alone[1]) / raw);
    fflush(stdout);
}

static void print_header(const struct options *options)
{
    if (options->csv)
        printf("scene,raw,answer,solve,fixed,answer_warm,solve_warm,fixed_warm\n");
    else
        printf("%-22s %35s %35s\n%-14s %7s %9s %7s %7s %7s %9s %7s %7s %7s\n", "", "after a trip",
               "warm", "scene", "raw", "answer", "solve", "fixed", "/raw", "answer", "solve",
               "fixed", "/raw");
}

static bool run(const struct options *options, struct answering *answering)
{
    static char self[PATH_MAX], domain_text[16];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    if (length < 0)
        return false;
    /* the other end of the bare trips */
    uint32_t domain = children_domain();
    snprintf(domain_text, sizeof domain_text, "%u", domain);
    char *echo[] = {self, "--echo", domain_text, NULL};
    children_start(echo);
    struct raw_link *raw = raw_link_open(domain);
    children_check();
    /* scene by scene */
    bool good = raw != NULL;
    print_header(options);
    for (int i = 0; good && i < QUERY_COUNT; i++) {
        const struct query *query = &queries[i];
        if (!query->b || (options->scene && strcmp(options->scene, query->name) != 0))
            continue;
        struct times times = times_create(2 * options->trips);
        good = measure_after_trips(answering, raw, query, options->trips, &times) &&
               measure_warm(answering, query, options->trips, &times);
        if (good)
            print(options, query->name, &times);
        times_free(&times);
    }
    raw_link_close(raw);
    return good;
}

/* The third question of its kind is what callgrind shall count: it counts all, so no others. */
static bool count_one(struct answering *answering, const struct query *query)
{
    bool good = true;
    for (unsigned long i = 0; good && i < 3; i++)
        good = answering_put(answering, query, i) && answering_answer(answering);
    return good && answering_put(answering, query, 3) && answering_count(answering);
}

static bool read_option(struct options *options, const char *name, const char *value)
{
    if (strcmp(name, "--scene") == 0)
        return query_find(options->scene = value);
    if (strcmp(name, "--once") == 0)
        return query_find(options->once = value);
    if (strcmp(name, "--trips") == 0)
        return (options->trips = (unsigned)strtoul(value, NULL, 10)) > 0;
    return false;
}

int main(int argc, char **argv)
{
    struct options options = {.trips = 1000};
    if (argc == 3 && strcmp(argv[1], "--echo") == 0) {
        raw_echo((uint32_t)strtoul(argv[2], NULL, 10));
        return EXIT_FAILURE;
    }
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--csv") == 0) {
            options.csv = true;
        } else if (i + 1 < argc && read_option(&options, argv[i], argv[i + 1])) {
            i++;
        } else {
            bool help = strcmp(argv[i], "--help") == 0;
            fputs(usage, help ? stdout : stderr);
            return help ? EXIT_SUCCESS : 2;
        }
    }
    struct answering *answering = answering_create(PERCUSS_SOURCE_DIR "/config/percussd.yaml");
    bool good = answering != NULL;
    if (good && options.once)
        good = count_one(answering, query_find(options.once));
    else if (good)
        good = run(&options, answering);
    answering_free(answering);
    children_stop();
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
