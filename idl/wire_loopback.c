/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_loopback.h"

#include <dds/ddsi/ddsi_config.h>
#include <dirent.h>
#include <linux/filter.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include "wire_ports.h"

enum {
    MOST_SOCKETS = 64,
    DRAIN_ATTEMPTS = 1000,
};

/* From the last word of a process until it is forgotten: below 2 s with what a client waits then
 * for a standby's answer, 0.2 s. The daemon announces its state each second, which renews it. */
static const dds_duration_t LEASE = DDS_MSECS(1700);
/* The same of a client, which nobody follows: what it asked is given up. It speaks twice in it. */
static const dds_duration_t LEASE_OF_CLIENT = DDS_SECS(3);

/* A client announces itself where servers are, and not to other clients: all of them would answer,
 * and renew its lease, and each of its own, for nothing. Its process takes a port behind theirs. */
static void be_client(uint32_t domain, struct ddsi_config *config)
{
    /* DDS reads them while it makes a domain, one at a time */
    static struct ddsi_config_peer_listelem peers[WIRE_LOOPBACK_CLIENTS];
    static char addresses[WIRE_LOOPBACK_CLIENTS][sizeof "127.0.0.1:65535"];
    for (int i = 0; i < WIRE_LOOPBACK_CLIENTS; i++) {
        snprintf(addresses[i], sizeof addresses[i], "127.0.0.1:%u",
                 wire_ports_of_index(domain, (unsigned)i) & UINT16_MAX);
        peers[i] = (struct ddsi_config_peer_listelem){
            .next = i + 1 < WIRE_LOOPBACK_CLIENTS ? &peers[i + 1] : NULL, .peer = addresses[i]};
    }
    config->peers = peers;
    config->ports.d1 += 2 * WIRE_LOOPBACK_CLIENTS;
    config->ports.d3 += 2 * WIRE_LOOPBACK_CLIENTS;
    config->maxAutoParticipantIndex = WIRE_LOOPBACK_INDICES - WIRE_LOOPBACK_CLIENTS;
    config->lease_duration = LEASE_OF_CLIENT;
}

/* Loopback has no multicast, so peers are addressed by port: one index per process. Deaf at first:
 * Cyclone DDS receives at any address of the machine, whatever its interface is, until its sockets
 * have a filter. */
static dds_entity_t create_deaf(uint32_t domain, enum wire_side side)
{
    static struct ddsi_config_network_interface_listelem interface = {
        .cfg = {.address = "127.0.0.1",
                .presence_required = 1,
                .multicast = DDSI_BOOLDEF_DEFAULT,
                .priority = {.isdefault = 1}}};
    static struct ddsi_config_peer_listelem peer = {.peer = "127.0.0.1"};
    struct ddsi_config config;
    ddsi_config_init_default(&config);
    config.network_interfaces = &interface;
    config.allowMulticast = DDSI_AMC_FALSE;
    config.peers = &peer;
    config.participantIndex = DDSI_PARTICIPANT_INDEX_AUTO;
    /* which addresses peers up to the one before it */
    config.maxAutoParticipantIndex = WIRE_LOOPBACK_INDICES;
    config.lease_duration = LEASE;
    if (side == WIRE_CLIENT)
        be_client(domain, &config);
    config.initial_deaf = 1;
    config.initial_deaf_mute_reset = DDS_INFINITY;
    return dds_create_domain_with_rawconfig(domain, &config);
}

/* Sockets of this process that receive at any address on a port of this domain. */
struct sockets {
    int number[MOST_SOCKETS];
    ino_t id[MOST_SOCKETS];
    size_t count;
};

/* Unicast ports of the processes of a domain. */
static bool is_ours(int file, uint32_t domain)
{
    const uint32_t first = wire_ports_of_index(domain, 0),
                   last = first + 1 + 2 * WIRE_LOOPBACK_INDICES;
    struct sockaddr_in address = {0};
    socklen_t size = sizeof address;
    return getsockname(file, (struct sockaddr *)&address, &size) == 0 &&
           address.sin_family == AF_INET && address.sin_addr.s_addr == htonl(INADDR_ANY) &&
           ntohs(address.sin_port) >= first && ntohs(address.sin_port) <= last;
}

static bool list_sockets(uint32_t domain, struct sockets *sockets)
{
    sockets->count = 0;
    DIR *files = opendir("/proc/self/fd");
    if (!files)
        return false;
    for (struct dirent *entry; (entry = readdir(files)) && sockets->count < MOST_SOCKETS;) {
        struct stat about;
        int file = atoi(entry->d_name);
        if (entry->d_name[0] == '.' || !is_ours(file, domain) || fstat(file, &about) != 0)
            continue;
        sockets->number[sockets->count] = file;
        sockets->id[sockets->count++] = about.st_ino;
    }
    closedir(files);
    return sockets->count < MOST_SOCKETS;
}

static bool is_in(const struct sockets *sockets, ino_t id)
{
    for (size_t i = 0; i < sockets->count; i++)
        if (sockets->id[i] == id)
            return true;
    return false;
}

/* Drops what does not come from 127.0.0.0/8, for good. */
static bool filter(int file)
{
    enum { SOURCE = 12 }; /* bytes from the beginning of an IP header */
    struct sock_filter program[] = {
        BPF_STMT(BPF_LD | BPF_B | BPF_ABS, (uint32_t)SKF_NET_OFF + SOURCE),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 127, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, UINT32_MAX),
        BPF_STMT(BPF_RET | BPF_K, 0),
    };
    struct sock_fprog whole = {.len = sizeof program / sizeof *program, .filter = program};
    const int locked = 1;
    return setsockopt(file, SOL_SOCKET, SO_ATTACH_FILTER, &whole, sizeof whole) == 0 &&
           setsockopt(file, SOL_SOCKET, SO_LOCK_FILTER, &locked, sizeof locked) == 0;
}

/* Until the deaf domain has thrown away what had come before the filter. */
static void drain(int file)
{
    int waiting = 1;
    for (int i = 0; i < DRAIN_ATTEMPTS && ioctl(file, FIONREAD, &waiting) == 0 && waiting > 0; i++)
        dds_sleepfor(DDS_MSECS(1));
}

/* Filters the sockets that were not there `before`: others belong to somebody else in this process.
 */
static bool close_to_others(uint32_t domain, const struct sockets *before)
{
    struct sockets now;
    size_t filtered = 0;
    if (!list_sockets(domain, &now))
        return false;
    for (size_t i = 0; i < now.count; i++) {
        if (is_in(before, now.id[i]))
            continue;
        if (!filter(now.number[i]))
            return false;
        drain(now.number[i]);
        filtered++;
    }
    return filtered > 0;
}

dds_entity_t wire_loopback_create(uint32_t domain, enum wire_side side)
{
    struct sockets before;
    bool listed = list_sockets(domain, &before);
    dds_entity_t created = create_deaf(domain, side);
    if (created < 0)
        return created;
    if (!listed || !close_to_others(domain, &before)) {
        dds_delete(created);
        return DDS_RETCODE_UNSUPPORTED;
    }
    dds_domain_set_deafmute(created, false, false, DDS_INFINITY);
    return created;
}
