/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss schema: what JSON the program reads and prints. */

#include <string.h>

#include "cli.h"
#include "ensemble_output.h"
#include "reply_json.h"
#include "request_json.h"

struct kind {
    const char *name;
    json_t *(*schema)(void);
};

static const struct kind kinds[] = {
    {"request", request_schema}, {"reply", reply_schema}, {"ensemble", ensemble_schema}};

struct choice {
    struct common *common;
    const struct kind *kind;
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct choice *choice = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        state->child_inputs[0] = choice->common;
        return 0;
    /* of what: the first argument alone */
    case ARGP_KEY_ARG:
        for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
            if (!choice->kind && !strcmp(kinds[i].name, text))
                choice->kind = &kinds[i];
        if (!choice->kind || state->arg_num > 0)
            argp_error(state, "'%s': one of request, reply, ensemble is allowed", text);
        return 0;
    case ARGP_KEY_NO_ARGS:
        argp_error(state, "one of request, reply, ensemble is needed");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
static const struct argp schema_argp = {
    .parser = parse,
    .args_doc = "request|reply|ensemble",
    .doc = "Prints the JSON Schema of the requests that 'query --request' reads, of the replies "
           "that 'query --json' prints, or of the reports of 'ensemble --json'; asks no server.",
    .children = children,
};

int command_schema(int argc, char **argv, struct common *common)
{
    struct choice choice = {common, NULL};
    argp_parse(&schema_argp, argc, argv, 0, NULL, &choice);
    json_t *schema = choice.kind->schema();
    json_t *root = json_pack("{ssss}", "$schema", "https://json-schema.org/draft/2020-12/schema",
                             "title", choice.kind->name);
    json_object_update(root, schema);
    json_decref(schema);
    json_print(root);
    return EXIT_ANSWERED;
}
