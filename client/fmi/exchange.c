/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Events, continuous states and communication steps. */
#include <math.h>

#include "fmi3.h"
#include "fmu.h"

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance handle)
{
    return fmu_is_in(handle, MODE_INITIALIZATION | MODE_EVENT, "fmi3EvaluateDiscreteStates")
               ? fmi3OK
               : fmi3Error;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance handle, fmi3Boolean *again, fmi3Boolean *terminate,
                                    fmi3Boolean *nominals_changed, fmi3Boolean *states_changed,
                                    fmi3Boolean *has_next, fmi3Float64 *next)
{
    struct fmu *fmu = handle;
    if (!fmu_is_in(fmu, MODE_EVENT, "fmi3UpdateDiscreteStates"))
        return fmi3Error;
    *again = *terminate = *nominals_changed = *states_changed = *has_next = false;
    *next = INFINITY;
    return MODEL.update(fmu, states_changed);
}

/* Variables of a role, in the order of the table. */
static size_t count_role(enum variable_role role)
{
    size_t count = 0;
    for (size_t i = 0; i < MODEL.variable_count; i++)
        count += MODEL.variables[i].role == role;
    return count;
}

static fmi3Status get_role(struct fmu *fmu, enum variable_role role, const char *function,
                           double values[], size_t count)
{
    if (!fmu)
        return fmi3Error;
    if (count != count_role(role))
        return fmu_error(fmu, "%s: %zu values, there are %zu", function, count, count_role(role));
    MODEL.refresh(fmu->numbers);
    for (size_t i = 0; i < MODEL.variable_count; i++)
        if (MODEL.variables[i].role == role)
            *values++ = *(const double *)(fmu->numbers + MODEL.variables[i].offset);
    return fmi3OK;
}

fmi3Status fmi3GetContinuousStates(fmi3Instance handle, fmi3Float64 states[], size_t count)
{
    return get_role(handle, VARIABLE_STATE, "fmi3GetContinuousStates", states, count);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance handle, fmi3Float64 derivatives[],
                                             size_t count)
{
    return get_role(handle, VARIABLE_DERIVATIVE, "fmi3GetContinuousStateDerivatives", derivatives,
                    count);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance handle, fmi3Float64 indicators[], size_t count)
{
    return get_role(handle, VARIABLE_INDICATOR, "fmi3GetEventIndicators", indicators, count);
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance handle, fmi3Float64 nominals[],
                                             size_t count)
{
    struct fmu *fmu = handle;
    if (!fmu)
        return fmi3Error;
    if (count != count_role(VARIABLE_STATE))
        return fmu_error(fmu, "fmi3GetNominalsOfContinuousStates: %zu values, there are %zu", count,
                         count_role(VARIABLE_STATE));
    for (size_t i = 0; i < count; i++)
        nominals[i] = 1.0;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance handle, size_t *count)
{
    if (!handle || !count)
        return fmi3Error;
    *count = count_role(VARIABLE_STATE);
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance handle, size_t *count)
{
    if (!handle || !count)
        return fmi3Error;
    *count = count_role(VARIABLE_INDICATOR);
    return fmi3OK;
}

fmi3Status fmi3SetTime(fmi3Instance handle, fmi3Float64 time)
{
    struct fmu *fmu = handle;
    if (!fmu_is_in(fmu, MODE_CONTINUOUS | MODE_EVENT, "fmi3SetTime"))
        return fmi3Error;
    if (!isfinite(time))
        return fmu_error(fmu, "time: %g is not a finite number", time);
    ((struct shared *)fmu->numbers)->time = time;
    return fmi3OK;
}

fmi3Status fmi3SetContinuousStates(fmi3Instance handle, const fmi3Float64 states[], size_t count)
{
    struct fmu *fmu = handle;
    if (!fmu_is_in(fmu, MODE_CONTINUOUS, "fmi3SetContinuousStates"))
        return fmi3Error;
    if (count != count_role(VARIABLE_STATE))
        return fmu_error(fmu, "fmi3SetContinuousStates: %zu values, there are %zu", count,
                         count_role(VARIABLE_STATE));
    for (size_t i = 0; i < MODEL.variable_count; i++)
        if (MODEL.variables[i].role == VARIABLE_STATE)
            *(double *)(fmu->numbers + MODEL.variables[i].offset) = *states++;
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance handle, fmi3Boolean no_earlier_state,
                                       fmi3Boolean *enter_event_mode, fmi3Boolean *terminate)
{
    (void)no_earlier_state;
    struct fmu *fmu = handle;
    if (!fmu_is_in(fmu, MODE_CONTINUOUS, "fmi3CompletedIntegratorStep"))
        return fmi3Error;
    *terminate = false;
    *enter_event_mode = MODEL.completed(fmu->numbers);
    return fmi3OK;
}

/* A communication point may be off by the rounding of sums of steps. */
static const double TIME_ROUNDING = 1e-9;

fmi3Status fmi3DoStep(fmi3Instance handle, fmi3Float64 point, fmi3Float64 size,
                      fmi3Boolean no_earlier_state, fmi3Boolean *event, fmi3Boolean *terminate,
                      fmi3Boolean *early, fmi3Float64 *reached)
{
    (void)no_earlier_state;
    struct fmu *fmu = handle;
    if (!fmu_is_in(fmu, MODE_STEP, "fmi3DoStep"))
        return fmi3Error;
    *event = *terminate = *early = false;

    /* steps follow each other without a gap */
    double time = ((const struct shared *)fmu->numbers)->time;
    *reached = time;
    if (!(fabs(point - time) <= TIME_ROUNDING * (1.0 + fabs(time))))
        return fmu_error(fmu, "fmi3DoStep: communication point %.17g: the FMU is at %.17g", point,
                         time);
    if (!(size > 0.0) || !isfinite(size))
        return fmu_error(fmu, "fmi3DoStep: a step of %g s: a number > 0 is needed", size);

    struct model_step outcome = {.time = time};
    fmi3Status status = MODEL.step(fmu, point + size, &outcome);
    *reached = outcome.time;
    *event = outcome.event;
    *early = status == fmi3OK && outcome.time < point + size;
    return status;
}
