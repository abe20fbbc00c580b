/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss export: the restitution of a pair as parameters of another simulator. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "engine_text.h"
#include "json_writer.h"
#include "quantity.h"
#include "scene.h"
#include "tally_output.h"

enum { KEY_FOR = OPTION_OWN, KEY_SPEED, KEY_STEP };
enum { POINTS = 9, MOST_POINTS = 1000 };
#define SPEEDS_EXAMPLE "0.05:0.5 or 50mm/s:500mm/s:20"

struct export
{
    struct common *common;
    struct scene scene;
    const struct engine *engine;
    double low, high, step; /* m/s; s, 0: any */
    size_t count;           /* 0: no --speed */
    struct tally warnings;
    double mass; /* effective, kg */
    struct scene_text text;
    struct engine_point points[MOST_POINTS];
};

static const struct argp_option options[] = {
    {"for", KEY_FOR, "PROGRAM", 0, "mujoco, bullet, chrono, drake, dem (LAMMPS) or abaqus", 10},
    {"speed", KEY_SPEED, "LO:HI", 0,
     "the speeds of the impacts to come, m/s or with units; LO:HI:N: by N answers, else by 9, with "
     "equal ratios of the speed",
     10},
    {"step", KEY_STEP, "H", 0,
     "time step of that program, s or with a unit: the contact lasts 50 of them at least, which "
     "makes it "
     "softer, but not its restitution",
     10},
    {0},
};

static void parse_speeds(const char *text, struct export *export, struct argp_state *state)
{
    double numbers[2];
    struct quantity_fault fault = {""};
    const char *first = strchr(text, ':'), *second = first ? strchr(first + 1, ':') : NULL;
    if (!first ||
        !quantity_read(text, (size_t)(first - text), QUANTITY_SPEED, &numbers[0], &fault) ||
        !quantity_read(first + 1, second ? (size_t)(second - first) - 1 : strlen(first + 1),
                       QUANTITY_SPEED, &numbers[1], &fault))
        argp_error(state, "--speed: '%s' is not LO:HI, for example %s%s%s", text, SPEEDS_EXAMPLE,
                   *fault.text ? ": " : "", fault.text);
    if (!(numbers[0] > 0.0) || !(numbers[1] >= numbers[0]))
        argp_error(state, "--speed: '%s': 0 < LO <= HI is needed, here %g to %g m/s", text,
                   numbers[0], numbers[1]);
    export->low = numbers[0];
    export->high = numbers[1];
    export->count = second ? parse_count("speed", second + 1, MOST_POINTS, state) : POINTS;
    if (export->count < 2)
        argp_error(state, "--speed: '%s': N of 2..%d is needed", text, MOST_POINTS);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct export *export = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &export->scene;
        state->child_inputs[1] = export->common;
        return 0;
    case KEY_FOR:
        export->engine = engine_find(text);
        if (!export->engine)
            argp_error(state, "--for: '%s': " ENGINE_NAMES " is allowed", text);
        return 0;
    case KEY_SPEED:
        parse_speeds(text, export, state);
        return 0;
    case KEY_STEP:
        export->step = parse_positive_quantity("step", text, QUANTITY_TIME, state);
        return 0;
    /* all are read */
    case ARGP_KEY_END: {
        const struct scene_need others[] = {{"--for PROGRAM", export->engine},
                                            {"--speed LO:HI", export->count > 0}};
        scene_check_single(&export->scene, state);
        scene_check_given(&export->scene, others, 2, "", state);
        return 0;
    }
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {
    {&scene_argp, 0, NULL, 0}, {&common_argp, 0, NULL, 0}, {0}};
const struct argp export_argp = {
    .options = options,
    .parser = parse,
    .doc =
        "Prints the parameters with which another simulator's contact comes nearest to the "
        "restitution of a pair over a range of speeds, as that program reads them, and how far it "
        "stays from it.\v"
        "Example: percuss export --for mujoco --a steel-sphere --b al-rod-1 --speed 0.05:0.5 "
        "--step "
        "0.1ms",
    .children = children,
};

/* The sub-impact that gives most of the impulse; NULL: none. */
static const struct percuss_sub_impact *
main_sub_impact(const struct percuss_contact_result *contact)
{
    const struct percuss_sub_impact *main = NULL;
    for (uint32_t i = 0; i < contact->sub_impacts_listed; i++)
        if (!main || contact->sub_impacts[i].impulse > main->impulse)
            main = &contact->sub_impacts[i];
    return main;
}

/* Of one speed. Exit code; complains. */
static int take_point(struct export *export, double speed, const struct percuss_reply *reply)
{
    char place[64];
    int code = status_exit_code(reply->status);
    if (code > EXIT_ANSWERED_WITH_WARNING || reply->contact_count != 1) {
        complain("at %g m/s: %s: %s", speed, percuss_status_name(reply->status), reply->message);
        return code > EXIT_ANSWERED_WITH_WARNING ? code : EXIT_REJECTED;
    }
    if (!reply->complete) {
        complain("at %g m/s: the restitution is not final: %s", speed, reply->message);
        return EXIT_REJECTED;
    }
    const struct percuss_contact_result *contact = &reply->contacts[0];
    const struct percuss_sub_impact *main = main_sub_impact(contact);
    if (!main) {
        complain("at %g m/s: there is no sub-impact", speed);
        return EXIT_REJECTED;
    }
    snprintf(place, sizeof place, "at %g m/s", speed);
    if (!tally_take(&export->warnings, reply, place))
        return complain_memory();
    size_t i = export->warnings.asked - 1;
    export->points[i] = (struct engine_point){.speed = speed,
                                              .restitution = contact->restitution,
                                              .error = reply->error.restitution_total,
                                              .duration = main->end - main->start};
    export->mass = 1.0 / contact->inverse_effective_mass;
    return EXIT_ANSWERED;
}

/* The answers at all speeds. Exit code; complains. */
static int ask_all(struct export *export, struct percuss_client *client)
{
    struct scene_bodies bodies;
    const struct common *common = export->common;
    int code = scene_find_bodies(&export->scene, common, client, &bodies);
    for (size_t i = 0; code == EXIT_ANSWERED && i < export->count; i++) {
        double share = export->count > 1 ? (double)i / (double)(export->count - 1) : 0.0;
        double speed = i > 0 && i + 1 == export->count
                           ? export->high
                           : export->low * pow(export->high / export->low, share);
        struct percuss_request request;
        struct percuss_reply reply;
        code = scene_request(&export->scene, &bodies, speed, &request);
        if (code == EXIT_ANSWERED)
            code = complain_result(percuss_solve(client, &request, common_timeout(common), &reply));
        if (code != EXIT_ANSWERED)
            break;
        code = take_point(export, speed, &reply);
        if (reply.status == PERCUSS_UNKNOWN_BODY)
            scene_explain_unknown(common, client, &request, &bodies.list);
        percuss_reply_free(&reply);
    }
    if (code == EXIT_ANSWERED)
        export->text = scene_describe(&export->scene, &bodies);
    percuss_body_list_free(&bodies.list);
    return code;
}

static void print_json(const struct export *export, const struct engine_fit *fit)
{
    json_t *root = json_object(), *points = json_array();
    for (size_t i = 0; i < export->count; i++) {
        const struct engine_point *point = &export->points[i];
        json_array_append_new(points, json_pack("{sososososo}", "speed", json_number(point->speed),
                                                "restitution", json_number(point->restitution),
                                                "error_total", json_number(point->error),
                                                "duration", json_number(point->duration), "model",
                                                json_number(point->model)));
    }
    bool constant = export->engine->law == ENGINE_CONSTANT;
    json_object_set_new(root, "for", json_string(export->engine->name));
    json_object_set_new(root, "points", points);
    json_object_set_new(root, "worst", json_number(fit->worst));
    json_object_set_new(root, "mass", json_number(fit->mass));
    json_object_set_new(root, "duration", json_number(fit->duration));
    json_object_set_new(root, "step", json_number(fit->step));
    json_object_set_new(root, "restitution", json_number(constant ? fit->restitution : NAN));
    json_object_set_new(root, "stiffness", json_number(fit->stiffness));
    json_object_set_new(root, "damping", json_number(constant ? fit->damping : NAN));
    json_object_set_new(root, "dissipation", json_number(constant ? NAN : fit->dissipation));
    json_object_set_new(root, "warnings", tally_to_json(&export->warnings));
    json_print(root);
}

/* Exit code; complains. */
static int put_out(struct export *export)
{
    struct engine_fit fit =
        engine_fit(export->engine->law, export->points, export->count, export->mass, export->step);
    if (export->engine->law == ENGINE_CONSTANT && !(fit.restitution > 0.0)) {
        complain("the restitution is %.3g in the middle of its range: no spring with a damper has "
                 "that",
                 fit.restitution);
        return EXIT_REJECTED;
    }
    const struct engine_case engine_case = {export->text.bodies, PERCUSS_VERSION, export->step,
                                            export->points, export->count};
    if (export->common->json) {
        print_json(export, &fit);
    } else {
        engine_print(stdout, export->engine, &engine_case, &fit);
        tally_complain(&export->warnings);
    }
    return EXIT_ANSWERED;
}

int command_export(int argc, char **argv, struct common *common)
{
    static struct export export;
    struct percuss_client *client;
    export =
        (struct export){.common = common, .scene = scene_straight(), .warnings.unit = "answers"};
    argp_parse(&export_argp, argc, argv, 0, NULL, &export);
    int code = open_client(common, NULL, &client);
    if (code != EXIT_ANSWERED)
        return code;
    code = ask_all(&export, client);
    if (code == EXIT_ANSWERED)
        code = put_out(&export);
    tally_clear(&export.warnings);
    percuss_client_free(client);
    return code;
}
