/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "commands.h"

#include <stdio.h>
#include <string.h>

#include "percuss/similar.h"

const struct command COMMANDS[] = {
    {"query", command_query, &query_argp, "one impact: impulse, restitution and the sub-impacts"},
    {"sweep", command_sweep, &sweep_argp, "the same impact at many speeds"},
    {"ensemble", command_ensemble, &ensemble_argp,
     "many impacts with uncertain inputs: how restitution spreads"},
    {"compare", command_compare, &compare_argp, "measured impacts beside their simulated twins"},
    {"calibrate", command_calibrate, &calibrate_argp,
     "parameters of the bodies from measured impacts"},
    {"export", command_export, &export_argp,
     "the restitution of a pair as parameters of another simulator"},
    {"bodies", command_bodies, &bodies_argp, "the bodies that the server knows"},
    {"dents", command_dents, &dents_argp, "the specimens that the server keeps, with their dents"},
    {"status", command_status, &status_argp, "what the server is doing"},
    {"ping", command_ping, &ping_argp, "round-trip time to the server"},
    {"doctor", command_doctor, &doctor_argp,
     "what keeps a server from answering, and what to do about it"},
    {"schema", command_schema, &schema_argp, "the JSON Schema of requests, replies and outputs"},
    {0},
};

const struct command *commands_find(const char *name)
{
    for (const struct command *command = COMMANDS; command->name; command++)
        if (!strcmp(command->name, name))
            return command;
    return NULL;
}

const struct command *commands_similar(const char *name)
{
    const struct command *nearest = NULL;
    size_t length = strlen(name);
    unsigned best = (unsigned)(length + 1) / 2;
    for (const struct command *command = COMMANDS; command->name; command++) {
        /* an unfinished name is no mistake */
        bool begun = !strncmp(command->name, name, length);
        unsigned distance = begun ? 0 : similar_distance(name, command->name);
        if (distance < best) {
            best = distance;
            nearest = command;
        }
    }
    return nearest;
}

char *commands_list(const char *rest)
{
    char *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return NULL;
    fputs("Commands:\n", stream);
    for (const struct command *command = COMMANDS; command->name; command++)
        fprintf(stream, "  %-9s %s\n", command->name, command->summary);
    fprintf(stream, "\n%s", rest);
    return fclose(stream) == 0 ? text : NULL;
}
