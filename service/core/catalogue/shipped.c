/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/shipped.h"

#include <dlfcn.h>
#include <limits.h>
#include <link.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* from the folder of the program: where it was built, and where it was installed to; and where a
 * library was installed to */
static const char *const PLACES[] = {"../share/percuss", INSTALLED_DATA, INSTALLED_DATA_OF_LIBRARY};

/* The library that this code is in, or else the program. */
static bool find_self(char path[PATH_MAX])
{
    struct link_map *map = NULL;
    Dl_info place;
    bool found = dladdr1((void *)shipped_find, &place, (void **)&map, RTLD_DL_LINKMAP) != 0;
    /* the program has no name there */
    if (found && map && map->l_name[0])
        return realpath(map->l_name, path);
    ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - 1);
    if (length > 0)
        path[length] = '\0';
    return length > 0;
}

/* The first file of that name in the places, from the folder of this program or library. */
static char *find(const char *const *places, size_t count, const char *name)
{
    char self[PATH_MAX];
    if (!find_self(self))
        return NULL;
    char *slash = strrchr(self, '/');
    int folder = slash ? (int)(slash + 1 - self) : 0;
    for (size_t i = 0; i < count; i++) {
        char *path;
        if (asprintf(&path, "%.*s%s/%s", folder, self, places[i], name) < 0)
            return NULL;
        if (access(path, F_OK) == 0)
            return path;
        free(path);
    }
    return NULL;
}

char *shipped_find(const char *name)
{
    return find(PLACES, sizeof PLACES / sizeof *PLACES, name);
}

char *shipped_resolve(const char *catalogue, const char *file)
{
    const char *slash = strrchr(catalogue, '/');
    int folder = file[0] == '/' || !slash ? 0 : (int)(slash - catalogue) + 1;
    char *path;
    if (asprintf(&path, "%.*s%s", folder, catalogue, file) < 0)
        return NULL;
    if (file[0] == '/' || access(path, F_OK) == 0)
        return path;
    char *shipped = shipped_find(file);
    if (!shipped)
        return path;
    free(path);
    return shipped;
}

/* The real path, for messages; NULL stays NULL. */
static char *as_whole(char *found)
{
    char *whole = found ? realpath(found, NULL) : NULL;
    free(found);
    return whole;
}

char *shipped_settings(void)
{
    static const char *const edited = INSTALLED_SETTINGS;
    char *found = find(&edited, 1, "percussd.yaml");
    return found ? as_whole(found) : shipped_plain_settings();
}

char *shipped_plain_settings(void)
{
    return as_whole(shipped_find("percussd.yaml"));
}

char *shipped_program(const char *name)
{
    static const char *const places[] = {"../bin", INSTALLED_PROGRAMS};
    static const char *const common[] = {"/usr/bin/", "/usr/local/bin/", "/bin/"};
    char *whole = as_whole(find(places, sizeof places / sizeof *places, name));
    for (size_t i = 0; whole && i < sizeof common / sizeof *common; i++) {
        size_t length = strlen(common[i]);
        if (strncmp(whole, common[i], length) == 0 && !strchr(whole + length, '/')) {
            free(whole);
            whole = NULL;
        }
    }
    return whole ? whole : strdup(name);
}
