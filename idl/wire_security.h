/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* DDS Security: the folder of one identity, as deploy/security/percuss-keys.sh makes it. */
#ifndef PERCUSS_WIRE_SECURITY_H
#define PERCUSS_WIRE_SECURITY_H

#include <dds/dds.h>
#include <stdbool.h>
#include <stddef.h>
#include <time.h>

#include "wire_validity.h"

/* Whether the folder has every file that an identity needs, readable, a private key that nobody but
 * its owner can read and that is the certificate's, and certificates and permissions that hold
 * today (wire_validity.h); and, where there is a list of revoked certificates, that it is the
 * authority's and does not have this one. False: `problem` says which file is wrong and what it
 * must be, or when it ended. What else stands in the files DDS checks when a participant is made.
 */
bool wire_security_check(const char *folder, char *problem, size_t size);

/* Whether whoever uses the folder is to be told of its dates: that it ends within 30 days from
 * then, or does not hold. True: `remark` says "security: DIR/cert.pem: ends in 3 days, on
 * 2026-11-20: make the folder anew before". */
bool wire_security_remark(const char *folder, const struct wire_validity *validity, time_t then,
                          char *remark, size_t size);

/* What a look at the folder's list of revoked certificates, crl.pem, came to. */
struct wire_revocation {
    unsigned listed;  /* certificates; 0: no list, or an empty one */
    unsigned cut_off; /* participants that were there and are on it */
    unsigned lost;    /* certificates of the last list that are not on it */
    bool is_missing;  /* there is no crl.pem any more, and the last list stays */
};

/* Reads the list anew, for all participants of this process, whatever their folders
 * (wire_revoked.h). False: it is no list that identity_ca.pem has signed, as `problem` says, and
 * the last list stays. */
bool wire_security_revoke(const char *folder, struct wire_revocation *found, char *problem,
                          size_t size);

/* How many participants were refused or cut off so far, as their certificates are revoked. */
unsigned long long wire_security_refused(void);

/* Properties of a participant that uses the folder, which wire_security_check has found good; its
 * list of revoked certificates is read. False: the list is bad meanwhile, and nobody is to be
 * believed. */
bool wire_security_set(const char *folder, dds_qos_t *qos);

#endif
