/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "tally_output.h"

#include "cli.h"

void tally_complain(const struct tally *tally)
{
    char line[TALLY_LINE];
    for (size_t i = 0; i < tally->count; i++) {
        tally_line(tally, i, line);
        complain("warning: %s", line);
    }
}

json_t *tally_to_json(const struct tally *tally)
{
    char line[TALLY_LINE];
    json_t *array = json_array();
    for (size_t i = 0; i < tally->count; i++) {
        tally_line(tally, i, line);
        json_array_append_new(array, json_string(line));
    }
    return array;
}
