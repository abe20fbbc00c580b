/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss dents: the server's specimens. */

#include <percuss/specimen.h>
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "json_writer.h"

enum { KEY_SPECIMEN = OPTION_OWN, KEY_CLEAR };

struct dents {
    struct common *common;
    const char *specimen; /* NULL: all */
    bool clear;
};

static const struct argp_option options[] = {
    {"specimen", KEY_SPECIMEN, "NAME", 0, "only this one", 10},
    {"clear", KEY_CLEAR, NULL, 0, "forget it, its dents and which body it is", 10},
    {0},
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct dents *dents = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        state->child_inputs[0] = dents->common;
        return 0;
    /* the specimen, and the action on its dents */
    case KEY_SPECIMEN:
        dents->specimen = text;
        return 0;
    case KEY_CLEAR:
        dents->clear = true;
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        if (dents->clear && !dents->specimen)
            argp_error(state, "--clear needs --specimen NAME: what is to be forgotten");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
const struct argp dents_argp = {
    .options = options,
    .parser = parse,
    .doc = "Lists the specimens that the server keeps with their dents, or forgets one.\v"
           "A specimen comes into being with the first request that names it: "
           "percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --specimen-b bar-1",
    .children = children,
};

JSON_TABLE(dent, PERCUSS_DENT_FIELDS)

static json_t *specimen_json(const struct percuss_specimen *specimen)
{
    json_t *object = json_object(), *patches = json_array();
    json_object_set_new(object, "specimen", json_string(specimen->name));
    json_object_set_new(object, "body", json_string(specimen->body));
    json_object_set_new(object, "impacts", json_integer((json_int_t)specimen->impacts));
    for (size_t i = 0; i < specimen->dent_count; i++)
        json_array_append_new(patches, json_object_of(dent_members(), &specimen->dents[i]));
    json_object_set_new(object, "patches", patches);
    return object;
}

static void print_specimen(const struct percuss_specimen *specimen)
{
    printf("%s  %s, %llu impacts, %zu dents\n", specimen->name, specimen->body,
           (unsigned long long)specimen->impacts, specimen->dent_count);
    if (specimen->dent_count == 0)
        return;
    printf("  %11s %11s %11s %10s %10s %10s\n", "x/mm", "y/mm", "z/mm", "radius/um", "depth/um",
           "peak/N");
    for (size_t i = 0; i < specimen->dent_count; i++) {
        const struct percuss_dent *dent = &specimen->dents[i];
        printf("  %11.4f %11.4f %11.4f %10.2f %10.4f %10.2f\n", 1e3 * dent->point[0],
               1e3 * dent->point[1], 1e3 * dent->point[2], 1e6 * dent->size,
               1e6 * dent->residual_indentation, dent->max_force);
    }
}

/* EXIT_REJECTED: the one that was asked for is not there. */
static int print_list(const struct dents *dents, const struct percuss_specimen_list *list)
{
    json_t *root = json_object(), *array = json_array();
    json_object_set_new(root, "specimens", array);
    int code = dents->specimen ? EXIT_REJECTED : EXIT_ANSWERED;
    /* all of them, or the one that was asked for */
    for (size_t i = 0; i < list->count; i++) {
        const struct percuss_specimen *specimen = &list->specimens[i];
        if (dents->specimen && strcmp(specimen->name, dents->specimen) != 0)
            continue;
        code = EXIT_ANSWERED;
        if (dents->common->json)
            json_array_append_new(array, specimen_json(specimen));
        else
            print_specimen(specimen);
    }
    if (dents->common->json)
        json_print(root);
    else
        json_decref(root);
    /* nothing to list */
    if (code == EXIT_REJECTED)
        complain("'%s': the server keeps no specimen of that name", dents->specimen);
    else if (list->count == 0)
        complain("the server keeps no specimens: no request has named one, or its settings name no "
                 "store");
    return code;
}

static int show_or_clear(const struct dents *dents, struct percuss_client *client)
{
    struct percuss_specimen_list list;
    double timeout = common_timeout(dents->common);
    enum percuss_result result = percuss_specimens(client, timeout, &list);
    if (result != PERCUSS_RESULT_OK)
        return complain_result(result);
    int code = print_list(dents, &list);
    percuss_specimen_list_free(&list);
    if (code != EXIT_ANSWERED || !dents->clear)
        return code;
    result = percuss_clear_specimen(client, dents->specimen, timeout);
    if (result != PERCUSS_RESULT_OK)
        return complain_result(result);
    complain("'%s': forgotten", dents->specimen);
    return EXIT_ANSWERED;
}

int command_dents(int argc, char **argv, struct common *common)
{
    struct percuss_client *client;
    struct dents dents = {.common = common};
    argp_parse(&dents_argp, argc, argv, 0, NULL, &dents);
    int code = open_onlooker(common, &client);
    if (code != EXIT_ANSWERED)
        return code;
    code = show_or_clear(&dents, client);
    percuss_client_free(client);
    return code;
}
