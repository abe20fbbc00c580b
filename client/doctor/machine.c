/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "machine.h"

#include <arpa/inet.h>
#include <dirent.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "wire.h"
#include "wire_loopback.h"

struct interfaces {
    char text[800];
    size_t length;
    bool loopback, network; /* one that is up */
};

static void note_interface(const struct ifaddrs *entry, struct interfaces *all)
{
    char address[INET_ADDRSTRLEN];
    if (!entry->ifa_addr || entry->ifa_addr->sa_family != AF_INET || !(entry->ifa_flags & IFF_UP))
        return;
    const struct sockaddr_in *of = (const struct sockaddr_in *)entry->ifa_addr;
    const bool loopback = entry->ifa_flags & IFF_LOOPBACK;
    inet_ntop(AF_INET, &of->sin_addr, address, sizeof address);
    all->loopback = all->loopback || loopback;
    all->network = all->network || !loopback;
    if (all->length < sizeof all->text)
        all->length += (size_t)snprintf(
            all->text + all->length, sizeof all->text - all->length, "%s%s %s%s",
            all->length ? ", " : "", entry->ifa_name, address,
            loopback || entry->ifa_flags & IFF_MULTICAST ? "" : " without multicast");
}

void machine_look_at_interfaces(bool network, struct findings *findings)
{
    static const char SUBJECT[] = "interfaces";
    struct interfaces all = {.text = ""};
    struct ifaddrs *list = NULL;
    if (getifaddrs(&list) != 0)
        return;
    for (const struct ifaddrs *entry = list; entry; entry = entry->ifa_next)
        note_interface(entry, &all);
    freeifaddrs(list);
    if (!network && !all.loopback)
        findings_add(findings, FINDING_PROBLEM, SUBJECT, "ip link set lo up (as root)",
                     "127.0.0.1 is not up, and without CYCLONEDDS_URI nothing else is used; up "
                     "are: %s",
                     all.text[0] ? all.text : "none");
    else if (!all.text[0])
        findings_add(findings, FINDING_PROBLEM, SUBJECT, "bring one up: ip link set NAME up",
                     "none is up");
    else if (network && !all.network)
        findings_add(findings, FINDING_WARNING, SUBJECT,
                     "bring the network up where other machines are to be reached",
                     "no other than loopback is up: %s", all.text);
    else
        findings_add(findings, FINDING_OK, SUBJECT, NULL, "up are: %s", all.text);
}

/* Linux sends packets to groups from interfaces without multicast, too, to itself. */
static bool has_multicast(const struct in_addr *address)
{
    struct ifaddrs *list = NULL;
    bool found = false;
    if (getifaddrs(&list) != 0)
        return true;
    for (const struct ifaddrs *entry = list; entry; entry = entry->ifa_next) {
        const struct sockaddr_in *of = (const struct sockaddr_in *)entry->ifa_addr;
        found =
            found || (of && of->sin_family == AF_INET && of->sin_addr.s_addr == address->s_addr &&
                      entry->ifa_flags & IFF_MULTICAST);
    }
    freeifaddrs(list);
    return found;
}

bool machine_multicasts(const char *address)
{
    static const char GROUP[] = "239.255.0.1"; /* as DDS does */
    enum { PATIENCE = 300 };                   /* ms */
    struct sockaddr_in to = {.sin_family = AF_INET};
    struct ip_mreq group = {0};
    socklen_t size = sizeof to;
    char byte = 1;
    int file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    struct pollfd ready = {.fd = file, .events = POLLIN};
    inet_pton(AF_INET, address, &group.imr_interface);
    inet_pton(AF_INET, GROUP, &group.imr_multiaddr);
    /* a port that nobody else has */
    bool good = bind(file, (struct sockaddr *)&to, sizeof to) == 0 &&
                getsockname(file, (struct sockaddr *)&to, &size) == 0;
    to.sin_addr = group.imr_multiaddr;
    good = good && has_multicast(&group.imr_interface) &&
           setsockopt(file, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) == 0 &&
           setsockopt(file, IPPROTO_IP, IP_MULTICAST_IF, &group.imr_interface,
                      sizeof group.imr_interface) == 0 &&
           sendto(file, &byte, 1, 0, (struct sockaddr *)&to, sizeof to) == 1 &&
           poll(&ready, 1, PATIENCE) == 1;
    if (file >= 0)
        close(file);
    return good;
}

unsigned machine_indices(uint32_t domain)
{
    struct wire_ports *ports = malloc(sizeof *ports);
    unsigned first = wire_is_configured() ? 0 : WIRE_LOOPBACK_CLIENTS;
    bool read = ports && wire_ports_read_own(ports);
    unsigned taken = read ? wire_ports_indices(ports, domain, first) : 0;
    free(ports);
    return taken;
}

/* Descriptors that the process may still open; -1: unknown. */
static long descriptors_left(long process)
{
    char path[64], line[128];
    long allowed = -1, used = 0;
    snprintf(path, sizeof path, "/proc/%ld/limits", process);
    FILE *limits = fopen(path, "re");
    while (limits && fgets(line, sizeof line, limits))
        (void)sscanf(line, "Max open files %ld", &allowed);
    if (limits)
        fclose(limits);
    snprintf(path, sizeof path, "/proc/%ld/fd", process);
    DIR *files = opendir(path);
    if (!files || allowed < 0)
        allowed = -1;
    while (files && readdir(files))
        used++;
    if (files)
        closedir(files);
    return allowed < 0 ? -1 : allowed - used + 2; /* . and .. */
}

static void look_at_descriptors(const struct wire_daemon *daemon, struct findings *findings)
{
    enum { FEW = 16 };
    long left = descriptors_left(daemon->process);
    if (left >= 0 && left < FEW)
        findings_add(findings, FINDING_WARNING, "descriptors",
                     "raise its limit (ulimit -n, LimitNOFILE=) and restart it",
                     "process %ld may open %ld more files only", daemon->process, left);
}

/* How CYCLONEDDS_URI of one that is there stands to ours. */
static void look_at_daemon(const struct wire_daemon *daemon, bool answered,
                           struct findings *findings)
{
    static const char SUBJECT[] = "process";
    const enum wire_likeness likeness = wire_daemon_likeness(daemon);
    const enum finding_level level = answered ? FINDING_OK : FINDING_PROBLEM;
    const char *own = getenv("CYCLONEDDS_URI"), *its = daemon->configuration;
    static const char advice[] =
        "sudo -E percuss doctor compares them; its log names it: journalctl "
        "-u percussd | grep CYCLONEDDS_URI";
    if (daemon->stopped)
        findings_add(findings, level, SUBJECT, "kill -CONT lets it go on, as a debugger's continue",
                     "percussd is stopped, as process %ld in this domain", daemon->process);
    else if (daemon->elsewhere)
        findings_add(findings, level, SUBJECT,
                     answered ? NULL : "run it in the host's network namespace (--network host)",
                     "percussd runs as process %ld in another network namespace, such as a "
                     "container's, which is not heard here",
                     daemon->process);
    else if (likeness == WIRE_UNKNOWN)
        findings_add(findings, answered ? FINDING_OK : FINDING_WARNING, SUBJECT,
                     answered ? NULL : advice,
                     "percussd runs as process %ld of user %u, who has a process in this domain; "
                     "its CYCLONEDDS_URI only that user and root can read",
                     daemon->process, daemon->user);
    else if (likeness == WIRE_ALIKE)
        findings_add(findings, FINDING_OK, SUBJECT, NULL,
                     "percussd runs as process %ld in this domain, with the same CYCLONEDDS_URI%s",
                     daemon->process,
                     answered ? "" : ": it is not that which keeps it from answering");
    else
        findings_add(findings, level, SUBJECT,
                     answered ? NULL
                              : "give both the same CYCLONEDDS_URI, or unset it for both, and "
                                "restart the daemon",
                     "percussd runs as process %ld in this domain with %s%.300s, and here it is "
                     "%.300s",
                     daemon->process, *its ? "CYCLONEDDS_URI=" : "CYCLONEDDS_URI not set", its,
                     own && *own ? own : "not set");
}

/* One that waits for another's end has not joined DDS, nor has one that begins. */
static void look_for_place(const struct wire_daemon *daemon, struct findings *findings)
{
    bool joined = !daemon->readable;
    for (size_t i = 0; i < WIRE_PORTS_DOMAINS; i++)
        joined = joined || daemon->domains[i];
    if (!joined)
        findings_add(findings, FINDING_OK, "process", NULL,
                     "percussd runs as process %ld and is in no domain: it stands by for another "
                     "one, or begins",
                     daemon->process);
}

size_t machine_look_at_daemons(uint32_t domain, bool answered, struct wire_daemon *daemons,
                               struct findings *findings)
{
    const size_t all = wire_daemons_find(daemons);
    size_t count = 0;
    for (size_t i = 0; i < all; i++) {
        look_for_place(&daemons[i], findings);
        if (!daemons[i].domains[domain])
            continue;
        look_at_daemon(&daemons[i], answered, findings);
        look_at_descriptors(&daemons[i], findings);
        daemons[count++] = daemons[i];
    }
    return count;
}
