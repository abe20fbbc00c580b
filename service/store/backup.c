/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/backup.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "store/database.h"

static void complain_once(void *context, const char *problem)
{
    snprintf(context, sizeof(struct fault), "%s", problem);
}

/* Opens a copy as a store and checks all its rows. */
static enum percuss_status check_copy(const char *path, struct fault *fault)
{
    struct fault problem = {""};
    struct audit audit = {.complain = complain_once, .context = &problem};
    struct specimen_store *copy;
    enum percuss_status status = specimen_store_open(path, UINT_MAX, &copy, fault);
    if (!status)
        status = specimen_store_audit(copy, &audit, fault);
    specimen_store_close(copy);
    if (!status && audit.damaged)
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "%.560s", problem.text);
    return status;
}

/* The path with the links in its folder resolved: SQLite opens the copy without following links. */
static enum percuss_status resolve_folder(const char *path, char whole[ATOMIC_FILE_SIZE],
                                          struct fault *fault)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    char folder[ATOMIC_FILE_SIZE], found[PATH_MAX];
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash + 1 - path) : 1,
             slash ? path : ".");
    if (!realpath(folder, found))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: cannot be written: %s", folder,
                         strerror(errno));
    const char *between = found[1] ? "/" : "";
    if (snprintf(whole, ATOMIC_FILE_SIZE, "%s%s%s", found, between, name) < ATOMIC_FILE_SIZE)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: cannot be written: %s", path,
                     strerror(ENAMETOOLONG));
}

enum percuss_status backup_write(struct specimen_store *store, const char *path,
                                 struct fault *fault)
{
    static const char *const ends[] = {"-wal", "-journal"};
    char whole[ATOMIC_FILE_SIZE], name[ATOMIC_FILE_SIZE + 32];
    struct atomic_file aside;
    enum percuss_status status = resolve_folder(path, whole, fault);
    int file = status ? -1 : atomic_file_create(&aside, whole, 0644, fault);
    if (file < 0)
        return PERCUSS_BAD_REQUEST;
    close(file);
    /* files that an interrupted copy has left beside it */
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        snprintf(name, sizeof name, "%s%s", aside.aside, ends[i]);
        unlink(name);
    }
    /* the former copy stays until the new one is whole and on the disk */
    status = specimen_store_copy(store, aside.aside, fault);
    if (!status)
        status = check_copy(aside.aside, fault);
    if (status) {
        atomic_file_abandon(&aside);
        return status;
    }
    return atomic_file_finish(&aside, true, fault);
}
