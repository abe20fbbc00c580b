/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_revoked.h"

#include <openssl/x509.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/queue.h>

struct list {
    char *folder;
    X509_CRL *revoked;
    LIST_ENTRY(list) others;
};

static LIST_HEAD(, list) lists = LIST_HEAD_INITIALIZER(lists);
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* With the lock. */
static struct list *list_find(const char *folder)
{
    struct list *list;
    LIST_FOREACH(list, &lists, others)
    if (strcmp(list->folder, folder) == 0)
        return list;
    return NULL;
}

/* With the lock. NULL: out of memory. */
static struct list *list_add(const char *folder)
{
    struct list *list = calloc(1, sizeof *list);
    char *copy = strdup(folder);
    if (!list || !copy) {
        free(list);
        free(copy);
        return NULL;
    }
    list->folder = copy;
    LIST_INSERT_HEAD(&lists, list, others);
    return list;
}

static unsigned count_entries(X509_CRL *list)
{
    const int count = list ? sk_X509_REVOKED_num(X509_CRL_get_REVOKED(list)) : 0;
    return count > 0 ? (unsigned)count : 0;
}

static unsigned count_lost(X509_CRL *last, X509_CRL *list)
{
    unsigned lost = 0;
    for (unsigned i = 0; i < count_entries(last); i++) {
        X509_REVOKED *same, *entry = sk_X509_REVOKED_value(X509_CRL_get_REVOKED(last), (int)i);
        ASN1_INTEGER *serial = ASN1_INTEGER_dup(X509_REVOKED_get0_serialNumber(entry));
        lost += !serial || X509_CRL_get0_by_serial(list, &same, serial) != 1;
        ASN1_INTEGER_free(serial);
    }
    return lost;
}

bool wire_revoked_take(const char *folder, X509_CRL *list, unsigned *lost)
{
    *lost = 0;
    pthread_mutex_lock(&lock);
    struct list *kept = list_find(folder);
    if (!kept)
        kept = list_add(folder);
    if (kept) {
        *lost = count_lost(kept->revoked, list);
        X509_CRL_free(kept->revoked);
        kept->revoked = list;
    }
    pthread_mutex_unlock(&lock);
    if (!kept)
        X509_CRL_free(list);
    return kept;
}

unsigned wire_revoked_count(const char *folder)
{
    pthread_mutex_lock(&lock);
    const struct list *list = list_find(folder);
    const unsigned count = list ? count_entries(list->revoked) : 0;
    pthread_mutex_unlock(&lock);
    return count;
}

/* Serial numbers are an authority's own. */
static bool has(X509_CRL *list, X509 *certificate)
{
    X509_REVOKED *entry;
    return X509_NAME_cmp(X509_CRL_get_issuer(list), X509_get_issuer_name(certificate)) == 0 &&
           X509_CRL_get0_by_cert(list, &entry, certificate) == 1;
}

bool wire_revoked_has(X509 *certificate)
{
    bool found = false;
    const struct list *list;
    pthread_mutex_lock(&lock);
    LIST_FOREACH(list, &lists, others)
    found = found || has(list->revoked, certificate);
    pthread_mutex_unlock(&lock);
    return found;
}
