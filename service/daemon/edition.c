/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/edition.h"

#include <stdlib.h>

#include "catalogue/catalogue.h"

static enum percuss_status edition_load(const char *path, struct edition **edition,
                                        struct fault *fault)
{
    *edition = calloc(1, sizeof **edition);
    if (!*edition)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    (*edition)->holders = 1;
    enum percuss_status status = catalogue_load(path, &(*edition)->set, fault);
    if (status) {
        free(*edition);
        *edition = NULL;
    }
    return status;
}

enum percuss_status editions_create(struct editions *editions, const char *path,
                                    struct fault *fault)
{
    *editions = (struct editions){0};
    pthread_mutex_init(&editions->lock, NULL);
    return edition_load(path, &editions->current, fault);
}

void editions_release(struct editions *editions)
{
    if (editions->current)
        editions_let_go(editions, editions->current);
    pthread_mutex_destroy(&editions->lock);
}

enum percuss_status editions_reload(struct editions *editions, const char *path,
                                    struct edition **before, struct fault *fault)
{
    struct edition *fresh;
    *before = NULL;
    enum percuss_status status = edition_load(path, &fresh, fault);
    if (status)
        return status;
    pthread_mutex_lock(&editions->lock);
    *before = editions->current;
    editions->current = fresh;
    pthread_mutex_unlock(&editions->lock);
    return PERCUSS_OK;
}

struct edition *editions_hold(struct editions *editions)
{
    pthread_mutex_lock(&editions->lock);
    struct edition *edition = editions->current;
    edition->holders++;
    pthread_mutex_unlock(&editions->lock);
    return edition;
}

void editions_let_go(struct editions *editions, struct edition *edition)
{
    pthread_mutex_lock(&editions->lock);
    bool last = --edition->holders == 0;
    pthread_mutex_unlock(&editions->lock);
    if (last) {
        body_set_free(edition->set);
        free(edition);
    }
}
