/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss sweep: the same impact at many speeds. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"
#include "plot.h"
#include "scene.h"
#include "sweep_output.h"

/* Enough to keep a server's workers busy, few enough for its queue. */
enum { OUTSTANDING = 16, MOST_POINTS = 1000000 };
enum { KEY_SPEED = OPTION_OWN, KEY_CSV, KEY_PLOT, KEY_MEASURED };
enum { MOST_CURVES = SCENE_CHOICES * SCENE_CHOICES, MOST_MEASURED = 8 };

struct sweep {
    struct common *common;
    struct scene scene;
    double low, high;
    unsigned count; /* 0: no --speed */
    bool csv;
    const char *plot; /* file; NULL: no picture */
    struct sweep_measured measured[MOST_MEASURED];
    size_t measured_count;
};

static const struct argp_option options[] = {
    {"speed", KEY_SPEED, "LO:HI:N", 0, "N speeds from LO to HI, m/s", 10},
    {"csv", KEY_CSV, NULL, 0, "print comma-separated values", 90},
    {"plot", KEY_PLOT, "FILE", 0,
     "draw the restitution against the speed with gnuplot: FILE.png or FILE.svg", 40},
    {"measured", KEY_MEASURED, "FILE.csv", 0,
     "lay measured impacts over the picture: columns speed, restitution and sub_impacts; may be "
     "given several times",
     40},
    {0},
};

static void parse_speeds(const char *text, struct sweep *sweep, struct argp_state *state)
{
    int end = 0;
    bool read = sscanf(text, "%lf:%lf:%u%n", &sweep->low, &sweep->high, &sweep->count, &end) == 3;
    if (!read || text[end])
        argp_error(state, "--speed: '%s' is not LO:HI:N, for example 0.1:0.4:31", text);
    if (!(sweep->low > 0.0) || !(sweep->high >= sweep->low) || !isfinite(sweep->high))
        argp_error(state, "--speed: '%s': 0 < LO <= HI is needed", text);
    if (sweep->count < 1 || sweep->count > MOST_POINTS)
        argp_error(state, "--speed: '%s': N of 1..%d is needed", text, MOST_POINTS);
}

static void check(const struct sweep *sweep, struct argp_state *state)
{
    if (!sweep->scene.a || !sweep->scene.b || sweep->count == 0)
        argp_error(state, "--a ID --b ID --speed LO:HI:N are needed");
    if (sweep->csv && sweep->common->json)
        argp_error(state, "--csv or --json, not both");
    if (sweep->measured_count > 0 && !sweep->plot)
        argp_error(state, "--measured is laid over a picture: --plot FILE is needed");
}

static void read_measured(const char *file, struct sweep *sweep, struct argp_state *state)
{
    struct measured_fault fault;
    if (sweep->measured_count == MOST_MEASURED)
        argp_error(state, "--measured: '%s': at most %d files", file, MOST_MEASURED);
    struct sweep_measured *measured = &sweep->measured[sweep->measured_count];
    measured->file = file;
    if (!measured_read(file, &measured->set, &fault))
        argp_error(state, "--measured: %s", fault.text);
    sweep->measured_count++;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct sweep *sweep = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &sweep->scene;
        state->child_inputs[1] = sweep->common;
        return 0;
    /* what is swept */
    case KEY_SPEED:
        parse_speeds(text, sweep, state);
        return 0;
    /* what is read and written */
    case KEY_CSV:
        sweep->csv = true;
        return 0;
    case KEY_PLOT:
        plot_check(text, state);
        sweep->plot = text;
        return 0;
    case KEY_MEASURED:
        read_measured(text, sweep, state);
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        check(sweep, state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {
    {&scene_argp, 0, NULL, 0}, {&common_argp, 0, NULL, 0}, {0}};
static const struct argp sweep_argp = {
    .options = options,
    .parser = parse,
    .doc = "Asks for the same impact at N speeds and prints a line for each. --b and "
           "--contact-model may be given several times: a curve for each.\v"
           "Examples: percuss sweep --a steel-sphere --b al-beam --speed 0.1:0.4:31 --csv\n"
           "percuss sweep --a steel-sphere --b al-rod-1 --b al-rod-2 --contact-model hertz "
           "--contact-model closed-form --speed 0.05:0.5:19 --plot rods.svg",
    .children = children,
};

/* A curve under way. */
struct run {
    const struct sweep *sweep;
    struct percuss_client *client;
    struct scene scene; /* of this curve */
    struct scene_bodies bodies;
    struct percuss_reply *replies; /* one a speed */
    uint64_t *sequences;
    unsigned sent, answered;
};

static double speed_at(const struct sweep *sweep, unsigned i)
{
    if (sweep->count == 1)
        return sweep->low;
    return sweep->low + (sweep->high - sweep->low) * i / (sweep->count - 1);
}

static int send_point(struct run *run, unsigned i)
{
    struct percuss_request request;
    int code = scene_request(&run->scene, &run->bodies, speed_at(run->sweep, i), &request);
    if (code != EXIT_ANSWERED)
        return code;
    enum percuss_result result = percuss_submit(run->client, &request, &run->sequences[i]);
    return result == PERCUSS_RESULT_OK ? EXIT_ANSWERED : complain_result(result);
}

/* Which point a reply answers: one of the last OUTSTANDING sent, or one sent again since. */
static unsigned point_of(const struct run *run, uint64_t sequence)
{
    unsigned i = run->sent;
    while (i > 0 && run->sequences[i - 1] != sequence)
        i--;
    return i - 1;
}

static void show_progress(const struct run *run)
{
    enum { WIDTH = 40 };
    unsigned count = run->sweep->count, filled = WIDTH * run->answered / count;
    fprintf(stderr, "\r[%-*.*s] %u/%u", WIDTH, (int)filled,
            "########################################", run->answered, count);
    if (run->answered == count)
        fputc('\n', stderr);
}

/* Takes one reply; a busy server is asked again. */
static int take_point(struct run *run)
{
    struct percuss_reply reply;
    enum percuss_result result =
        percuss_wait(run->client, 0, common_timeout(run->sweep->common), &reply);
    if (result != PERCUSS_RESULT_OK)
        return complain_result(result);
    unsigned i = point_of(run, reply.sequence);
    if (reply.status == PERCUSS_BUSY) {
        percuss_reply_free(&reply);
        usleep(1000);
        return send_point(run, i);
    }
    run->replies[i] = reply;
    run->answered++;
    return EXIT_ANSWERED;
}

static int ask_all(struct run *run)
{
    bool show = isatty(STDERR_FILENO);
    int code = EXIT_ANSWERED;
    while (code == EXIT_ANSWERED && run->answered < run->sweep->count) {
        bool more = run->sent < run->sweep->count && run->sent - run->answered < OUTSTANDING;
        if (more)
            code = send_point(run, run->sent++);
        else
            code = take_point(run);
        if (show && !more)
            show_progress(run);
    }
    return code;
}

/* The worst exit code of the replies; says a refusal and explains an unknown body once. */
static int judge(const struct run *run)
{
    int worst = EXIT_ANSWERED;
    const struct percuss_reply *refused = NULL;
    for (unsigned i = 0; i < run->sweep->count; i++) {
        int code = status_exit_code(run->replies[i].status);
        if (code > worst) {
            worst = code;
            refused = &run->replies[i];
        }
    }
    if (worst > EXIT_ANSWERED_WITH_WARNING)
        complain("%s: %s", percuss_status_name(refused->status), refused->message);
    struct percuss_request request;
    if (refused && refused->status == PERCUSS_UNKNOWN_BODY &&
        scene_request(&run->scene, &run->bodies, run->sweep->low, &request) == EXIT_ANSWERED)
        scene_explain_unknown(&request, &run->bodies.list);
    return worst;
}

/* Asks for all points of a curve; the replies stay the run's. */
static int run_curve(struct run *run)
{
    unsigned count = run->sweep->count;
    run->replies = calloc(count, sizeof *run->replies);
    run->sequences = calloc(count, sizeof *run->sequences);
    if (!run->replies || !run->sequences)
        return complain_memory();
    int code = scene_find_bodies(&run->scene, run->sweep->common, run->client, &run->bodies);
    return code == EXIT_ANSWERED ? ask_all(run) : code;
}

static void free_run(struct run *run)
{
    for (unsigned i = 0; run->replies && i < run->sweep->count; i++)
        percuss_reply_free(&run->replies[i]);
    free(run->replies);
    free(run->sequences);
    percuss_body_list_free(&run->bodies.list);
}

/* The warnings of all points. False: out of memory. */
static bool take_warnings(const struct run *runs, size_t count, struct tally *tally)
{
    bool good = true;
    for (size_t k = 0; k < count; k++)
        for (unsigned i = 0; good && i < runs[k].sweep->count; i++) {
            char place[128], curve[96] = "";
            if (count > 1)
                snprintf(curve, sizeof curve, "of %s, %s, ", runs[k].scene.b,
                         percuss_contact_model_name(runs[k].scene.options.contact_model));
            snprintf(place, sizeof place, "%sat %g m/s", curve, speed_at(runs[k].sweep, i));
            good = tally_take(tally, &runs[k].replies[i], place);
        }
    return good;
}

static int print(const struct sweep *sweep, const struct run *runs, size_t count)
{
    struct tally tally = {.unit = "points"};
    struct sweep_curve curves[MOST_CURVES];
    double *speeds = calloc(sweep->count, sizeof *speeds);
    if (!speeds || !take_warnings(runs, count, &tally))
        return complain_memory();
    /* all curves over the same speeds */
    for (unsigned i = 0; i < sweep->count; i++)
        speeds[i] = speed_at(sweep, i);
    for (size_t k = 0; k < count; k++)
        curves[k] = (struct sweep_curve){
            runs[k].scene.b, percuss_contact_model_name(runs[k].scene.options.contact_model),
            runs[k].replies};
    struct sweep_points points = {
        sweep->scene.a, sweep->count,          speeds,         count, curves,
        &tally,         sweep->measured_count, sweep->measured};
    /* first, or a reader that closes the output early would leave no picture */
    int code = sweep->plot ? sweep_plot(sweep->plot, &points) : EXIT_ANSWERED;
    if (sweep->common->json)
        sweep_print_json(&points);
    else if (sweep->csv)
        sweep_print_csv(&points);
    else
        sweep_print_table(&points);
    if (!sweep->common->json)
        tally_complain(&tally);
    tally_clear(&tally);
    free(speeds);
    return code;
}

/* A run for every body and contact model given; returns how many. */
static size_t list_runs(const struct sweep *sweep, struct percuss_client *client, struct run *runs)
{
    const struct scene *scene = &sweep->scene;
    size_t models = scene->model_count ? scene->model_count : 1, count = 0;
    for (size_t b = 0; b < scene->b_count; b++) {
        for (size_t m = 0; m < models; m++) {
            struct run *run = &runs[count++];
            *run = (struct run){.sweep = sweep, .client = client, .scene = *scene};
            run->scene.b = scene->all_b[b];
            if (scene->model_count)
                run->scene.options.contact_model = scene->models[m];
        }
    }
    return count;
}

static int run_sweep(const struct sweep *sweep, struct percuss_client *client)
{
    struct run *runs = calloc(MOST_CURVES, sizeof *runs);
    if (!runs)
        return complain_memory();
    /* a curve for each body and contact model */
    size_t count = list_runs(sweep, client, runs);
    int code = EXIT_ANSWERED;
    for (size_t k = 0; code == EXIT_ANSWERED && k < count; k++)
        code = run_curve(&runs[k]);
    if (code == EXIT_ANSWERED) {
        code = print(sweep, runs, count);
        /* the worst of all curves decides about the exit code */
        for (size_t k = 0; k < count; k++) {
            int judged = judge(&runs[k]);
            code = judged > code ? judged : code;
        }
    }
    for (size_t k = 0; k < count; k++)
        free_run(&runs[k]);
    free(runs);
    return code;
}

int command_sweep(int argc, char **argv, struct common *common)
{
    struct sweep sweep = {.common = common, .scene = scene_default()};
    struct percuss_client *client;
    argp_parse(&sweep_argp, argc, argv, 0, NULL, &sweep);
    int code = open_client(common, NULL, &client);
    if (code != EXIT_ANSWERED)
        return code;
    code = run_sweep(&sweep, client);
    percuss_client_free(client);
    for (size_t k = 0; k < sweep.measured_count; k++)
        measured_set_free(&sweep.measured[k].set);
    return code;
}
