/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss schema: what JSON the program reads and prints. */

#include <string.h>

#include "cli.h"
#include "ensemble_output.h"
#include "reply_json.h"
#include "request_json.h"
#include "schema_outputs.h"

struct kind {
    const char *name;
    json_t *(*schema)(void);
};

static const struct kind kinds[] = {
    {"request", request_schema}, {"reply", reply_schema},     {"ensemble", ensemble_schema},
    {"sweep", sweep_schema},     {"compare", compare_schema}, {"calibrate", calibrate_schema},
    {"bodies", bodies_schema},   {"remarks", remarks_schema}, {"dents", dents_schema},
    {"status", status_schema},   {"ping", ping_schema},       {"query", query_schema},
};
#define KIND_NAMES                                                                                 \
    "request, reply, ensemble, sweep, compare, calibrate, bodies, remarks, dents, status, ping, "  \
    "query"

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
            argp_error(state, "'%s': one of " KIND_NAMES " is allowed", text);
        return 0;
    case ARGP_KEY_NO_ARGS:
        argp_error(state, "one of " KIND_NAMES " is needed");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
const struct argp schema_argp = {
    .parser = parse,
    .args_doc = "request|reply|ensemble|sweep|compare|calibrate|bodies|remarks|dents|status|ping|"
                "query",
    .doc = "Prints the JSON Schema of the requests that 'query --request' reads, of the replies "
           "that 'query --json' prints (query: of several), of what another command prints with "
           "--json, or of the remarks of "
           "'bodies --check --json'; asks no server.",
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
