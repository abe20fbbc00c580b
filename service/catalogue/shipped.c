/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/shipped.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* from the folder of the program: where it was built, and where it was installed to */
static const char *const PLACES[] = {"../share/percuss", INSTALLED_DATA};

char *shipped_find(const char *name)
{
    char program[PATH_MAX];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length <= 0)
        return NULL;
    program[length] = '\0';
    char *slash = strrchr(program, '/');
    int folder = slash ? (int)(slash + 1 - program) : 0;
    for (size_t i = 0; i < sizeof PLACES / sizeof *PLACES; i++) {
        char *path;
        if (asprintf(&path, "%.*s%s/%s", folder, program, PLACES[i], name) < 0)
            return NULL;
        if (access(path, F_OK) == 0)
            return path;
        free(path);
    }
    return NULL;
}
