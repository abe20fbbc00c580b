/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/first_steps.h"

#include <math.h>

#include "solve/attempt.h"

/* Share of the tolerance that the accuracy of the first steps is: of a single contact, of a
 * sequence, and where contacts open and close within steps, the audit is to close or nothing else
 * tells what steps leave. */
static const double SHARE_SINGLE = 0.1;
static const double SHARE_SEQUENCE = 0.01;
static const double SHARE_FINE = 1e-3;
/* And what it is at most. */
static const double MOST_SINGLE = 1.0;
static const double MOST_SEQUENCE = 1e-5;
static const double MOST_GROUP = 1e-6;

/* The audit must close to 1e-9 where the tolerance is 1e-8 or less. In groups contacts open and
 * close within steps. Longer steps for comparison than those of 2e-4 do not exist. */
double first_steps_accuracy(double tolerance, bool sequence, bool group)
{
    bool followed = tolerance < FIRST_STEPS_FOLLOWED && tolerance >= FIRST_STEPS_FOLLOWED_FINE;
    bool fine = tolerance <= FIRST_STEPS_AUDITED || group || (sequence && followed);
    double share = fine ? SHARE_FINE : sequence ? SHARE_SEQUENCE : SHARE_SINGLE;
    double most = group ? MOST_GROUP : sequence ? MOST_SEQUENCE : MOST_SINGLE;
    return fmax(fmin(share * tolerance, most), ATTEMPT_FINEST);
}
