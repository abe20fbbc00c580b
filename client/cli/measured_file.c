/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "measured_file.h"

#include "cli.h"
#include "plot.h"
#include "quantity.h"
#include "scene.h"

enum { KEY_COLUMN = OPTION_OWN + 50, KEY_SCALE, KEY_RATE, KEY_GRAVITY, KEY_UNCERTAINTY };

static const struct argp_option options[] = {
    {"column", KEY_COLUMN, "NAME=HEADING[:UNIT]", 0,
     "what the file of measurements calls the column NAME, or its number from 1 on, and the unit "
     "that it is in: "
     "speed=v:mm/s; may be given several times. Without a unit it is the one that the file says, "
     "or else that of SI; px and frame are those of --scale and --rate",
     35},
    {"scale", KEY_SCALE, "LENGTH", 0,
     "length of a pixel, of columns of lengths in px or without a unit: 0.12mm", 35},
    {"rate", KEY_RATE, "F", 0,
     "frames or readings a second, of times in frames, or of histories without a column time: 240",
     35},
    {"gravity", KEY_GRAVITY, "G", 0,
     "m/s^2, or with a unit (default: 9.80665; of a history that which it shows)", 35},
    {"uncertainty", KEY_UNCERTAINTY, "NAME=VALUE", 0,
     "half of the 95 % interval of each number in the column NAME: rebound=2mm; may be given "
     "several "
     "times",
     35},
    {0},
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct measured_fault fault;
    struct column_map *map = state->input;
    switch (key) {
    case KEY_COLUMN:
        if (!column_map_add(map, text, &fault))
            argp_error(state, "--column: %s", fault.text);
        return 0;
    case KEY_UNCERTAINTY:
        if (!column_map_doubt(map, text, &fault))
            argp_error(state, "--uncertainty: %s", fault.text);
        return 0;
    case KEY_SCALE:
        map->scale = parse_positive_quantity("scale", text, QUANTITY_LENGTH, state);
        return 0;
    case KEY_RATE:
        map->rate = parse_positive_quantity("rate", text, QUANTITY_FREQUENCY, state);
        return 0;
    case KEY_GRAVITY:
        map->gravity = parse_positive_quantity("gravity", text, QUANTITY_ACCELERATION, state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
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
