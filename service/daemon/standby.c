/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/standby.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include "catalogue/catalogue.h"
#include "daemon/limits.h"
#include "daemon/log.h"
#include "exchange/clock.h"

/* 32 hexadecimal digits and the end of the line. */
enum { LINE_SIZE = 33 };

/* The file that this process has locked, or -1. A global, as the lock is the process's. */
static int held = -1;

/* Between two tries to take the place: far below the lease of a killed daemon. */
static const struct timespec TURN = {.tv_nsec = 50000000};

static enum percuss_status standby_refuse(const char *path, const char *problem,
                                          struct fault *fault)
{
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%.400s: %s", path, problem);
}

/* The whole file is locked, now or not at all. The lock is the process's, so that a child which
 * outlives it does not keep it. */
static enum percuss_status standby_lock(int file, const char *path, struct fault *fault)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(file, F_SETLK, &whole) == 0)
        return PERCUSS_OK;
    if (errno == EACCES || errno == EAGAIN)
        return fault_set(fault, PERCUSS_BUSY, "%.400s: is held by another process", path);
    return standby_refuse(path, strerror(errno), fault);
}

/* False: the line is no server id. */
static bool standby_parse(const char line[LINE_SIZE], uint8_t server[16])
{
    static const char digits[] = "0123456789abcdef";
    for (int i = 0; i < 32; i++) {
        const char *digit = line[i] ? strchr(digits, line[i]) : NULL;
        if (!digit)
            return false;
        unsigned value = (unsigned)(digit - digits);
        server[i / 2] = (uint8_t)(i % 2 ? server[i / 2] | value : value << 4);
    }
    return line[LINE_SIZE - 1] == '\n';
}

/* A new id, on the disk before it is published. */
static enum percuss_status standby_draw(int file, const char *path, uint8_t server[16],
                                        struct fault *fault)
{
    char line[LINE_SIZE + 1];
    if (getrandom(server, 16, 0) != 16)
        return fault_set(fault, PERCUSS_INTERNAL, "no random numbers");
    for (int i = 0; i < 16; i++)
        snprintf(line + 2 * i, 3, "%02x", server[i]);
    line[LINE_SIZE - 1] = '\n';
    if (pwrite(file, line, LINE_SIZE, 0) == LINE_SIZE && fsync(file) == 0)
        return PERCUSS_OK;
    return standby_refuse(path, "cannot be written", fault);
}

/* The id in the file. */
static enum percuss_status standby_identify(int file, const char *path, uint8_t server[16],
                                            struct fault *fault)
{
    char line[LINE_SIZE + 1];
    ssize_t size = pread(file, line, sizeof line, 0);
    if (size < 0)
        return standby_refuse(path, "cannot be read", fault);
    if (size == 0)
        return standby_draw(file, path, server, fault);
    if (size == LINE_SIZE && standby_parse(line, server))
        return PERCUSS_OK;
    return standby_refuse(path, "must be empty or hold a server id of 32 hexadecimal digits",
                          fault);
}

enum percuss_status standby_take(const char *path, uint8_t server[16], struct fault *fault)
{
    int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0)
        return standby_refuse(path, strerror(errno), fault);
    enum percuss_status status = standby_lock(file, path, fault);
    if (!status)
        status = standby_identify(file, path, server, fault);
    /* a locked file stays open to the end of the process */
    if (status)
        close(file);
    else
        held = file;
    return status;
}

enum percuss_status standby_check(const char *path, struct fault *fault)
{
    return limits_check_place(path, R_OK | W_OK, fault);
}

bool standby_is_held(const char *path)
{
    struct fault fault;
    struct stat locked, named;
    return held >= 0 && standby_lock(held, path, &fault) == PERCUSS_OK &&
           fstat(held, &locked) == 0 && stat(path, &named) == 0 && locked.st_dev == named.st_dev &&
           locked.st_ino == named.st_ino;
}

/* Whether the catalogue can be loaded: an error is logged now rather than when it takes over. */
static enum percuss_status standby_try_catalogue(const struct settings *settings,
                                                 struct fault *fault)
{
    struct body_set *set;
    const char *folder = settings->bodies[0] ? settings->bodies : NULL;
    enum percuss_status status = catalogue_load_reducing(settings->catalogue, folder, &set, fault);
    if (!status)
        body_set_free(set);
    return status;
}

/* Until the next look at the place; false: a signal asks for the end. */
static bool standby_rest(const struct settings *settings, const sigset_t *signals)
{
    struct fault fault;
    int signal_number = sigtimedwait(signals, NULL, &TURN);
    if (signal_number == SIGTERM || signal_number == SIGINT)
        return false;
    if (signal_number == SIGHUP && standby_try_catalogue(settings, &fault))
        log_line(LEVEL_ERROR, "standby: %s", fault.text);
    return true;
}

enum standby_end standby_wait(const struct settings *settings, const sigset_t *signals,
                              const struct notifier *notifier, uint8_t server[16],
                              struct fault *fault)
{
    enum percuss_status status = standby_take(settings->standby, server, fault);
    double told = -INFINITY;
    if (status != PERCUSS_BUSY)
        return status ? STANDBY_FAILED : STANDBY_TAKEN;
    /* check that it can take over, and tell the manager that it waits */
    log_line(LEVEL_INFO, "standby: %s: waits until it ends", fault->text);
    if (standby_try_catalogue(settings, fault))
        return STANDBY_FAILED;
    notify(notifier, "READY=1\nSTATUS=standby: waits until the one that answers ends");
    /* until the place is free */
    while (status == PERCUSS_BUSY) {
        if (!standby_rest(settings, signals))
            return STANDBY_STOPPED;
        if (notifier->watchdog > 0.0 && clock_now() - told > 0.25 * notifier->watchdog) {
            notify(notifier, "WATCHDOG=1");
            told = clock_now();
        }
        status = standby_take(settings->standby, server, fault);
    }
    if (status)
        return STANDBY_FAILED;
    log_line(LEVEL_INFO, "standby: the place is free: takes over");
    return STANDBY_TAKEN;
}
