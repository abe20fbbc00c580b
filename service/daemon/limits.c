/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/limits.h"

#include <errno.h>
#include <malloc.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "daemon/log.h"
#include "store/database_check.h"

/* DDS takes 8, and aborts or crashes without them; files of store, catalogue, tables and security
 * are open for a time; the others are for sockets that a configuration of DDS asks for. */
static const rlim_t DESCRIPTORS = 64;
/* KiB: program, libraries, catalogue, tables and two heaps under a load of six clients are 170 to
 * 200 MiB; with the smallest caches. Measured with 2 workers: 352 MB with the stacks of 23 threads.
 */
static const unsigned long long BASE = 288 * 1024;
/* Threads of DDS, the reading and the main one, those of lanes with few; ensembles at once. */
enum { OTHER_THREADS = 16, ENSEMBLES = 3 };
/* Heaps of the allocator where the address space is limited: each takes 64 MiB of it. */
enum { HEAPS = 2 };

static const unsigned long long KIB = 1024, MIB = 1048576;

unsigned long long limits_address_space(const struct settings *settings, size_t stack)
{
    /* two lanes, and threads of each ensemble, have as many as there are workers */
    unsigned long long threads = OTHER_THREADS + (2 + ENSEMBLES) * settings->workers;
    return BASE + threads * (stack / KIB);
}

/* Bytes that the process may map; 0: no limit. */
static unsigned long long limits_mapping(void)
{
    static const int kinds[] = {RLIMIT_AS, RLIMIT_DATA};
    unsigned long long least = 0;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        struct rlimit limit;
        if (getrlimit((__rlimit_resource_t)kinds[i], &limit) == 0 &&
            limit.rlim_cur != RLIM_INFINITY && (!least || limit.rlim_cur < least))
            least = limit.rlim_cur;
    }
    return least;
}

static size_t limits_stack_size(void)
{
    pthread_attr_t attributes;
    size_t size = 8 * MIB;
    if (pthread_attr_init(&attributes) == 0) {
        pthread_attr_getstacksize(&attributes, &size);
        pthread_attr_destroy(&attributes);
    }
    return size;
}

static enum percuss_status check_descriptors(struct fault *fault)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= DESCRIPTORS)
        return PERCUSS_OK;
    rlim_t allowed = limit.rlim_cur;
    limit.rlim_cur = limit.rlim_max < DESCRIPTORS ? limit.rlim_max : DESCRIPTORS;
    if (limit.rlim_cur >= DESCRIPTORS && setrlimit(RLIMIT_NOFILE, &limit) == 0)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "file descriptors: %llu are allowed (ulimit -n, LimitNOFILE=): must be at "
                     "least %llu",
                     (unsigned long long)allowed, (unsigned long long)DESCRIPTORS);
}

enum percuss_status limits_check(const struct settings *settings, struct fault *fault)
{
    enum percuss_status status = check_descriptors(fault);
    unsigned long long allowed = limits_mapping();
    unsigned long long needed = limits_address_space(settings, limits_stack_size());
    if (status || !allowed || allowed / KIB >= needed)
        return status;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "address space: %llu KiB are allowed (ulimit -v or -d, LimitAS=): must be at "
                     "least %llu with %u workers and stacks of %zu KiB, or unlimited",
                     allowed / KIB, needed, settings->workers, limits_stack_size() / (size_t)KIB);
}

enum percuss_status limits_check_place(const char *path, int mode, struct fault *fault)
{
    if (access(path, mode) == 0)
        return PERCUSS_OK;
    if (errno == ENOENT)
        return database_folder_check(path, fault);
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: cannot be written to: %s", path,
                     strerror(errno));
}

/* The lowest limit of a group and those above it. `folder` is cut down to `root`. */
static unsigned long long limits_lowest(char *folder, size_t root, const char *file)
{
    unsigned long long least = 0;
    for (;;) {
        char path[4096 + 32];
        unsigned long long bytes;
        snprintf(path, sizeof path, "%s/%s", folder, file);
        FILE *stream = fopen(path, "re");
        /* "max" is no number; version 1 says so by one near 2^63 */
        if (stream && fscanf(stream, "%llu", &bytes) == 1 && bytes < 1ULL << 62 &&
            (!least || bytes < least))
            least = bytes;
        if (stream)
            fclose(stream);
        char *slash = strrchr(folder + root, '/');
        if (!slash)
            return least;
        *slash = '\0';
    }
}

unsigned long long limits_cgroup(const char *root, const char *membership)
{
    char line[2048], folder[4096];
    unsigned long long least = 0;
    FILE *stream = fopen(membership, "re");
    while (stream && fgets(line, sizeof line, stream)) {
        /* "0::/PATH" of version 2, "4:memory:/PATH" of version 1 */
        line[strcspn(line, "\n")] = '\0';
        char *controllers = strchr(line, ':');
        char *path = controllers ? strchr(controllers + 1, ':') : NULL;
        if (!path)
            continue;
        *path++ = '\0';
        controllers++;
        bool first = strcmp(controllers, "memory") == 0;
        if (*controllers && !first)
            continue;
        size_t length =
            (size_t)snprintf(folder, sizeof folder, "%s%s", root, first ? "/memory" : "");
        snprintf(folder + length, sizeof folder - length, "%s", strcmp(path, "/") ? path : "");
        unsigned long long found =
            limits_lowest(folder, length, first ? "memory.limit_in_bytes" : "memory.max");
        if (found && (!least || found < least))
            least = found;
    }
    if (stream)
        fclose(stream);
    return least;
}

static unsigned least_of(unsigned megabytes, unsigned long long bytes)
{
    unsigned long long most = bytes / MIB ? bytes / MIB : 1;
    return megabytes < most ? megabytes : (unsigned)most;
}

unsigned limits_solving_threads(const struct settings *settings)
{
    /* those of both lanes, of tables, of ensembles and of specimens, and the reading one */
    return 2 * settings->workers + 1 + 1 + ENSEMBLES + 1 + 1;
}

/* Has each of the four take no more than that. */
static void limits_share(struct settings *settings, unsigned long long asked,
                         unsigned long long prepared)
{
    settings->token_megabytes = least_of(settings->token_megabytes, asked);
    settings->reply_megabytes = least_of(settings->reply_megabytes, asked);
    settings->box_megabytes = least_of(settings->box_megabytes, prepared);
    settings->body_megabytes = least_of(settings->body_megabytes, prepared);
}

bool limits_fit_caches(struct settings *settings, unsigned long long memory,
                       unsigned long long address_space)
{
    enum { EACH_THREAD = 32 }; /* MiB: the catalogue's bodies, and those of a calibration */
    settings->body_megabytes = EACH_THREAD * limits_solving_threads(settings);
    const struct settings before = *settings;
    if (settings->limit_megabytes) {
        const unsigned long long quarter = settings->limit_megabytes * MIB / 4;
        settings->box_megabytes = settings->body_megabytes = (unsigned)(quarter / MIB);
        limits_share(settings, quarter, quarter);
    }
    /* a quarter of the memory is left for solving; they share the address space that is left */
    if (memory)
        limits_share(settings, memory / 4, memory / 8);
    if (address_space) {
        unsigned long long needed = KIB * limits_address_space(settings, limits_stack_size());
        unsigned long long rest = address_space > needed ? address_space - needed : 0;
        /* BASE has the smallest ones in it */
        limits_share(settings, 8 * MIB + rest / 4, 8 * MIB + rest / 4);
    }
    return settings->limit_megabytes || before.token_megabytes != settings->token_megabytes ||
           before.reply_megabytes != settings->reply_megabytes ||
           before.box_megabytes != settings->box_megabytes ||
           before.body_megabytes != settings->body_megabytes;
}

void limits_fit(struct settings *settings)
{
    unsigned long long memory = limits_cgroup("/sys/fs/cgroup", "/proc/self/cgroup");
    unsigned long long address_space = limits_mapping();
    unsigned tokens = settings->token_megabytes, replies = settings->reply_megabytes;
    if (address_space)
        mallopt(M_ARENA_MAX, HEAPS);
    if (!limits_fit_caches(settings, memory, address_space))
        return;
    char group[64] = "", space[64] = "", kept[64] = "";
    if (memory)
        snprintf(group, sizeof group, " %llu MiB by its control group", memory / MIB);
    if (address_space)
        snprintf(space, sizeof space, "%s %llu MiB of address space", memory ? "," : "",
                 address_space / MIB);
    if (settings->limit_megabytes)
        snprintf(kept, sizeof kept, "%s %u MiB by limits.megabytes",
                 memory || address_space ? "," : "", settings->limit_megabytes);
    log_line(LEVEL_INFO,
             "memory: the process may have%s%s%s: tokens.megabytes %u of %u, replies.megabytes "
             "%u of %u, vibrations %u, prepared bodies %u",
             group, space, kept, settings->token_megabytes, tokens, settings->reply_megabytes,
             replies, settings->box_megabytes, settings->body_megabytes);
    enum { EACH_NEEDS = 4 }; /* MiB: tables of steps of a few bodies */
    const unsigned threads = limits_solving_threads(settings);
    if (settings->body_megabytes < EACH_NEEDS * threads)
        log_line(LEVEL_WARNING,
                 "memory: %u MiB are for the bodies that %u threads prepare: where a thread needs "
                 "more than its part, each impact prepares its bodies anew; %u MiB are enough for "
                 "most (limits.megabytes %u, or fewer workers)",
                 settings->body_megabytes, threads, EACH_NEEDS * threads, 4 * EACH_NEEDS * threads);
}
