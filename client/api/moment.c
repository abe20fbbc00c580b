/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "moment.h"

#include <time.h>

#include "error.h"

double moment_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

enum percuss_result moment_deadline(double timeout, double *deadline)
{
    if (!(timeout >= 0.0))
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "timeout: %g: seconds >= 0 are needed",
                         timeout);
    *deadline = moment_now() + timeout;
    return PERCUSS_RESULT_OK;
}

void moment_sleep(double seconds)
{
    struct timespec time = {.tv_sec = (time_t)seconds};
    time.tv_nsec = (long)(1e9 * (seconds - (double)time.tv_sec));
    nanosleep(&time, NULL);
}
