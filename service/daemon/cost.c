/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/cost.h"

#include "contact/law.h"

/* Finer solutions than these take tens of milliseconds; or seconds. */
static const double CHEAP_TOLERANCE = 1e-4, SHORT_TOLERANCE = 1e-9;

static bool takes(const percuss_v1_Options *options, enum contact_effort effort)
{
    return contact_law_asked(options->contact_model)->effort == effort;
}

static bool is_at_least(const percuss_v1_Options *options, double tolerance)
{
    return options->tolerance == 0.0 || options->tolerance >= tolerance;
}

bool cost_is_cheap(const percuss_v1_Request *request)
{
    const percuss_v1_Options *options = &request->options;
    return request->contacts._length <= 1 && options->method == PERCUSS_METHOD_MODAL &&
           takes(options, CONTACT_EFFORT_LEAST) && !options->conditioning && !options->trace &&
           is_at_least(options, CHEAP_TOLERANCE);
}

bool cost_is_long(const percuss_v1_Options *options)
{
    return options->method != PERCUSS_METHOD_MODAL || takes(options, CONTACT_EFFORT_LONG) ||
           !is_at_least(options, SHORT_TOLERANCE);
}
