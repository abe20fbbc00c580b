/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Parts of ensembles as octets, between processes. */
#ifndef PERCUSS_LOCAL_SHARING_H
#define PERCUSS_LOCAL_SHARING_H

#include <percuss/ensemble_share.h>

#include "respond/ensemble_answer.h"

/* INVALID_ARGUMENT: another library's client, which does not solve here. */
enum percuss_result sharing_check(const struct percuss_client *client);

/* Asks for a range of a run. */
void sharing_ask(percuss_share_function *share, void *context, struct ensemble_run *run,
                 const struct ensemble_range *range);

#endif
