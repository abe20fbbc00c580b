/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Measured impacts and histories, files of comma-separated values. */
#include <math.h>

#include "fuzz.h"
#include "impact.h"

static void read_impacts(const char *file)
{
    struct measured_set set = {0};
    struct measured_fault fault = {""};
    if (!measured_read(file, &set, &fault))
        fuzz_refused(PERCUSS_BAD_REQUEST, fault.text);
    for (size_t i = 0; i < set.count; i++) {
        FUZZ_REQUIRE(set.impacts[i].speed > 0.0, "speed %g", set.impacts[i].speed);
        measured_complete(&set.impacts[i], 0.03, 33.0);
    }
    measured_set_free(&set);
}

static void read_history(const char *file)
{
    struct history history = {0};
    struct history_impacts impacts = {0};
    struct history_motion motion = {0};
    struct measured_fault fault = {""};
    if (!history_read(file, &history, &fault)) {
        fuzz_refused(PERCUSS_BAD_REQUEST, fault.text);
        return;
    }
    for (size_t i = 1; i < history.count; i++)
        FUZZ_REQUIRE(history.time[i] > history.time[i - 1], "times that do not ascend");
    if (!history_find(&history, &impacts, &fault)) {
        fuzz_refused(PERCUSS_BAD_REQUEST, fault.text);
    } else {
        FUZZ_REQUIRE(impacts.count >= 1 && impacts.count <= HISTORY_SUB_IMPACTS, "%zu sub-impacts",
                     impacts.count);
        FUZZ_REQUIRE(impacts.before < 0.0, "approach of %g m/s", impacts.before);
        if (history_align(&history, &impacts, &motion))
            history_motion_free(&motion);
    }
    history_free(&history);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *file = fuzz_file(0, data, size);
    read_impacts(file);
    read_history(file);
    return 0;
}
