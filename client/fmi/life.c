/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Instances come and go, and change from mode to mode. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3.h"
#include "fmu.h"

/* Every variable at its start. */
static void set_start_values(struct fmu *fmu)
{
    memset(fmu->numbers, 0, MODEL.size);
    for (size_t i = 0; i < MODEL.variable_count; i++) {
        const struct variable *variable = &MODEL.variables[i];
        void *place = fmu->numbers + variable->offset;
        if (!variable_has_start(variable))
            continue;
        if (variable->type == VARIABLE_FLOAT64)
            *(double *)place = variable->start;
        else if (variable->type == VARIABLE_INT32)
            *(int32_t *)place = (int32_t)variable->start;
        else if (variable->type == VARIABLE_BOOLEAN)
            *(bool *)place = variable->start != 0.0;
        else
            snprintf(place, VARIABLE_TEXT_SIZE, "%s", variable->text);
    }
}

/* An fmu, or NULL after it was said why not. */
static struct fmu *create(fmi3String token, fmi3String resources, bool logging,
                          fmi3InstanceEnvironment environment, fmi3LogMessageCallback log)
{
    const char *wrong = NULL;
    struct fmu *fmu = NULL;
    if (!token || strcmp(token, MODEL.token) != 0)
        wrong = "the instantiation token is not that of this FMU's modelDescription.xml";
    else if (!(fmu = calloc(1, sizeof *fmu + MODEL.size)) ||
             !(fmu->resources = strdup(resources ? resources : ".")))
        wrong = "out of memory";
    if (wrong) {
        if (log)
            log(environment, fmi3Error, "logStatusError", wrong);
        free(fmu);
        return NULL;
    }
    fmu->environment = environment;
    fmu->log = log;
    fmu->logs_impacts = logging;
    fmu->mode = MODE_INSTANTIATED;
    set_start_values(fmu);
    return fmu;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                          fmi3Boolean visible, fmi3Boolean logging,
                                          fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log)
{
    (void)name, (void)visible;
    return create(token, resources, logging, environment, log);
}

fmi3Instance
fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                            fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean event_mode_used,
                            fmi3Boolean early_return_allowed,
                            const fmi3ValueReference intermediate[], size_t intermediate_count,
                            fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                            fmi3IntermediateUpdateCallback intermediate_update)
{
    (void)name, (void)visible, (void)intermediate, (void)intermediate_count;
    (void)intermediate_update;
    struct fmu *fmu = create(token, resources, logging, environment, log);
    if (fmu) {
        fmu->co_simulation = true;
        fmu->event_mode_used = event_mode_used;
        fmu->early_return_allowed = early_return_allowed;
    }
    return fmu;
}

void fmi3FreeInstance(fmi3Instance handle)
{
    struct fmu *fmu = handle;
    if (!fmu)
        return;
    source_close(fmu->source);
    free(fmu->resources);
    free(fmu);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance handle, fmi3Boolean on, size_t count,
                               const fmi3String categories[])
{
    struct fmu *fmu = handle;
    if (!fmu)
        return fmi3Error;
    /* errors are always told; no category at all means every one */
    bool impacts = count == 0;
    for (size_t i = 0; i < count; i++) {
        if (!strcmp(categories[i], "logImpacts"))
            impacts = true;
        else if (strcmp(categories[i], "logStatusError") != 0)
            return fmu_error(fmu,
                             "fmi3SetDebugLogging: category '%s' is none of: logStatusError, "
                             "logImpacts",
                             categories[i]);
    }
    if (impacts)
        fmu->logs_impacts = on;
    return fmi3OK;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance handle, fmi3Boolean tolerance_defined,
                                       fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean stop_defined, fmi3Float64 stop)
{
    (void)tolerance_defined, (void)tolerance, (void)stop_defined, (void)stop;
    struct fmu *fmu = handle;
    if (!fmu_is_in(fmu, MODE_INSTANTIATED, "fmi3EnterInitializationMode"))
        return fmi3Error;
    if (!isfinite(start))
        return fmu_error(fmu, "startTime: %g is not a finite number", start);
    ((struct shared *)fmu->numbers)->time = start;
    fmu->mode = MODE_INITIALIZATION;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance handle)
{
    struct fmu *fmu = handle;
    if (!fmu_is_in(fmu, MODE_INITIALIZATION, "fmi3ExitInitializationMode"))
        return fmi3Error;
    fmi3Status status = fmu_open(fmu);
    if (status == fmi3OK)
        status = MODEL.initialize(fmu);
    if (status != fmi3OK)
        return status;
    bool to_step = fmu->co_simulation && !fmu->event_mode_used;
    fmu->mode = to_step ? MODE_STEP : MODE_EVENT;
    return fmi3OK;
}

/* From one of the modes to another one. */
static fmi3Status change(struct fmu *fmu, unsigned from, enum mode to, const char *function)
{
    if (!fmu_is_in(fmu, from, function))
        return fmi3Error;
    fmu->mode = to;
    return fmi3OK;
}

fmi3Status fmi3EnterEventMode(fmi3Instance handle)
{
    struct fmu *fmu = handle;
    if (fmu && fmu->co_simulation && !fmu->event_mode_used)
        return fmu_error(fmu, "fmi3EnterEventMode: instantiated without event mode");
    return change(fmu, MODE_CONTINUOUS | MODE_STEP, MODE_EVENT, "fmi3EnterEventMode");
}

fmi3Status fmi3EnterStepMode(fmi3Instance handle)
{
    struct fmu *fmu = handle;
    if (fmu && !fmu->co_simulation)
        return fmu_error(fmu, "fmi3EnterStepMode: instantiated for Model Exchange");
    return change(fmu, MODE_EVENT, MODE_STEP, "fmi3EnterStepMode");
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance handle)
{
    struct fmu *fmu = handle;
    if (fmu && fmu->co_simulation)
        return fmu_error(fmu, "fmi3EnterContinuousTimeMode: instantiated for Co-Simulation");
    return change(fmu, MODE_EVENT, MODE_CONTINUOUS, "fmi3EnterContinuousTimeMode");
}

fmi3Status fmi3Terminate(fmi3Instance handle)
{
    return change(handle, MODE_EVENT | MODE_CONTINUOUS | MODE_STEP, MODE_TERMINATED,
                  "fmi3Terminate");
}

fmi3Status fmi3Reset(fmi3Instance handle)
{
    struct fmu *fmu = handle;
    if (!fmu)
        return fmi3Error;
    set_start_values(fmu);
    fmu->mode = MODE_INSTANTIATED;
    return fmi3OK;
}
