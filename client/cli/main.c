/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss: asks a percussd, or the solver in this process, from the command line. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

const char *argp_program_version = "percuss " PERCUSS_VERSION;

static const struct {
    const char *name;
    command_function *function;
} commands[] = {
    {"query", command_query},     {"sweep", command_sweep},         {"ensemble", command_ensemble},
    {"bodies", command_bodies},   {"status", command_status},       {"ping", command_ping},
    {"compare", command_compare}, {"calibrate", command_calibrate}, {"dents", command_dents},
    {"schema", command_schema},
};

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

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
static const struct argp main_argp = {
    .parser = parse_main,
    .args_doc = "COMMAND [OPTION...]",
    .doc =
        "Asks a percussd what an impact does, or with --local the solver in this process.\v"
        "Commands:\n"
        "  query     one impact: impulse, restitution and the sub-impacts\n"
        "  sweep     the same impact at many speeds\n"
        "  bodies    the bodies that the server knows\n"
        "  status    what the server is doing\n"
        "  dents     the specimens that the server keeps, with their dents\n"
        "  ping      round-trip time to the server\n"
        "  compare   measured impacts beside their simulated twins\n"
        "  calibrate parameters of the bodies from measured impacts\n"
        "  schema    the JSON Schema of requests, replies and ensembles\n"
        "  ensemble  many impacts with uncertain inputs: the restitution as a distribution\n\n"
        "percuss COMMAND --help explains a command. Try: "
        "percuss query --local --a steel-sphere --b al-beam --speed 0.3\n\n"
        "Where an answer leaves the range of its models, warnings say so on standard error (with "
        "--json in the list warnings); of many impacts each kind once, with its count.\n\n"
        "Exit status: 0 answered, 1 answered with a warning status, 2 usage, 3 no server, "
        "4 timeout, 5 rejected.",
    .children = children,
};

static int run(const char *name, int argc, char **argv, struct common *common)
{
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        if (!strcmp(commands[i].name, name))
            return commands[i].function(argc, argv, common);
    complain("'%s' is not a command; percuss --help lists them", name);
    return EXIT_USAGE;
}

int main(int argc, char **argv)
{
    struct invocation invocation = {.common = {.timeout = NAN, .domain = environment_domain()}};
    environment_server(invocation.common.server);
    argp_err_exit_status = EXIT_USAGE;
    argp_parse(&main_argp, argc, argv, ARGP_IN_ORDER, NULL, &invocation);

    /* usage texts of a command start with this name */
    char *name = argv[invocation.command], title[64];
    snprintf(title, sizeof title, "percuss %s", name);
    argv[invocation.command] = title;
    int code = run(name, argc - invocation.command, argv + invocation.command, &invocation.common);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        complain("writing the output failed");
        return EXIT_FAILURE;
    }
    return code;
}
