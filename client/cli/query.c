/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss query: one impact. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "ensemble_output.h"
#include "output_file.h"
#include "plot.h"
#include "plot_impact.h"
#include "quantity.h"
#include "reply_csv.h"
#include "reply_json.h"
#include "reply_table.h"
#include "request_json.h"
#include "scene.h"
#include "spread.h"

enum {
    KEY_SPEED = OPTION_OWN,
    KEY_SPEED_SIGMA,
    KEY_REQUEST,
    KEY_SPECIMEN_A,
    KEY_SPECIMEN_B,
    KEY_TRACE,
    KEY_PLOT,
    KEY_MEASURED,
    KEY_CSV
};

struct query {
    struct common *common;
    struct scene scene;
    double speed;       /* NAN: not given */
    double speed_sigma; /* its standard deviation; 0: not given */
    const char *file;
    bool csv;
    const char *trace, *plot;       /* files; NULL: not wanted */
    struct history_motion measured; /* laid over the picture; count 0: nothing */
    const char *specimens[2];       /* of A, B; NULL: not given */
};

static const struct argp_option options[] = {
    {"speed", KEY_SPEED, "V", 0, "speed of A towards B, m/s or with a unit: 0.3, 300mm/s", 10},
    {"speed-sigma", KEY_SPEED_SIGMA, "S", 0,
     "standard deviation of the speed: also tells how the restitution spreads", 10},
    {"specimen-a", KEY_SPECIMEN_A, "NAME", 0,
     "A is this specimen: its dents are kept by the server; percuss dents lists them", 20},
    {"specimen-b", KEY_SPECIMEN_B, "NAME", 0, "the same for B", 20},
    {"request", KEY_REQUEST, "FILE", 0, "ask a whole request in JSON instead; - is standard input",
     30},
    {"trace", KEY_TRACE, "FILE", 0, "write the time histories as comma-separated values", 40},
    {"plot", KEY_PLOT, "FILE", 0,
     "draw motion and contact force over time with gnuplot: FILE.png or FILE.svg", 40},
    {"measured", KEY_MEASURED, "FILE.csv", 0,
     "lay a measured history over the picture: columns time, velocity_a or displacement_a, and "
     "those of b",
     40},
    {"csv", KEY_CSV, NULL, 0,
     "print comma-separated values: a line for each sub-impact, with its contact's restitution",
     90},
    {0},
};

/* Either a scene or a whole request. */
static void check(const struct query *query, struct argp_state *state)
{
    const struct scene *scene = &query->scene;
    bool specimen = query->specimens[0] || query->specimens[1];
    if (query->file &&
        (scene->given || specimen || !isnan(query->speed) || query->speed_sigma > 0.0))
        argp_error(state, "--request says everything; no other flag of the impact goes with it");
    scene_check_single(scene, state);
    if (query->measured.count > 0 && !query->plot)
        argp_error(state, "--measured is laid over a picture: --plot FILE is needed");
    if (query->csv && (query->common->json || query->speed_sigma > 0.0))
        argp_error(state, "--csv or %s, not both",
                   query->common->json ? "--json" : "--speed-sigma");
    if (!query->file && !(scene->a && scene->b && !isnan(query->speed)))
        argp_error(state, "--a ID --b ID --speed V or --request FILE is needed");
}

/* Reads a measured history and lays its first touch on time 0; usage error with the reason. */
static void read_measured(const char *file, struct query *query, struct argp_state *state)
{
    struct history history;
    struct history_impacts impacts;
    struct measured_fault fault = {""};
    bool good = history_read(file, &history, &fault);
    if (good && history_find(&history, &impacts, &fault)) {
        history_motion_free(&query->measured);
        good = history_align(&history, &impacts, &query->measured) ||
               measured_fail(&fault, "%s: out of memory", file);
    } else {
        good = false;
    }
    history_free(&history);
    if (!good)
        argp_error(state, "--measured: %s", fault.text);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct query *query = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &query->scene;
        state->child_inputs[1] = query->common;
        return 0;
    /* the impact */
    case KEY_SPEED:
        query->speed = parse_positive_quantity("speed", text, QUANTITY_SPEED, state);
        return 0;
    case KEY_SPEED_SIGMA:
        query->speed_sigma = parse_positive_quantity("speed-sigma", text, QUANTITY_SPEED, state);
        return 0;
    case KEY_SPECIMEN_A:
    case KEY_SPECIMEN_B:
        if (strlen(text) >= PERCUSS_ID_SIZE)
            argp_error(state, "--specimen: '%s': a name of at most %d bytes is needed", text,
                       PERCUSS_ID_SIZE - 1);
        query->specimens[key - KEY_SPECIMEN_A] = text;
        return 0;
    /* files to read and to write */
    case KEY_REQUEST:
        query->file = text;
        return 0;
    case KEY_TRACE:
        if (strcmp(text, "-") != 0)
            output_file_check("trace", text, state);
        query->trace = text;
        return 0;
    case KEY_CSV:
        query->csv = true;
        return 0;
    case KEY_PLOT:
        plot_check(text, state);
        query->plot = text;
        return 0;
    case KEY_MEASURED:
        read_measured(text, query, state);
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        check(query, state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {
    {&scene_argp, 0, NULL, 0}, {&common_argp, 0, NULL, 0}, {0}};
const struct argp query_argp = {
    .options = options,
    .parser = parse,
    .doc =
        "Asks for one impact: A moves at speed V straight at B, which is at rest, and hits it at "
        "the bodies' default sites; or whatever a JSON request says.\v"
        "Example: percuss query --a steel-sphere --b al-beam --speed 0.3 --at 0.25",
    .children = children,
};

/* Names what is known after the server refused a body. */
static void explain_unknown(const struct query *query, const struct percuss_request *request,
                            struct percuss_client *client)
{
    struct percuss_body_list list;
    if (percuss_bodies(client, common_timeout(query->common), &list) == PERCUSS_RESULT_OK)
        scene_explain_unknown(request, &list);
    percuss_body_list_free(&list);
}

/* The answer, and how it spreads where that was asked for (NULL: not). */
static void print_answer(const struct query *query, const struct percuss_request *request,
                         const struct percuss_reply *reply,
                         const struct percuss_ensemble_reply *spread)
{
    if (query->common->json) {
        json_t *root = reply_to_json(reply);
        if (spread)
            json_object_set_new(root, "spread", ensemble_to_json(spread));
        json_print(root);
        return;
    }
    if (query->csv)
        reply_csv_print(request, reply, query->common->units);
    else
        reply_table_print(request, reply);
    if (spread)
        spread_print(query->speed_sigma, spread);
}

static int ask(const struct query *query, const struct percuss_request *request,
               struct percuss_client *client)
{
    struct percuss_reply reply;
    struct percuss_ensemble_reply spread = {0};
    struct percuss_trace trace = {0};
    double timeout = common_timeout(query->common);
    /* histories only where something is made of them */
    bool traced = query->trace || query->plot;
    enum percuss_result result =
        traced ? percuss_solve_traced(client, request, timeout, &reply, &trace)
               : percuss_solve(client, request, timeout, &reply);
    if (result != PERCUSS_RESULT_OK)
        return complain_result(result);
    /* what the spread of the speed does to the answer */
    bool spreads = query->speed_sigma > 0.0 && reply.contact_count > 0;
    if (spreads)
        result = spread_ask(client, request, query->speed, query->speed_sigma, timeout, &spread);
    print_answer(query, request, &reply, spreads && !result ? &spread : NULL);
    if (reply.status == PERCUSS_UNKNOWN_BODY)
        explain_unknown(query, request, client);
    int code =
        result == PERCUSS_RESULT_OK ? status_exit_code(reply.status) : complain_result(result);
    /* files of the histories */
    int written = EXIT_ANSWERED;
    if (query->trace && trace.contact_count > 0)
        written = write_trace_csv(query->trace, &trace, query->common->units);
    const struct impact_picture picture = {request, &reply, &trace,
                                           query->measured.count > 0 ? &query->measured : NULL};
    if (query->plot && trace.contact_count > 0 && written == EXIT_ANSWERED)
        written = plot_impact(query->plot, &picture);
    if (written != EXIT_ANSWERED)
        code = written;
    percuss_trace_free(&trace);
    percuss_ensemble_reply_free(&spread);
    percuss_reply_free(&reply);
    return code;
}

static int ask_scene(const struct query *query)
{
    struct percuss_client *client;
    struct scene_bodies bodies;
    struct percuss_request request;
    int code = open_client(query->common, NULL, &client);
    if (code != EXIT_ANSWERED)
        return code;
    /* bodies of the catalogue, placed in contact */
    code = scene_find_bodies(&query->scene, query->common, client, &bodies);
    if (code == EXIT_ANSWERED)
        code = scene_request(&query->scene, &bodies, query->speed, &request);
    for (int i = 0; code == EXIT_ANSWERED && i < 2; i++)
        if (query->specimens[i])
            strcpy(request.bodies[i].specimen, query->specimens[i]); /* it fits: it was parsed */
    if (code == EXIT_ANSWERED)
        code = ask(query, &request, client);
    percuss_body_list_free(&bodies.list);
    percuss_client_free(client);
    return code;
}

static int ask_file(const struct query *query)
{
    struct percuss_client *client;
    struct json_fault fault;
    struct json_request *request = malloc(sizeof *request);
    if (!request)
        return complain_memory();
    int code = EXIT_USAGE;
    if (!request_json_load(query->file, request, &fault))
        complain("%s", fault.text);
    else
        code = open_client(query->common, request->has_client ? request->client : NULL, &client);
    if (code == EXIT_ANSWERED) {
        code = ask(query, &request->request, client);
        percuss_client_free(client);
    }
    free(request);
    return code;
}

int command_query(int argc, char **argv, struct common *common)
{
    struct query query = {.common = common, .scene = scene_default(), .speed = NAN};
    argp_parse(&query_argp, argc, argv, 0, NULL, &query);
    int code = query.file ? ask_file(&query) : ask_scene(&query);
    history_motion_free(&query.measured);
    return code;
}
