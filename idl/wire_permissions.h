/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* DDS Security: Cyclone DDS's plugins for access control and for cryptography, with two checks that
 * it leaves out.
 *
 * - Permissions. Whether a peer's reader or writer needs permissions, Cyclone DDS (0.10.2,
 * and 11.0) takes from the attributes that the peer itself announces: whoever leaves them out is
 * matched without a look at his permissions. Here no keys are exchanged with a reader or writer
 * whose participant has no permissions for the topic, whatever it announces.
 * - Revocation. A participant whose certificate is on a list of revoked ones (wire_revoked.h) is
 * not believed, and one that is there already is cut off when the list is read anew. */
#ifndef PERCUSS_WIRE_PERMISSIONS_H
#define PERCUSS_WIRE_PERMISSIONS_H

struct ddsi_domaingv;

/* As Cyclone DDS loads its plugins: 0 is success. */
int wire_permissions_access_init(const char *argument, void **context,
                                 struct ddsi_domaingv *domain);
int wire_permissions_access_end(void *context);
int wire_permissions_crypto_init(const char *argument, void **context,
                                 struct ddsi_domaingv *domain);
int wire_permissions_crypto_end(void *context);

/* Cuts off all participants whose certificates are revoked: returns how many. Any thread but DDS's.
 */
unsigned wire_permissions_cut(void);

/* How many were refused or cut off so far, as their certificates are revoked. Thread-safe. */
unsigned long long wire_permissions_refused(void);

#endif
