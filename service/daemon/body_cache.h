/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The folder of bodies that percussd has reduced from meshes: what nobody has used for long goes.
 * Daemons with different catalogues may share it. */
#ifndef PERCUSS_DAEMON_BODY_CACHE_H
#define PERCUSS_DAEMON_BODY_CACHE_H

#include "model/body.h"

/* Marks what the set uses as used now, by the time of its file, and deletes bodies that were used
 * by no set for so many days, and what reductions of processes that are gone left behind. Touches
 * nothing that does not bear a name of the reducer's. */
void body_cache_tidy(const char *folder, const struct body_set *set, double days);

#endif
