/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss sweep: the same impact at many speeds. */

#include <errno.h>
#include <math.h>
#include <percuss/percuss.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli.h"
#include "fall.h"
#include "fold.h"
#include "html_page.h"
#include "measured_file.h"
#include "output_file.h"
#include "quantity.h"
#include "request_json.h"
#include "scene.h"
#include "sweep_output.h"

/* The points of a curve: several requests at a time, told in their order. */

/* Hears of point i, once it and all before it are there. False: no more of them are wanted. */
typedef bool sweep_run_ready(void *context, unsigned i);

struct sweep_run {
    const struct common *common;
    struct percuss_client *client;
    struct scene scene; /* of this curve */
    struct scene_bodies bodies;
    const double *speeds, *angles;
    unsigned count;
    unsigned first; /* points before it are known already */
    sweep_run_ready *ready;
    void *context;                 /* of that */
    struct percuss_reply *replies; /* one a speed; those below `first` are empty */
    bool *there;
    uint64_t *sequences;
    unsigned sent, answered, told;
};

/* Enough to keep a server's workers busy, few enough for its queue. */
enum { OUTSTANDING = 16 };

/* Between two looks whether it was interrupted, and two drawings of the progress, s. */
static const double LOOK = 0.1;

static volatile sig_atomic_t interrupted;

static void interrupt(int signal_number)
{
    (void)signal_number;
    interrupted = 1;
}

/* From now on an interrupt (SIGINT, SIGTERM) ends the asking, and a second one the program. */
static void sweep_run_catch_interrupts(void)
{
    const struct sigaction once = {.sa_handler = interrupt, .sa_flags = (int)SA_RESETHAND};
    sigaction(SIGINT, &once, NULL);
    sigaction(SIGTERM, &once, NULL);
}

static bool sweep_run_interrupted(void)
{
    return interrupted;
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* The question of point i. Exit code; complains. */
static int make_request(const struct sweep_run *run, unsigned i, struct percuss_request *request)
{
    struct scene scene = run->scene;
    scene.angle = run->angles[i];
    return scene_request(&scene, &run->bodies, run->speeds[i], request);
}

static int send_point(struct sweep_run *run, unsigned i)
{
    struct percuss_request request;
    int code = make_request(run, i, &request);
    if (code != EXIT_ANSWERED)
        return code;
    enum percuss_result result = percuss_submit(run->client, &request, &run->sequences[i]);
    return result == PERCUSS_RESULT_OK ? EXIT_ANSWERED : complain_result(result);
}

/* Which point a reply answers: one of the last OUTSTANDING sent, or one sent again since. */
static unsigned point_of(const struct sweep_run *run, uint64_t sequence)
{
    unsigned i = run->sent;
    while (i > 0 && run->sequences[i - 1] != sequence)
        i--;
    return i - 1;
}

static void show_progress(const struct sweep_run *run, double *shown)
{
    unsigned done = run->first + run->answered;
    bool ends = done == run->count;
    if (!isatty(STDERR_FILENO) || (!ends && now() < *shown + LOOK))
        return;
    *shown = now();
    char text[48];
    snprintf(text, sizeof text, " %u/%u", done, run->count);
    fputc('\r', stderr);
    fold_bar((double)done / run->count, text);
    if (ends)
        fputc('\n', stderr);
}

/* Waits for any reply, until an interrupt. PENDING: interrupted. In this process waiting is
 * solving, which must not begin anew at every look. */
static enum percuss_result await(struct sweep_run *run, struct percuss_reply *reply)
{
    const double look = run->common->local ? INFINITY : LOOK;
    double end = now() + common_timeout(run->common);
    for (;;) {
        double left = end - now();
        enum percuss_result result = percuss_wait(run->client, 0, fmax(fmin(left, look), 0), reply);
        if (interrupted && result == PERCUSS_RESULT_TIMEOUT)
            return PERCUSS_RESULT_PENDING;
        if (result != PERCUSS_RESULT_TIMEOUT || left <= look)
            return result;
    }
}

/* Tells of all that are there in order. */
static bool tell(struct sweep_run *run)
{
    bool wanted = true;
    while (wanted && run->told < run->count && run->there[run->told])
        wanted = run->ready(run->context, run->told++);
    return wanted;
}

/* Takes one reply; a busy server is asked again. */
static int take_point(struct sweep_run *run)
{
    struct percuss_reply reply;
    enum percuss_result result = await(run, &reply);
    if (result == PERCUSS_RESULT_PENDING)
        return EXIT_ANSWERED_WITH_WARNING;
    if (result != PERCUSS_RESULT_OK)
        return complain_result(result);
    unsigned i = point_of(run, reply.sequence);
    if (reply.status == PERCUSS_BUSY) {
        percuss_reply_free(&reply);
        usleep(1000);
        return send_point(run, i);
    }
    run->replies[i] = reply;
    run->there[i] = true;
    run->answered++;
    return tell(run) ? EXIT_ANSWERED : EXIT_FAILURE;
}

/* Asks for the points from `first` on; members above `replies` are the caller's. Exit code;
 * complains. With any code the points below `told` are there. To be released. */
static int sweep_run_ask(struct sweep_run *run)
{
    double shown = 0.0;
    run->replies = calloc(run->count, sizeof *run->replies);
    run->there = calloc(run->count, sizeof *run->there);
    run->sequences = calloc(run->count, sizeof *run->sequences);
    run->sent = run->told = run->first;
    if (!run->replies || !run->there || !run->sequences)
        return complain_memory();
    int code = scene_find_bodies(&run->scene, run->common, run->client, &run->bodies);
    while (code == EXIT_ANSWERED && run->told < run->count && !interrupted) {
        unsigned outstanding = run->sent - run->first - run->answered;
        if (run->sent < run->count && outstanding < OUTSTANDING) {
            code = send_point(run, run->sent++);
        } else {
            code = take_point(run);
            show_progress(run, &shown);
        }
    }
    return code == EXIT_ANSWERED && run->told < run->count ? EXIT_ANSWERED_WITH_WARNING : code;
}

/* Asks for one point by itself. The reply is the caller's. Exit code; complains. */
static int sweep_run_again(struct sweep_run *run, unsigned i, struct percuss_reply *reply)
{
    struct percuss_request request;
    int code = scene_find_bodies(&run->scene, run->common, run->client, &run->bodies);
    if (code == EXIT_ANSWERED)
        code = make_request(run, i, &request);
    percuss_body_list_free(&run->bodies.list);
    if (code != EXIT_ANSWERED)
        return code;
    return complain_result(
        percuss_solve(run->client, &request, common_timeout(run->common), reply));
}

static void sweep_run_release(struct sweep_run *run)
{
    for (unsigned i = 0; run->replies && i < run->count; i++)
        percuss_reply_free(&run->replies[i]);
    free(run->replies);
    free(run->there);
    free(run->sequences);
    percuss_body_list_free(&run->bodies.list);
}

/* A sweep's CSV in a file, which a later run continues. */

/* A file under way. */
struct reading {
    const char *name;
    const struct sweep_points *points;
    FILE *file;
    char *line;
    size_t room, number; /* of the line */
    long good;           /* where the last whole line ends */
};

/* A whole line without its end; false: there is none. */
static bool next_line(struct reading *reading)
{
    ssize_t length = getline(&reading->line, &reading->room, reading->file);
    if (length <= 0 || reading->line[length - 1] != '\n')
        return false;
    reading->line[length - 1] = '\0';
    reading->number++;
    reading->good = ftell(reading->file);
    return true;
}

/* The line that a row or the head becomes, without its end; NULL: no memory. */
static char *line_of(const struct sweep_points *points, size_t k, unsigned i, bool head)
{
    char *text = NULL;
    size_t size;
    FILE *memory = open_memstream(&text, &size);
    if (!memory)
        return NULL;
    if (head)
        sweep_csv_head(points, memory);
    else
        sweep_csv_row(points, k, i, memory);
    if (fclose(memory) != 0 || size == 0)
        return text;
    text[size - 1] = '\0';
    return text;
}

static const char *status_of(const char *name)
{
    for (unsigned status = 0; status < PERCUSS_STATUS_COUNT; status++)
        if (strcmp(percuss_status_name(status), name) == 0)
            return percuss_status_name(status);
    return NULL;
}

/* The first, none, where there is no column of it. */
static const char *friction_state_of(const char *name)
{
    for (unsigned state = 0; state < PERCUSS_FRICTION_STATE_COUNT; state++)
        if (!*name || strcmp(percuss_friction_state_name(state), name) == 0)
            return percuss_friction_state_name(state);
    return NULL;
}

/* The row in the line, if it is one: as it would be written. */
static bool parse_row(const struct reading *reading, size_t k, unsigned i, struct sweep_row *row)
{
    char status[32] = "", slip[32] = "";
    int end = 0, askew = 0;
    const char *text = reading->line;
    for (int skipped = 0; reading->points->curve_count > 1 && skipped < 2; skipped++) {
        text = strchr(text, ',');
        if (!text)
            return false;
        text++;
    }
    if (sscanf(text, "%lf,%lf,%lf,%lf,%u,%u,%lf,%31[^,]%n", &row->speed, &row->restitution,
               &row->error, &row->impulse, &row->sub_impacts, &row->significant, &row->end_time,
               status, &end) != 8)
        return false;
    if (reading->points->askew &&
        sscanf(text + end, ",%lf,%lf,%lf,%lf,%lf,%lf,%lf,%31[^,]%n", &row->angle,
               &row->impulse_tangential[0], &row->impulse_tangential[1], &row->slip_after[0],
               &row->slip_after[1], &row->tangential_restitution, &row->restitution_kinematic, slip,
               &askew) != 8)
        return false;
    if (sscanf(text + end + askew, ",%lf", &row->error_total) != 1)
        return false;
    row->status = status_of(status);
    row->friction_state = friction_state_of(slip);
    if (!row->status || !row->friction_state || row->speed != reading->points->speeds[i] ||
        (reading->points->askew && row->angle != reading->points->angles[i]))
        return false;
    char *written = line_of(reading->points, k, i, false);
    bool same = written && strcmp(written, reading->line) == 0;
    free(written);
    return same;
}

static int sweep_refuse(const struct reading *reading, const char *what)
{
    complain("--resume: %s:%zu: '%.200s' %s: another sweep's file?", reading->name, reading->number,
             reading->line, what);
    return EXIT_USAGE;
}

/* An older percuss has left off the last columns. */
static int sweep_refuse_older(const struct reading *reading, const char *head)
{
    complain("--resume: %s: has no column %s: an older percuss began it: begin another file",
             reading->name, head + strlen(reading->line) + 1);
    return EXIT_USAGE;
}

static int read_rows(struct reading *reading, struct sweep_curve *curves)
{
    char *head = line_of(reading->points, 0, 0, true);
    if (!head)
        return complain_memory();
    bool empty = !next_line(reading);
    size_t length = empty ? 0 : strlen(reading->line);
    int code = empty || strcmp(head, reading->line) == 0 ? EXIT_ANSWERED
               : strncmp(head, reading->line, length) == 0 && head[length] == ','
                   ? sweep_refuse_older(reading, head)
                   : sweep_refuse(reading, "is not the first line of this sweep");
    free(head);
    if (code != EXIT_ANSWERED)
        return code;
    /* curve by curve, speed by speed, as they are asked for */
    for (size_t k = 0; !empty && k < reading->points->curve_count; k++)
        for (unsigned i = 0; i < reading->points->count; i++) {
            if (!next_line(reading))
                return EXIT_ANSWERED;
            if (!parse_row(reading, k, i, &curves[k].rows[i]))
                return sweep_refuse(reading, "is not the row of this sweep that stands here");
            curves[k].done = i + 1;
        }
    if (!empty && next_line(reading))
        return sweep_refuse(reading, "is one row more than this sweep has");
    return EXIT_ANSWERED;
}

/* Opens the file, or begins it, for the rows that it lacks. Its rows become `rows` and `done` of
 * the curves: it must be the beginning of this very sweep, row by row; a last line that was cut is
 * taken away. Exit code; complains. The caller closes *file. */
static int sweep_file_open(const char *name, const struct sweep_points *points,
                           struct sweep_curve *curves, FILE **file)
{
    struct reading reading = {.name = name, .points = points, .file = fopen(name, "a+e")};
    *file = NULL;
    if (!reading.file) {
        complain("--resume: %s: %s", name, strerror(errno));
        return EXIT_USAGE;
    }
    rewind(reading.file);
    int code = read_rows(&reading, curves);
    /* a cut line is removed; new lines are added at the end */
    if (code == EXIT_ANSWERED && ftruncate(fileno(reading.file), reading.good) != 0) {
        complain("--resume: %s: %s", name, strerror(errno));
        code = EXIT_FAILURE;
    }
    free(reading.line);
    if (code != EXIT_ANSWERED) {
        fclose(reading.file);
        return code;
    }
    fseek(reading.file, 0, SEEK_END);
    if (reading.good == 0)
        sweep_csv_head(points, reading.file);
    *file = reading.file;
    return EXIT_ANSWERED;
}

/* Which point it is, by what differs. */
struct place_text {
    char text[48];
};

static struct place_text place_of(const struct sweep_points *points, unsigned i)
{
    struct place_text place;
    snprintf(place.text, sizeof place.text, points->by_angle ? "%g degrees" : "%g m/s",
             points->by_angle ? points->angles[i] : points->speeds[i]);
    return place;
}

/* Whether row i of curve k, asked for again, is to the last bit that of the file. False: the file
 * has the answers to another question; complains. */
static bool sweep_file_agrees(const char *name, const struct sweep_points *points, size_t k,
                              unsigned i, const struct percuss_reply *again)
{
    struct sweep_row row = sweep_row_of(points, i, again);
    struct sweep_curve curve = points->curves[k];
    struct sweep_points other = *points;
    struct place_text place = place_of(points, i);
    /* the same curve with the row alone */
    curve.rows = &row;
    other.curves = &curve;
    char *held = line_of(points, k, i, false), *fresh = line_of(&other, 0, 0, false);
    bool same = held && fresh && strcmp(held, fresh) == 0;
    if (!same)
        complain("--resume: %s: its row at %s, '%s', is '%s' now: it has the answers to another "
                 "question, or of another catalogue",
                 name, place.text, held ? held : "", fresh ? fresh : "");
    free(held);
    free(fresh);
    return same;
}

enum { MOST_POINTS = 1000000 };
enum { KEY_SPEED = OPTION_OWN, KEY_DROP, KEY_SPEEDS, KEY_CSV, KEY_RESUME, KEY_MEASURED, KEY_HTML };
enum { MOST_CURVES = SCENE_CHOICES * SCENE_CHOICES };

struct sweep {
    struct common *common;
    struct scene scene;
    double low, high;        /* m/s, or m */
    bool drops;              /* these are heights of falls */
    bool logarithmic;        /* equal ratios between them, not equal differences */
    unsigned speed_count;    /* 0: no --speed */
    const char *speed_text;  /* of one speed alone */
    const char *speeds_file; /* the speeds instead; NULL: none */
    double *speeds;          /* of that */
    unsigned count;          /* points */
    bool csv;
    const char *resume; /* file that is gone on with; NULL: none */
    const char *html;   /* file of a page; NULL: none */
    struct plot_output plot;
    struct sweep_measurements measured; /* laid over the picture and the page */
};

static const struct argp_option options[] = {
    {"speed", KEY_SPEED, "LO:HI:N", 0,
     "N speeds from LO to HI, m/s or with units: 0.1:0.4:31, 100mm/s:400mm/s:31; LO:HI:N:log: with "
     "equal ratios; one speed with --angle LO:HI:N",
     10},
    {"drop", KEY_DROP, "LO:HI:N", 0,
     "the speeds of falls from these heights instead, m or with units: 50mm:1m:20; --gravity says "
     "by which gravity",
     10},
    {"speeds", KEY_SPEEDS, "FILE.csv", 0,
     "the speeds in this file's column speed, in their order; - is standard input; --column says "
     "what it calls them",
     10},
    {"csv", KEY_CSV, NULL, 0, "print comma-separated values", 90},
    {"resume", KEY_RESUME, "FILE.csv", 0,
     "go on with a sweep that came to an end before its time: asks for the rows that FILE.csv "
     "lacks and adds them to it, as comma-separated values; begins it if it is not there",
     40},
    {"html", KEY_HTML, "FILE", 0,
     "write the curves as a page for a browser: restitution with its error, sub-impacts, duration, "
     "forces, the values under the pointer; - is standard output",
     40},
    {"measured", KEY_MEASURED, "FILE.csv", 0,
     "lay measured impacts over the picture or the page: columns speed, restitution and "
     "sub_impacts; "
     "ID=FILE.csv: those on body ID alone; may be given several times",
     40},
    {0},
};

#define SPEEDS_EXAMPLE "0.1:0.4:31 or \"100 mm/s:400 mm/s:31\""

/* LO:HI:N of speeds, or of the heights of falls. */
static void parse_speeds(const char *text, struct sweep *sweep, struct argp_state *state)
{
    struct quantity_fault fault;
    const enum quantity quantity = sweep->drops ? QUANTITY_LENGTH : QUANTITY_SPEED;
    const char *option = sweep->drops ? "drop" : "speed";
    const char *high = strchr(text, ':'), *count = high ? strchr(high + 1, ':') : NULL;
    sweep->speed_text = NULL;
    /* one alone, where angles differ: at the end that is known */
    if (!high && quantity_read(text, strlen(text), quantity, &sweep->low, &fault) &&
        sweep->low > 0.0) {
        sweep->high = sweep->low;
        sweep->speed_count = 1;
        sweep->speed_text = text;
        return;
    }
    size_t digits = count ? strspn(count + 1, "0123456789") : 0;
    sweep->logarithmic = count && !strcmp(count + 1 + digits, ":log");
    if (!count || (count[1 + digits] && !sweep->logarithmic))
        argp_error(state, "--%s: '%s' is not LO:HI:N, for example %s, nor LO:HI:N:log", option,
                   text, sweep->drops ? "50mm:1m:20" : SPEEDS_EXAMPLE);
    /* two numbers, each with a unit or without */
    if (!quantity_read(text, (size_t)(high - text), quantity, &sweep->low, &fault) ||
        !quantity_read(high + 1, (size_t)(count - high - 1), quantity, &sweep->high, &fault))
        argp_error(state, "--%s: '%s': LO:HI:N: %s", option, text, fault.text);
    if (!(sweep->low > 0.0) || !(sweep->high >= sweep->low))
        argp_error(state, "--%s: '%s': 0 < LO <= HI is needed, here %g to %g %s", option, text,
                   sweep->low, sweep->high, units_si(quantity));
    /* and how many of them */
    unsigned long points = strtoul(count + 1, NULL, 10);
    if (points < 1 || points > MOST_POINTS)
        argp_error(state, "--%s: '%s': N of 1..%d is needed", option, text, MOST_POINTS);
    sweep->speed_count = (unsigned)points;
}

/* The speeds of a file. */
static void read_speeds(struct sweep *sweep, struct argp_state *state)
{
    struct measured_remarks remarks = {0};
    size_t count = 0;
    if (sweep->speed_count > 0)
        argp_error(state, "--%s or --speeds, not both", sweep->drops ? "drop" : "speed");
    bool good = measured_read_speeds(sweep->speeds_file, &sweep->measured.columns, &sweep->speeds,
                                     &count, &remarks);
    measured_file_complain("--speeds: ", &remarks);
    if (!good)
        argp_error(state, "--speeds: '%s' is not read", sweep->speeds_file);
    if (count > MOST_POINTS)
        argp_error(state, "--speeds: '%s': at most %d speeds, not %zu", sweep->speeds_file,
                   MOST_POINTS, count);
    sweep->speed_count = (unsigned)count;
}

/* Either the speeds differ or the angles. */
static void check_points(struct sweep *sweep, struct argp_state *state)
{
    const struct scene *scene = &sweep->scene;
    if (sweep->speed_text && !scene->angle_list)
        argp_error(state,
                   "--%s: '%s' is not LO:HI:N, for example %s; one speed needs --angle LO:HI:N",
                   sweep->drops ? "drop" : "speed", sweep->speed_text,
                   sweep->drops ? "50mm:1m:20" : SPEEDS_EXAMPLE);
    if (!sweep->speed_text && scene->angle_list)
        argp_error(state, "--angle: LO:HI:N: with one --speed, not with %u", sweep->speed_count);
    if (scene->angle_list && sweep->measured.count > 0)
        argp_error(state, "--measured is laid over a picture against the speed, not the angle");
    sweep->count = scene->angle_list ? scene->angle_count : sweep->speed_count;
}

static void sweep_check(struct sweep *sweep, struct argp_state *state)
{
    if (sweep->speeds_file)
        read_speeds(sweep, state);
    const struct scene_need speeds = {"--speed LO:HI:N", sweep->speed_count > 0};
    scene_check_given(&sweep->scene, &speeds, 1, "", state);
    check_points(sweep, state);
    if (sweep->measured.columns.count > 0 && sweep->measured.count == 0 && !sweep->speeds_file)
        argp_error(state, "--column is of a file that is read: --measured FILE or --speeds FILE "
                          "is needed");
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
        measured_scene_inputs(state, (void *[]){&sweep->scene, sweep->common, &sweep->plot,
                                                &sweep->measured.columns});
        return 0;
    /* the speeds */
    case KEY_SPEED:
    case KEY_DROP:
        if (sweep->speed_count > 0 && sweep->drops != (key == KEY_DROP))
            argp_error(state, "--speed or --drop, not both");
        sweep->drops = key == KEY_DROP;
        parse_speeds(text, sweep, state);
        return 0;
    case KEY_SPEEDS:
        sweep->speeds_file = text;
        return 0;
    /* the files */
    case KEY_CSV:
        sweep->csv = true;
        return 0;
    case KEY_RESUME:
        output_file_check("resume", text, state);
        sweep->resume = text;
        return 0;
    case KEY_HTML:
        sweep->html = html_page_file(text, state);
        return 0;
    case KEY_MEASURED:
        sweep_measured_add(&sweep->measured, text, state);
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        sweep_check(sweep, state);
        sweep_measured_read(&sweep->measured, &sweep->scene,
                            plot_wanted(&sweep->plot) || sweep->html, state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

const struct argp sweep_argp = {
    .options = options,
    .parser = parse,
    .doc =
        "Asks for the same impact at N speeds, or angles, and prints a line for each as it comes. "
        "--b and "
        "--contact-model may be given several times: a curve for each. Interrupted, or when "
        "the server goes, it leaves what was answered.\v"
        "Examples: percuss sweep --a steel-sphere --b al-beam --speed 0.1:0.4:31 --csv\n"
        "percuss sweep --a steel-sphere --b al-rod-1 --b al-rod-2 --contact-model hertz "
        "--contact-model closed-form --speed 0.05:0.5:19 --plot rods.svg\n"
        "percuss sweep --a steel-sphere --b al-beam --speed 0.3 --angle 0:80:9 --friction 0.3",
    .children = measured_scene_children,
};

/* All curves under way. */
struct work {
    const struct sweep *sweep;
    struct sweep_points points;
    double *speeds, *angles;
    struct sweep_curve curves[MOST_CURVES];
    struct sweep_run runs[MOST_CURVES];
    struct tally tally;
    FILE *file;  /* --resume; NULL: standard output */
    size_t at;   /* the curve that is asked for */
    bool failed; /* no memory, or the output cannot be written */
};

static double value_at(double low, double high, unsigned count, unsigned i)
{
    return count == 1 ? low : low + (high - low) * i / (count - 1);
}

/* Equal differences or ratios of the speeds, or of the heights of falls; both ends as they were
 * given. */
static double speed_at(const struct sweep *sweep, unsigned i)
{
    if (sweep->speeds)
        return sweep->speeds[i];
    double value = value_at(sweep->low, sweep->high, sweep->count, i);
    if (sweep->logarithmic && i > 0)
        value = i + 1 == sweep->count
                    ? sweep->high
                    : sweep->low * pow(sweep->high / sweep->low, (double)i / (sweep->count - 1));
    return sweep->drops ? fall_speed(value, column_gravity(&sweep->measured.columns)) : value;
}

/* The speed and the angle of each point. False: out of memory. */
static bool list_points(struct work *work)
{
    const struct sweep *sweep = work->sweep;
    const struct scene *scene = &sweep->scene;
    work->speeds = calloc(sweep->count, sizeof *work->speeds);
    work->angles = calloc(sweep->count, sizeof *work->angles);
    for (unsigned i = 0; work->speeds && work->angles && i < sweep->count; i++) {
        work->speeds[i] = speed_at(sweep, i);
        work->angles[i] = value_at(scene->angle, scene->last_angle, sweep->count, i);
    }
    return work->speeds && work->angles;
}

static bool take_warnings(struct work *work, unsigned i, const struct percuss_reply *reply)
{
    const struct sweep_curve *curve = &work->curves[work->at];
    char place[128], which[96] = "";
    if (work->points.curve_count > 1)
        snprintf(which, sizeof which, "of %s, %s, ", curve->b, curve->contact_model);
    snprintf(place, sizeof place, "%sat %s", which, place_of(&work->points, i).text);
    return tally_take(&work->tally, reply, place);
}

/* Writes a point's results at once, so that an early end loses none. */
static bool put_out(void *context, unsigned i)
{
    struct work *work = context;
    struct sweep_curve *curve = &work->curves[work->at];
    const struct percuss_reply *reply = &work->runs[work->at].replies[i];
    curve->rows[i] = sweep_row_of(&work->points, i, reply);
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
        make_request(run, 0, &request) == EXIT_ANSWERED)
        scene_explain_unknown(run->common, run->client, &request, &run->bodies.list);
    return worst;
}

/* Goes on with a file; its last row must be the answer to the question that is asked here. */
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

/* Asks for the missing points; the worst of all curves decides about the exit code. */
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

/* The page of all curves, with the first request of this one. A sweep without an answer has none.
 */
static int write_page(const struct work *work, size_t asked)
{
    const struct sweep_points *points = &work->points;
    const struct sweep_run *run = &work->runs[asked];
    size_t done = 0;
    for (size_t k = 0; k < points->curve_count; k++)
        done += points->curves[k].done;
    if (done == 0)
        return EXIT_ANSWERED;
    json_t *data = sweep_to_page(points);
    struct percuss_request request;
    /* nothing was asked for where all rows stood in a file */
    if (data && run->bodies.pair.a && make_request(run, 0, &request) == EXIT_ANSWERED &&
        json_object_set_new(data, "request", request_to_json(&request)) != 0) {
        json_decref(data);
        data = NULL;
    }
    return html_page_write(work->sweep->html, data, NULL, NULL, work->sweep->common);
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
    if (sweep->html && write_page(work, asked) != EXIT_ANSWERED)
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
            *run = (struct sweep_run){sweep->common,
                                      client,
                                      *scene,
                                      .speeds = work->speeds,
                                      .angles = work->angles,
                                      .count = sweep->count,
                                      .ready = put_out,
                                      .context = work};
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
    work->points = (struct sweep_points){.a = scene->a,
                                         .count = sweep->count,
                                         .speeds = work->speeds,
                                         .angles = work->angles,
                                         .by_angle = scene->angle_list,
                                         .logarithmic = sweep->logarithmic,
                                         .askew = scene->askew,
                                         .friction = scene->friction,
                                         .curve_count = count,
                                         .curves = work->curves,
                                         .warnings = &work->tally,
                                         .measured_count = sweep->measured.count,
                                         .measured = sweep->measured.list,
                                         .units = sweep->common->units};
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
    free(work->angles);
    free(work);
}

static int run_sweep(const struct sweep *sweep, struct percuss_client *client)
{
    struct work *work = calloc(1, sizeof *work);
    if (!work)
        return complain_memory();
    work->sweep = sweep;
    work->tally.unit = "points";
    int code = list_points(work) && list_curves(work, client) ? EXIT_ANSWERED : complain_memory();
    if (code == EXIT_ANSWERED && sweep->resume)
        code = open_file(work);
    if (code == EXIT_ANSWERED) {
        sweep_run_catch_interrupts();
        /* a reader that closes the output early is no reason to leave out the picture or the page
         */
        if (plot_wanted(&sweep->plot) || sweep->html)
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
    sweep.scene.angles = ANGLES_SWEPT;
    argp_parse(&sweep_argp, argc, argv, 0, NULL, &sweep);
    if (!common->json)
        scene_doubt_speed(sweep.drops ? fall_speed(sweep.high, FALL_STANDARD_GRAVITY) : sweep.high);
    int code = open_client(common, NULL, &client);
    if (code != EXIT_ANSWERED)
        return code;
    code = run_sweep(&sweep, client);
    percuss_client_free(client);
    sweep_measured_free(&sweep.measured);
    free(sweep.speeds);
    return code;
}
