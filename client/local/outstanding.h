/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Questions of percuss_submit, solved by the thread that waits for them. */
#ifndef PERCUSS_LOCAL_OUTSTANDING_H
#define PERCUSS_LOCAL_OUTSTANDING_H

#include "instance.h"

/* Forgets all. */
void outstanding_clear(struct percuss_client *client);

#endif
