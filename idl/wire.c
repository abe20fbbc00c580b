/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include "wire_loopback.h"
#include "wire_security.h"

/* The domain of an earlier participant of this process serves as well, as soon as it is ready. */
static dds_return_t create_domain(uint32_t domain)
{
    static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&one_at_a_time);
    dds_entity_t created = wire_loopback_create(domain);
    pthread_mutex_unlock(&one_at_a_time);
    return created == DDS_RETCODE_PRECONDITION_NOT_MET || created > 0 ? DDS_RETCODE_OK : created;
}

/* DDS crashes or aborts without these: descriptors of its sockets, of what wakes its threads and of
 * the check of its sockets; address space for the threads' stacks and 16 MiB. */
enum { DESCRIPTORS = 8, THREADS = 8 };
static const unsigned long long MEMORY = 16 << 20;

/* By taking them for a moment. */
static bool has_descriptors(void)
{
    int held[DESCRIPTORS], count = 0;
    while (count < DESCRIPTORS && (held[count] = open("/", O_PATH | O_CLOEXEC)) >= 0)
        count++;
    bool enough = count == DESCRIPTORS || errno != EMFILE;
    while (count > 0)
        close(held[--count]);
    return enough;
}

static unsigned long long needed_bytes(void)
{
    pthread_attr_t attributes;
    size_t stack = 8 << 20;
    if (pthread_attr_init(&attributes) == 0) {
        pthread_attr_getstacksize(&attributes, &stack);
        pthread_attr_destroy(&attributes);
    }
    return MEMORY + (unsigned long long)THREADS * stack;
}

/* Where nothing says how much the process has it is taken to suffice. */
static bool has_address_space(void)
{
    struct rlimit limit;
    unsigned long long pages = 0;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return true;
    FILE *file = fopen("/proc/self/statm", "re");
    if (!file || fscanf(file, "%llu", &pages) != 1)
        pages = 0;
    if (file)
        fclose(file);
    return pages * (unsigned long long)sysconf(_SC_PAGESIZE) + needed_bytes() <= limit.rlim_cur;
}

bool wire_is_configured(void)
{
    const char *uri = getenv("CYCLONEDDS_URI");
    return uri && *uri;
}

dds_entity_t wire_participant_create(uint32_t domain)
{
    return wire_participant_create_secured(domain, NULL);
}

dds_entity_t wire_participant_create_secured(uint32_t domain, const char *security)
{
    if (!has_descriptors())
        return WIRE_NO_DESCRIPTORS;
    if (!has_address_space())
        return WIRE_NO_ADDRESS_SPACE;
    dds_return_t made = wire_is_configured() ? DDS_RETCODE_OK : create_domain(domain);
    if (made < 0)
        return made;
    dds_qos_t *qos = security ? dds_create_qos() : NULL;
    if (qos)
        wire_security_set(security, qos);
    dds_entity_t participant = dds_create_participant(domain, qos, NULL);
    dds_delete_qos(qos);
    /* what the plugins find wrong is no more than an error to DDS, and a line in its log */
    return security && participant == DDS_RETCODE_ERROR ? DDS_RETCODE_NOT_ALLOWED_BY_SECURITY
                                                        : participant;
}

const char *wire_participant_problem(dds_return_t code)
{
    if (code == DDS_RETCODE_UNSUPPORTED)
        return "its sockets cannot be closed to other machines: /proc/self/fd and socket filters "
               "are needed for it, or a configuration in CYCLONEDDS_URI";
    if (code == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
        return "its certificate or its permissions are not good, or do not belong together";
    if (code == WIRE_NO_DESCRIPTORS || code == WIRE_NO_ADDRESS_SPACE) {
        static _Thread_local char text[160];
        if (code == WIRE_NO_DESCRIPTORS)
            snprintf(text, sizeof text,
                     "fewer than %d file descriptors are left, which DDS needs: ulimit -n must be "
                     "higher",
                     DESCRIPTORS);
        else
            snprintf(text, sizeof text,
                     "less than %llu KiB of address space are left, which the threads of DDS need: "
                     "ulimit -v must be higher",
                     needed_bytes() / 1024);
        return text;
    }
    return dds_strretcode(-code);
}

static void set_partition(dds_qos_t *qos, const char *partition)
{
    if (partition && *partition)
        dds_qset_partition1(qos, partition);
}

dds_qos_t *wire_qos_exchange(const char *partition)
{
    dds_qos_t *qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, WIRE_WINDOW);
    set_partition(qos, partition);
    return qos;
}

dds_qos_t *wire_qos_announcement(const char *partition)
{
    dds_qos_t *qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
    set_partition(qos, partition);
    return qos;
}
