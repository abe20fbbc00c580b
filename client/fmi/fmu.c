/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fmu.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3.h"

const char *fmi3GetVersion(void)
{
    return "3.0";
}

fmi3Status fmu_error(struct fmu *fmu, const char *format, ...)
{
    char text[SOURCE_MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (fmu->log)
        fmu->log(fmu->environment, fmi3Error, "logStatusError", text);
    return fmi3Error;
}

static const char *mode_name(enum mode mode)
{
    switch (mode) {
    case MODE_INSTANTIATED:
        return "instantiated";
    case MODE_INITIALIZATION:
        return "initialization mode";
    case MODE_EVENT:
        return "event mode";
    case MODE_CONTINUOUS:
        return "continuous-time mode";
    case MODE_STEP:
        return "step mode";
    case MODE_TERMINATED:
        break;
    }
    return "terminated";
}

bool fmu_is_in(struct fmu *fmu, unsigned modes, const char *function)
{
    if (!fmu)
        return false;
    if (fmu->mode & modes)
        return true;
    fmu_error(fmu, "%s is not allowed now: the FMU is in the state '%s'", function,
              mode_name(fmu->mode));
    return false;
}

fmi3Status fmu_open(struct fmu *fmu)
{
    const struct shared *shared = (const struct shared *)fmu->numbers;
    if (fmu->source && !memcmp(&fmu->source->choice, &shared->source, sizeof shared->source))
        return fmi3OK;
    source_close(fmu->source);
    char message[SOURCE_MESSAGE_SIZE];
    fmu->source = source_open(&shared->source, fmu->resources, message);
    return fmu->source ? fmi3OK : fmu_error(fmu, "%s", message);
}

fmi3Status fmu_pair(struct fmu *fmu, double speed, struct percuss_request *request)
{
    fmi3Status status = fmu_open(fmu);
    if (status != fmi3OK)
        return status;
    char message[SOURCE_MESSAGE_SIZE];
    if (!source_pair(fmu->source, (const struct shared *)fmu->numbers, speed, request, message))
        return fmu_error(fmu, "%s", message);
    return fmi3OK;
}

fmi3Status fmu_ask(struct fmu *fmu, const struct percuss_request *request, double gap_rate,
                   struct impact *impact)
{
    /* a state that was set may have brought another choice */
    fmi3Status status = fmu_open(fmu);
    if (status != fmi3OK)
        return status;

    char message[SOURCE_MESSAGE_SIZE], warning[SOURCE_MESSAGE_SIZE];
    if (!source_ask(fmu->source, request, impact, warning, message))
        return fmu_error(fmu, "%s", message);
    impact->gap_rate_before = gap_rate;
    impact->gap_rate_after = -impact->rebound * gap_rate;
    /* a trial question is no impact */
    if (!fmu->log || !fmu->logs_impacts || fmu->mode == MODE_INITIALIZATION)
        return fmi3OK;

    snprintf(message, sizeof message, "%s on %s at %.9g m/s: restitution %.9g, impulse %.9g N s",
             request->bodies[0].id, request->bodies[1].id, -gap_rate, impact->restitution,
             impact->impulse);
    fmu->log(fmu->environment, fmi3OK, "logImpacts", message);
    if (warning[0])
        fmu->log(fmu->environment, fmi3Warning, "logImpacts", warning);
    return fmi3OK;
}
