/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/body_cache.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "daemon/log.h"

enum { NAME_LENGTH = 64 }; /* of an order: a hash in hexadecimal */

static const double DAY = 86400.0; /* s */
/* A process of another machine, which is not seen here, may be in work that long. */
static const double LEFT_BEHIND_DAYS = 2.0;

static const struct body_order *find(const struct body_set *set, const char *name)
{
    for (size_t i = 0; i < set->order_count; i++)
        if (strncmp(set->orders[i].name, name, NAME_LENGTH) == 0)
            return &set->orders[i];
    return NULL;
}

/* "1234.messages": a file of a process that is there no more. */
static bool is_orphan(const char *suffix)
{
    static const char *const kinds[] = {".h5", ".h5.part", ".messages", ".yaml"};
    char *end;
    long process = strtol(suffix, &end, 10);
    bool known = false;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        known = known || strcmp(end, kinds[i]) == 0;
    return known && process > 0 && kill((pid_t)process, 0) != 0 && errno == ESRCH;
}

/* The days that a file stays unused before it goes; negative: for ever. */
static double days_of(const char *name, const struct body_set *set, double days)
{
    if (strspn(name, "0123456789abcdef") != NAME_LENGTH || name[NAME_LENGTH] != '.')
        return -1.0;
    const char *suffix = name + NAME_LENGTH + 1;
    bool result =
        strcmp(suffix, "h5") == 0 || strcmp(suffix, "failed") == 0 || strcmp(suffix, "killed") == 0;
    if (result)
        return find(set, name) ? -1.0 : days;
    return is_orphan(suffix) ? LEFT_BEHIND_DAYS : -1.0;
}

static void mark(int folder, const struct body_set *set)
{
    for (size_t i = 0; i < set->order_count; i++) {
        char name[NAME_LENGTH + 4];
        snprintf(name, sizeof name, "%.64s.h5", set->orders[i].name);
        if (set->orders[i].made)
            utimensat(folder, name, NULL, 0);
    }
}

void body_cache_tidy(const char *folder, const struct body_set *set, double days)
{
    struct dirent *entry;
    struct stat file;
    DIR *stream = opendir(folder);
    if (!stream)
        return;
    mark(dirfd(stream), set);
    time_t now = time(NULL);
    while ((entry = readdir(stream))) {
        double stays = days_of(entry->d_name, set, days);
        if (stays < 0.0 || fstatat(dirfd(stream), entry->d_name, &file, AT_SYMLINK_NOFOLLOW) != 0)
            continue;
        double unused = difftime(now, file.st_mtime) / DAY;
        if (S_ISREG(file.st_mode) && unused > stays &&
            unlinkat(dirfd(stream), entry->d_name, 0) == 0)
            log_line(LEVEL_INFO, "%s/%s: unused for %.0f days: deleted", folder, entry->d_name,
                     unused);
    }
    closedir(stream);
}
