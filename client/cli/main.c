/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss: asks a percussd, or the solver in this process, from the command line. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "commands.h"
#include "fold.h"
#include "option_hint.h"

const char *argp_program_version = "percuss " PERCUSS_VERSION;

struct invocation {
    struct common common;
    int command; /* its place in argv; 0: none */
};

static error_t parse_main(int key, char *text, struct argp_state *state)
{
    struct invocation *invocation = state->input;
    (void)text;
    switch (key) {
    /* options before the command */
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &invocation->common;
        return 0;
    case ARGP_KEY_ARG:
        /* the rest is the command's */
        invocation->command = state->next - 1;
        state->next = state->argc;
        return 0;
    /* no command */
    case ARGP_KEY_NO_ARGS:
        argp_state_help(state, stderr, ARGP_HELP_STD_HELP & ~ARGP_HELP_EXIT_OK);
        exit(EXIT_USAGE);
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* Puts the commands before the other text at the help's end. */
static char *add_commands(int key, const char *text, void *input)
{
    (void)input;
    char *whole = key == ARGP_KEY_HELP_POST_DOC && text ? commands_list(text) : NULL;
    return whole ? whole : (char *)text;
}

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
static const struct argp main_argp = {
    .parser = parse_main,
    .args_doc = "COMMAND [OPTION...]\nhelp [COMMAND]",
    .doc = "Asks a percussd what an impact does, or with --local the solver in this process.\v"
           "percuss help COMMAND explains a command. Try:\n"
           "  percuss query --local --a steel-sphere --b al-beam --speed 0.3\n\n"
           "Where an answer leaves the range of its models, warnings say so on standard error "
           "(with --json in the list warnings); of many impacts each kind once, with its count.\n\n"
           "Exit status: 0 answered, 1 answered with a warning status, 2 usage, 3 no server, "
           "4 timeout, 5 rejected.",
    .children = children,
    .help_filter = add_commands,
};

static int run(const char *name, int argc, char **argv, struct common *common)
{
    const struct command *command = commands_find(name);
    if (command) {
        option_hint_say(command->argp, argc, argv);
        return command->function(argc, argv, common);
    }
    /* for the shells alone */
    if (!strcmp(name, "complete"))
        return command_complete(argc, argv, common);
    const struct command *meant = commands_similar(name);
    if (meant)
        complain("'%s' is not a command: did you mean '%s'? percuss --help lists them", name,
                 meant->name);
    else
        complain("'%s' is not a command; percuss --help lists them", name);
    return EXIT_USAGE;
}

/* percuss help, percuss help COMMAND: the texts of --help. */
static int help(int argc, char **argv, struct common *common)
{
    char title[64], option[] = "--help";
    const char *name = argc > 1 ? argv[1] : "help";
    bool whole = !strcmp(name, "help") || name[0] == '-';
    snprintf(title, sizeof title, whole ? "percuss" : "percuss %s", name);
    char *words[] = {title, option, NULL};
    if (!whole)
        return run(name, 2, words, common);
    struct invocation invocation = {.common = *common};
    argp_parse(&main_argp, 2, words, 0, NULL, &invocation);
    return EXIT_ANSWERED;
}

int main(int argc, char **argv)
{
    struct invocation invocation = {.common = {.timeout = NAN, .domain = environment_domain()}};
    environment_server(invocation.common.server);
    /* argp changes the order of its words */
    char **words = malloc(((size_t)argc + 1) * sizeof *words);
    if (!words)
        return complain_memory();
    memcpy(words, argv, ((size_t)argc + 1) * sizeof *words);
    invocation.common.words = words;
    argp_err_exit_status = EXIT_USAGE;
    fold_help();
    argp_parse(&main_argp, argc, argv, ARGP_IN_ORDER, NULL, &invocation);

    /* usage texts of a command start with this name */
    char *name = argv[invocation.command], title[64];
    snprintf(title, sizeof title, "percuss %s", name);
    argv[invocation.command] = title;
    argc -= invocation.command;
    argv += invocation.command;
    fold_begin();
    int code = strcmp(name, "help") ? run(name, argc, argv, &invocation.common)
                                    : help(argc, argv, &invocation.common);
    fold_end();
    free(words);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        complain("writing the output failed");
        return EXIT_FAILURE;
    }
    return code;
}
