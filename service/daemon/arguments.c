/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/arguments.h"

#include <argp.h>
#include <stdlib.h>
#include <string.h>

#include "catalogue/shipped.h"
#include "percuss/habits.h"
#include "respond/settings.h"

enum { KEY_CHECK = 0x100, KEY_STORE, KEY_FORMAT, KEY_PARTITION, USAGE = 2 };

const char *argp_program_version = "percussd " PERCUSS_VERSION;

static const struct argp_option options[] = {
    {"config", 'c', "FILE", 0,
     "Settings; the shipped percussd.yaml explains each key, and is read where no other file is "
     "given",
     0},
    {"catalogue", 'C', "FILE", 0, "Bodies and materials; goes before the one in the settings", 0},
    {"domain", 'd', "N", 0,
     "DDS domain, 0 to 230; goes before PERCUSS_DOMAIN, and that before the one in the settings",
     0},
    {"partition", KEY_PARTITION, "NAME", 0,
     "Answer only those who ask in this DDS partition; goes before PERCUSS_PARTITION, and that "
     "before the one in the settings; empty: none",
     0},
    {"log-format", KEY_FORMAT, "FORMAT", 0,
     "text, json (an object a line) or journal (of systemd); goes before the one in the settings",
     0},
    {"check-config", KEY_CHECK, NULL, 0,
     "Look at all that a start needs, say ok or what is wrong: of settings and catalogue the first "
     "error of each",
     0},
    {"check-store", KEY_STORE, "FILE", 0,
     "Look through a store of specimens, or a copy, that no daemon has open", 0},
    {0},
};

static int parse_domain(struct argp_state *state, const char *name, const char *text)
{
    char *end;
    long domain = strtol(text, &end, 10);
    if (end == text || *end || domain < 0 || domain > SETTINGS_MAX_DOMAIN)
        argp_error(state, "%s: %s: must be a whole number, 0 to %d", name, text,
                   SETTINGS_MAX_DOMAIN);
    return (int)domain;
}

static const char *parse_partition(struct argp_state *state, const char *name, const char *text)
{
    if (*text && !wire_partition_is_good(text))
        argp_error(state, "%s: %s: must be " WIRE_PARTITION_RULE ", or empty", name, text);
    return text;
}

static int parse_format(struct argp_state *state, const char *text)
{
    for (enum log_format format = 0; format < LOG_FORMAT_COUNT; format++) {
        if (strcmp(text, log_format_name(format)) == 0)
            return (int)format;
    }
    argp_error(state, "--log-format: %s: must be text, journal or json", text);
    return -1;
}

/* What the environment says, unless the command line has said it. */
static void read_environment(struct argp_state *state, struct arguments *arguments)
{
    const char *domain = getenv("PERCUSS_DOMAIN");
    if (arguments->domain < 0 && domain && *domain)
        arguments->domain = parse_domain(state, "PERCUSS_DOMAIN", domain);
    const char *partition = getenv("PERCUSS_PARTITION");
    if (!arguments->partition && partition && *partition)
        arguments->partition = parse_partition(state, "PERCUSS_PARTITION", partition);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    switch (key) {
    /* files, whom it answers, and the log */
    case 'c':
        arguments->config = text;
        return 0;
    case 'C':
        arguments->catalogue = text;
        return 0;
    case 'd':
        arguments->domain = parse_domain(state, "--domain", text);
        return 0;
    case KEY_PARTITION:
        arguments->partition = parse_partition(state, "--partition", text);
        return 0;
    case KEY_FORMAT:
        arguments->log_format = parse_format(state, text);
        return 0;
    /* only a check */
    case KEY_CHECK:
        arguments->check_config = true;
        return 0;
    case KEY_STORE:
        arguments->check_store = text;
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        read_environment(state, arguments);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

struct arguments arguments_read(int argc, char **argv)
{
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .children = habits,
        .doc =
            "Answers what impacts do, on DDS."
            "\vSIGTERM and SIGINT: answers what is waiting and ends. SIGHUP: reads the catalogue "
            "again; a bad one is logged and the old one stays. SIGUSR1: looks through the store of "
            "specimens and copies it to the file that the settings name as its backup.",
    };
    struct arguments arguments = {.domain = -1, .log_format = -1};
    argp_err_exit_status = USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    /* an administrator's are of his catalogue, with a store that is not everybody's */
    if (!arguments.config && !arguments.check_store)
        arguments.shipped = arguments.catalogue ? shipped_plain_settings() : shipped_settings();
    return arguments;
}
