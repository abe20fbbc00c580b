/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One impact from the group to the applied impulses. */
#ifndef PERCUSS_SLOW_IMPACT_H
#define PERCUSS_SLOW_IMPACT_H

#include "group.h"

/* Solves the impact of the due contact `first` of `seen`, a group that has been probed. */
enum percuss_result impact_solve(struct percuss_slow *slow, const struct group *seen, size_t first,
                                 double now);

#endif
