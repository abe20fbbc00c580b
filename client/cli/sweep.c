/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss sweep: the same impact at many speeds. */

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "measured_file.h"
#include "output_file.h"
#include "quantity.h"
#include "scene.h"
#include "sweep_file.h"
#include "sweep_output.h"
#include "sweep_run.h"

enum { MOST_POINTS = 1000000 };
enum { KEY_SPEED = OPTION_OWN, KEY_CSV, KEY_RESUME, KEY_MEASURED };
enum { MOST_CURVES = SCENE_CHOICES * SCENE_CHOICES };

struct sweep {
    struct common *common;
    struct scene scene;
    double low, high;
    unsigned count; /* 0: no --speed */
    bool csv;
    const char *resume; /* file that is gone on with; NULL: none */
    struct plot_output plot;
    struct sweep_measurements measured; /* laid over the picture */
};

static const struct argp_option options[] = {
    {"speed", KEY_SPEED, "LO:HI:N", 0,
     "N speeds from LO to HI, m/s or with units: 0.1:0.4:31, 100mm/s:400mm/s:31", 10},
    {"csv", KEY_CSV, NULL, 0, "print comma-separated values", 90},
    {"resume", KEY_RESUME, "FILE.csv", 0,
     "go on with a sweep that came to an end before its time: asks for the rows that FILE.csv "
     "lacks and adds them to it, as comma-separated values; begins it if it is not there",
     40},
    {"measured", KEY_MEASURED, "FILE.csv", 0,
     "lay measured impacts over the picture: columns speed, restitution and sub_impacts; "
     "ID=FILE.csv: those on body ID alone; may be given several times",
     40},
    {0},
};

static void parse_speeds(const char *text, struct sweep *sweep, struct argp_state *state)
{
    struct quantity_fault fault;
    const char *high = strchr(text, ':'), *count = high ? strchr(high + 1, ':') : NULL;
    if (!count || strspn(count + 1, "0123456789") != strlen(count + 1))
        argp_error(state,
                   "--speed: '%s' is not LO:HI:N, for example 0.1:0.4:31 or "
                   "\"100 mm/s:400 mm/s:31\"",
                   text);
    /* two speeds, each with a unit or without */
    if (!quantity_read(text, (size_t)(high - text), QUANTITY_SPEED, &sweep->low, &fault) ||
        !quantity_read(high + 1, (size_t)(count - high - 1), QUANTITY_SPEED, &sweep->high, &fault))
        argp_error(state, "--speed: '%s': LO:HI:N: %s", text, fault.text);
    if (!(sweep->low > 0.0) || !(sweep->high >= sweep->low))
        argp_error(state, "--speed: '%s': 0 < LO <= HI is needed, here %g to %g m/s", text,
                   sweep->low, sweep->high);
    /* and how many of them */
    unsigned long points = strtoul(count + 1, NULL, 10);
    if (points < 1 || points > MOST_POINTS)
        argp_error(state, "--speed: '%s': N of 1..%d is needed", text, MOST_POINTS);
    sweep->count = (unsigned)points;
}

static void check(const struct sweep *sweep, struct argp_state *state)
{
    const struct scene_need speeds = {"--speed LO:HI:N", sweep->count > 0};
    scene_check_given(&sweep->scene, &speeds, 1, "", state);
    if (sweep->csv && sweep->common->json)
        argp_error(state, "--csv or --json, not both");
    if (sweep->resume && (sweep->csv || sweep->common->json))
        argp_error(state,
                   "--resume writes comma-separated values into its file: no --csv or --json");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct sweep *sweep = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &sweep->scene;
        state->child_inputs[1] = sweep->common;
        state->child_inputs[2] = &sweep->plot;
        state->child_inputs[3] = &sweep->measured.columns;
        return 0;
    /* what is swept */
    case KEY_SPEED:
        parse_speeds(text, sweep, state);
        return 0;
    /* what is read and written */
    case KEY_CSV:
        sweep->csv = true;
        return 0;
    case KEY_RESUME:
        output_file_check("resume", text, state);
        sweep->resume = text;
        return 0;
    case KEY_MEASURED:
        sweep_measured_add(&sweep->measured, text, state);
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        check(sweep, state);
        sweep_measured_read(&sweep->measured, &sweep->scene, plot_wanted(&sweep->plot), state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&scene_argp, 0, NULL, 0},
                                             {&common_argp, 0, NULL, 0},
                                             {&plot_argp, 0, NULL, 0},
                                             {&measured_file_argp, 0, NULL, 0},
                                             {0}};
const struct argp sweep_argp = {
    .options = options,
    .parser = parse,
    .doc = "Asks for the same impact at N speeds and prints a line for each as it comes. --b and "
           "--contact-model may be given several times: a curve for each. Interrupted, or when "
           "the server goes, it leaves what was answered.\v"
           "Examples: percuss sweep --a steel-sphere --b al-beam --speed 0.1:0.4:31 --csv\n"
           "percuss sweep --a steel-sphere --b al-rod-1 --b al-rod-2 --contact-model hertz "
           "--contact-model closed-form --speed 0.05:0.5:19 --plot rods.svg",
    .children = children,
};

/* All curves under way. */
struct work {
    const struct sweep *sweep;
    struct sweep_points points;
    double *speeds;
    struct sweep_curve curves[MOST_CURVES];
    struct sweep_run runs[MOST_CURVES];
    struct tally tally;
    FILE *file;  /* --resume; NULL: standard output */
    size_t at;   /* the curve that is asked for */
    bool failed; /* no memory, or the output cannot be written */
};

static double speed_at(const struct sweep *sweep, unsigned i)
{
    if (sweep->count == 1)
        return sweep->low;
    return sweep->low + (sweep->high - sweep->low) * i / (sweep->count - 1);
}

static bool take_warnings(struct work *work, unsigned i, const struct percuss_reply *reply)
{
    const struct sweep_curve *curve = &work->curves[work->at];
    char place[128], which[96] = "";
    if (work->points.curve_count > 1)
        snprintf(which, sizeof which, "of %s, %s, ", curve->b, curve->contact_model);
    snprintf(place, sizeof place, "%sat %g m/s", which, work->speeds[i]);
    return tally_take(&work->tally, reply, place);
}

/* What a point has brought, where it belongs: who ends the program has all of them. */
static bool put_out(void *context, unsigned i)
{
    struct work *work = context;
    struct sweep_curve *curve = &work->curves[work->at];
    const struct percuss_reply *reply = &work->runs[work->at].replies[i];
    curve->rows[i] = sweep_row_of(reply, work->speeds[i]);
    curve->done = i + 1;
    FILE *file = work->file ? work->file : stdout;
    if (work->file || work->sweep->csv)
        sweep_csv_row(&work->points, work->at, i, file);
    else if (!work->sweep->common->json)
        sweep_print_row(&work->points, work->at, i);
    work->failed = fflush(file) != 0 && work->file;
    if (work->failed)
        complain("--resume: %s: cannot be written", work->sweep->resume);
    else if (!take_warnings(work, i, reply))
        work->failed = complain_memory() != EXIT_ANSWERED;
    return !work->failed;
}

/* The worst exit code of the replies; says a refusal and explains an unknown body once. */
static int judge(const struct sweep_run *run)
{
    int worst = EXIT_ANSWERED;
    const struct percuss_reply *refused = NULL;
    for (unsigned i = run->first; i < run->told; i++) {
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
        scene_request(&run->scene, &run->bodies, run->speeds[0], &request) == EXIT_ANSWERED)
        scene_explain_unknown(run->common, run->client, &request, &run->bodies.list);
    return worst;
}

/* Goes on with a file, whose last row must be the answer to the question that is asked here. */
static int open_file(struct work *work)
{
    const struct sweep *sweep = work->sweep;
    int code = sweep_file_open(sweep->resume, &work->points, work->curves, &work->file);
    size_t k = work->points.curve_count;
    while (code == EXIT_ANSWERED && k > 0 && work->curves[k - 1].done == 0)
        k--;
    if (code != EXIT_ANSWERED || k == 0)
        return code;
    struct percuss_reply again;
    unsigned last = work->curves[--k].done - 1;
    code = sweep_run_again(&work->runs[k], last, &again);
    if (code != EXIT_ANSWERED)
        return code;
    bool agrees = sweep_file_agrees(sweep->resume, &work->points, k, last, &again);
    percuss_reply_free(&again);
    return agrees ? EXIT_ANSWERED : EXIT_USAGE;
}

/* Asks for what there is not yet; the worst of all curves decides about the exit code. */
static int ask_all(struct work *work)
{
    int code = EXIT_ANSWERED, worst = EXIT_ANSWERED;
    if (work->sweep->csv)
        sweep_csv_head(&work->points, stdout);
    for (size_t k = 0; code == EXIT_ANSWERED && k < work->points.curve_count; k++) {
        work->at = k;
        work->runs[k].first = work->curves[k].done;
        code = sweep_run_ask(&work->runs[k]);
        work->curves[k].replies = work->runs[k].replies;
        int judged = work->runs[k].replies ? judge(&work->runs[k]) : EXIT_ANSWERED;
        worst = judged > worst ? judged : worst;
    }
    return code > worst ? code : worst;
}

/* That not all points are there, and why, unless that was said. */
static void tell_end(const struct work *work)
{
    size_t done = 0, all = (size_t)work->sweep->count * work->points.curve_count;
    for (size_t k = 0; k < work->points.curve_count; k++)
        done += work->curves[k].done;
    if (done < all)
        complain("%s%zu of %zu points%s", sweep_run_interrupted() ? "interrupted: " : "", done, all,
                 work->file ? ": the same command goes on" : "");
}

static int finish(struct work *work, int code)
{
    const struct sweep *sweep = work->sweep;
    tell_end(work);
    /* the bodies of the first curve that was asked for */
    size_t asked = 0;
    while (asked + 1 < work->points.curve_count && !work->runs[asked].bodies.pair.a)
        asked++;
    const struct scene_text text =
        scene_describe(&work->runs[asked].scene, &work->runs[asked].bodies);
    work->points.title = text.title;
    if (plot_wanted(&sweep->plot) && sweep_plot(&sweep->plot, &work->points) != EXIT_ANSWERED)
        code = EXIT_FAILURE;
    if (sweep->common->json)
        sweep_print_json(&work->points);
    else
        tally_complain(&work->tally);
    return code;
}

/* A curve for every body and contact model given. False: out of memory. */
static bool list_curves(struct work *work, struct percuss_client *client)
{
    const struct sweep *sweep = work->sweep;
    const struct scene *scene = &sweep->scene;
    size_t models = scene->model_count ? scene->model_count : 1, count = 0;
    bool good = true;
    for (size_t b = 0; b < scene->b_count; b++) {
        for (size_t m = 0; m < models; m++, count++) {
            struct sweep_run *run = &work->runs[count];
            *run = (struct sweep_run){
                sweep->common,         client,           *scene,         .speeds = work->speeds,
                .count = sweep->count, .ready = put_out, .context = work};
            run->scene.b = scene->all_b[b];
            if (scene->model_count)
                run->scene.options.contact_model = scene->models[m];
            work->curves[count] = (struct sweep_curve){
                .b = run->scene.b,
                .contact_model = percuss_contact_model_name(run->scene.options.contact_model),
                .rows = calloc(sweep->count, sizeof(struct sweep_row))};
            good = good && work->curves[count].rows;
        }
    }
    work->points = (struct sweep_points){scene->a,
                                         NULL,
                                         sweep->count,
                                         work->speeds,
                                         count,
                                         work->curves,
                                         &work->tally,
                                         sweep->measured.count,
                                         sweep->measured.list,
                                         sweep->common->units};
    return good;
}

static void release(struct work *work)
{
    for (size_t k = 0; k < work->points.curve_count; k++) {
        sweep_run_release(&work->runs[k]);
        free(work->curves[k].rows);
    }
    if (work->file)
        fclose(work->file);
    tally_clear(&work->tally);
    free(work->speeds);
    free(work);
}

static int run_sweep(const struct sweep *sweep, struct percuss_client *client)
{
    struct work *work = calloc(1, sizeof *work);
    if (!work)
        return complain_memory();
    work->sweep = sweep;
    work->tally.unit = "points";
    work->speeds = calloc(sweep->count, sizeof *work->speeds);
    for (unsigned i = 0; work->speeds && i < sweep->count; i++)
        work->speeds[i] = speed_at(sweep, i);
    int code = work->speeds && list_curves(work, client) ? EXIT_ANSWERED : complain_memory();
    if (code == EXIT_ANSWERED && sweep->resume)
        code = open_file(work);
    if (code == EXIT_ANSWERED) {
        sweep_run_catch_interrupts();
        /* a reader that closes the output early is no reason to leave out the picture */
        if (plot_wanted(&sweep->plot))
            signal(SIGPIPE, SIG_IGN);
        code = finish(work, ask_all(work));
    }
    release(work);
    return code;
}

int command_sweep(int argc, char **argv, struct common *common)
{
    struct sweep sweep = {.common = common, .scene = scene_default()};
    struct percuss_client *client;
    argp_parse(&sweep_argp, argc, argv, 0, NULL, &sweep);
    if (!common->json)
        scene_doubt_speed(sweep.high);
    int code = open_client(common, NULL, &client);
    if (code != EXIT_ANSWERED)
        return code;
    code = run_sweep(&sweep, client);
    percuss_client_free(client);
    sweep_measured_free(&sweep.measured);
    return code;
}
