/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss ensemble: many impacts with uncertain inputs. */

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"
#include "ensemble_output.h"
#include "fold.h"
#include "html_page.h"
#include "input_text.h"
#include "json_writer.h"
#include "output_file.h"
#include "quantity.h"
#include "scene.h"

enum {
    KEY_SPEED = OPTION_OWN,
    KEY_INPUT,
    KEY_MODEL_ERROR,
    KEY_CORRELATE,
    KEY_SAMPLES,
    KEY_SEED,
    KEY_SAMPLING,
    KEY_HALF_WIDTH,
    KEY_QUANTILE_HALF_WIDTH,
    KEY_QUANTILES,
    KEY_BINS,
    KEY_CSV,
    KEY_DEADLINE,
    KEY_PROGRESS,
    KEY_HTML,
    KEY_VERBOSE = 'v'
};

struct ensemble {
    struct common *common;
    struct scene scene;
    struct percuss_ensemble_request *request;
    bool has_speed, has_samples, model_error, progress, verbose;
    const char *csv;  /* file; NULL: not wanted */
    const char *html; /* likewise */
    struct plot_output plot;
};

static const struct argp_option options[] = {
    {"speed", KEY_SPEED, "DIST", 0, "speed of A towards B, m/s or with units: a distribution", 10},
    {"input", KEY_INPUT, "NAME[@ID]=DIST", 0,
     "another uncertain number: direction, friction; site (or at), young, poisson, density, "
     "radius, yield, "
     "damping, scale of a body, in SI units or with their own: young@al-beam=normal:70GPa:1GPa, or "
     "young:al-beam=... (again for more)",
     11},
    {"model-error", KEY_MODEL_ERROR, NULL, 0,
     "what the models themselves may be wrong by is uncertain too: the inputs model-force, "
     "model-compliance and model-yield, with --friction model-friction, normal, in standard "
     "deviations",
     11},
    {"correlate", KEY_CORRELATE, "I,J=RHO", 0,
     "inputs I and J (0: the first, in order) are correlated", 11},
    {"samples", KEY_SAMPLES, "N", 0,
     "how many at most (default 1000, or each value of the lists once)", 12},
    {"seed", KEY_SEED, "N", 0, "of the random numbers (default 1)", 12},
    {"sampling", KEY_SAMPLING, "S", 0, "plain, latin-hypercube or sobol (default plain)", 12},
    {"half-width", KEY_HALF_WIDTH, "W", 0,
     "stop when the 95 % interval of the mean restitution is within -+ W", 13},
    {"quantile-half-width", KEY_QUANTILE_HALF_WIDTH, "W", 0, "and those of all quantiles", 13},
    {"quantiles", KEY_QUANTILES, "P,P,...", 0, "probabilities of the quantiles", 14},
    {"bins", KEY_BINS, "N", 0, "of the histogram", 14},
    {"csv", KEY_CSV, "FILE", 0, "write every sample", 15},
    {"html", KEY_HTML, "FILE", 0,
     "write a page for a browser: the distribution of the restitution, what causes its spread, the "
     "samples; - is standard output",
     15},
    {"deadline", KEY_DEADLINE, "S", 0,
     "seconds, or with a unit, after which the server answers with what it has", 15},
    {"verbose", KEY_VERBOSE, NULL, 0,
     "print all that is known of the distribution, not the six lines alone that say most; -v by "
     "itself is --version",
     14},
    {"progress", KEY_PROGRESS, NULL, 0, "show progress even if stderr is no terminal", 15},
    {0},
};

static void add_input(struct ensemble *ensemble, const char *text, bool speed,
                      struct argp_state *state)
{
    struct percuss_ensemble_request *request = ensemble->request;
    struct input_fault fault;
    /* the speed is an input with an option of its own, and may be stated as others are, too */
    static const char as_input[] = "speed=";
    if (!speed && strncmp(text, as_input, sizeof as_input - 1) == 0) {
        speed = true;
        text += sizeof as_input - 1;
    }
    if (speed && ensemble->has_speed)
        argp_error(state, "--speed: given twice");
    ensemble->has_speed = ensemble->has_speed || speed;
    if (request->input_count == PERCUSS_MAX_INPUTS)
        argp_error(state, "--input: more than %d inputs", PERCUSS_MAX_INPUTS);
    struct percuss_input *input = &request->inputs[request->input_count++];
    /* DIST, or NAME@BODY=DIST */
    bool read;
    if (speed) {
        *input = (struct percuss_input){.name = "speed"};
        read = input_text_distribution(text, input, &fault);
    } else {
        read = input_text_read(text, input, &fault);
    }
    if (!read)
        argp_error(state, "--%s: %s", speed ? "speed" : "input", fault.text);
}

static void add_model_error(struct ensemble *ensemble, struct argp_state *state)
{
    static const char *const inputs[] = {"model-force=normal:0:1", "model-compliance=normal:0:1",
                                         "model-yield=normal:0:1"};
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++)
        add_input(ensemble, inputs[i], false, state);
    ensemble->model_error = true;
}

static void add_correlation(struct ensemble *ensemble, const char *text, struct argp_state *state)
{
    struct percuss_ensemble_request *request = ensemble->request;
    struct percuss_correlation *pair = &request->correlations[request->correlation_count];
    int end = 0;
    if (request->correlation_count == PERCUSS_MAX_CORRELATIONS)
        argp_error(state, "--correlate: more than %d pairs", PERCUSS_MAX_CORRELATIONS);
    if (sscanf(text, "%u,%u=%lf%n", &pair->first, &pair->second, &pair->coefficient, &end) != 3 ||
        text[end])
        argp_error(state, "--correlate: '%s' is not I,J=RHO, for example 0,1=0.8", text);
    request->correlation_count++;
}

static void parse_quantiles(struct percuss_ensemble_request *request, const char *text,
                            struct argp_state *state)
{
    for (const char *at = text; at;) {
        char *end;
        double p = strtod(at, &end);
        if (end == at || (*end && *end != ',') || !(p > 0.0 && p < 1.0) ||
            request->quantile_count == PERCUSS_MAX_QUANTILES)
            argp_error(state, "--quantiles: '%s' is not a list of up to %d probabilities", text,
                       PERCUSS_MAX_QUANTILES);
        request->quantiles[request->quantile_count++] = p;
        at = *end ? end + 1 : NULL;
    }
}

static enum percuss_sampling parse_sampling(const char *text, struct argp_state *state)
{
    unsigned i = 0;
    while (i < PERCUSS_SAMPLING_COUNT && strcmp(text, percuss_sampling_name(i)) != 0)
        i++;
    if (i == PERCUSS_SAMPLING_COUNT)
        argp_error(state, "--sampling: '%s' is not plain, latin-hypercube or sobol", text);
    return i;
}

static uint64_t parse_seed(const char *text, struct argp_state *state)
{
    char *end;
    unsigned long long seed = strtoull(text, &end, 10);
    if (end == text || *end || strchr(text, '-'))
        argp_error(state, "--seed: '%s' is not a whole number", text);
    return seed;
}

/* Without a number of samples, lists say how many. */
static void settle(struct ensemble *ensemble, struct argp_state *state)
{
    struct percuss_ensemble_request *request = ensemble->request;
    const struct scene_need speed = {"--speed DIST", ensemble->has_speed};
    /* as of all commands */
    if (ensemble->verbose && state->argc == 2) {
        puts(argp_program_version);
        exit(EXIT_SUCCESS);
    }
    scene_check_given(&ensemble->scene, &speed, 1, "", state);
    /* --friction may stand behind --model-error */
    if (ensemble->model_error && ensemble->scene.friction > 0.0)
        add_input(ensemble, "model-friction=normal:0:1", false, state);
    for (size_t i = 0; i < request->input_count; i++)
        if (request->inputs[i].body[0])
            scene_check_body(&ensemble->scene, "input", request->inputs[i].body, state);
    for (size_t i = 0; !ensemble->has_samples && i < request->input_count; i++)
        if (request->inputs[i].distribution == PERCUSS_DISTRIBUTION_LIST)
            request->samples = 0;
    request->list_samples = ensemble->csv || ensemble->html || plot_wanted(&ensemble->plot);
}

/* Parses an uncertain input. */
static error_t parse_input(int key, char *text, struct argp_state *state)
{
    struct ensemble *ensemble = state->input;
    switch (key) {
    case KEY_SPEED:
        add_input(ensemble, text, true, state);
        return 0;
    case KEY_INPUT:
        add_input(ensemble, text, false, state);
        return 0;
    case KEY_MODEL_ERROR:
        add_model_error(ensemble, state);
        return 0;
    case KEY_CORRELATE:
        add_correlation(ensemble, text, state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* Which samples, and how many. */
static error_t parse_samples(int key, char *text, struct argp_state *state)
{
    struct ensemble *ensemble = state->input;
    struct percuss_ensemble_request *request = ensemble->request;
    switch (key) {
    /* at most so many of them */
    case KEY_SAMPLES:
        request->samples = parse_count("samples", text, PERCUSS_MAX_SAMPLES, state);
        ensemble->has_samples = true;
        return 0;
    case KEY_SEED:
        request->seed = parse_seed(text, state);
        return 0;
    case KEY_SAMPLING:
        request->sampling = parse_sampling(text, state);
        return 0;
    /* fewer where these suffice */
    case KEY_HALF_WIDTH:
        request->half_width = parse_positive_quantity("half-width", text, QUANTITY_NUMBER, state);
        return 0;
    case KEY_QUANTILE_HALF_WIDTH:
        request->quantile_half_width =
            parse_positive_quantity("quantile-half-width", text, QUANTITY_NUMBER, state);
        return 0;
    case KEY_DEADLINE:
        ensemble->scene.options.deadline =
            parse_positive_quantity("deadline", text, QUANTITY_TIME, state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct ensemble *ensemble = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &ensemble->scene;
        state->child_inputs[1] = ensemble->common;
        state->child_inputs[2] = &ensemble->plot;
        return 0;
    /* the report of the samples */
    case KEY_VERBOSE:
        ensemble->verbose = true;
        return 0;
    case KEY_QUANTILES:
        parse_quantiles(ensemble->request, text, state);
        return 0;
    case KEY_BINS:
        ensemble->request->bins = parse_count("bins", text, 1000, state);
        return 0;
    case KEY_CSV:
        output_file_check("csv", text, state);
        ensemble->csv = text;
        return 0;
    case KEY_HTML:
        ensemble->html = html_page_file(text, state);
        return 0;
    case KEY_PROGRESS:
        ensemble->progress = true;
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        settle(ensemble, state);
        return 0;
    default:
        return parse_input(key, text, state) == 0 ? 0 : parse_samples(key, text, state);
    }
}

static const struct argp_child children[] = {
    {&scene_argp, 0, NULL, 0}, {&common_argp, 0, NULL, 0}, {&plot_argp, 0, NULL, 0}, {0}};
const struct argp ensemble_argp = {
    .options = options,
    .parser = parse,
    .doc = "Asks for many impacts with uncertain inputs and prints what their restitution is as a "
           "distribution. DIST is a number, uniform:LOWEST:HIGHEST, "
           "normal:MEAN:DEVIATION[:LOWEST:HIGHEST], log-normal: the same, or list:FILE[:COLUMN]. "
           "Interrupted, it prints what was found so far.\v"
           "Example: percuss ensemble --a steel-sphere --b al-beam --speed uniform:0.089:0.411 "
           "--input young@al-beam=normal:70e9:1e9 --samples 10000",
    .children = children,
};

static volatile sig_atomic_t interrupted;

static void interrupt(int signal_number)
{
    (void)signal_number;
    interrupted = 1;
}

static bool show_progress(void *context, const struct percuss_ensemble_progress *progress)
{
    const struct ensemble *ensemble = context;
    if (!ensemble->progress || progress->samples == 0)
        return !interrupted;
    char text[96];
    int length = snprintf(text, sizeof text, " %llu/%llu", (unsigned long long)progress->done,
                          (unsigned long long)progress->samples);
    if (!isnan(progress->half_width))
        snprintf(text + length, sizeof text - (size_t)length, "  e %.4f -+ %.4f ", progress->mean,
                 progress->half_width);
    fputc('\r', stderr);
    fold_bar((double)progress->done / (double)progress->samples, text);
    return !interrupted;
}

/* The speed of the flight is that of the approach by a share. */
static void scale_speed(struct percuss_input *input, double share)
{
    double *const numbers[] = {&input->first, &input->second, &input->lower, &input->upper};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        *numbers[i] *= share;
    for (size_t i = 0; i < input->value_count; i++)
        ((double *)input->values)[i] *= share; /* they are this program's */
}

/* Names the input that a refusal calls inputs[N]. */
static void tell_input(const struct percuss_ensemble_request *request,
                       const struct percuss_ensemble_reply *reply)
{
    unsigned number;
    if (sscanf(reply->message, "inputs[%u]", &number) != 1 || number >= request->input_count)
        return;
    const struct percuss_input *input = &request->inputs[number];
    complain("inputs[%u] is %s%s%s", number, input->name, input->body[0] ? "@" : "", input->body);
}

static int ask(struct ensemble *ensemble, struct percuss_client *client,
               const struct scene_bodies *bodies)
{
    const struct percuss_ensemble_request *request = ensemble->request;
    struct percuss_ensemble_reply reply;
    ensemble->progress = ensemble->progress || isatty(STDERR_FILENO);
    /* a second interrupt ends the program */
    sigaction(SIGINT, &(struct sigaction){.sa_handler = interrupt, .sa_flags = (int)SA_RESETHAND},
              NULL);
    solve_ensemble_function *solve = ensemble->common->solve_ensemble;
    solve = solve ? solve : percuss_solve_ensemble;
    enum percuss_result result =
        solve(client, request, common_timeout(ensemble->common), show_progress, ensemble, &reply);
    if (ensemble->progress)
        fputc('\n', stderr);
    if (result != PERCUSS_RESULT_OK)
        return complain_result(result);
    /* files first, then the answer */
    int code = status_exit_code(reply.status);
    if (ensemble->csv && reply.statistic_count > 0 &&
        !ensemble_write_csv(ensemble->csv, request, &reply, ensemble->common->units))
        code = EXIT_FAILURE;
    if (plot_wanted(&ensemble->plot) && reply.statistic_count > 0 &&
        ensemble_plot(&ensemble->plot, scene_describe(&ensemble->scene, bodies).title, request,
                      &reply) != EXIT_ANSWERED)
        code = EXIT_FAILURE;
    if (ensemble->html && reply.statistic_count > 0 &&
        ensemble_write_page(ensemble->html, scene_describe(&ensemble->scene, bodies).title, request,
                            &reply, ensemble->common) != EXIT_ANSWERED)
        code = EXIT_FAILURE;
    if (ensemble->common->json)
        json_print(ensemble_to_json(&reply));
    else
        ensemble_print_table(request, &reply, ensemble->verbose);
    tell_input(request, &reply);
    if (reply.status == PERCUSS_UNKNOWN_BODY)
        scene_explain_unknown(ensemble->common, client, &request->scene, &bodies->list);
    percuss_ensemble_reply_free(&reply);
    return code;
}

static int run(struct ensemble *ensemble)
{
    struct percuss_client *client;
    struct scene_bodies bodies = {0};
    double speed = 0.0;
    /* the scene itself has the middle of the speeds */
    for (size_t i = 0; i < ensemble->request->input_count; i++) {
        struct percuss_input *input = &ensemble->request->inputs[i];
        if (strcmp(input->name, "speed") != 0)
            continue;
        speed = input_text_middle(input);
        if (ensemble->scene.angle != 0.0)
            scale_speed(input, scene_normal_share(&ensemble->scene));
    }
    if (!ensemble->common->json)
        scene_doubt_speed(speed);
    /* bodies of the catalogue, placed in contact */
    int code = open_client(ensemble->common, NULL, &client);
    if (code != EXIT_ANSWERED)
        return code;
    code = scene_find_bodies(&ensemble->scene, ensemble->common, client, &bodies);
    if (code == EXIT_ANSWERED)
        code = scene_request(&ensemble->scene, &bodies, speed, &ensemble->request->scene);
    if (code == EXIT_ANSWERED)
        code = ask(ensemble, client, &bodies);
    percuss_body_list_free(&bodies.list);
    percuss_client_free(client);
    return code;
}

int command_ensemble(int argc, char **argv, struct common *common)
{
    struct ensemble ensemble = {.common = common, .scene = scene_default()};
    ensemble.request = malloc(sizeof *ensemble.request);
    if (!ensemble.request)
        return complain_memory();
    percuss_ensemble_request_init(ensemble.request);
    ensemble.request->seed = 1;
    argp_parse(&ensemble_argp, argc, argv, 0, NULL, &ensemble);
    int code = run(&ensemble);
    for (size_t i = 0; i < ensemble.request->input_count; i++)
        free((void *)ensemble.request->inputs[i].values);
    free(ensemble.request);
    return code;
}
