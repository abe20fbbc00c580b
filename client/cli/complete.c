/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss complete: the ways to go on with a command line, for the shells. */
#include <ctype.h>
#include <math.h>
#include <percuss/specimen.h>
#include <stdio.h>
#include <string.h>

#include "column.h"
#include "complete_line.h"
#include "domains.h"
#include "engine_text.h"

/* The values of an option. */

/* s for a server to appear and to answer: longer waits disturb typing, and on one host it takes 0.1
 * s */
static const double PATIENCE = 0.5;

/* How much of a server's id is offered: as much as messages show of it. */
enum { SERVER_DIGITS = 8, NAME_SIZE = 2 * PERCUSS_ID_SIZE + 32 };

/* Options with named values. */
static const struct {
    const char *option;
    const char *(*name_of)(unsigned);
    unsigned count;
} choices[] = {
    {"contact-model", percuss_contact_model_name, PERCUSS_CONTACT_COUNT},
    {"method", percuss_method_name, PERCUSS_METHOD_COUNT},
    {"compliance", percuss_compliance_name, PERCUSS_COMPLIANCE_COUNT},
    {"friction-law", percuss_friction_name, PERCUSS_FRICTION_COUNT},
    {"sampling", percuss_sampling_name, PERCUSS_SAMPLING_COUNT},
    {"for", engine_name, ENGINE_COUNT},
};

/* A client that is connected; NULL: none is at once. */
static struct percuss_client *reach(const struct line *line)
{
    struct percuss_client *client;
    if (make_client(line->common, NULL, &client) == EXIT_ANSWERED &&
        percuss_client_connect(client, PATIENCE) == PERCUSS_RESULT_OK)
        return client;
    percuss_client_free(client);
    return NULL;
}

typedef void offer_function(const struct line *line, const struct percuss_body *body);

/* Offers something of each body of the catalogue, or of those that the line names alone. */
static void offer_of_bodies(const struct line *line, bool named, offer_function *offer)
{
    struct percuss_body_list list = {0};
    struct percuss_client *client = reach(line);
    if (client && percuss_bodies(client, PATIENCE, &list) == PERCUSS_RESULT_OK)
        for (size_t i = 0; i < list.count; i++) {
            const char *id = list.bodies[i].id;
            bool given = (line->bodies[0] && !strcmp(id, line->bodies[0])) ||
                         (line->bodies[1] && !strcmp(id, line->bodies[1]));
            if (given || !named)
                offer(line, &list.bodies[i]);
        }
    percuss_body_list_free(&list);
    percuss_client_free(client);
}

static void offer_id(const struct line *line, const struct percuss_body *body)
{
    line_offer(line, body->id, body->description);
}

/* Places on A for --at-a, on B for --at-b. */
static void offer_sites(const struct line *line, const struct percuss_body *body)
{
    const char *id = line->bodies[strcmp(line->option->name, "at-a") != 0];
    for (size_t i = 0; id && !strcmp(id, body->id) && i < body->site_count; i++)
        line_offer(line, body->sites[i].name, body->id);
}

/* "young:al-beam" for --fit, with the catalogue's value. */
static void offer_parameters(const struct line *line, const struct percuss_body *body)
{
    char text[NAME_SIZE], value[32];
    for (unsigned p = 0; p < PERCUSS_PARAMETER_COUNT; p++) {
        /* nothing to start from: it has none, or stays elastic */
        if (!isfinite(body->parameters[p]))
            continue;
        snprintf(text, sizeof text, "%s:%s", percuss_parameter_name(p), body->id);
        snprintf(value, sizeof value, "%g", body->parameters[p]);
        line_offer(line, text, value);
    }
}

/* "young@al-beam=" for --input. */
static void offer_inputs(const struct line *line, const struct percuss_body *body)
{
    char text[NAME_SIZE], value[32];
    for (unsigned p = 0; p < PERCUSS_PARAMETER_COUNT; p++) {
        /* work-hardening is never uncertain */
        if (!isfinite(body->parameters[p]) || p == PERCUSS_PARAMETER_TANGENT)
            continue;
        snprintf(text, sizeof text, "%s@%s=", percuss_parameter_name(p), body->id);
        snprintf(value, sizeof value, "%g", body->parameters[p]);
        line_offer(line, text, value);
    }
    snprintf(text, sizeof text, "site@%s=", body->id);
    if (!strcmp(body->shape, "beam"))
        line_offer(line, text, "place along it, 0..1");
}

static void offer_specimens(const struct line *line)
{
    struct percuss_specimen_list list = {0};
    struct percuss_client *client = reach(line);
    if (client && percuss_specimens(client, PATIENCE, &list) == PERCUSS_RESULT_OK)
        for (size_t i = 0; i < list.count; i++)
            line_offer(line, list.specimens[i].name, list.specimens[i].body);
    percuss_specimen_list_free(&list);
    percuss_client_free(client);
}

/* Those that announce themselves. */
static void offer_servers(const struct line *line)
{
    struct percuss_client *client;
    struct percuss_server_list list = {0};
    line_offer(line, PERCUSS_LEAST_LOADED, "the one with least to do");
    if (line->common->local || make_client(line->common, NULL, &client) != EXIT_ANSWERED)
        return;
    if (percuss_servers(client, PATIENCE, &list) == PERCUSS_RESULT_OK)
        for (size_t i = 0; i < list.count; i++) {
            const struct percuss_server *server = &list.servers[i];
            char id[33], what[128];
            format_hex(server->server, id);
            if (strlen(line->word) <= SERVER_DIGITS)
                id[SERVER_DIGITS] = '\0';
            snprintf(what, sizeof what, "process %u on %s, %s", server->process, server->host,
                     server->state);
            line_offer(line, id, what);
        }
    percuss_server_list_free(&list);
    percuss_client_free(client);
}

static void offer_domains(const struct line *line)
{
    unsigned domains[DOMAINS_MOST];
    char text[16];
    struct common common = *line->common;
    common.domain = UINT32_MAX; /* all others are of interest */
    size_t count = domains_with_server(&common, domains);
    for (size_t i = 0; i < count; i++) {
        snprintf(text, sizeof text, "%u", domains[i]);
        line_offer(line, text, "has a server");
    }
}

/* NAME= of those that a file of measurements may have. */
static void offer_columns(const struct line *line)
{
    char text[HEADING_SIZE];
    puts(":nospace");
    for (int i = 0; i < IMPACT_COLUMNS + HISTORY_COLUMNS; i++) {
        bool impact = i < IMPACT_COLUMNS;
        const struct column_kind *kind =
            impact ? &IMPACT_KINDS[i] : &HISTORY_KINDS[i - IMPACT_COLUMNS];
        snprintf(text, sizeof text, "%s=", kind->name);
        line_offer(line, text, impact ? "of a file of impacts" : "of a file of histories");
    }
}

/* Offers the values of the line's option: names that are fixed, files, and names that the line's
 * server or this process knows; without those where no server answers at once. */
static void complete_values(const struct line *line)
{
    const char *name = line->option->name, *kind = line->option->arg;
    /* names that are fixed */
    for (size_t i = 0; i < sizeof choices / sizeof choices[0]; i++)
        for (unsigned k = 0; !strcmp(choices[i].option, name) && k < choices[i].count; k++)
            line_offer(line, choices[i].name_of(k), NULL);
    /* names of the catalogue */
    bool named = line->bodies[0] || line->bodies[1];
    if (!strcmp(name, "a") || !strcmp(name, "b"))
        offer_of_bodies(line, false, offer_id);
    else if (!strcmp(name, "at-a") || !strcmp(name, "at-b"))
        offer_of_bodies(line, true, offer_sites);
    else if (!strcmp(name, "at")) {
        line_offer(line, "middle", "half-way along a beam");
        line_offer(line, "tip", "the free end of a beam that is held at the other");
        line_offer(line, "root", "the end at which it is held");
    } else if (!strcmp(name, "fit"))
        offer_of_bodies(line, named, offer_parameters);
    else if (!strcmp(name, "input")) {
        puts(":nospace");
        line_offer(line, "direction=", "of the approach, radians from the normal");
        offer_of_bodies(line, named, offer_inputs);
    } else if (!strcmp(name, "column"))
        offer_columns(line);
    /* servers, and specimens */
    if (!strcmp(name, "server"))
        offer_servers(line);
    else if (!strcmp(name, "domain"))
        offer_domains(line);
    else if (!strncmp(name, "specimen", 8))
        offer_specimens(line);
    else if (!strncmp(kind, "FILE", 4) || !strcmp(kind, "DIR"))
        puts(":files");
}

/* The options that argp adds to every command. */
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

/* The words of "request|reply"; capitals stand for a file of the user. */
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

/* The ways to go on behind an unfinished command line, for the shells. argv[1] and on: the words
 * behind the program's name, the last one unfinished, maybe empty. Prints a line for each, its
 * meaning behind a tab; or ":files" where a file is to be named. */
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
