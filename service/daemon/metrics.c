/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/metrics.h"

#include <math.h>

/* Two bounds a decade separate a cheap impact from one that waited. */
static const double TIMES[METRICS_BUCKETS] = {1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2,  3e-2,
                                              1e-1, 3e-1, 1.0,  3.0,  10.0, 30.0, 100.0, 300.0};
static const double SHARES[METRICS_BUCKETS] = {1e-12, 1e-11, 1e-10, 1e-9, 3e-9, 1e-8, 3e-8, 1e-7,
                                               3e-7,  1e-6,  3e-6,  1e-5, 3e-5, 1e-4, 1e-3, 1e-2};

static const char *const METRICS_KINDS[EXCHANGE_COUNT] = {
    [EXCHANGE_SINGLE] = "request", [EXCHANGE_BATCH] = "batch", [EXCHANGE_ENSEMBLE] = "ensemble"};

static void metrics_add(atomic_ullong *counter)
{
    atomic_fetch_add_explicit(counter, 1, memory_order_relaxed);
}

static unsigned long long metrics_read(const atomic_ullong *counter)
{
    return atomic_load_explicit(counter, memory_order_relaxed);
}

static void histogram_note(struct histogram *histogram, const double *bounds, double number)
{
    int bucket = 0;
    while (bucket < METRICS_BUCKETS && !(number <= bounds[bucket]))
        bucket++;
    metrics_add(&histogram->counts[bucket]);
    double sum = atomic_load_explicit(&histogram->sum, memory_order_relaxed);
    while (!atomic_compare_exchange_weak_explicit(&histogram->sum, &sum, sum + number,
                                                  memory_order_relaxed, memory_order_relaxed))
        continue;
}

void metrics_note_time(struct histogram *histogram, double seconds)
{
    histogram_note(histogram, TIMES, seconds);
}

void metrics_note_share(struct histogram *histogram, double share)
{
    histogram_note(histogram, SHARES, share);
}

void metrics_count_refusal(struct metrics *metrics, enum exchange exchange,
                           enum percuss_status status)
{
    if ((unsigned)status < PERCUSS_STATUS_COUNT)
        metrics_add(&metrics->replies[exchange][status]);
}

/* Of an impact that was solved, also the times and the closure of its energy. */
static void metrics_count_reply(struct metrics *metrics, enum exchange exchange,
                                const percuss_v1_Reply *reply)
{
    metrics_count_refusal(metrics, exchange, reply->status);
    if (reply->status != PERCUSS_OK && reply->status != PERCUSS_TRUNCATED)
        return;
    metrics_note_time(&metrics->waits, reply->timing.queue);
    metrics_note_time(&metrics->solves, reply->timing.solve);
    if (reply->energy.available > 0.0)
        metrics_note_share(&metrics->closures,
                           fabs(reply->energy.closure) / reply->energy.available);
}

void metrics_count(struct metrics *metrics, const struct answer *answer)
{
    size_t count = answer->exchange == EXCHANGE_BATCH ? answer->member_count : 1;
    if (answer->report)
        metrics_count_refusal(metrics, answer->exchange, answer->report->status);
    for (size_t i = 0; answer->reply && i < count; i++)
        metrics_count_reply(metrics, answer->exchange, &answer->reply[i]);
}

void metrics_print_replies(const struct metrics *metrics, FILE *file)
{
    fputs("# HELP percuss_replies Replies that were made, those to requests of a batch each.\n"
          "# TYPE percuss_replies counter\n",
          file);
    for (int kind = 0; kind < EXCHANGE_COUNT; kind++)
        for (unsigned status = 0; status < PERCUSS_STATUS_COUNT; status++)
            fprintf(file, "percuss_replies_total{kind=\"%s\",status=\"%s\"} %llu\n",
                    METRICS_KINDS[kind], status_name(status),
                    metrics_read(&metrics->replies[kind][status]));
    fprintf(file,
            "# HELP percuss_pings Pings that were answered.\n"
            "# TYPE percuss_pings counter\n"
            "percuss_pings_total %llu\n"
            "# HELP percuss_catalogue_loads Times that the catalogue was read again.\n"
            "# TYPE percuss_catalogue_loads counter\n"
            "percuss_catalogue_loads_total{result=\"taken\"} %llu\n"
            "percuss_catalogue_loads_total{result=\"refused\"} %llu\n",
            metrics_read(&metrics->pings), metrics_read(&metrics->reloads),
            metrics_read(&metrics->failed_reloads));
}

static void metrics_print_histogram(const struct histogram *histogram, const char *name,
                                    const char *help, const double *bounds, FILE *file)
{
    unsigned long long count = 0;
    double sum = atomic_load_explicit(&histogram->sum, memory_order_relaxed);
    fprintf(file, "# HELP %s %s\n# TYPE %s histogram\n", name, help, name);
    for (int i = 0; i < METRICS_BUCKETS; i++) {
        count += metrics_read(&histogram->counts[i]);
        fprintf(file, "%s_bucket{le=\"%g\"} %llu\n", name, bounds[i], count);
    }
    count += metrics_read(&histogram->counts[METRICS_BUCKETS]);
    fprintf(file, "%s_bucket{le=\"+Inf\"} %llu\n%s_sum %.9g\n%s_count %llu\n", name, count, name,
            sum, name, count);
}

void metrics_print_histograms(const struct metrics *metrics, FILE *file)
{
    metrics_print_histogram(&metrics->waits, "percuss_wait_seconds",
                            "From a request's arrival to the beginning of its solve.", TIMES, file);
    metrics_print_histogram(&metrics->solves, "percuss_solve_seconds", "Solving an impact.", TIMES,
                            file);
    metrics_print_histogram(&metrics->commits, "percuss_store_commit_seconds",
                            "Writing an impact on a specimen to the store.", TIMES, file);
    metrics_print_histogram(&metrics->closures, "percuss_energy_closure_ratio",
                            "What the energies of an answer lack, of the energy available.", SHARES,
                            file);
}
