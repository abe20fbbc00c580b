/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/cost.h"

#include "percuss/vocabulary.h"

/* Finer solutions than these take tens of milliseconds; or seconds. */
static const double cheap_tolerance = 1e-4, short_tolerance = 1e-9;

static bool is_at_least(const percuss_v1_Options *options, double tolerance)
{
    return options->tolerance == 0.0 || options->tolerance >= tolerance;
}

bool cost_is_cheap(const percuss_v1_Request *request)
{
    const percuss_v1_Options *options = &request->options;
    return request->contacts._length <= 1 && options->method == PERCUSS_METHOD_MODAL &&
           options->contact_model <= PERCUSS_CONTACT_CLOSED_FORM && !options->conditioning &&
           !options->trace && is_at_least(options, cheap_tolerance);
}

bool cost_is_long(const percuss_v1_Options *options)
{
    return options->method != PERCUSS_METHOD_MODAL ||
           options->contact_model > PERCUSS_CONTACT_TABLE || !is_at_least(options, short_tolerance);
}
