/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "output_file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli.h"

static bool can_write(const char *file);

/* Whether the file can be written where a link that leads nowhere yet points to. */
static bool can_write_behind(const char *link)
{
    char target[PATH_MAX], path[2 * PATH_MAX];
    const char *slash = strrchr(link, '/');
    ssize_t length = readlink(link, target, sizeof target - 1);
    if (length < 0)
        return false;
    target[length] = '\0';
    size_t folder = slash && target[0] != '/' ? (size_t)(slash + 1 - link) : 0;
    snprintf(path, sizeof path, "%.*s%s", (int)folder, link, target);
    return can_write(path);
}

/* The trial leaves an existing file as it is, and removes only a file that it created. */
static bool can_write(const char *file)
{
    struct stat there;
    /* a file that is not there yet is tried and taken away again */
    int trial = open(file, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (trial >= 0) {
        close(trial);
        unlink(file);
        return true;
    }
    if (errno != EEXIST)
        return false;
    if (stat(file, &there) != 0)
        return errno == ENOENT && can_write_behind(file);
    /* the reader of a pipe would take a trial for its end */
    if (!S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode))
        return access(file, W_OK) == 0;
    trial = open(file, O_WRONLY);
    if (trial >= 0)
        close(trial);
    return trial >= 0;
}

static bool trusts;

void output_file_trust(void)
{
    trusts = true;
}

void output_file_check(const char *option, const char *file, struct argp_state *state)
{
    if (!trusts && !can_write(file))
        argp_failure(state, EXIT_USAGE, errno, "--%s: %s: cannot be written", option, file);
}

/* A folder that is not there yet is tried and taken away again. */
static bool can_write_into(const char *folder)
{
    struct stat there;
    if (mkdir(folder, 0777) == 0) {
        rmdir(folder);
        return true;
    }
    if (errno != EEXIST || stat(folder, &there) != 0)
        return false;
    errno = ENOTDIR;
    return S_ISDIR(there.st_mode) && access(folder, W_OK | X_OK) == 0;
}

void output_folder_check(const char *option, const char *folder, struct argp_state *state)
{
    if (!trusts && !can_write_into(folder))
        argp_failure(state, EXIT_USAGE, errno, "--%s: %s: cannot be written", option, folder);
}

int output_folder_make(const char *option, const char *folder)
{
    if (mkdir(folder, 0777) == 0 || errno == EEXIST)
        return EXIT_ANSWERED;
    complain("--%s: %s: %s", option, folder, strerror(errno));
    return EXIT_FAILURE;
}

int output_file_write(const char *option, const char *file, const void *bytes, size_t size)
{
    FILE *out = fopen(file, "wb");
    if (!out) {
        complain("--%s: %s: %s", option, file, strerror(errno));
        return EXIT_FAILURE;
    }
    bool written = fwrite(bytes, 1, size, out) == size;
    written = fclose(out) == 0 && written;
    if (!written)
        complain("--%s: %s: could not be written: %s", option, file, strerror(errno));
    return written ? EXIT_ANSWERED : EXIT_FAILURE;
}
