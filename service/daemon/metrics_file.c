/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/metrics_file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "daemon/queue.h"
#include "daemon/specimen_lane.h"
#include "exchange/clock.h"

static const char *const LANES[LANE_COUNT] = {[LANE_SHORT] = "short",
                                              [LANE_LONG] = "long",
                                              [LANE_TABLES] = "tables",
                                              [LANE_ENSEMBLES] = "ensembles",
                                              [LANE_SPECIMENS] = "specimens"};

static void print_gauge(FILE *file, const char *name, const char *help, double value)
{
    fprintf(file, "# HELP %s %s\n# TYPE %s gauge\n%s %.15g\n", name, help, name, name, value);
}

static void print_queues(const struct shared *shared, FILE *file)
{
    fputs("# HELP percuss_queue_length Jobs that wait.\n# TYPE percuss_queue_length gauge\n", file);
    for (int lane = 0; lane < LANE_COUNT; lane++)
        fprintf(file, "percuss_queue_length{lane=\"%s\"} %zu\n", LANES[lane],
                queue_length(shared->lanes[lane]));
    print_gauge(file, "percuss_queue_capacity", "Jobs that may wait in each queue.",
                shared->settings->queue_capacity);
}

static void print_state(struct shared *shared, FILE *file)
{
    struct snapshot *snapshot = snapshots_hold(&shared->snapshots);
    fprintf(file,
            "# HELP percuss_info The daemon and its catalogue.\n# TYPE percuss_info gauge\n"
            "percuss_info{version=\"%s\",catalogue=\"%s\"} 1\n",
            PERCUSS_VERSION, snapshot->set->revision);
    print_gauge(file, "percuss_bodies", "Bodies of the catalogue.", (double)snapshot->set->count);
    snapshots_release(&shared->snapshots, snapshot);
    print_gauge(file, "percuss_clients", "Clients that read replies.",
                (double)endpoint_clients(shared->endpoint));
    print_gauge(file, "percuss_specimens", "Specimens of the store.",
                shared->specimens ? (double)specimen_lane_count(shared->specimens) : 0.0);
    print_gauge(file, "percuss_workers", "Workers for short computations.",
                shared->settings->workers);
    print_gauge(file, "percuss_draining", "1: it is about to end.", atomic_load(&shared->draining));
    print_gauge(file, "percuss_uptime_seconds", "Since its start.", clock_now() - shared->started);
    print_gauge(file, "percuss_identity_end_seconds",
                "When the identity ends, since 1970; 0: not secured.",
                (double)shared->identity_end);
    fprintf(file,
            "# HELP percuss_undelivered Replies that their clients did not take.\n"
            "# TYPE percuss_undelivered counter\n"
            "percuss_undelivered_total %llu\n",
            atomic_load(&shared->undelivered));
}

/* By the names that every exporter uses. */
static void print_process(FILE *file)
{
    struct rusage used;
    unsigned long pages = 0;
    FILE *memory = fopen("/proc/self/statm", "r");
    if (memory && fscanf(memory, "%*u %lu", &pages) != 1)
        pages = 0;
    if (memory)
        fclose(memory);
    getrusage(RUSAGE_SELF, &used);
    double seconds = (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                     1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    print_gauge(file, "process_resident_memory_bytes", "Memory that is in use.",
                (double)pages * (double)sysconf(_SC_PAGESIZE));
    fprintf(file,
            "# HELP process_cpu_seconds Processor time.\n# TYPE process_cpu_seconds counter\n"
            "process_cpu_seconds_total %.6f\n",
            seconds);
}

static bool print_all(struct shared *shared, FILE *file)
{
    print_state(shared, file);
    print_queues(shared, file);
    metrics_print_replies(&shared->metrics, file);
    metrics_print_histograms(&shared->metrics, file);
    print_process(file);
    fputs("# EOF\n", file);
    bool good = !ferror(file);
    return fclose(file) == 0 && good;
}

bool metrics_file_write(struct shared *shared, const char *path, struct fault *fault)
{
    struct atomic_file aside;
    struct fault reason = {""};
    /* its name does not end as those do that monitoring systems look for */
    int descriptor = atomic_file_create(&aside, path, 0666, &reason);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
    if (descriptor >= 0 && !file)
        close(descriptor);
    bool good = file && print_all(shared, file);
    if (descriptor >= 0 && !good) {
        fault_set(&reason, PERCUSS_INTERNAL, "%.300s: %s", path, strerror(errno));
        atomic_file_abandon(&aside);
    }
    /* not synchronised: it is of one second, and the main thread must not wait for the disk */
    good = good && !atomic_file_finish(&aside, false, &reason);
    if (!good)
        fault_set(fault, PERCUSS_INTERNAL, "metrics: %s", reason.text);
    return good;
}
