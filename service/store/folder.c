/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/folder.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool folder_make(const char *path)
{
    char part[PATH_MAX];
    if (snprintf(part, sizeof part, "%s", path) >= (int)sizeof part) {
        errno = ENAMETOOLONG;
        return false;
    }
    /* each that it lies in, then itself */
    for (char *slash = strchr(part + 1, '/'); *part && slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        if (mkdir(part, 0755) != 0 && errno != EEXIST && access(part, F_OK) != 0)
            return false;
        *slash = '/';
    }
    return mkdir(path, 0755) == 0 || errno == EEXIST;
}

/* `rest` in the folder that a variable names, up to the first of `ends`, if it is an absolute path.
 */
static bool find_in(char *path, size_t size, const char *variable, const char *ends,
                    const char *rest)
{
    const char *folder = getenv(variable);
    if (!folder || *folder != '/')
        return false;
    int length = snprintf(path, size, "%.*s%s", (int)strcspn(folder, ends), folder, rest);
    return length > 0 && (size_t)length < size;
}

bool folder_own_tables(char *path, size_t size)
{
    const char *named = getenv("PERCUSS_TABLES");
    char here[PATH_MAX];
    if (!named)
        /* systemd may name several folders */
        return find_in(path, size, "STATE_DIRECTORY", ":", "/tables") ||
               find_in(path, size, "XDG_DATA_HOME", "", "/percuss/tables") ||
               find_in(path, size, "HOME", "", "/.local/share/percuss/tables");
    if (*named == '/' || !*named)
        return find_in(path, size, "PERCUSS_TABLES", "", "");
    /* from the working folder: it is named to people who may be elsewhere */
    if (!getcwd(here, sizeof here))
        return false;
    int length = snprintf(path, size, "%s/%s", here, named);
    return length > 0 && (size_t)length < size;
}
