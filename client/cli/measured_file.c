/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "measured_file.h"

#include "cli.h"
#include "plot.h"
#include "scene.h"

enum { KEY_COLUMN = OPTION_OWN + 50 };

static const struct argp_option options[] = {
    {"column", KEY_COLUMN, "NAME=HEADING[:UNIT]", 0,
     "what the file of measurements calls the column NAME, or its number from 1 on, and the unit "
     "that it is in: "
     "speed=v:mm/s; may be given several times. Without a unit it is the one that the file says, "
     "or else that of SI",
     35},
    {0},
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct measured_fault fault;
    if (key != KEY_COLUMN)
        return ARGP_ERR_UNKNOWN;
    if (!column_map_add(state->input, text, &fault))
        argp_error(state, "--column: %s", fault.text);
    return 0;
}

const struct argp measured_file_argp = {.options = options, .parser = parse};

const struct argp_child measured_scene_children[5] = {{&scene_argp, 0, NULL, 0},
                                                      {&common_argp, 0, NULL, 0},
                                                      {&plot_argp, 0, NULL, 0},
                                                      {&measured_file_argp, 0, NULL, 0},
                                                      {0}};

void measured_scene_inputs(struct argp_state *state, void *const inputs[4])
{
    for (int i = 0; i < 4; i++)
        state->child_inputs[i] = inputs[i];
}

void measured_file_complain(const char *option, const struct measured_remarks *remarks)
{
    for (size_t i = 0; i < remarks->notes && i < REMARKS_KEPT; i++)
        complain("%s%s", option, remarks->note[i].text);
    for (size_t i = 0; i < remarks->errors && i < REMARKS_KEPT; i++)
        complain("%s%s", option, remarks->error[i].text);
    if (remarks->errors > REMARKS_KEPT)
        complain("%sand %zu errors more", option, remarks->errors - REMARKS_KEPT);
}

int measured_file_read(const char *file, const struct column_map *map, struct measured_set *set)
{
    struct measured_remarks remarks = {0};
    bool good = measured_read(file, map, set, &remarks);
    measured_file_complain("", &remarks);
    return good ? EXIT_ANSWERED : EXIT_USAGE;
}

json_t *measured_file_left_to_json(const struct measured_set *set)
{
    json_t *array = json_array();
    for (size_t i = 0; i < set->left_count; i++)
        json_array_append_new(array, json_pack("{sIss}", "line", (json_int_t)set->left[i].line,
                                               "reason", set->left[i].reason));
    return array;
}
