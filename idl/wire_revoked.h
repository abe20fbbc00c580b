/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The lists of revoked certificates of this process: one for each folder of an identity that has
 * one. All of them hold for all its participants. Thread-safe. */
#ifndef PERCUSS_WIRE_REVOKED_H
#define PERCUSS_WIRE_REVOKED_H

#include <stdbool.h>

struct X509_crl_st; /* OpenSSL's X509_CRL */
struct x509_st;     /* OpenSSL's X509 */

/* Puts `list`, which becomes its own, in place of that folder's last one. `lost`: how many entries
 * of the last one it lacks. False: out of memory, and the last one stays. */
bool wire_revoked_take(const char *folder, struct X509_crl_st *list, unsigned *lost);

/* How many entries that folder's list has; 0: none, or no list. */
unsigned wire_revoked_count(const char *folder);

/* Whether a list of the certificate's issuer has it. */
bool wire_revoked_has(struct x509_st *certificate);

#endif
