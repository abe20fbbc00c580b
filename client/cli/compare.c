/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss compare: measured impacts beside computed ones. */

#include "compare.h"

#include <stdlib.h>

#include "cli.h"
#include "measured_file.h"
#include "waiting.h"

enum { KEY_CSV = OPTION_OWN, KEY_PERMUTATIONS, KEY_SEED };
enum { DEFAULT_PERMUTATIONS = 1999, MOST_PERMUTATIONS = 1000000, MOST_SEED = 1u << 31 };

struct compare {
    struct common *common;
    struct scene scene;
    const char *file;
    struct plot_output plot;
    struct column_map columns;
    bool csv;
    unsigned permutations, seed;
};

static const struct argp_option options[] = {
    {"csv", KEY_CSV, NULL, 0, "print the impacts as comma-separated values", 90},
    {"permutations", KEY_PERMUTATIONS, "N", 0,
     "random permutations behind the p-value of the energy distance (default 1999)", 40},
    {"seed", KEY_SEED, "N", 0, "of the permutations (default 1)", 40},
    {0},
};

static void check(const struct compare *compare, struct argp_state *state)
{
    scene_check_single(&compare->scene, state);
    const struct scene_need file = {"MEASURED.csv", compare->file};
    scene_check_given(&compare->scene, &file, 1, "", state);
    if (compare->csv && compare->common->json)
        argp_error(state, "--csv or --json, not both");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct compare *compare = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &compare->scene;
        state->child_inputs[1] = compare->common;
        state->child_inputs[2] = &compare->plot;
        state->child_inputs[3] = &compare->columns;
        return 0;
    /* the output */
    case KEY_CSV:
        compare->csv = true;
        return 0;
    /* the test by permutations */
    case KEY_PERMUTATIONS:
        compare->permutations = parse_count("permutations", text, MOST_PERMUTATIONS, state);
        return 0;
    case KEY_SEED:
        compare->seed = parse_count("seed", text, MOST_SEED, state);
        return 0;
    /* the file of measured impacts */
    case ARGP_KEY_ARG:
        if (compare->file)
            argp_error(state, "one file is needed, not '%s' as well", text);
        compare->file = text;
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        check(compare, state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&scene_argp, 0, NULL, 0},
                                             {&common_argp, 0, NULL, 0},
                                             {&plot_argp, 0, NULL, 0},
                                             {&measured_file_argp, 0, NULL, 0},
                                             {0}};
const struct argp compare_argp = {
    .options = options,
    .parser = parse,
    .args_doc = "MEASURED.csv",
    .doc =
        "Puts measured impacts beside their simulated twins: residuals, and how different the two "
        "distributions of the restitution are.\v"
        "MEASURED.csv, or - for standard input, has a line of column names: speed, restitution "
        "and optionally impulse, sub_impacts, first_impulse, first_duration, second_start, at; or "
        "history, the name of a file with the columns time and velocity_a (or displacement_a), "
        "from which the others follow. Separators are commas, semicolons, tabs or blanks; units "
        "may stand in the names, as in speed [mm/s]. percuss(1) says more.\n"
        "Example: percuss compare measured.csv --a steel-sphere --b al-beam --plot measured.svg",
    .children = children,
};

static int report(const struct compare *compare, const struct comparison *comparison)
{
    if (compare->common->json)
        compare_print_json(comparison);
    else if (compare->csv)
        compare_print_csv(comparison, compare->common->units);
    else
        compare_print_table(comparison);
    if (!compare->common->json)
        tally_complain(comparison->warnings);
    return plot_wanted(&compare->plot) ? compare_plot(&compare->plot, comparison) : EXIT_ANSWERED;
}

static int run(const struct compare *compare, struct twins *twins, struct measured_set *set)
{
    struct twin *list = calloc(set->count, sizeof *list);
    const struct scene_text text = scene_describe(&compare->scene, &twins->bodies);
    struct comparison comparison = {.scene = &compare->scene,
                                    .title = text.title,
                                    .set = set,
                                    .twins = list,
                                    .warnings = &twins->warnings};
    int code = list ? twins_ask(twins, set, &(struct twin_changes){.faster = 1.0}, list)
                    : complain_memory();
    waiting_end();
    if (code == EXIT_ANSWERED)
        code = twins_complete(twins, set, list);
    if (code == EXIT_ANSWERED)
        code = differences_find(set, list, compare->permutations, compare->seed,
                                &comparison.differences)
                   ? report(compare, &comparison)
                   : complain_memory();
    free(list);
    return code;
}

int command_compare(int argc, char **argv, struct common *common)
{
    struct compare compare = {.common = common,
                              .scene = scene_default(),
                              .permutations = DEFAULT_PERMUTATIONS,
                              .seed = 1};
    struct measured_set set;
    struct twins twins;
    argp_parse(&compare_argp, argc, argv, 0, NULL, &compare);
    /* the measured impacts */
    int code = measured_file_read(compare.file, &compare.columns, &set);
    if (code != EXIT_ANSWERED)
        return code;
    /* its twins, and how far they are from it */
    code = twins_open(&twins, common, &compare.scene);
    if (code == EXIT_ANSWERED) {
        code = run(&compare, &twins, &set);
        twins_close(&twins);
    }
    measured_set_free(&set);
    return code;
}
