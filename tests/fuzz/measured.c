/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Measured impacts and histories, files of columns; behind a line of %% stands what the user says
 * of the columns, one a line. */
#include <math.h>

#include "fuzz.h"
#include "history_motion.h"
#include "impact.h"

static struct measured_remarks remarks;

/* What is said is text of one line; what is wrong is said, and only then. */
static void check_remarks(bool good)
{
    FUZZ_REQUIRE(good == (remarks.errors == 0), "good: %d, with %zu errors", good, remarks.errors);
    for (size_t i = 0; i < remarks.errors && i < REMARKS_KEPT; i++)
        fuzz_refused(PERCUSS_BAD_REQUEST, remarks.error[i].text);
    for (size_t i = 0; i < remarks.notes && i < REMARKS_KEPT; i++)
        fuzz_refused(PERCUSS_BAD_REQUEST, remarks.note[i].text);
}

static void read_impacts(const char *file, const struct column_map *map)
{
    struct measured_set set = {0};
    remarks = (struct measured_remarks){0};
    check_remarks(measured_read(file, map, &set, &remarks));
    for (size_t i = 0; i < set.count; i++) {
        struct measured_impact *impact = &set.impacts[i];
        FUZZ_REQUIRE(impact->speed > 0.0, "speed %g", impact->speed);
        /* a body that vibrated gives back more than it got: doubted, and read */
        FUZZ_REQUIRE(!(impact->restitution < -1.0 || impact->restitution > 2.0), "restitution %g",
                     impact->restitution);
        measured_complete(impact, 0.03, 33.0);
    }
    for (size_t i = 0; i < set.left_count; i++)
        FUZZ_REQUIRE(set.left[i].line > 0 && set.left[i].reason, "row %zu left out", i);
    measured_set_free(&set);
}

static void read_history(const char *file, const struct column_map *map)
{
    struct history history = {0};
    struct history_impacts impacts = {0};
    struct history_motion motion = {0};
    struct measured_fault fault = {""};
    remarks = (struct measured_remarks){0};
    bool good = history_read(file, map, &history, &remarks);
    check_remarks(good);
    if (!good)
        return;
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

static void take_choices(struct fuzz_bytes bytes, struct column_map *map)
{
    while (bytes.left > 0) {
        struct fuzz_bytes line = fuzz_part(&bytes, "\n");
        struct measured_fault fault = {""};
        char text[256];
        snprintf(text, sizeof text, "%.*s", (int)(line.left < 255 ? line.left : 255),
                 (const char *)line.data);
        if (!column_map_add(map, text, &fault))
            fuzz_refused(PERCUSS_BAD_REQUEST, fault.text);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct fuzz_bytes bytes = {data, size};
    struct fuzz_bytes text = fuzz_part(&bytes, "\n%%\n");
    struct column_map map = {0};
    const char *file = fuzz_file(0, text.data, text.left);
    take_choices(bytes, &map);
    read_impacts(file, &map);
    read_history(file, &map);
    return 0;
}
