/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss ping: the time from a request to its answer when nothing is solved. */

#include <math.h>
#include <stdio.h>

#include "cli.h"
#include "json_writer.h"

enum { KEY_COUNT = OPTION_OWN, DEFAULT_COUNT = 10, MOST_PINGS = 1000000 };

struct ping {
    struct common *common;
    unsigned count;
};

static const struct argp_option options[] = {
    {"count", KEY_COUNT, "N", 0, "pings to send, one after the other (default 10)", 10},
    {0},
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct ping *ping = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = ping->common;
        return 0;
    case KEY_COUNT:
        ping->count = parse_count("count", text, MOST_PINGS, state);
        if (ping->count == 0)
            argp_error(state, "--count: at least 1 is needed");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
const struct argp ping_argp = {
    .options = options,
    .parser = parse,
    .doc = "Measures the round-trip time to the server.",
    .children = children,
};

/* Shortest, mean and longest round trip, s. */
struct round_trips {
    double shortest, mean, longest;
};

static enum percuss_result measure(struct percuss_client *client, const struct ping *ping,
                                   struct round_trips *trips)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    *trips = (struct round_trips){.shortest = INFINITY};
    for (unsigned i = 0; i < ping->count && result == PERCUSS_RESULT_OK; i++) {
        double trip = 0.0;
        result = percuss_ping(client, common_timeout(ping->common), &trip);
        trips->shortest = fmin(trips->shortest, trip);
        trips->longest = fmax(trips->longest, trip);
        trips->mean += trip / ping->count;
    }
    return result;
}

static void print(const struct ping *ping, const struct round_trips *trips)
{
    if (!ping->common->json) {
        printf("%u pings: shortest %.1f us, mean %.1f us, longest %.1f us\n", ping->count,
               1e6 * trips->shortest, 1e6 * trips->mean, 1e6 * trips->longest);
        return;
    }
    json_t *root = json_object();
    json_object_set_new(root, "count", json_integer(ping->count));
    json_object_set_new(root, "shortest", json_number(trips->shortest));
    json_object_set_new(root, "mean", json_number(trips->mean));
    json_object_set_new(root, "longest", json_number(trips->longest));
    json_print(root);
}

int command_ping(int argc, char **argv, struct common *common)
{
    struct percuss_client *client;
    struct round_trips trips;
    struct ping ping = {common, DEFAULT_COUNT};
    argp_parse(&ping_argp, argc, argv, 0, NULL, &ping);
    int code = open_client(common, NULL, &client);
    if (code != EXIT_ANSWERED)
        return code;
    enum percuss_result result = measure(client, &ping, &trips);
    if (result == PERCUSS_RESULT_OK)
        print(&ping, &trips);
    else
        code = complain_result(result);
    percuss_client_free(client);
    return code;
}
