/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Monotonic time. */
#ifndef PERCUSS_API_MOMENT_H
#define PERCUSS_API_MOMENT_H

#include <percuss/result.h>

/* s. */
double moment_now(void);

/* When a wait of `timeout` seconds that starts now is over. INVALID_ARGUMENT: not a number >= 0. */
enum percuss_result moment_deadline(double timeout, double *deadline);

/* Sleeps for at least so many seconds, unless a signal comes. */
void moment_sleep(double seconds);

#endif
