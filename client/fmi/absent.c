/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Functions of the standard for features that these FMUs lack by their modelDescription.xml:
 * clocks, structural parameters, partial derivatives, interpolation, Scheduled Execution. */
#include "fmi3.h"
#include "fmu.h"

static fmi3Status absent_refuse(struct fmu *fmu, const char *function)
{
    return fmu ? fmu_error(fmu, "%s: this FMU has nothing for it", function) : fmi3Error;
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
    fmi3Boolean logging, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3ClockUpdateCallback clock_update, fmi3LockPreemptionCallback lock,
    fmi3UnlockPreemptionCallback unlock)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging;
    (void)clock_update, (void)lock, (void)unlock;
    if (log)
        log(environment, fmi3Error, "logStatusError",
            "fmi3InstantiateScheduledExecution: this FMU is for Model Exchange and Co-Simulation");
    return NULL;
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance fmu)
{
    return absent_refuse(fmu, "fmi3EnterConfigurationMode");
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance fmu)
{
    return absent_refuse(fmu, "fmi3ExitConfigurationMode");
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance fmu, fmi3ValueReference reference,
                                               size_t *count)
{
    (void)reference, (void)count;
    return absent_refuse(fmu, "fmi3GetNumberOfVariableDependencies");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance fmu, fmi3ValueReference reference,
                                       size_t elements[], fmi3ValueReference independents[],
                                       size_t independent_elements[], fmi3DependencyKind kinds[],
                                       size_t count)
{
    (void)reference, (void)elements, (void)independents, (void)independent_elements, (void)kinds,
        (void)count;
    return absent_refuse(fmu, "fmi3GetVariableDependencies");
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance fmu, const fmi3ValueReference unknowns[],
                                        size_t unknown_count, const fmi3ValueReference knowns[],
                                        size_t known_count, const fmi3Float64 seed[],
                                        size_t seed_count, fmi3Float64 sensitivity[],
                                        size_t sensitivity_count)
{
    (void)unknowns, (void)unknown_count, (void)knowns, (void)known_count, (void)seed,
        (void)seed_count, (void)sensitivity, (void)sensitivity_count;
    return absent_refuse(fmu, "fmi3GetDirectionalDerivative");
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance fmu, const fmi3ValueReference unknowns[],
                                    size_t unknown_count, const fmi3ValueReference knowns[],
                                    size_t known_count, const fmi3Float64 seed[], size_t seed_count,
                                    fmi3Float64 sensitivity[], size_t sensitivity_count)
{
    (void)unknowns, (void)unknown_count, (void)knowns, (void)known_count, (void)seed,
        (void)seed_count, (void)sensitivity, (void)sensitivity_count;
    return absent_refuse(fmu, "fmi3GetAdjointDerivative");
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance fmu, const fmi3ValueReference references[],
                                  size_t count, fmi3Float64 intervals[],
                                  fmi3IntervalQualifier qualifiers[])
{
    (void)references, (void)count, (void)intervals, (void)qualifiers;
    return absent_refuse(fmu, "fmi3GetIntervalDecimal");
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance fmu, const fmi3ValueReference references[],
                                   size_t count, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[])
{
    (void)references, (void)count, (void)counters, (void)resolutions, (void)qualifiers;
    return absent_refuse(fmu, "fmi3GetIntervalFraction");
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance fmu, const fmi3ValueReference references[],
                               size_t count, fmi3Float64 shifts[])
{
    (void)references, (void)count, (void)shifts;
    return absent_refuse(fmu, "fmi3GetShiftDecimal");
}

fmi3Status fmi3GetShiftFraction(fmi3Instance fmu, const fmi3ValueReference references[],
                                size_t count, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    (void)references, (void)count, (void)counters, (void)resolutions;
    return absent_refuse(fmu, "fmi3GetShiftFraction");
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance fmu, const fmi3ValueReference references[],
                                  size_t count, const fmi3Float64 intervals[])
{
    (void)references, (void)count, (void)intervals;
    return absent_refuse(fmu, "fmi3SetIntervalDecimal");
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance fmu, const fmi3ValueReference references[],
                                   size_t count, const fmi3UInt64 counters[],
                                   const fmi3UInt64 resolutions[])
{
    (void)references, (void)count, (void)counters, (void)resolutions;
    return absent_refuse(fmu, "fmi3SetIntervalFraction");
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance fmu, const fmi3ValueReference references[],
                               size_t count, const fmi3Float64 shifts[])
{
    (void)references, (void)count, (void)shifts;
    return absent_refuse(fmu, "fmi3SetShiftDecimal");
}

fmi3Status fmi3SetShiftFraction(fmi3Instance fmu, const fmi3ValueReference references[],
                                size_t count, const fmi3UInt64 counters[],
                                const fmi3UInt64 resolutions[])
{
    (void)references, (void)count, (void)counters, (void)resolutions;
    return absent_refuse(fmu, "fmi3SetShiftFraction");
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance fmu, const fmi3ValueReference references[],
                                    size_t count, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t value_count)
{
    (void)references, (void)count, (void)orders, (void)values, (void)value_count;
    return absent_refuse(fmu, "fmi3GetOutputDerivatives");
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance fmu, fmi3ValueReference clock, fmi3Float64 time)
{
    (void)clock, (void)time;
    return absent_refuse(fmu, "fmi3ActivateModelPartition");
}
