/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* DDS Security: the folder of one identity, as deploy/security/percuss-keys.sh makes it. */
#ifndef PERCUSS_WIRE_SECURITY_H
#define PERCUSS_WIRE_SECURITY_H

#include <dds/dds.h>
#include <stdbool.h>
#include <stddef.h>

/* Whether the folder has every file that an identity needs, readable, a private key that nobody but
 * its owner can read and that is the certificate's, and certificates and permissions that hold today
 * (wire_validity.h). False: `problem` says which file is wrong and what it must be, or when it ended.
 * What else stands in the files DDS checks when a participant is made. */
bool wire_security_check(const char *folder, char *problem, size_t size);

/* Properties of a participant that uses the folder, which wire_security_check has found good. */
void wire_security_set(const char *folder, dds_qos_t *qos);

#endif
