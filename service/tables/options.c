/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "tables/options.h"

#include <argp.h>
#include <stdlib.h>

#include "base/units.h"
#include "percuss/habits.h"
#include "store/folder.h"
#include "store/table_key.h"

enum { USAGE = 2, LEAST_RESOLUTION = 6, MOST_RESOLUTION = 60 };

const char *argp_program_version = "percuss-tables " PERCUSS_VERSION;

static const struct argp_option list[] = {
    {"catalogue", 'C', "FILE", 0, "Bodies and materials, as percussd reads them", 0},
    {"bodies", 'B', "DIR", 0, "Bodies reduced from meshes; `bodies` in percussd's settings", 0},
    {"folder", 'f', "DIR", 0,
     "Where the tables go, made if need be: `tables` in percussd's settings; default: the folder "
     "of "
     "your own, which stands beside the shipped tables by itself: PERCUSS_TABLES, or "
     "~/.local/share/percuss/tables",
     0},
    {"a", 'a', "ID", 0, "Only for the materials of this body ...", 0},
    {"b", 'b', "ID", 0, "... and this one", 0},
    {"speed", 's', "V", 0,
     "Deep enough for compact bodies that meet at V, m/s or such as 300mm/s; default 1", 0},
    {"resolution", 'r', "N", 0, "Elements along the mesh's core, 6 to 60; default 12", 0},
    {"family", 'F', NULL, 0, "The family for all metals instead, DIR/family.json: 18 minutes", 0},
    {0},
};

static double parse_number(struct argp_state *state, const char *name, const char *text,
                           double least, double most)
{
    char *end;
    double number = strtod(text, &end);
    if (end == text || *end || !(number >= least && number <= most))
        argp_error(state, "--%s: %s: must be a number, %g to %g", name, text, least, most);
    return number;
}

static double parse_speed(struct argp_state *state, const char *text)
{
    double speed;
    if (units_read(text, QUANTITY_SPEED, &speed) || !(speed >= 1e-3 && speed <= 1e3))
        argp_error(state,
                   "--speed: %s: must be a speed, 0.001 to 1000 m/s, or with a unit, such as %s",
                   text, units_example(QUANTITY_SPEED));
    return speed;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct options *options = state->input;
    switch (key) {
    /* from where, and to where */
    case 'C':
        options->catalogue = text;
        return 0;
    case 'B':
        options->bodies = text;
        return 0;
    case 'f':
        options->folder = text;
        return 0;
    /* of which bodies */
    case 'a':
        options->a = text;
        return 0;
    case 'b':
        options->b = text;
        return 0;
    /* how far and how finely */
    case 's':
        options->speed = parse_speed(state, text);
        return 0;
    case 'r':
        options->resolution =
            (size_t)parse_number(state, "resolution", text, LEAST_RESOLUTION, MOST_RESOLUTION);
        return 0;
    case 'F':
        options->family = true;
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        if (options->family && (options->catalogue || options->a || options->b))
            argp_error(state, "--family: has no catalogue and no bodies");
        if (!options->catalogue && !options->family)
            argp_error(state, "--catalogue FILE (or --family) must be given");
        if (!options->folder && !folder_own_tables(options->own, sizeof options->own))
            argp_error(state, "--folder DIR must be given: PERCUSS_TABLES is empty, or neither it "
                              "nor HOME says where");
        if (!options->folder)
            options->folder = options->own;
        if (!options->a != !options->b)
            argp_error(state, "--a ID and --b ID must be given together");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

void options_read(struct options *options, int argc, char **argv)
{
    static const struct argp argp = {
        .options = list,
        .parser = parse,
        .children = habits,
        .doc = "Computes tables of elastic-plastic contacts ahead of time, for the contact model "
               "`table`: finite elements of the contact region, some seconds to minutes each. "
               "Without --a and --b: of every two materials in the catalogue whose bodies can meet "
               "in a circular contact and of which one may yield. A body that is given as a mesh "
               "and not reduced yet is left out."
               "\vA table holds for bodies of any size. What is there already is left as it is.",
    };
    *options = (struct options){.bodies = "", .speed = 1.0, .resolution = TABLE_RESOLUTION};
    argp_err_exit_status = USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, options);
}
