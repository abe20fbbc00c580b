/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A DDS domain of one's own, for tests and benchmarks. */
#ifndef PERCUSS_TESTS_DOMAIN_H
#define PERCUSS_TESTS_DOMAIN_H

#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/random.h>
#include <unistd.h>

/* Domains 20 to 99 and the lock files are those of tests/service/support/lib.sh. */
static inline bool domain_lock(uint32_t domain)
{
    char path[256];
    const char *folder = getenv("PERCUSS_DOMAIN_LOCKS");
    folder = folder ? folder : getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/percuss-domain-%u.lock", folder ? folder : "/tmp", domain);
    int file = open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0)
        return true;
    if (file >= 0)
        close(file);
    return false;
}

/* A random one that nobody else uses as long as this process lives. Ends the process, with a
 * message, if there is none. */
static inline uint32_t domain_draw(void)
{
    enum { ATTEMPTS = 1000 };
    for (int i = 0; i < ATTEMPTS; i++) {
        uint16_t drawn = 0;
        if (getrandom(&drawn, sizeof drawn, 0) == sizeof drawn && domain_lock(20 + drawn % 80))
            return 20 + drawn % 80;
    }
    fprintf(stderr, "no free DDS domain from 20 to 99\n");
    exit(EXIT_FAILURE);
}

#endif
