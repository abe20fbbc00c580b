/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "watching.h"

#include <math.h>

#include "error.h"
#include "moment.h"

struct watching watching_begin(percuss_watch_function *function, void *context)
{
    return (struct watching){function, context, pthread_self()};
}

double watching_first(const struct watching *watching)
{
    bool watched = watching->function && pthread_equal(watching->thread, pthread_self());
    return watched ? moment_now() + WATCHING_INTERVAL : INFINITY;
}

bool watching_asks(const struct watching *watching, double *next)
{
    if (isinf(*next) || moment_now() < *next)
        return true;
    bool goes_on = watching->function(watching->context);
    *next = moment_now() + WATCHING_INTERVAL;
    return goes_on;
}

enum percuss_result watching_cancelled(void)
{
    return error_set(PERCUSS_RESULT_CANCELLED, "the call was given up by whoever watches");
}
