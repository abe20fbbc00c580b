/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss calibrate: parameters of the bodies from measured impacts. */

#include <jansson.h>
#include <math.h>
#include <percuss/percuss.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "fitting.h"
#include "input_text.h"
#include "json_writer.h"
#include "measured_file.h"
#include "percuss/similar.h"
#include "quantity.h"
#include "tally_output.h"
#include "twins.h"
#include "waiting.h"

/* The results of a calibration. */

struct calibrate_report {
    const struct calibrate_parameter *parameters;
    size_t count;
    const struct calibration *calibration;
    size_t impacts;
    const struct tally *warnings; /* of the twins with the calibrated values */
    const struct measured_set *set;
};

/* Parameters more alike than this can stand in for each other. */
static const double ALIKE = 0.95;
/* Some second sub-impacts are always near a jump; more than this share tell of another fault. */
static const double MANY = 0.5;

static void name_parameter(const struct calibrate_parameter *parameter, char name[128])
{
    snprintf(name, 128, "%s of %s", percuss_parameter_name(parameter->parameter), parameter->body);
}

static void calibrate_print_table(const struct calibrate_report *report)
{
    const struct calibration *calibration = report->calibration;
    char name[128];
    /* the values, and how well they are determined */
    printf("%-36s %12s %12s   %-28s\n", "parameter", "start", "value", "95 % interval");
    for (size_t i = 0; i < report->count; i++) {
        const struct calibrate_parameter *parameter = &report->parameters[i];
        name_parameter(parameter, name);
        printf("%-36s %12.6g %12.6g   ", name, parameter->start, parameter->value);
        if (isinf(parameter->half_width))
            puts("unbounded");
        else
            printf("%.6g to %.6g (+- %.2g %%)%s\n", parameter->value - parameter->half_width,
                   parameter->value + parameter->half_width,
                   100.0 * parameter->half_width / fabs(parameter->value),
                   fitting_determines(parameter) ? "" : " not determined");
    }
    /* the readings that they rest on */
    printf("\nfitted to %zu impacts:\n", report->impacts);
    for (int q = 0; q < QUANTITIES; q++)
        if (calibration->known[q] > 0)
            printf("  %-34s %4zu of %zu readings used, scatter %.2g %%\n", quantity_name(q),
                   calibration->used[q], calibration->known[q], 100.0 * calibration->noise[q]);
}

static json_t *quantities_to_json(const struct calibration *calibration)
{
    json_t *array = json_array();
    for (int q = 0; q < QUANTITIES; q++) {
        json_t *object = json_object();
        json_object_set_new(object, "quantity", json_string(quantity_name(q)));
        json_object_set_new(object, "known", json_integer((json_int_t)calibration->known[q]));
        json_object_set_new(object, "used", json_integer((json_int_t)calibration->used[q]));
        json_object_set_new(object, "scatter", json_number(calibration->noise[q]));
        json_array_append_new(array, object);
    }
    return array;
}

static void calibrate_print_json(const struct calibrate_report *report)
{
    const struct fit *fit = &report->calibration->fit;
    json_t *root = json_object(), *array = json_array(), *correlation = json_array();
    /* parameter by parameter, with its row of correlations */
    for (size_t i = 0; i < report->count; i++) {
        const struct calibrate_parameter *parameter = &report->parameters[i];
        json_t *object = json_object(), *row = json_array();
        json_object_set_new(object, "parameter",
                            json_string(percuss_parameter_name(parameter->parameter)));
        json_object_set_new(object, "body", json_string(parameter->body));
        json_object_set_new(object, "start", json_number(parameter->start));
        json_object_set_new(object, "value", json_number(parameter->value));
        json_object_set_new(object, "low", json_number(parameter->value - parameter->half_width));
        json_object_set_new(object, "high", json_number(parameter->value + parameter->half_width));
        json_object_set_new(object, "determined", json_boolean(fitting_determines(parameter)));
        json_array_append_new(array, object);
        for (size_t j = 0; j < report->count; j++)
            json_array_append_new(row, json_number(fit->correlation[i][j]));
        json_array_append_new(correlation, row);
    }
    /* with the readings that they rest on */
    json_object_set_new(root, "parameters", array);
    json_object_set_new(root, "correlation", correlation);
    json_object_set_new(root, "quantities", quantities_to_json(report->calibration));
    json_object_set_new(root, "impacts", json_integer((json_int_t)report->impacts));
    json_object_set_new(root, "freedom", json_number(fit->freedom));
    json_object_set_new(root, "left_out", measured_file_left_to_json(report->set));
    json_object_set_new(root, "warnings", tally_to_json(report->warnings));
    json_print(root);
}

/* Names on stderr the parameters that the data do not determine; returns whether there are any. */
static bool calibrate_warn(const struct calibrate_report *report)
{
    const struct calibration *calibration = report->calibration;
    char name[128], other[128];
    bool warned = false;
    /* parameters that cannot be told, or not from each other */
    for (size_t i = 0; i < report->count; i++) {
        name_parameter(&report->parameters[i], name);
        if (!fitting_determines(&report->parameters[i])) {
            complain("these data do not determine the %s: leave it at a known value", name);
            warned = true;
        }
        for (size_t j = 0; j < i; j++) {
            if (!(fabs(calibration->fit.correlation[i][j]) > ALIKE))
                continue;
            name_parameter(&report->parameters[j], other);
            complain("these data hardly tell the %s from the %s (correlation %.3f): fit one only",
                     name, other, calibration->fit.correlation[i][j]);
            warned = true;
        }
    }
    /* quantities of which most readings were of no use */
    for (int q = 0; q < QUANTITIES; q++) {
        size_t left = calibration->known[q] - calibration->used[q];
        if ((double)left <= MANY * (double)calibration->known[q])
            continue;
        complain("%s: %zu of %zu readings are no smooth function of the parameters, or off by more "
                 "than four standard deviations, and were left out",
                 quantity_name(q), left, calibration->known[q]);
        warned = true;
    }
    return warned;
}

enum { KEY_FIT = OPTION_OWN, KEY_NOISE };

struct calibrate {
    struct common *common;
    struct scene scene;
    const char *file;
    struct column_map columns;
    struct calibrate_parameter parameters[FIT_PARAMETERS];
    size_t count;
    double noise;
};

static const struct argp_option options[] = {
    {"fit", KEY_FIT, "PARAMETER:ID[=START]", 0,
     "what to calibrate: young, poisson, density, yield, tangent, damping, radius or scale of a "
     "body; may "
     "be given several times. START, in SI units or with its own: the catalogue's value unless "
     "given",
     30},
    {"noise", KEY_NOISE, "R", 0,
     "relative standard deviation of the measured numbers to start with (default 0.01)", 30},
    {0},
};

static unsigned parse_parameter(const char *text, size_t length, struct argp_state *state)
{
    char name[PERCUSS_ID_SIZE];
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    struct similar similar = similar_to(name);
    for (unsigned i = 0; i < PERCUSS_PARAMETER_COUNT; i++) {
        const char *known = percuss_parameter_name(i);
        if (!strcmp(known, name))
            return i;
        similar_offer(&similar, known);
    }
    argp_error(state,
               "--fit: '%s': PARAMETER:ID[=START] is needed with young, poisson, density, yield, "
               "tangent, damping, radius or scale%s%s%s",
               text, similar.nearest ? ": did you mean '" : "",
               similar.nearest ? similar.nearest : "", similar.nearest ? "'?" : "");
    return 0;
}

/* A number of that parameter: "70 GPa" of young. */
static double parse_start(const char *text, const char *start, unsigned parameter,
                          struct argp_state *state)
{
    struct quantity_fault fault;
    double number;
    enum quantity quantity = quantity_of(percuss_parameter_name(parameter));
    if (!quantity_read(start, strlen(start), quantity, &number, &fault))
        argp_error(state, "--fit: '%s': START: %s", text, fault.text);
    return number;
}

static void parse_fit(const char *text, struct calibrate *calibrate, struct argp_state *state)
{
    const char *colon = input_text_owner(text), *equals = strchr(text, '=');
    if (calibrate->count == FIT_PARAMETERS)
        argp_error(state, "--fit: up to %d parameters are allowed", FIT_PARAMETERS);
    /* PARAMETER */
    struct calibrate_parameter *parameter = &calibrate->parameters[calibrate->count++];
    size_t length = colon ? (size_t)(colon - text) : strcspn(text, "=");
    *parameter = (struct calibrate_parameter){.parameter = parse_parameter(text, length, state),
                                              .start = NAN};
    if (!colon)
        argp_error(state, "--fit: '%s': a body is needed: %.*s:ID", text, (int)length, text);
    /* :ID, and =START if it is given */
    size_t id = equals ? (size_t)(equals - colon) - 1 : strlen(colon + 1);
    if (id == 0 || id >= sizeof parameter->body)
        argp_error(state, "--fit: '%s': the id of a body is needed behind the %s", text,
                   *colon == ':' ? "colon" : "@");
    snprintf(parameter->body, sizeof parameter->body, "%.*s", (int)id, colon + 1);
    if (equals)
        parameter->start = parse_start(text, equals + 1, parameter->parameter, state);
    for (size_t i = 0; i + 1 < calibrate->count; i++)
        if (calibrate->parameters[i].parameter == parameter->parameter &&
            !strcmp(calibrate->parameters[i].body, parameter->body))
            argp_error(state, "--fit: '%s': given twice", text);
}

static void calibrate_check(const struct calibrate *calibrate, struct argp_state *state)
{
    const struct scene *scene = &calibrate->scene;
    scene_check_single(scene, state);
    const struct scene_need others[] = {{"MEASURED.csv", calibrate->file},
                                        {"--fit PARAMETER:ID", calibrate->count > 0}};
    scene_check_given(scene, others, 2, "", state);
    for (size_t i = 0; i < calibrate->count; i++) {
        const char *body = calibrate->parameters[i].body;
        scene_check_body(scene, "fit", body, state);
    }
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct calibrate *calibrate = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &calibrate->scene;
        state->child_inputs[1] = calibrate->common;
        state->child_inputs[2] = &calibrate->columns;
        return 0;
    /* the fitted parameters, and the noise of the measurements */
    case KEY_FIT:
        parse_fit(text, calibrate, state);
        return 0;
    case KEY_NOISE:
        calibrate->noise = parse_number("noise", text, state);
        if (!(calibrate->noise > 0.0 && calibrate->noise < 1.0))
            argp_error(state, "--noise: '%s': a number between 0 and 1 is needed", text);
        return 0;
    /* the file of measured impacts */
    case ARGP_KEY_ARG:
        if (calibrate->file)
            argp_error(state, "one file is needed, not '%s' as well", text);
        calibrate->file = text;
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        calibrate_check(calibrate, state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {
    {&scene_argp, 0, NULL, 0}, {&common_argp, 0, NULL, 0}, {&measured_file_argp, 0, NULL, 0}, {0}};
const struct argp calibrate_argp = {
    .options = options,
    .parser = parse,
    .args_doc = "MEASURED.csv",
    .doc = "Finds parameters of the bodies with which the simulated twins of measured impacts fit "
           "best, with 95 % confidence intervals, and says which of them the data do not "
           "determine.\v"
           "It fits the first sub-impact's impulse and duration and the start of the second, as "
           "far as they were measured; the restitution of several sub-impacts in a row is too "
           "sensitive. MEASURED.csv: as for percuss compare.\n"
           "Example: percuss calibrate measured.csv --a steel-sphere --b al-beam --fit "
           "young:al-beam --fit damping:al-beam",
    .children = children,
};

/* A calibration under way. */
struct run {
    struct calibrate *calibrate;
    struct twins twins;
    struct measured_set set;
    struct fitting fitting;
};

static int complain_start(const struct run *run, enum fitting_lack lack, size_t which)
{
    const struct calibrate_parameter *parameter = &run->calibrate->parameters[which];
    const char *name = percuss_parameter_name(parameter->parameter), *id = parameter->body;
    if (lack == FITTING_LACKS_PARAMETER)
        complain("--fit: a %s like %s has no %s",
                 percuss_body_find(&run->twins.bodies.list, id)->shape, id, name);
    else
        complain("--fit: the catalogue has no %s of %s to start from; give --fit %s:%s=START", name,
                 id, name, id);
    return EXIT_USAGE;
}

/* Too few readings is the data's fault; anything else was complained of. */
static int explain(const struct run *run, const struct calibration *calibration)
{
    size_t used = 0, known = 0;
    if (run->fitting.result != PERCUSS_RESULT_OK)
        return twins_code(&run->twins, run->fitting.result);
    /* the quantities of the file, and how many of each could be used */
    for (int q = 0; q < QUANTITIES; q++) {
        used += calibration->used[q];
        known += calibration->known[q];
    }
    if (known == 0)
        complain("%s: tells neither the impulse nor the duration of the first sub-impact nor the "
                 "start of the second (columns first_impulse, first_duration, second_start, or a "
                 "history, or sub_impacts = 1): the restitution of several sub-impacts is chaotic "
                 "and calibrates nothing",
                 run->calibrate->file);
    else
        complain("%s: %zu usable numbers of %zu do not suffice for %zu parameters (the others "
                 "are no smooth function of the parameters or more than 30 %% off the model: start "
                 "nearer with --fit PARAMETER:ID=START)",
                 run->calibrate->file, used, known, run->calibrate->count);
    return EXIT_USAGE;
}

static int run_calibration(struct run *run)
{
    struct calibrate *calibrate = run->calibrate;
    struct calibration calibration;
    if (!fitting_solve(&run->fitting, &calibration))
        return explain(run, &calibration);
    /* warnings are of the twins with the best values */
    int code = twins_code(&run->twins, fitting_ask(&run->fitting, calibration.fit.x, 1.0));
    waiting_end();
    if (code != EXIT_ANSWERED)
        complain("asked once more with the values that came out, the model did not answer: what it "
                 "warns of there is not known");
    struct calibrate_report report = {calibrate->parameters, calibrate->count,     &calibration,
                                      run->set.count,        &run->twins.warnings, &run->set};
    /* the values and their doubts */
    if (calibrate->common->json)
        calibrate_print_json(&report);
    else
        calibrate_print_table(&report);
    if (!calibrate->common->json)
        tally_complain(&run->twins.warnings);
    bool warned = calibrate_warn(&report);
    if (code != EXIT_ANSWERED)
        return code;
    return warned ? EXIT_ANSWERED_WITH_WARNING : EXIT_ANSWERED;
}

/* The twins with the catalogue's values complete the measured impacts. */
static int prepare(struct run *run)
{
    struct calibrate *calibrate = run->calibrate;
    struct twin *list = calloc(run->set.count, sizeof *list);
    if (!list)
        return complain_memory();
    run->fitting = (struct fitting){
        &run->twins.question, &run->set, calibrate->parameters,       calibrate->count,
        calibrate->noise,     list,      twins_listener(&run->twins), PERCUSS_RESULT_OK};
    size_t which;
    enum fitting_lack lack = fitting_start(&run->fitting, &which);
    if (lack != FITTING_LACKS_NOTHING)
        return complain_start(run, lack, which);
    int code = twins_ask(&run->twins, &run->set, &(struct twin_changes){.faster = 1.0}, list);
    return code == EXIT_ANSWERED ? twins_complete(&run->twins, &run->set, list) : code;
}

int command_calibrate(int argc, char **argv, struct common *common)
{
    struct calibrate calibrate = {.common = common, .scene = scene_straight(), .noise = 0.01};
    struct run run = {.calibrate = &calibrate};
    argp_parse(&calibrate_argp, argc, argv, 0, NULL, &calibrate);
    if (calibrate.scene.options.tolerance == 0.0)
        calibrate.scene.options.tolerance = FITTING_TOLERANCE;
    /* the measured impacts */
    int code = measured_file_read(calibrate.file, &calibrate.columns, &run.set);
    if (code != EXIT_ANSWERED)
        return code;
    /* its twins, and the parameters that bring them closest */
    code = twins_open(&run.twins, common, &calibrate.scene);
    if (code == EXIT_ANSWERED) {
        code = prepare(&run);
        if (code == EXIT_ANSWERED)
            code = run_calibration(&run);
        twins_close(&run.twins);
    }
    free(run.fitting.list);
    measured_set_free(&run.set);
    return code;
}
