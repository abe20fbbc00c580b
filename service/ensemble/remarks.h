/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The warnings of an ensemble: what single impacts would be warned of, counted, and its own. */
#ifndef PERCUSS_ENSEMBLE_REMARKS_H
#define PERCUSS_ENSEMBLE_REMARKS_H

#include "ensemble/report.h"

/* Fills report->warnings, when all else is filled, from samples 0 .. report->done - 1 in their
 * order: the same for any number of workers. What is quoted is solved again: where the watch (NULL:
 * nobody) stops that, the words are left out. False: out of memory. */
bool remarks_fill(struct ensemble_report *report, const struct ensemble *ensemble,
                  const struct ensemble_sample *samples, const struct watch *watch);

#endif
