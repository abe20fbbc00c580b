/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A network that changes the order of packets, put in place of the C library's sendmsg by
 * LD_PRELOAD: some UDP packets are held back until a later one to the same address has gone, or for
 * LONGEST. The environment says what to do:
 *   PERCUSS_REORDER        packets of a thousand that are held back; 0 or none: nothing is done
 *   PERCUSS_REORDER_COUNT  a file of 24 octets that processes share: numbers of 8 octets that count
 *                          packets sent, held back, and overtaken */
#include <dlfcn.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { HELD_MOST = 64, PACKET_MOST = 65536 };

/* ns: a packet without a successor is late by so much; below any time-out of DDS */
static const long LONGEST = 2000000;

struct packet {
    int socket; /* a descriptor of its own */
    struct sockaddr_in to;
    struct timespec due;
    size_t size;
    uint8_t *bytes;
};

/* Shared with other processes: it survives those that are killed. */
struct counts {
    _Atomic uint64_t sent, held, overtaken;
};

static struct {
    uint32_t share; /* of 2^32 packets are held back */
    struct counts *counts, own;
    pthread_mutex_t lock;
    pthread_cond_t filled;
    size_t held;
    struct packet packets[HELD_MOST];
    bool has_thread;
} network = {.lock = PTHREAD_MUTEX_INITIALIZER};

/* The C library's function. */
#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

__attribute__((constructor)) static void begin(void)
{
    const char *share = getenv("PERCUSS_REORDER"), *path = getenv("PERCUSS_REORDER_COUNT");
    network.share = (uint32_t)(share ? strtod(share, NULL) / 1000.0 * UINT32_MAX : 0.0);
    network.counts = &network.own;
    pthread_condattr_t by_clock;
    pthread_condattr_init(&by_clock);
    pthread_condattr_setclock(&by_clock, CLOCK_MONOTONIC);
    pthread_cond_init(&network.filled, &by_clock);
    int file = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
    if (file < 0)
        return;
    void *shared = mmap(NULL, sizeof *network.counts, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (shared != MAP_FAILED)
        network.counts = shared;
    close(file);
}

/* Sends a packet that was held back, and releases it. */
static void deliver(struct packet *packet)
{
    struct iovec part = {packet->bytes, packet->size};
    struct msghdr message = {.msg_name = &packet->to,
                             .msg_namelen = sizeof packet->to,
                             .msg_iov = &part,
                             .msg_iovlen = 1};
    REAL(sendmsg)(packet->socket, &message, MSG_NOSIGNAL);
    close(packet->socket);
    free(packet->bytes);
}

static bool is_same(const struct sockaddr_in *a, const struct sockaddr_in *b)
{
    return a->sin_port == b->sin_port && a->sin_addr.s_addr == b->sin_addr.s_addr;
}

static bool is_before(const struct timespec *a, const struct timespec *b)
{
    return a->tv_sec < b->tv_sec || (a->tv_sec == b->tv_sec && a->tv_nsec <= b->tv_nsec);
}

/* Takes out the packets to that address (NULL: any) that are due by then (NULL: whenever), in their
 * order; returns their number. */
static size_t take(const struct sockaddr_in *to, const struct timespec *by, struct packet *taken)
{
    size_t count = 0, left = 0;
    pthread_mutex_lock(&network.lock);
    for (size_t i = 0; i < network.held; i++) {
        const struct packet *packet = &network.packets[i];
        if ((!to || is_same(to, &packet->to)) && (!by || is_before(&packet->due, by)))
            taken[count++] = *packet;
        else
            network.packets[left++] = *packet;
    }
    network.held = left;
    pthread_mutex_unlock(&network.lock);
    return count;
}

/* Delivers what nothing has overtaken. All packets wait equally long, so the first is due first. */
static void *deliver_late(void *unused)
{
    (void)unused;
    for (;;) {
        struct packet taken[HELD_MOST];
        struct timespec now;
        pthread_mutex_lock(&network.lock);
        while (network.held == 0)
            pthread_cond_wait(&network.filled, &network.lock);
        struct timespec due = network.packets[0].due;
        pthread_mutex_unlock(&network.lock);
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, NULL);
        clock_gettime(CLOCK_MONOTONIC, &now);
        size_t count = take(NULL, &now, taken);
        for (size_t i = 0; i < count; i++)
            deliver(&taken[i]);
    }
    return NULL;
}

/* Copies the parts of a message. False: too large, or no memory. */
static bool copy_bytes(const struct msghdr *message, struct packet *packet)
{
    packet->size = 0;
    for (size_t i = 0; i < message->msg_iovlen; i++)
        packet->size += message->msg_iov[i].iov_len;
    packet->bytes = packet->size <= PACKET_MOST ? malloc(packet->size) : NULL;
    if (!packet->bytes)
        return false;
    size_t at = 0;
    for (size_t i = 0; i < message->msg_iovlen; i++) {
        memcpy(packet->bytes + at, message->msg_iov[i].iov_base, message->msg_iov[i].iov_len);
        at += message->msg_iov[i].iov_len;
    }
    return true;
}

static bool hold(int socket, const struct msghdr *message)
{
    struct packet packet;
    if (!copy_bytes(message, &packet))
        return false;
    memcpy(&packet.to, message->msg_name, sizeof packet.to);
    clock_gettime(CLOCK_MONOTONIC, &packet.due);
    packet.due.tv_nsec += LONGEST;
    packet.due.tv_sec += packet.due.tv_nsec / 1000000000;
    packet.due.tv_nsec %= 1000000000;
    packet.socket = dup(socket);
    pthread_mutex_lock(&network.lock);
    pthread_t thread;
    if (!network.has_thread && pthread_create(&thread, NULL, deliver_late, NULL) == 0) {
        pthread_detach(thread);
        network.has_thread = true;
    }
    bool good = packet.socket >= 0 && network.has_thread && network.held < HELD_MOST;
    if (good) {
        network.packets[network.held++] = packet;
        pthread_cond_signal(&network.filled);
    }
    pthread_mutex_unlock(&network.lock);
    if (good)
        return true;
    if (packet.socket >= 0)
        close(packet.socket);
    free(packet.bytes);
    return false;
}

/* Whether chance holds this packet back. */
static bool is_drawn(void)
{
    static _Thread_local uint64_t state;
    while (state == 0)
        if (getrandom(&state, sizeof state, 0) != sizeof state)
            return false;
    /* xorshift64: G. Marsaglia, Xorshift RNGs, 2003 */
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (uint32_t)(state >> 32) < network.share;
}

ssize_t sendmsg(int socket, const struct msghdr *message, int flags)
{
    const struct sockaddr_in *to = message->msg_name;
    if (!network.share || !to || to->sin_family != AF_INET || message->msg_controllen)
        return REAL(sendmsg)(socket, message, flags);
    atomic_fetch_add(&network.counts->sent, 1);
    if (is_drawn() && hold(socket, message)) {
        atomic_fetch_add(&network.counts->held, 1);
        size_t size = 0;
        for (size_t i = 0; i < message->msg_iovlen; i++)
            size += message->msg_iov[i].iov_len;
        return (ssize_t)size;
    }
    ssize_t result = REAL(sendmsg)(socket, message, flags);
    struct packet overtaken[HELD_MOST];
    size_t count = take(to, NULL, overtaken);
    for (size_t i = 0; i < count; i++)
        deliver(&overtaken[i]);
    atomic_fetch_add(&network.counts->overtaken, count);
    return result;
}
