/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/store_care.h"

#include <errno.h>
#include <limits.h>
#include <string.h>
#include <unistd.h>

#include "daemon/log.h"
#include "store/backup.h"
#include "store/database.h"

/* Problems that are logged one by one. */
enum { MOST_COMPLAINTS = 20 };

static void complain(void *context, const char *problem)
{
    int *count = context;
    if ((*count)++ < MOST_COMPLAINTS)
        log_line(LEVEL_ERROR, "store: %s", problem);
}

/* Looks through the store and logs what is found. */
static enum percuss_status look(struct specimen_store *store, struct audit *audit,
                                struct fault *fault)
{
    int complaints = 0;
    audit->complain = complain;
    audit->context = &complaints;
    enum percuss_status status = specimen_store_audit(store, audit, fault);
    if (!status)
        log_line(audit->damaged ? LEVEL_ERROR : LEVEL_INFO,
                 "store: %zu specimens, %zu replies, %zu marks of clients: %zu damaged",
                 audit->specimens, audit->replies, audit->marks, audit->damaged);
    return status;
}

enum percuss_status store_care_check(struct specimen_store *store, bool structure,
                                     struct fault *fault)
{
    struct audit audit = {.structure = structure};
    enum percuss_status status = look(store, &audit, fault);
    if (status || !audit.unusable)
        return status;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "the store of specimens is damaged: nobody knows what was answered: restore "
                     "it from a copy or move it away");
}

void store_care_back_up(struct specimen_store *store, const char *path)
{
    struct fault fault;
    if (store_care_check(store, true, &fault))
        log_line(LEVEL_ERROR, "store: %s", fault.text);
    if (!*path)
        return;
    if (backup_write(store, path, &fault))
        log_line(LEVEL_ERROR, "store: not copied: %s", fault.text);
    else
        log_line(LEVEL_INFO, "store: copied to %s", path);
}

bool store_care_check_file(const char *path)
{
    struct specimen_store *store = NULL;
    struct fault fault;
    enum percuss_status status = PERCUSS_OK;
    /* opening would make one */
    if (access(path, R_OK | W_OK) != 0)
        status = fault_set(&fault, PERCUSS_BAD_REQUEST, "%.300s: cannot be used: %s", path,
                           strerror(errno));
    if (!status)
        status = specimen_store_open(path, UINT_MAX, &store, &fault);
    struct audit audit = {.structure = false};
    if (!status)
        status = look(store, &audit, &fault);
    specimen_store_close(store);
    if (status)
        log_line(LEVEL_ERROR, "%s", fault.text);
    return !status && !audit.damaged;
}
