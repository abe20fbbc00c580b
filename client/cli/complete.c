/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "complete.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"

/* s for a server to appear and to answer: who types does not wait longer, and on one host it takes
 * 0.1 s */
static const double PATIENCE = 0.5;

/* Options whose values have names. */
static const struct {
    const char *option;
    const char *(*name_of)(unsigned);
    unsigned count;
} choices[] = {
    {"contact-model", percuss_contact_model_name, PERCUSS_CONTACT_COUNT},
    {"method", percuss_method_name, PERCUSS_METHOD_COUNT},
    {"compliance", percuss_compliance_name, PERCUSS_COMPLIANCE_COUNT},
    {"sampling", percuss_sampling_name, PERCUSS_SAMPLING_COUNT},
};

/* What argp adds to the options of every command. */
static const struct argp_option built_in[] = {
    {"help", '?', NULL, 0, "Give this help list", 0},
    {"usage", '?', NULL, 0, "Give a short usage message", 0},
    {"version", 'V', NULL, 0, "Print program version", 0},
    {0},
};

struct line {
    struct common *common;
    const struct command *command;    /* NULL: not given yet */
    bool help;                        /* the command is help */
    const struct argp_option *option; /* whose value is next; NULL: none */
    const char *before;               /* of the last word what stays, for example "--a=" */
    int before_length;
    const char *word; /* its rest, to be completed */
};

static void offer(const struct line *line, const char *text, const char *what)
{
    if (!strncmp(text, line->word, strlen(line->word)))
        printf("%.*s%s\t%s\n", line->before_length, line->before, text, what ? what : "");
}

static bool ends(const struct argp_option *option)
{
    return !option->name && !option->key && !option->doc && !option->group;
}

/* The option of that name in an argp and those below it; NULL: there is none. */
static const struct argp_option *find_option(const struct argp *argp, const char *name,
                                             size_t length)
{
    const struct argp_option *found = NULL;
    for (const struct argp_option *o = argp->options; o && !ends(o) && !found; o++)
        if (o->name && strlen(o->name) == length && !strncmp(o->name, name, length))
            found = o;
    for (const struct argp_child *child = argp->children; child && child->argp && !found; child++)
        found = find_option(child->argp, name, length);
    return found;
}

static void offer_list(const struct line *line, const struct argp_option *options)
{
    char text[64];
    for (const struct argp_option *o = options; o && !ends(o); o++) {
        if (!o->name || (o->flags & OPTION_HIDDEN))
            continue;
        snprintf(text, sizeof text, "--%s", o->name);
        offer(line, text, o->doc);
    }
}

static void offer_options(const struct line *line, const struct argp *argp)
{
    offer_list(line, argp->options);
    for (const struct argp_child *child = argp->children; child && child->argp; child++)
        offer_options(line, child->argp);
}

/* The catalogue of the server that the line names, or of this process; nothing where none answers
 * at once. */
static void offer_bodies(const struct line *line)
{
    struct percuss_client *client;
    struct percuss_body_list list = {0};
    if (make_client(line->common, NULL, &client) != EXIT_ANSWERED)
        return;
    if (percuss_client_connect(client, PATIENCE) == PERCUSS_RESULT_OK &&
        percuss_bodies(client, PATIENCE, &list) == PERCUSS_RESULT_OK)
        for (size_t i = 0; i < list.count; i++)
            offer(line, list.bodies[i].id, list.bodies[i].description);
    percuss_body_list_free(&list);
    percuss_client_free(client);
}

static void offer_values(const struct line *line)
{
    const char *name = line->option->name, *kind = line->option->arg;
    for (size_t i = 0; i < sizeof choices / sizeof choices[0]; i++)
        for (unsigned k = 0; !strcmp(choices[i].option, name) && k < choices[i].count; k++)
            offer(line, choices[i].name_of(k), NULL);
    if (!strcmp(name, "a") || !strcmp(name, "b"))
        offer_bodies(line);
    else if (!strcmp(name, "server"))
        offer(line, PERCUSS_LEAST_LOADED, "the one with least to do");
    else if (!strncmp(kind, "FILE", 4) || !strcmp(kind, "DIR"))
        puts(":files");
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
        offer(line, word, NULL);
        arguments += length + (arguments[length] == '|');
    }
}

static void offer_commands(const struct line *line)
{
    for (const struct command *command = COMMANDS; command->name; command++)
        offer(line, command->name, command->summary);
    if (!line->help)
        offer(line, "help", "explain a command");
}

/* The value of an option that decides which server is asked. */
static void take_value(struct line *line, char *value)
{
    char *end;
    unsigned long number = strtoul(value, &end, 10);
    if (!strcmp(line->option->name, "partition"))
        line->common->partition = value;
    else if (!strcmp(line->option->name, "security"))
        line->common->security = value;
    else if (!strcmp(line->option->name, "catalogue"))
        line->common->catalogue = value;
    else if (!strcmp(line->option->name, "config"))
        line->common->config = value;
    else if (!strcmp(line->option->name, "domain") && *value && !*end)
        line->common->domain = (uint32_t)number;
    line->option = NULL;
}

/* One whole word; a shell may give --a=ID as three. */
static void take_word(struct line *line, char *word)
{
    const struct argp *argp = line->command ? line->command->argp : &common_argp;
    if (!strncmp(word, "--", 2)) {
        char *value = strchr(word, '=');
        line->option =
            find_option(argp, word + 2, value ? (size_t)(value - word) - 2 : strlen(word) - 2);
        if (line->option && line->option->key == OPTION_LOCAL)
            line->common->local = true;
        if (line->option && !line->option->arg)
            line->option = NULL;
        if (value && line->option)
            take_value(line, value + 1);
    } else if (!strcmp(word, "=")) {
        return;
    } else if (line->option && !(line->option->flags & OPTION_ARG_OPTIONAL)) {
        take_value(line, word);
    } else if (!line->command && !line->help && word[0] != '-') {
        line->help = !strcmp(word, "help");
        line->command = commands_find(word);
    }
}

/* The unfinished word: the value may have begun in it. */
static void take_last(struct line *line, char *word)
{
    char *value = !strncmp(word, "--", 2) ? strchr(word, '=') : NULL;
    line->word = line->before = word;
    if (value) {
        const struct argp *argp = line->command ? line->command->argp : &common_argp;
        line->option = find_option(argp, word + 2, (size_t)(value - word) - 2);
        line->word = value + 1;
        line->before_length = (int)(value + 1 - word);
    } else if (!strcmp(word, "=") && line->option) {
        line->word = word + 1;
    } else if (line->option && (line->option->flags & OPTION_ARG_OPTIONAL)) {
        line->option = NULL;
    }
}

int command_complete(int argc, char **argv, struct common *common)
{
    char nothing[] = "";
    struct line line = {.common = common};
    for (int i = 1; i + 1 < argc; i++)
        take_word(&line, argv[i]);
    take_last(&line, argc > 1 ? argv[argc - 1] : nothing);
    /* a value, an option, or an argument */
    if (line.option) {
        if (line.option->arg)
            offer_values(&line);
    } else if (line.word[0] == '-') {
        offer_options(&line, line.command ? line.command->argp : &common_argp);
        offer_list(&line, built_in);
    } else if (line.command && !line.help) {
        offer_arguments(&line, line.command->argp->args_doc);
    } else if (!line.command) {
        offer_commands(&line);
    }
    return EXIT_ANSWERED;
}
