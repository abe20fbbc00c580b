/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The store of specimens looked through and copied, with what is found in the log. */
#ifndef PERCUSS_DAEMON_STORE_CARE_H
#define PERCUSS_DAEMON_STORE_CARE_H

#include "store/specimens.h"

/* Logs each row that is damaged, and with `structure` each flaw of the file, which opening looks
 * for. PERCUSS_BAD_REQUEST: the store must not be used; PERCUSS_INTERNAL: it cannot be read. */
enum percuss_status store_care_check(struct specimen_store *store, bool structure,
                                     struct fault *fault);

/* The whole check, and a copy to that file (empty text: none). */
void store_care_back_up(struct specimen_store *store, const char *path);

/* Checks a store that no daemon has open, or a copy. False: it is damaged or there is none. */
bool store_care_check_file(const char *path);

#endif
