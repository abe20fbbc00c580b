/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_CLI_SPREAD_H
#define PERCUSS_CLI_SPREAD_H

#include <percuss/percuss.h>

/* What is left of the restitution's certainty when the speed is known with a standard deviation
 * only: a small ensemble around the impact, whose contact 0 approaches at `speed`. */
enum percuss_result spread_ask(struct percuss_client *client, const struct percuss_request *request,
                               double speed, double deviation, double timeout,
                               struct percuss_ensemble_reply *reply);

/* Two lines for people; the refusal if it is one. */
void spread_print(double deviation, const struct percuss_ensemble_reply *reply);

#endif
