/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "complete.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "complete_line.h"
#include "complete_values.h"

/* What argp adds to the options of every command. */
static const struct argp_option built_in[] = {
    {"help", '?', NULL, 0, "Give this help list", 0},
    {"usage", '?', NULL, 0, "Give a short usage message", 0},
    {"version", 'V', NULL, 0, "Print program version", 0},
    {0},
};

static void offer_list(const struct line *line, const struct argp_option *options)
{
    char text[64];
    for (const struct argp_option *o = options; o && !line_options_end(o); o++) {
        if (!o->name || (o->flags & OPTION_HIDDEN))
            continue;
        snprintf(text, sizeof text, "--%s", o->name);
        line_offer(line, text, o->doc);
    }
}

static void offer_options(const struct line *line, const struct argp *argp)
{
    offer_list(line, argp->options);
    for (const struct argp_child *child = argp->children; child && child->argp; child++)
        offer_options(line, child->argp);
}

/* The words of "request|reply"; what is in capitals is a file of the user's. */
static void offer_arguments(const struct line *line, const char *arguments)
{
    char word[32];
    if (arguments && isupper((unsigned char)arguments[0])) {
        puts(":files");
        return;
    }
    while (arguments && *arguments) {
        size_t length = strcspn(arguments, "|");
        snprintf(word, sizeof word, "%.*s", (int)length, arguments);
        line_offer(line, word, NULL);
        arguments += length + (arguments[length] == '|');
    }
}

static void offer_commands(const struct line *line)
{
    for (const struct command *command = COMMANDS; command->name; command++)
        line_offer(line, command->name, command->summary);
    if (!line->help)
        line_offer(line, "help", "explain a command");
}

int command_complete(int argc, char **argv, struct common *common)
{
    struct line line;
    if (!line_read(argc - 1, argv + 1, common, &line))
        return complain_memory();
    /* a value, an option, or an argument */
    if (line.option) {
        if (line.option->arg)
            complete_values(&line);
    } else if (line.word[0] == '-') {
        offer_options(&line, line_argp(&line));
        offer_list(&line, built_in);
    } else if (line.command && !line.help) {
        offer_arguments(&line, line.command->argp->args_doc);
    } else if (!line.command) {
        offer_commands(&line);
    }
    line_free(&line);
    return EXIT_ANSWERED;
}
