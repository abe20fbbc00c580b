/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/backup.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "store/database.h"
#include "store/folder.h"

static void complain_once(void *context, const char *problem)
{
    snprintf(context, sizeof(struct fault), "%s", problem);
}

/* Whether a copy is whole, by opening it as the store it is. */
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

enum percuss_status backup_write(struct specimen_store *store, const char *path,
                                 struct fault *fault)
{
    static const char *const ends[] = {"", "-wal", "-journal"};
    char aside[4096 + 16], name[sizeof aside + 16];
    snprintf(aside, sizeof aside, "%s.part", path);
    /* what an interrupted one has left */
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        snprintf(name, sizeof name, "%s%s", aside, ends[i]);
        unlink(name);
    }
    /* the former copy stays until the new one is whole and on the disk */
    enum percuss_status status = specimen_store_copy(store, aside, fault);
    if (!status)
        status = check_copy(aside, fault);
    if (!status && rename(aside, path) != 0)
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: cannot be written: %s", path,
                           strerror(errno));
    if (!status)
        status = folder_sync(path, fault);
    else
        unlink(aside);
    return status;
}
