/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "output_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli.h"

static bool can_write(const char *file)
{
    struct stat there;
    bool is_new = stat(file, &there) != 0;
    /* the reader of a pipe would take a trial for its end */
    if (!is_new && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode))
        return access(file, W_OK) == 0;
    int trial = open(file, is_new ? O_WRONLY | O_CREAT : O_WRONLY, 0666);
    if (trial < 0)
        return false;
    close(trial);
    if (is_new)
        unlink(file);
    return true;
}

void output_file_check(const char *option, const char *file, struct argp_state *state)
{
    if (!can_write(file))
        argp_failure(state, EXIT_USAGE, errno, "--%s: %s: cannot be written", option, file);
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
