/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The functions of the Functional Mock-up Interface 3.0, all of which an FMU must have. The
 * standard (fmi-standard.org) describes each. */
#ifndef PERCUSS_FMI3_H
#define PERCUSS_FMI3_H

#include "fmi3_types.h"

/* which variables are meant */
#define FMI3_REFERENCES const fmi3ValueReference[], size_t

/* exported by the shared object */
#pragma GCC visibility push(default)

const char *fmi3GetVersion(void);
fmi3Status fmi3SetDebugLogging(fmi3Instance, fmi3Boolean, size_t, const fmi3String[]);

/* life */
fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                          fmi3Boolean, fmi3InstanceEnvironment,
                                          fmi3LogMessageCallback);
fmi3Instance fmi3InstantiateCoSimulation(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                         fmi3Boolean, fmi3Boolean, fmi3Boolean, FMI3_REFERENCES,
                                         fmi3InstanceEnvironment, fmi3LogMessageCallback,
                                         fmi3IntermediateUpdateCallback);
fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                               fmi3Boolean, fmi3InstanceEnvironment,
                                               fmi3LogMessageCallback, fmi3ClockUpdateCallback,
                                               fmi3LockPreemptionCallback,
                                               fmi3UnlockPreemptionCallback);
void fmi3FreeInstance(fmi3Instance);
fmi3Status fmi3EnterConfigurationMode(fmi3Instance);
fmi3Status fmi3ExitConfigurationMode(fmi3Instance);
fmi3Status fmi3EnterInitializationMode(fmi3Instance, fmi3Boolean, fmi3Float64, fmi3Float64,
                                       fmi3Boolean, fmi3Float64);
fmi3Status fmi3ExitInitializationMode(fmi3Instance);
fmi3Status fmi3EnterEventMode(fmi3Instance);
fmi3Status fmi3EnterStepMode(fmi3Instance);
fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance);
fmi3Status fmi3Terminate(fmi3Instance);
fmi3Status fmi3Reset(fmi3Instance);

/* values: the types that are got and set alike, and the two that are not */
#define FMI3_PLAIN_TYPES(X)                                                                        \
    X(Float32)                                                                                     \
    X(Float64)                                                                                     \
    X(Int8) X(UInt8) X(Int16) X(UInt16) X(Int32) X(UInt32) X(Int64) X(UInt64) X(Boolean) X(String)
#define FMI3_DECLARE(type)                                                                         \
    fmi3Status fmi3Get##type(fmi3Instance, FMI3_REFERENCES, fmi3##type[], size_t);                 \
    fmi3Status fmi3Set##type(fmi3Instance, FMI3_REFERENCES, const fmi3##type[], size_t);
FMI3_PLAIN_TYPES(FMI3_DECLARE)
#undef FMI3_DECLARE
fmi3Status fmi3GetBinary(fmi3Instance, FMI3_REFERENCES, size_t[], fmi3Binary[], size_t);
fmi3Status fmi3SetBinary(fmi3Instance, FMI3_REFERENCES, const size_t[], const fmi3Binary[], size_t);
fmi3Status fmi3GetClock(fmi3Instance, FMI3_REFERENCES, fmi3Clock[]);
fmi3Status fmi3SetClock(fmi3Instance, FMI3_REFERENCES, const fmi3Clock[]);

/* dependencies */
fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance, fmi3ValueReference, size_t *);
fmi3Status fmi3GetVariableDependencies(fmi3Instance, fmi3ValueReference, size_t[],
                                       fmi3ValueReference[], size_t[], fmi3DependencyKind[],
                                       size_t);
fmi3Status fmi3GetDirectionalDerivative(fmi3Instance, FMI3_REFERENCES, FMI3_REFERENCES,
                                        const fmi3Float64[], size_t, fmi3Float64[], size_t);
fmi3Status fmi3GetAdjointDerivative(fmi3Instance, FMI3_REFERENCES, FMI3_REFERENCES,
                                    const fmi3Float64[], size_t, fmi3Float64[], size_t);

/* states that are kept */
fmi3Status fmi3GetFMUState(fmi3Instance, fmi3FMUState *);
fmi3Status fmi3SetFMUState(fmi3Instance, fmi3FMUState);
fmi3Status fmi3FreeFMUState(fmi3Instance, fmi3FMUState *);
fmi3Status fmi3SerializedFMUStateSize(fmi3Instance, fmi3FMUState, size_t *);
fmi3Status fmi3SerializeFMUState(fmi3Instance, fmi3FMUState, fmi3Byte[], size_t);
fmi3Status fmi3DeserializeFMUState(fmi3Instance, const fmi3Byte[], size_t, fmi3FMUState *);

/* clocks */
fmi3Status fmi3GetIntervalDecimal(fmi3Instance, FMI3_REFERENCES, fmi3Float64[],
                                  fmi3IntervalQualifier[]);
fmi3Status fmi3GetIntervalFraction(fmi3Instance, FMI3_REFERENCES, fmi3UInt64[], fmi3UInt64[],
                                   fmi3IntervalQualifier[]);
fmi3Status fmi3GetShiftDecimal(fmi3Instance, FMI3_REFERENCES, fmi3Float64[]);
fmi3Status fmi3GetShiftFraction(fmi3Instance, FMI3_REFERENCES, fmi3UInt64[], fmi3UInt64[]);
fmi3Status fmi3SetIntervalDecimal(fmi3Instance, FMI3_REFERENCES, const fmi3Float64[]);
fmi3Status fmi3SetIntervalFraction(fmi3Instance, FMI3_REFERENCES, const fmi3UInt64[],
                                   const fmi3UInt64[]);
fmi3Status fmi3SetShiftDecimal(fmi3Instance, FMI3_REFERENCES, const fmi3Float64[]);
fmi3Status fmi3SetShiftFraction(fmi3Instance, FMI3_REFERENCES, const fmi3UInt64[],
                                const fmi3UInt64[]);
fmi3Status fmi3ActivateModelPartition(fmi3Instance, fmi3ValueReference, fmi3Float64);

/* events */
fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance);
fmi3Status fmi3UpdateDiscreteStates(fmi3Instance, fmi3Boolean *, fmi3Boolean *, fmi3Boolean *,
                                    fmi3Boolean *, fmi3Boolean *, fmi3Float64 *);

/* Model Exchange */
fmi3Status fmi3CompletedIntegratorStep(fmi3Instance, fmi3Boolean, fmi3Boolean *, fmi3Boolean *);
fmi3Status fmi3SetTime(fmi3Instance, fmi3Float64);
fmi3Status fmi3SetContinuousStates(fmi3Instance, const fmi3Float64[], size_t);
fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance, fmi3Float64[], size_t);
fmi3Status fmi3GetEventIndicators(fmi3Instance, fmi3Float64[], size_t);
fmi3Status fmi3GetContinuousStates(fmi3Instance, fmi3Float64[], size_t);
fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance, fmi3Float64[], size_t);
fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance, size_t *);
fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance, size_t *);

/* Co-Simulation */
fmi3Status fmi3GetOutputDerivatives(fmi3Instance, FMI3_REFERENCES, const fmi3Int32[], fmi3Float64[],
                                    size_t);
fmi3Status fmi3DoStep(fmi3Instance, fmi3Float64, fmi3Float64, fmi3Boolean, fmi3Boolean *,
                      fmi3Boolean *, fmi3Boolean *, fmi3Float64 *);

#pragma GCC visibility pop

#endif
