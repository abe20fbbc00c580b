/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/status.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "daemon/log.h"
#include "daemon/queue.h"
#include "daemon/specimen_lane.h"
#include "exchange/clock.h"
#include "exchange/text.h"
#include "model/ritz_store.h"
#include "wire_security.h"

/* Whether a task stands before another one. */
static bool task_precedes(const struct task *task, const struct task *other)
{
    return task->running != other->running ? task->running : task->arrival < other->arrival;
}

/* Puts it in its place, as long as there is one. */
static void task_insert(struct tasks *tasks, const struct task *task)
{
    size_t place = tasks->count;
    while (place > 0 && task_precedes(task, &tasks->list[place - 1]))
        place--;
    tasks->all++;
    if (place == TASKS_LISTED)
        return;
    tasks->count += tasks->count < TASKS_LISTED;
    memmove(&tasks->list[place + 1], &tasks->list[place],
            (tasks->count - place - 1) * sizeof *tasks->list);
    tasks->list[place] = *task;
}

struct visit {
    struct shared *shared;
    struct tasks *tasks;
};

static void task_note(void *context, const struct job *job)
{
    struct visit *visit = context;
    struct task task;
    if (!job->kind->describe || !job->kind->describe(job, &task))
        return;
    if (task.running || !reply_store_is_gone(visit->shared->replies, task.client))
        task_insert(visit->tasks, &task);
}

/* A mesh is reduced by another process. */
static void task_note_reduction(struct shared *shared, struct tasks *tasks)
{
    struct task task = {.kind = percuss_v1_TASK_MESH, .running = true};
    char text[8];
    activity_read(&shared->reduction, text, sizeof text, &task.done);
    task.arrival = activity_begun(&shared->reduction);
    if (!isnan(task.arrival))
        task_insert(tasks, &task);
}

void tasks_look(struct shared *shared, struct tasks *tasks)
{
    struct visit visit = {shared, tasks};
    tasks->count = 0;
    tasks->all = 0;
    task_note_reduction(shared, tasks);
    for (int lane = 0; lane < LANE_COUNT; lane++)
        queue_visit(shared->lanes[lane], task_note, &visit);
}

static uint32_t status_waiting(const struct shared *shared)
{
    size_t length = 0;
    for (int lane = 0; lane < LANE_COUNT; lane++)
        length += queue_length(shared->lanes[lane]);
    return (uint32_t)length;
}

void status_describe(struct shared *shared, char *text, size_t size)
{
    char activity[128], more[160] = "";
    double progress;
    activity_read(&shared->activity, activity, sizeof activity, &progress);
    if (activity[0] && isfinite(progress))
        snprintf(more, sizeof more, "; %s, %.0f %%", activity, 100.0 * progress);
    struct snapshot *snapshot = snapshots_hold(&shared->snapshots);
    snprintf(text, size,
             "%s: %zu bodies of catalogue %.8s; %llu answered, %llu refused, %u waiting%s",
             atomic_load(&shared->draining) ? "draining" : "ready", snapshot->set->count,
             snapshot->set->revision, atomic_load(&shared->answered), atomic_load(&shared->refused),
             status_waiting(shared), more);
    snapshots_release(&shared->snapshots, snapshot);
}

/* Fills the status with the tasks. */
static void status_list_tasks(struct shared *shared, percuss_v1_Task list[TASKS_LISTED],
                              percuss_v1_ServerStatus *status)
{
    struct tasks tasks;
    double now = clock_now();
    tasks_look(shared, &tasks);
    for (size_t i = 0; i < tasks.count; i++) {
        const struct task *task = &tasks.list[i];
        list[i] = (percuss_v1_Task){
            .sequence = task->sequence,
            .kind = task->kind,
            .running = task->running,
            .age = fmax(0.0, now - task->arrival),
            .done = task->done,
        };
        memcpy(list[i].client, task->client, sizeof list[i].client);
    }
    status->tasks._buffer = list;
    status->tasks._length = status->tasks._maximum = (uint32_t)tasks.count;
    status->all_tasks = tasks.all;
}

void status_announce(struct shared *shared)
{
    percuss_v1_Task tasks[TASKS_LISTED];
    struct snapshot *snapshot = snapshots_hold(&shared->snapshots);
    /* its numbers */
    percuss_v1_ServerStatus status = {
        .process = (uint32_t)getpid(),
        .workers = shared->settings->workers,
        .bodies = (uint32_t)snapshot->set->count,
        .queue_length = status_waiting(shared),
        .queue_capacity = LANE_COUNT * shared->settings->queue_capacity,
        .answered = atomic_load(&shared->answered),
        .refused = atomic_load(&shared->refused),
        .uptime = clock_now() - shared->started,
        .others = atomic_load(&shared->others),
        .specimens = shared->specimens ? (uint32_t)specimen_lane_count(shared->specimens) : 0,
    };
    /* its texts; the solver's activity, for which clients wait, before the reduction's */
    activity_read(&shared->activity, status.activity, sizeof status.activity, &status.progress);
    if (!status.activity[0])
        activity_read(&shared->reduction, status.activity, sizeof status.activity,
                      &status.progress);
    COPY_TEXT(status.version, PERCUSS_VERSION);
    COPY_TEXT(status.state, atomic_load(&shared->draining) ? "draining" : "ready");
    COPY_TEXT(status.catalogue_revision, snapshot->set->revision);
    COPY_TEXT(status.catalogue, shared->catalogue);
    snapshots_release(&shared->snapshots, snapshot);
    gethostname(status.host, sizeof status.host - 1);
    status_list_tasks(shared, tasks, &status);
    endpoint_announce_status(shared->endpoint, &status);
}

static const char *const LANES[LANE_COUNT] = {[LANE_SHORT] = "short",
                                              [LANE_LONG] = "long",
                                              [LANE_TABLES] = "tables",
                                              [LANE_ENSEMBLES] = "ensembles",
                                              [LANE_SPECIMENS] = "specimens"};

static void metrics_print_gauge(FILE *file, const char *name, const char *help, double value)
{
    fprintf(file, "# HELP %s %s\n# TYPE %s gauge\n%s %.15g\n", name, help, name, name, value);
}

static void metrics_print_queues(const struct shared *shared, FILE *file)
{
    fputs("# HELP percuss_queue_length Jobs that wait.\n# TYPE percuss_queue_length gauge\n", file);
    for (int lane = 0; lane < LANE_COUNT; lane++)
        fprintf(file, "percuss_queue_length{lane=\"%s\"} %zu\n", LANES[lane],
                queue_length(shared->lanes[lane]));
    metrics_print_gauge(file, "percuss_queue_capacity", "Jobs that may wait in each queue.",
                        shared->settings->queue_capacity);
}

static void metrics_print_state(struct shared *shared, FILE *file)
{
    struct snapshot *snapshot = snapshots_hold(&shared->snapshots);
    fprintf(file,
            "# HELP percuss_info The daemon and its catalogue.\n# TYPE percuss_info gauge\n"
            "percuss_info{version=\"%s\",catalogue=\"%s\"} 1\n",
            PERCUSS_VERSION, snapshot->set->revision);
    metrics_print_gauge(file, "percuss_bodies", "Bodies of the catalogue.",
                        (double)snapshot->set->count);
    snapshots_release(&shared->snapshots, snapshot);
    metrics_print_gauge(file, "percuss_clients", "Clients that read replies.",
                        (double)endpoint_clients(shared->endpoint));
    metrics_print_gauge(file, "percuss_specimens", "Specimens of the store.",
                        shared->specimens ? (double)specimen_lane_count(shared->specimens) : 0.0);
    metrics_print_gauge(file, "percuss_workers", "Workers for short computations.",
                        shared->settings->workers);
    metrics_print_gauge(file, "percuss_draining", "1: it is about to end.",
                        atomic_load(&shared->draining));
    metrics_print_gauge(file, "percuss_uptime_seconds", "Since its start.",
                        clock_now() - shared->started);
    metrics_print_gauge(file, "percuss_identity_end_seconds",
                        "When the identity ends, since 1970; 0: not secured.",
                        (double)shared->identity_end);
    fprintf(file,
            "# HELP percuss_undelivered Replies that their clients did not take.\n"
            "# TYPE percuss_undelivered counter\n"
            "percuss_undelivered_total %llu\n",
            atomic_load(&shared->undelivered));
    fprintf(file,
            "# HELP percuss_revoked Participants refused or cut off, as their certificates are "
            "revoked.\n"
            "# TYPE percuss_revoked counter\n"
            "percuss_revoked_total %llu\n",
            wire_security_refused());
}

/* A part of what is kept from one request to the next, and the most that it may be. */
struct kept {
    const char *what;
    size_t bytes;
    unsigned most; /* MiB */
};
enum { KEPT_PARTS = 4 };

static void list_kept(struct shared *shared, struct kept kept[KEPT_PARTS])
{
    const struct settings *settings = shared->settings;
    struct snapshot *snapshot = snapshots_hold(&shared->snapshots);
    kept[0] = (struct kept){"states", token_store_bytes(shared->tokens), settings->token_megabytes};
    kept[1] =
        (struct kept){"replies", reply_store_bytes(shared->replies), settings->reply_megabytes};
    kept[2] = (struct kept){"vibrations", ritz_store_bytes(snapshot->set->boxes),
                            settings->box_megabytes};
    kept[3] =
        (struct kept){"bodies", atomic_load(&shared->prepared.bytes), settings->body_megabytes};
    snapshots_release(&shared->snapshots, snapshot);
}

size_t status_kept_bytes(struct shared *shared)
{
    struct kept kept[KEPT_PARTS];
    size_t bytes = 0;
    list_kept(shared, kept);
    for (int i = 0; i < KEPT_PARTS; i++)
        bytes += kept[i].bytes;
    return bytes;
}

static void metrics_print_kept(struct shared *shared, FILE *file)
{
    struct kept kept[KEPT_PARTS];
    list_kept(shared, kept);
    fputs("# HELP percuss_kept_bytes Kept from one request to the next.\n"
          "# TYPE percuss_kept_bytes gauge\n",
          file);
    for (int i = 0; i < KEPT_PARTS; i++)
        fprintf(file, "percuss_kept_bytes{what=\"%s\"} %zu\n", kept[i].what, kept[i].bytes);
    fputs("# HELP percuss_kept_limit_bytes The most that it may be.\n"
          "# TYPE percuss_kept_limit_bytes gauge\n",
          file);
    for (int i = 0; i < KEPT_PARTS; i++)
        fprintf(file, "percuss_kept_limit_bytes{what=\"%s\"} %.15g\n", kept[i].what,
                1048576.0 * kept[i].most);
}

size_t status_resident_bytes(void)
{
    unsigned long pages = 0;
    FILE *memory = fopen("/proc/self/statm", "re");
    if (memory && fscanf(memory, "%*u %lu", &pages) != 1)
        pages = 0;
    if (memory)
        fclose(memory);
    return pages * (size_t)sysconf(_SC_PAGESIZE);
}

/* Under the names that every exporter uses. */
static void metrics_print_process(FILE *file)
{
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    double seconds = (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                     1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    metrics_print_gauge(file, "process_resident_memory_bytes", "Memory that is in use.",
                        (double)status_resident_bytes());
    fprintf(file,
            "# HELP process_cpu_seconds Processor time.\n# TYPE process_cpu_seconds counter\n"
            "process_cpu_seconds_total %.6f\n",
            seconds);
}

static bool metrics_print_all(struct shared *shared, FILE *file)
{
    metrics_print_state(shared, file);
    metrics_print_queues(shared, file);
    metrics_print_replies(&shared->metrics, file);
    metrics_print_histograms(&shared->metrics, file);
    metrics_print_kept(shared, file);
    metrics_print_process(file);
    fputs("# EOF\n", file);
    bool good = !ferror(file);
    return fclose(file) == 0 && good;
}

bool status_write_metrics(struct shared *shared, const char *path, struct fault *fault)
{
    struct atomic_file aside;
    struct fault reason = {""};
    /* its suffix is not one that monitoring systems look for */
    int descriptor = atomic_file_create(&aside, path, 0666, &reason);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
    if (descriptor >= 0 && !file)
        close(descriptor);
    bool good = file && metrics_print_all(shared, file);
    if (descriptor >= 0 && !good) {
        fault_set(&reason, PERCUSS_INTERNAL, "%.300s: %s", path, strerror(errno));
        atomic_file_abandon(&aside);
    }
    /* not synchronised: it is valid for a second, and the main thread must not wait for the disk */
    good = good && !atomic_file_finish(&aside, false, &reason);
    if (!good)
        fault_set(fault, PERCUSS_INTERNAL, "metrics: %s", reason.text);
    return good;
}

struct neighbour_look {
    struct neighbours *neighbours;
    const uint8_t *server; /* this daemon's id */
    const struct shared *shared;
    const char *revision; /* of its catalogue */
};

/* The known one of that id, or a place for it at the end; NULL: no room. */
static struct neighbour *neighbour_find(struct neighbours *neighbours, const uint8_t server[16])
{
    size_t i = 0;
    while (i < neighbours->count && memcmp(neighbours->each[i].server, server, 16) != 0)
        i++;
    return i < NEIGHBOURS_MOST ? &neighbours->each[i] : NULL;
}

static void neighbour_warn(const struct neighbour_look *look, const struct neighbour *neighbour,
                           const percuss_v1_ServerStatus *status)
{
    if (memcmp(status->server, look->server, 16) == 0)
        log_line(LEVEL_ERROR,
                 "%s answers in this domain under the id of this one: the file `standby` of its "
                 "settings is a copy of ours: one of the two must end",
                 neighbour->name);
    else if (neighbour->alike)
        log_line(LEVEL_WARNING,
                 "%s answers in this domain too, with the same catalogue: clients that name no "
                 "server ask the one that has been up longest",
                 neighbour->name);
    else
        log_line(
            LEVEL_WARNING,
            "%s answers in this domain too, with ANOTHER CATALOGUE: %s (revision %.8s), ours "
            "is %s (revision %.8s): answers depend on which server a client asks: stop one of "
            "the two, or start it outside domain %u by --domain N or PERCUSS_DOMAIN=N, and its "
            "clients too",
            neighbour->name, *status->catalogue ? status->catalogue : "of an unknown path",
            status->catalogue_revision, look->shared->catalogue, look->revision,
            look->shared->settings->domain);
}

static void neighbour_note(void *context, const percuss_v1_ServerStatus *status)
{
    const struct neighbour_look *look = context;
    struct neighbours *neighbours = look->neighbours;
    struct neighbour *neighbour = neighbour_find(neighbours, status->server);
    bool alike = strcmp(status->catalogue_revision, look->revision) == 0;
    neighbours->others += memcmp(status->server, look->server, 16) != 0;
    if (!neighbour)
        return;
    /* its id and name */
    bool is_new = neighbour == &neighbours->each[neighbours->count];
    if (is_new) {
        memcpy(neighbour->server, status->server, sizeof neighbour->server);
        snprintf(neighbour->name, sizeof neighbour->name,
                 "percussd %02x%02x%02x%02x (process %u on %s)", status->server[0],
                 status->server[1], status->server[2], status->server[3], status->process,
                 status->host);
        neighbours->count++;
    }
    /* changes of it */
    neighbour->there = true;
    if (!is_new && alike == neighbour->alike)
        return;
    neighbour->alike = alike;
    neighbour_warn(look, neighbour, status);
}

void neighbours_look(struct neighbours *neighbours, struct shared *shared)
{
    struct endpoint *endpoint = shared->endpoint;
    struct snapshot *snapshot = snapshots_hold(&shared->snapshots);
    struct neighbour_look look = {neighbours, endpoint_server(endpoint), shared,
                                  snapshot->set->revision};
    neighbours->others = 0;
    for (size_t i = 0; i < neighbours->count; i++)
        neighbours->each[i].there = false;
    endpoint_visit_servers(endpoint, neighbour_note, &look);
    snapshots_release(&shared->snapshots, snapshot);
    for (size_t i = neighbours->count; i-- > 0;) {
        if (neighbours->each[i].there)
            continue;
        log_line(LEVEL_INFO, "%s has gone from this domain", neighbours->each[i].name);
        neighbours->each[i] = neighbours->each[--neighbours->count];
    }
}
