/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One ensemble answered: decoded, its samples solved by several threads, and reported. */
#ifndef PERCUSS_RESPOND_ENSEMBLE_ANSWER_H
#define PERCUSS_RESPOND_ENSEMBLE_ANSWER_H

#include "respond/ensemble_means.h"

/* What is said where nobody is there any more. */
#define ENSEMBLE_CLIENT_GONE "the client had gone: ask again"

/* The reply, whatever it says; NULL: out of memory. It ends early, with the samples solved so far,
 * when it is cancelled or its deadline passes, and without any when its client is gone. */
struct answer *ensemble_answer(const struct ensemble_means *means,
                               const struct ensemble_question *question);

/* Whether the items of a range are among those that `share` was asked for last. */
bool ensemble_asks_for(const struct ensemble_run *run, const struct ensemble_range *range);

/* Takes items that `share` was asked for: struct ensemble_sample or struct ensemble_extra,
 * range->end
 * - range->first of them. Of the thread of ensemble_answer. False: no more are wanted. */
bool ensemble_take(struct ensemble_run *run, const struct ensemble_range *range, const void *items);

/* What those who share the samples of an ensemble must agree in, known once `share` is called. */
struct digest ensemble_run_digest(const struct ensemble_run *run);

#endif
