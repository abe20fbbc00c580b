/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* States of the FMU that an importer keeps: a copy of all numbers and the mode. Bodies are at rest
 * before each impact, so there is nothing else. As bytes they begin with the token of the FMU. */
#include <stdlib.h>
#include <string.h>

#include "fmi3.h"
#include "fmu.h"

struct kept {
    char token[64];
    uint32_t mode, co_simulation;
    unsigned char numbers[];
};

static size_t kept_size(void)
{
    return sizeof(struct kept) + MODEL.size;
}

fmi3Status fmi3GetFMUState(fmi3Instance handle, fmi3FMUState *state)
{
    struct fmu *fmu = handle;
    if (!fmu || !state)
        return fmi3Error;
    struct kept *kept = *state ? *state : calloc(1, kept_size());
    if (!kept)
        return fmu_error(fmu, "out of memory");
    strncpy(kept->token, MODEL.token, sizeof kept->token - 1);
    kept->mode = fmu->mode;
    kept->co_simulation = fmu->co_simulation;
    memcpy(kept->numbers, fmu->numbers, MODEL.size);
    *state = kept;
    return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance handle, fmi3FMUState state)
{
    struct fmu *fmu = handle;
    const struct kept *kept = state;
    if (!fmu)
        return fmi3Error;
    if (!kept)
        return fmu_error(fmu, "fmi3SetFMUState: no state");
    if ((kept->co_simulation != 0) != fmu->co_simulation)
        return fmu_error(fmu, "fmi3SetFMUState: Model Exchange and Co-Simulation cannot take each "
                              "other's states");
    fmu->mode = (enum mode)kept->mode;
    memcpy(fmu->numbers, kept->numbers, MODEL.size);
    return fmi3OK;
}

fmi3Status fmi3FreeFMUState(fmi3Instance handle, fmi3FMUState *state)
{
    if (!handle || !state)
        return fmi3Error;
    free(*state);
    *state = NULL;
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance handle, fmi3FMUState state, size_t *size)
{
    (void)state;
    if (!handle || !size)
        return fmi3Error;
    *size = kept_size();
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance handle, fmi3FMUState state, fmi3Byte bytes[],
                                 size_t size)
{
    struct fmu *fmu = handle;
    if (!fmu || !state || !bytes)
        return fmi3Error;
    if (size != kept_size())
        return fmu_error(fmu, "fmi3SerializeFMUState: %zu bytes, %zu are needed", size,
                         kept_size());
    memcpy(bytes, state, size);
    return fmi3OK;
}

/* Whether bytes of a stranger can be the value of each variable. */
static bool check_values(const unsigned char *numbers)
{
    for (size_t i = 0; i < MODEL.variable_count; i++) {
        const struct variable *variable = &MODEL.variables[i];
        const unsigned char *place = numbers + variable->offset;
        if (variable->type == VARIABLE_BOOLEAN && *place > 1)
            return false;
        if (variable->type == VARIABLE_STRING && place[VARIABLE_TEXT_SIZE - 1] != '\0')
            return false;
    }
    return true;
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance handle, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState *state)
{
    struct fmu *fmu = handle;
    if (!fmu || !bytes || !state)
        return fmi3Error;
    struct kept *kept = malloc(kept_size());
    if (!kept)
        return fmu_error(fmu, "out of memory");

    /* bytes of a stranger: nothing is believed of them */
    bool whole = size == kept_size();
    if (whole) {
        memcpy(kept, bytes, size);
        /* one bit of the modes */
        uint32_t mode = kept->mode;
        whole = kept->token[sizeof kept->token - 1] == '\0' && !strcmp(kept->token, MODEL.token) &&
                mode != 0 && mode <= MODE_TERMINATED && (mode & (mode - 1)) == 0 &&
                check_values(kept->numbers);
    }
    if (!whole) {
        free(kept);
        return fmu_error(fmu, "fmi3DeserializeFMUState: these %zu bytes are no state of '%s'", size,
                         MODEL.token);
    }
    *state = kept;
    return fmi3OK;
}
