/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The values of variables. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "fmi3.h"
#include "fmu.h"

static const char *const TYPE_NAMES[] = {
    [VARIABLE_FLOAT64] = "Float64",
    [VARIABLE_INT32] = "Int32",
    [VARIABLE_BOOLEAN] = "Boolean",
    [VARIABLE_STRING] = "String",
};

/* The variable of that reference and type; NULL after a message. */
static const struct variable *values_find(struct fmu *fmu, fmi3ValueReference reference,
                                          enum variable_type type)
{
    if (reference >= MODEL.variable_count) {
        fmu_error(fmu, "value reference %u: there are 0..%zu", (unsigned)reference,
                  MODEL.variable_count - 1);
        return NULL;
    }
    const struct variable *variable = &MODEL.variables[reference];
    if (variable->type == type)
        return variable;
    fmu_error(fmu, "%s is a %s, no %s", variable->name, TYPE_NAMES[variable->type],
              TYPE_NAMES[type]);
    return NULL;
}

/* Whether the importer may set it now. */
static bool check_settable(struct fmu *fmu, const struct variable *variable)
{
    if (!variable_has_start(variable)) {
        fmu_error(fmu, "%s cannot be set: it is calculated", variable->name);
        return false;
    }
    unsigned modes = MODE_INSTANTIATED | MODE_INITIALIZATION;
    if (variable->role == VARIABLE_INPUT)
        modes |= MODE_EVENT | MODE_CONTINUOUS | MODE_STEP;
    else if (variable->role == VARIABLE_STATE)
        modes |= MODE_CONTINUOUS; /* as by fmi3SetContinuousStates */
    return fmu_is_in(fmu, modes, variable->name);
}

static bool check_count(struct fmu *fmu, size_t references, size_t values)
{
    if (references == values)
        return true;
    fmu_error(fmu, "%zu values for %zu variables: each has one", values, references);
    return false;
}

/* Where the value is to be read; NULL after a message. */
static const void *readable(struct fmu *fmu, fmi3ValueReference reference, enum variable_type type)
{
    const struct variable *variable = values_find(fmu, reference, type);
    return variable ? fmu->numbers + variable->offset : NULL;
}

/* Where it is to be written. */
static void *writable(struct fmu *fmu, fmi3ValueReference reference, enum variable_type type,
                      const struct variable **variable)
{
    *variable = values_find(fmu, reference, type);
    return *variable && check_settable(fmu, *variable) ? fmu->numbers + (*variable)->offset : NULL;
}

#define VALUES_GET(type, enumerator)                                                               \
    fmi3Status fmi3Get##type(fmi3Instance handle, const fmi3ValueReference references[],           \
                             size_t count, fmi3##type values[], size_t value_count)                \
    {                                                                                              \
        struct fmu *fmu = handle;                                                                  \
        if (!fmu || !check_count(fmu, count, value_count))                                         \
            return fmi3Error;                                                                      \
        MODEL.refresh(fmu->numbers);                                                               \
        for (size_t i = 0; i < count; i++) {                                                       \
            const void *place = readable(fmu, references[i], enumerator);                          \
            if (!place)                                                                            \
                return fmi3Error;                                                                  \
            VALUES_READ_##type(values[i], place);                                                  \
        }                                                                                          \
        return fmi3OK;                                                                             \
    }
#define VALUES_READ_Float64(value, place) (value) = *(const double *)(place)
#define VALUES_READ_Int32(value, place)   (value) = *(const int32_t *)(place)
#define VALUES_READ_Boolean(value, place) (value) = *(const bool *)(place)
#define VALUES_READ_String(value, place)  (value) = (place)
VALUES_GET(Float64, VARIABLE_FLOAT64)
VALUES_GET(Int32, VARIABLE_INT32)
VALUES_GET(Boolean, VARIABLE_BOOLEAN)
VALUES_GET(String, VARIABLE_STRING)

static bool write_Float64(struct fmu *fmu, const struct variable *variable, void *place,
                          double value)
{
    if (!isfinite(value)) {
        fmu_error(fmu, "%s: %g is not a finite number", variable->name, value);
        return false;
    }
    *(double *)place = value;
    return true;
}

static bool write_Int32(struct fmu *fmu, const struct variable *variable, void *place,
                        int32_t value)
{
    (void)fmu, (void)variable;
    *(int32_t *)place = value;
    return true;
}

static bool write_Boolean(struct fmu *fmu, const struct variable *variable, void *place, bool value)
{
    (void)fmu, (void)variable;
    *(bool *)place = value;
    return true;
}

static bool write_String(struct fmu *fmu, const struct variable *variable, void *place,
                         const char *value)
{
    if (!value || strlen(value) >= VARIABLE_TEXT_SIZE) {
        fmu_error(fmu, "%s: a text of up to %d bytes is needed", variable->name,
                  VARIABLE_TEXT_SIZE - 1);
        return false;
    }
    /* the rest is zero, so that equal texts are equal bytes */
    memset(place, 0, VARIABLE_TEXT_SIZE);
    memcpy(place, value, strlen(value));
    return true;
}

#define VALUES_SET(type, enumerator)                                                               \
    fmi3Status fmi3Set##type(fmi3Instance handle, const fmi3ValueReference references[],           \
                             size_t count, const fmi3##type values[], size_t value_count)          \
    {                                                                                              \
        struct fmu *fmu = handle;                                                                  \
        if (!fmu || !check_count(fmu, count, value_count))                                         \
            return fmi3Error;                                                                      \
        for (size_t i = 0; i < count; i++) {                                                       \
            const struct variable *variable;                                                       \
            void *place = writable(fmu, references[i], enumerator, &variable);                     \
            if (!place || !write_##type(fmu, variable, place, values[i]))                          \
                return fmi3Error;                                                                  \
        }                                                                                          \
        return fmi3OK;                                                                             \
    }
VALUES_SET(Float64, VARIABLE_FLOAT64)
VALUES_SET(Int32, VARIABLE_INT32)
VALUES_SET(Boolean, VARIABLE_BOOLEAN)
VALUES_SET(String, VARIABLE_STRING)

/* No variable is of these types. */
#define VALUES_NONE(type)                                                                          \
    fmi3Status fmi3Get##type(fmi3Instance handle, const fmi3ValueReference references[],           \
                             size_t count, fmi3##type values[], size_t value_count)                \
    {                                                                                              \
        (void)references, (void)values, (void)value_count;                                         \
        return !handle || count ? none(handle, #type) : fmi3OK;                                    \
    }                                                                                              \
    fmi3Status fmi3Set##type(fmi3Instance handle, const fmi3ValueReference references[],           \
                             size_t count, const fmi3##type values[], size_t value_count)          \
    {                                                                                              \
        (void)references, (void)values, (void)value_count;                                         \
        return !handle || count ? none(handle, #type) : fmi3OK;                                    \
    }

static fmi3Status none(struct fmu *fmu, const char *type)
{
    return fmu ? fmu_error(fmu, "no variable is a %s", type) : fmi3Error;
}
VALUES_NONE(Float32)
VALUES_NONE(Int8)
VALUES_NONE(UInt8)
VALUES_NONE(Int16)
VALUES_NONE(UInt16)
VALUES_NONE(UInt32)
VALUES_NONE(Int64)
VALUES_NONE(UInt64)

fmi3Status fmi3GetBinary(fmi3Instance handle, const fmi3ValueReference references[], size_t count,
                         size_t sizes[], fmi3Binary values[], size_t value_count)
{
    (void)references, (void)sizes, (void)values, (void)value_count;
    return !handle || count ? none(handle, "Binary") : fmi3OK;
}

fmi3Status fmi3SetBinary(fmi3Instance handle, const fmi3ValueReference references[], size_t count,
                         const size_t sizes[], const fmi3Binary values[], size_t value_count)
{
    (void)references, (void)sizes, (void)values, (void)value_count;
    return !handle || count ? none(handle, "Binary") : fmi3OK;
}

fmi3Status fmi3GetClock(fmi3Instance handle, const fmi3ValueReference references[], size_t count,
                        fmi3Clock values[])
{
    (void)references, (void)values;
    return !handle || count ? none(handle, "Clock") : fmi3OK;
}

fmi3Status fmi3SetClock(fmi3Instance handle, const fmi3ValueReference references[], size_t count,
                        const fmi3Clock values[])
{
    (void)references, (void)values;
    return !handle || count ? none(handle, "Clock") : fmi3OK;
}
