/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What every program of the project does on its command line: -h and -v are what argp calls --help
 * and --version, and a word that nobody takes is named. The children of each program's argp. */
#ifndef PERCUSS_HABITS_H
#define PERCUSS_HABITS_H

#include <argp.h>
#include <stdio.h>
#include <stdlib.h>

static error_t habits_parse(int key, char *text, struct argp_state *state)
{
    switch (key) {
    case 'h':
        argp_state_help(state, stdout, ARGP_HELP_STD_HELP);
        return 0;
    case 'v':
        puts(argp_program_version);
        exit(EXIT_SUCCESS);
    case ARGP_KEY_ARG:
        argp_error(state, "'%s': no argument is expected, only options", text);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option habits_options[] = {
    {NULL, 'h', NULL, 0, "as --help", -1},
    {NULL, 'v', NULL, 0, "as --version", -1},
    {0},
};
static const struct argp habits_argp = {.options = habits_options, .parser = habits_parse};
static const struct argp_child habits[] = {{&habits_argp, 0, NULL, 0}, {0}};

#endif
