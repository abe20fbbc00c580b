/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/aside.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool aside_begin(const char *path, char aside[ASIDE_SIZE])
{
    struct stat about;
    bool itself = lstat(path, &about) == 0 && !S_ISREG(about.st_mode);
    if (snprintf(aside, ASIDE_SIZE, "%s%s", path, itself ? "" : ".part") < ASIDE_SIZE)
        return true;
    *aside = '\0';
    errno = ENAMETOOLONG;
    return false;
}

static bool synchronise(const char *path)
{
    int file = open(path, O_RDONLY | O_CLOEXEC);
    bool good = file >= 0 && fsync(file) == 0;
    int reason = errno;
    if (file >= 0)
        close(file);
    errno = reason;
    return good;
}

bool aside_end(const char *aside, const char *path, bool good)
{
    if (strcmp(aside, path) == 0)
        return good;
    if (good && synchronise(aside) && rename(aside, path) == 0)
        return true;
    int reason = errno;
    unlink(aside);
    errno = reason;
    return false;
}
