/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How long a request will take, as far as its options tell. */
#ifndef PERCUSS_DAEMON_COST_H
#define PERCUSS_DAEMON_COST_H

#include <stdbool.h>

#include "wire.h"

/* Some 0.02 to 0.5 ms with a warm workspace: the reading thread may solve it. */
bool cost_is_cheap(const percuss_v1_Request *request);

/* Perhaps seconds: it is for the long lane. */
bool cost_is_long(const percuss_v1_Options *options);

#endif
