/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* More modes until those left out matter less than the tolerance. */
#ifndef PERCUSS_SOLVE_MODE_SEARCH_H
#define PERCUSS_SOLVE_MODE_SEARCH_H

#include "solve/sequence.h"

/* Most modes of a family of a body that are tried. */
enum { MODE_SEARCH_MOST = 1200 };

/* Whether a contact bends a beam, or there are several: then a sequence of sub-impacts is likely,
 * which amplifies every error. */
bool mode_search_expects_sequence(const struct problem *problem);

/* Solves with as few modes as the tolerance allows; best->accuracy is given. PERCUSS_OK,
 * PERCUSS_INTERNAL or PERCUSS_TIMEOUT. An overlap without a touch before
 * (outcome.always_overlapped) ends it. */
enum percuss_status mode_search(struct attempt_context *context, struct attempt *best,
                                struct mode_error *error);

#endif
