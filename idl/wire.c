/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire.h"

#include <errno.h>
#include <fcntl.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "wire_loopback.h"
#include "wire_ports.h"
#include "wire_security.h"
#include "wire_shared.h"

/* The domain of an earlier participant of this process serves as well, as soon as it is ready. */
static dds_return_t create_domain(uint32_t domain, enum wire_side side)
{
    static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&one_at_a_time);
    dds_entity_t created = wire_loopback_create(domain, side);
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

/* What the thread's last failure was about. */
static _Thread_local struct {
    uint32_t domain;
    unsigned first, indices; /* of its participant indices, and how many are taken */
} failed;

/* Where nothing says what there is it is taken to be up. */
static bool has_loopback(void)
{
    struct ifaddrs *list = NULL;
    if (getifaddrs(&list) != 0)
        return true;
    bool found = false;
    for (const struct ifaddrs *entry = list; entry; entry = entry->ifa_next)
        found = found || (entry->ifa_flags & IFF_LOOPBACK && entry->ifa_flags & IFF_UP &&
                          entry->ifa_addr && entry->ifa_addr->sa_family == AF_INET);
    freeifaddrs(list);
    return found;
}

/* DDS has one code for most of what it finds wrong. */
static dds_return_t find_reason(uint32_t domain, const enum wire_side *side, dds_return_t code)
{
    if (!side && !wire_is_configured())
        return code;
    struct wire_ports *ports = malloc(sizeof *ports);
    bool read = code == DDS_RETCODE_ERROR && ports && wire_ports_read_own(ports);
    failed.domain = domain;
    failed.first =
        side && *side == WIRE_CLIENT && !wire_is_configured() ? WIRE_LOOPBACK_CLIENTS : 0;
    failed.indices = read ? wire_ports_indices(ports, domain, failed.first) : 0;
    free(ports);
    if (code == DDS_RETCODE_ERROR && wire_is_configured())
        return WIRE_CONFIGURED_BADLY;
    if (code == DDS_RETCODE_ERROR && !has_loopback())
        return WIRE_NO_LOOPBACK;
    return failed.first + failed.indices >= WIRE_LOOPBACK_INDICES ? WIRE_NO_INDEX : code;
}

/* `side`: in the built-in configuration, where CYCLONEDDS_URI states none; NULL: in DDS's own. */
static dds_entity_t create_participant(uint32_t domain, const char *security,
                                       const enum wire_side *side)
{
    if (!has_descriptors())
        return WIRE_NO_DESCRIPTORS;
    if (!has_address_space())
        return WIRE_NO_ADDRESS_SPACE;
    if (wire_is_configured() && wire_shared_is_asked(getenv("CYCLONEDDS_URI")) &&
        !wire_shared_is_there())
        return WIRE_NO_SHARED_MEMORY;
    dds_return_t made =
        wire_is_configured() || !side ? DDS_RETCODE_OK : create_domain(domain, *side);
    if (made < 0)
        return find_reason(domain, side, made);
    dds_qos_t *qos = security ? dds_create_qos() : NULL;
    if (security && (!qos || !wire_security_set(security, qos))) {
        dds_delete_qos(qos);
        return DDS_RETCODE_NOT_ALLOWED_BY_SECURITY;
    }
    dds_entity_t participant = dds_create_participant(domain, qos, NULL);
    dds_delete_qos(qos);
    if (participant > 0)
        return participant;
    /* what the plugins find wrong is no more than an error to DDS, and a line in its log */
    return security && participant == DDS_RETCODE_ERROR ? DDS_RETCODE_NOT_ALLOWED_BY_SECURITY
                                                        : find_reason(domain, side, participant);
}

/* That other processes have all of the built-in configuration. */
static void say_no_index(char *text, size_t size)
{
    const unsigned last = WIRE_LOOPBACK_INDICES - 1;
    snprintf(text, size,
             "other processes of this machine have participant indices %u to %u of domain %u (UDP "
             "ports %u to %u), one each, and there are no more: end some of them, or give all of "
             "them a CYCLONEDDS_URI (config/cyclonedds.xml is a beginning) with a higher "
             "Discovery/MaxAutoParticipantIndex than %u",
             failed.first, last, failed.domain, wire_ports_of_index(failed.domain, failed.first),
             wire_ports_of_index(failed.domain, last) + 1, WIRE_LOOPBACK_INDICES);
}

/* Of what is wrong DDS tells standard error alone. */
static void say_configured_badly(char *text, size_t size)
{
    enum { DDS_INDICES = 9 };
    int length = snprintf(text, size,
                          "Cyclone DDS cannot use CYCLONEDDS_URI=%.120s, for the reason that it "
                          "wrote to standard error: percuss doctor looks at it",
                          getenv("CYCLONEDDS_URI"));
    if (failed.indices >= DDS_INDICES)
        snprintf(text + length, size - (size_t)length,
                 "; where that is a free participant index, other processes of this machine have "
                 "them all: Discovery/MaxAutoParticipantIndex, %d unless it is set, has to be "
                 "higher for all of them",
                 DDS_INDICES);
}

static const enum wire_side SERVER = WIRE_SERVER, CLIENT = WIRE_CLIENT;

dds_entity_t wire_participant_create(uint32_t domain)
{
    return create_participant(domain, NULL, &SERVER);
}

dds_entity_t wire_participant_create_secured(uint32_t domain, const char *security)
{
    return create_participant(domain, security, &SERVER);
}

dds_entity_t wire_participant_create_client(uint32_t domain, const char *security)
{
    return create_participant(domain, security, &CLIENT);
}

dds_entity_t wire_participant_create_open(uint32_t domain)
{
    return create_participant(domain, NULL, NULL);
}

const char *wire_participant_problem(dds_return_t code)
{
    if (code == DDS_RETCODE_UNSUPPORTED)
        return "its sockets cannot be closed to other machines: /proc/self/fd and socket filters "
               "are needed for it, or a configuration in CYCLONEDDS_URI";
    if (code == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
        return "its certificate or its permissions are not good, or do not belong together";
    if (code == WIRE_NO_LOOPBACK)
        return "127.0.0.1 is not up, and without CYCLONEDDS_URI nothing else is used: ip link set "
               "lo up (as root) is needed";
    if (code == WIRE_NO_SHARED_MEMORY)
        return "CYCLONEDDS_URI has SharedMemory enabled, and its daemon is not there: start "
               "iox-roudi, or say <Enable>false</Enable>";
    if (code > WIRE_NO_DESCRIPTORS || code < WIRE_CONFIGURED_BADLY)
        return dds_strretcode(-code);
    static _Thread_local char text[480];
    if (code == WIRE_NO_INDEX)
        say_no_index(text, sizeof text);
    else if (code == WIRE_CONFIGURED_BADLY)
        say_configured_badly(text, sizeof text);
    else if (code == WIRE_NO_DESCRIPTORS)
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
