/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss query: one impact. */

#include <jansson.h>
#include <math.h>
#include <percuss/percuss.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "csv.h"
#include "ensemble_output.h"
#include "fall.h"
#include "html_impact.h"
#include "html_page.h"
#include "json_writer.h"
#include "measured_file.h"
#include "output_file.h"
#include "plot_impact.h"
#include "quantity.h"
#include "reply_json.h"
#include "reply_table.h"
#include "request_json.h"
#include "scene.h"
#include "waiting.h"

/* The spread of the restitution by the deviation of the speed. */

/* Sixteen replicates of 32 points tell the deviation to a few per cent, within some 20 ms. */
enum { SAMPLES = 512 };

/* The spread of the restitution by a standard deviation of the speed: asks for a small ensemble
 * around the impact; its contact 0 approaches at `speed`. */
static enum percuss_result spread_ask(struct percuss_client *client,
                                      const struct percuss_request *request, double speed,
                                      double deviation, double timeout,
                                      struct percuss_ensemble_reply *reply)
{
    struct percuss_ensemble_request *ensemble = malloc(sizeof *ensemble);
    *reply = (struct percuss_ensemble_reply){0};
    if (!ensemble)
        return PERCUSS_RESULT_NO_MEMORY;
    /* the same scene at speeds that are distributed normally */
    percuss_ensemble_request_init(ensemble);
    ensemble->scene = *request;
    ensemble->samples = SAMPLES;
    ensemble->sampling = PERCUSS_SAMPLING_SOBOL;
    ensemble->input_count = 1;
    ensemble->inputs[0] = (struct percuss_input){
        .name = "speed",
        .distribution = PERCUSS_DISTRIBUTION_NORMAL,
        .first = speed,
        .second = deviation,
        .lower = NAN,
        .upper = NAN,
    };
    enum percuss_result result =
        percuss_solve_ensemble(client, ensemble, timeout, NULL, NULL, reply);
    free(ensemble);
    return result;
}

/* Two lines for people; the refusal if it is one. */
static void spread_print(double deviation, const struct percuss_ensemble_reply *reply)
{
    if (reply->statistic_count == 0) {
        complain("%s: %s", percuss_status_name(reply->status), reply->message);
        return;
    }
    const struct percuss_statistic *e = &reply->statistics[0];
    size_t last = e->quantile_count - 1;
    printf("\n  with the speed known to -+ %g m/s\n", deviation);
    printf("  restitution  %.4f -+ %.4f", e->mean, e->standard_deviation);
    if (e->quantile_count > 1)
        printf(", %g %% of it between %.4f and %.4f",
               100.0 * (e->probabilities[last] - e->probabilities[0]), e->quantiles[0],
               e->quantiles[last]);
    printf("\n");
    for (size_t i = 0; i < reply->warning_count; i++)
        complain("warning: %s", reply->warnings[i]);
}

/* The answers of a query: one, or several to different speeds and contact models. */

/* Answers to print, one after the other. */
struct query_output {
    bool json, csv, units;
    bool several;                   /* each is told from the others by speed and contact model */
    bool friction;                  /* CSV has columns of friction */
    unsigned count;                 /* printed so far */
    json_t *answers;                /* of several as JSON, until the end */
    const struct scene_text *scene; /* the question in words; NULL: a whole request */
};

/* A reply as comma-separated values. */

/* The id of a body of the request; empty: the reply is not of this request. */
static const char *body_of(const struct percuss_request *request, size_t contact, bool b)
{
    if (contact >= request->contact_count)
        return "";
    uint32_t body = b ? request->contacts[contact].b : request->contacts[contact].a;
    return body < request->body_count ? request->bodies[body].id : "";
}

/* Prints the names of the columns on stdout, behind `lead`: others with a comma after each. */
static void reply_csv_head(const char *lead, bool friction, bool units)
{
    csv_head(stdout, lead, units);
    csv_head(stdout,
             "contact,a,b,restitution,error,impulse,sub_impacts,end_time,status,sub_impact,start,"
             "end,sub_impulse,peak_force,max_indentation,negligible",
             units);
    if (friction)
        csv_head(stdout,
                 ",friction,impulse_tangential_1,impulse_tangential_2,impulse_tangential_error,"
                 "slip_before_1,slip_before_2,slip_after_1,slip_after_2,tangential_restitution,"
                 "restitution_kinematic,friction_state,sub_impulse_tangential_1,"
                 "sub_impulse_tangential_2,sub_friction_state",
                 units);
    csv_head(stdout, ",error_total", units);
    putchar('\n');
}

/* The columns of friction. */
static void print_csv_friction(const struct percuss_contact_result *contact,
                               const struct percuss_sub_impact *sub)
{
    const double numbers[] = {contact->friction,
                              contact->impulse_tangential[0],
                              contact->impulse_tangential[1],
                              contact->impulse_tangential_error,
                              contact->slip_before[0],
                              contact->slip_before[1],
                              contact->slip_after[0],
                              contact->slip_after[1],
                              contact->tangential_restitution,
                              contact->restitution_kinematic};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        printf(",%.17g", numbers[i]);
    printf(",%s,%.17g,%.17g,%s", percuss_friction_state_name(contact->friction_state),
           sub->impulse_tangential[0], sub->impulse_tangential[1],
           percuss_friction_state_name(sub->friction_state));
}

/* Prints a line for each sub-impact that is listed, with its contact's columns before it (a contact
 * without one has a line too), on stdout, behind `lead`; message and warnings to stderr. */
static void reply_csv_print(const char *lead, bool friction, const struct percuss_request *request,
                            const struct percuss_reply *reply)
{
    /* only its numbers are printed of one that is not there */
    const struct percuss_sub_impact none = {.start = NAN,
                                            .end = NAN,
                                            .impulse = NAN,
                                            .peak_force = NAN,
                                            .max_indentation = NAN,
                                            .impulse_tangential = {NAN, NAN}};
    for (size_t c = 0; c < reply->contact_count; c++) {
        const struct percuss_contact_result *contact = &reply->contacts[c];
        for (uint32_t i = 0; i == 0 || i < contact->sub_impacts_listed; i++) {
            const bool there = i < contact->sub_impacts_listed;
            const struct percuss_sub_impact *sub = there ? &contact->sub_impacts[i] : &none;
            printf("%s%zu,", lead, c);
            csv_text(stdout, body_of(request, c, false));
            putchar(',');
            csv_text(stdout, body_of(request, c, true));
            printf(",%.17g,%.17g,%.17g,%u,%.17g,%s", contact->restitution,
                   reply_restitution_error(reply), contact->impulse, contact->sub_impact_count,
                   contact->end_time, percuss_status_name(reply->status));
            printf(",%u,%.17g,%.17g,%.17g,%.17g,%.17g,%d", there ? i + 1 : 0, sub->start, sub->end,
                   sub->impulse, sub->peak_force, sub->max_indentation, sub->negligible);
            if (friction)
                print_csv_friction(contact, sub);
            printf(",%.17g\n", reply_total_error(reply));
        }
    }
    reply_table_tell(reply);
}

static void add_json(struct query_output *output, const struct impact_run *run, double speed,
                     const struct percuss_ensemble_reply *spread)
{
    json_t *reply = reply_to_json(&run->reply);
    if (spread)
        json_object_set_new(reply, "spread", ensemble_to_json(spread));
    if (!output->several) {
        json_print(reply);
        return;
    }
    json_t *answer = json_object();
    json_object_set_new(answer, "speed", json_number(speed));
    json_object_set_new(
        answer, "contact_model",
        json_string(percuss_contact_model_name(run->request.options.contact_model)));
    json_object_set_new(answer, "reply", reply);
    if (!output->answers)
        output->answers = json_array();
    json_array_append_new(output->answers, answer);
}

static void add_csv(struct query_output *output, const struct impact_run *run, double speed)
{
    char lead[64] = "";
    if (output->several)
        snprintf(lead, sizeof lead, "%.17g,%s,", speed,
                 percuss_contact_model_name(run->request.options.contact_model));
    /* columns as the first answer has them, or the flags */
    if (output->count == 0) {
        output->friction = output->friction || reply_has_friction(&run->reply);
        reply_csv_head(output->several ? "speed,contact_model," : "", output->friction,
                       output->units);
    }
    reply_csv_print(lead, output->friction, &run->request, &run->reply);
}

static void add_table(const struct query_output *output, const struct impact_run *run, double speed)
{
    if (output->several)
        printf("%s%g m/s, contact model %s: ", output->count > 0 ? "\n" : "", speed,
               percuss_contact_model_name(run->request.options.contact_model));
    reply_table_print(&run->request, &run->reply, output->scene);
}

/* Prints the answer to this speed (m/s); `spread` is how it spreads, NULL: not asked for. */
static void query_output_add(struct query_output *output, const struct impact_run *run,
                             double speed, const struct percuss_ensemble_reply *spread)
{
    if (output->json)
        add_json(output, run, speed, spread);
    else if (output->csv)
        add_csv(output, run, speed);
    else
        add_table(output, run, speed);
    output->count++;
}

/* Prints the end of the output. */
static void query_output_end(struct query_output *output)
{
    if (output->answers)
        json_print(json_pack("{so}", "answers", output->answers));
    output->answers = NULL;
}

enum {
    KEY_SPEED = OPTION_OWN,
    KEY_DROP,
    KEY_SPEED_SIGMA,
    KEY_REQUEST,
    KEY_SPECIMEN_A,
    KEY_SPECIMEN_B,
    KEY_TRACE,
    KEY_HTML,
    KEY_MEASURED,
    KEY_CSV
};

enum { MOST_SPEEDS = 6 };

struct query {
    struct common *common;
    struct scene scene;
    double speeds[MOST_SPEEDS];
    bool dropped[MOST_SPEEDS]; /* until all is read that one is a height */
    size_t speed_count;
    double speed_sigma; /* standard deviation of the speed; 0: not given */
    const char *file;
    bool csv;
    const char *trace; /* file; NULL: not wanted */
    const char *html;  /* likewise */
    struct plot_output plot;
    struct impact_measured measured[MOST_SPEEDS]; /* laid over the picture */
    size_t measured_count;
    struct column_map columns; /* of these */
    const char *specimens[2];  /* of A, B; NULL: not given */
};

static const struct argp_option options[] = {
    {"speed", KEY_SPEED, "V", 0,
     "speed of A towards B, m/s or with a unit: 0.3, 300mm/s; it and --contact-model may be given "
     "several times: an answer for each",
     10},
    {"drop", KEY_DROP, "H", 0,
     "the speed of a fall from this height, m or with a unit: 300mm; as --speed it may be given "
     "several times; --gravity says by which gravity",
     10},
    {"speed-sigma", KEY_SPEED_SIGMA, "S", 0,
     "standard deviation of the speed: also tells how the restitution spreads", 10},
    {"specimen-a", KEY_SPECIMEN_A, "NAME", 0,
     "A is this specimen: its dents are kept by the server; percuss dents lists them", 20},
    {"specimen-b", KEY_SPECIMEN_B, "NAME", 0, "the same for B", 20},
    {"request", KEY_REQUEST, "FILE", 0, "ask a whole request in JSON instead; - is standard input",
     30},
    {"trace", KEY_TRACE, "FILE", 0, "write the time histories as comma-separated values", 40},
    {"html", KEY_HTML, "FILE", 0,
     "write the impact as a page for a browser: its bodies in motion, histories and numbers; - is "
     "standard output",
     40},
    {"measured", KEY_MEASURED, "FILE.csv", 0,
     "lay a measured history over the picture: columns time, velocity_a or displacement_a, and "
     "those of b; given several times, each over another speed",
     40},
    {"csv", KEY_CSV, NULL, 0,
     "print comma-separated values: a line for each sub-impact, with its contact's restitution",
     90},
    {0},
};

/* Refuses outputs that are of one answer alone. */
static void check_several(const struct query *query, struct argp_state *state)
{
    const struct scene *scene = &query->scene;
    bool several = query->speed_count > 1 || scene->model_count > 1;
    bool specimen = query->specimens[0] || query->specimens[1];
    const char *option = query->trace               ? "trace"
                         : query->html              ? "html"
                         : query->speed_sigma > 0.0 ? "speed-sigma"
                         : specimen                 ? "specimen"
                                                    : NULL;
    if (several && option)
        argp_error(state, "--%s: one --speed and one --contact-model are needed, not %zu and %zu",
                   option, query->speed_count, scene->model_count);
    if (query->measured_count > 0 && !plot_wanted(&query->plot))
        argp_error(state, "--measured is laid over a picture: --plot FILE is needed");
    if (query->columns.count > 0 && query->measured_count == 0)
        argp_error(state, "--column is of a file that is measured: --measured FILE is needed");
    if (query->measured_count > 1 && query->measured_count > query->speed_count)
        argp_error(state, "--measured: one a speed at most, not %zu of %zu", query->measured_count,
                   query->speed_count);
}

/* Either a scene or a whole request. */
static void query_check(const struct query *query, struct argp_state *state)
{
    const struct scene *scene = &query->scene;
    bool specimen = query->specimens[0] || query->specimens[1];
    if (query->file &&
        (scene->given || specimen || query->speed_count > 0 || query->speed_sigma > 0.0))
        argp_error(state, "--request says everything; no other flag of the impact goes with it");
    scene_check_one_b(scene, state);
    check_several(query, state);
    if (query->csv && (query->common->json || query->speed_sigma > 0.0))
        argp_error(state, "--csv or %s, not both",
                   query->common->json ? "--json" : "--speed-sigma");
    const struct scene_need speed = {"--speed V or --drop H", query->speed_count > 0};
    if (!query->file)
        scene_check_given(scene, &speed, 1, " (or a whole request: --request FILE)", state);
}

/* A speed, or the height of a fall. */
static void parse_speed(const char *text, bool drop, struct query *query, struct argp_state *state)
{
    const char *option = drop ? "drop" : "speed";
    double speed =
        parse_positive_quantity(option, text, drop ? QUANTITY_LENGTH : QUANTITY_SPEED, state);
    if (query->speed_count == MOST_SPEEDS)
        argp_error(state, "--%s: '%s': at most %d speeds; percuss sweep takes more", option, text,
                   MOST_SPEEDS);
    query->dropped[query->speed_count] = drop;
    query->speeds[query->speed_count++] = speed;
}

/* Reads a measured history and lays its first touch on time 0; usage error with the reason. */
static void read_measured(const struct query *query, struct impact_measured *measured,
                          struct argp_state *state)
{
    struct history history;
    struct history_impacts impacts;
    struct measured_remarks remarks = {0};
    struct measured_fault fault;
    bool good = history_read(measured->file, &query->columns, &history, &remarks);
    if (good && history.acceleration_a)
        good =
            remarks_wrong(&remarks, "%s: an acceleration tells no velocity to lay over a picture",
                          measured->file);
    if (good && !history_find(&history, &impacts, &fault))
        good = remarks_wrong(&remarks, "%s: %.400s", measured->file, fault.text);
    if (good && !history_align(&history, &impacts, &measured->motion))
        good = remarks_wrong(&remarks, "%s: out of memory", measured->file);
    history_free(&history);
    measured_file_complain("--measured: ", &remarks);
    if (!good)
        argp_error(state, "--measured: '%s' is not read", measured->file);
}

static void add_measured(const char *file, struct query *query, struct argp_state *state)
{
    if (query->measured_count == MOST_SPEEDS)
        argp_error(state, "--measured: '%s': at most %d files", file, MOST_SPEEDS);
    query->measured[query->measured_count++].file = file;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct query *query = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        measured_scene_inputs(
            state, (void *[]){&query->scene, query->common, &query->plot, &query->columns});
        return 0;
    /* the impact */
    case KEY_SPEED:
    case KEY_DROP:
        parse_speed(text, key == KEY_DROP, query, state);
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
    case KEY_HTML:
        query->html = html_page_file(text, state);
        return 0;
    case KEY_CSV:
        query->csv = true;
        return 0;
    case KEY_MEASURED:
        add_measured(text, query, state);
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        for (size_t i = 0; i < query->speed_count; i++)
            if (query->dropped[i])
                query->speeds[i] = fall_speed(query->speeds[i], column_gravity(&query->columns));
        query_check(query, state);
        /* once all is known that is said of their columns */
        for (size_t i = 0; i < query->measured_count; i++)
            read_measured(query, &query->measured[i], state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

const struct argp query_argp = {
    .options = options,
    .parser = parse,
    .doc =
        "Asks for one impact: A moves at speed V straight at B, or at an angle, which is at rest, "
        "and hits it at the bodies' default sites; or whatever a JSON request says.\v"
        "Examples: percuss query --a steel-sphere --b al-beam --speed 0.3 --at 0.25\n"
        "percuss query --a steel-sphere --b al-beam --speed 0.3 --angle 30 --friction 0.3",
    .children = measured_scene_children,
};

/* Everything that a query asks. */
struct asking {
    const struct query *query;
    struct percuss_client *client;
    struct scene_text text; /* of a scene */
    struct query_output output;
    size_t count; /* answers wanted: of the first speed by all models, then of the next */
    struct impact_run *runs;
};

static bool begin(struct asking *asking, const struct query *query)
{
    size_t speeds = query->file ? 1 : query->speed_count;
    size_t models = query->scene.model_count > 1 ? query->scene.model_count : 1;
    *asking = (struct asking){.query = query, .count = speeds * models};
    asking->output = (struct query_output){.json = query->common->json,
                                           .csv = query->csv,
                                           .units = query->common->units,
                                           .friction = query->scene.askew,
                                           .several = asking->count > 1};
    asking->runs = calloc(asking->count, sizeof *asking->runs);
    return asking->runs != NULL;
}

static void end(struct asking *asking)
{
    for (size_t k = 0; asking->runs && k < asking->count; k++) {
        percuss_trace_free(&asking->runs[k].trace);
        percuss_reply_free(&asking->runs[k].reply);
    }
    free(asking->runs);
    percuss_client_free(asking->client);
}

/* Names the known bodies after the server refused one. */
static void explain_unknown(const struct asking *asking, const struct percuss_request *request)
{
    const struct common *common = asking->query->common;
    struct percuss_body_list list;
    if (percuss_bodies(asking->client, common_timeout(common), &list) == PERCUSS_RESULT_OK)
        scene_explain_unknown(common, asking->client, request, &list);
    percuss_body_list_free(&list);
}

/* Asks one question and prints the answer. */
static int ask(struct asking *asking, struct impact_run *run, double speed)
{
    const struct query *query = asking->query;
    struct percuss_ensemble_reply spread = {0};
    double timeout = common_timeout(query->common);
    /* histories only where something is made of them */
    bool traced = query->trace || query->html || plot_wanted(&query->plot);
    waiting_begin(query->common, asking->client, NULL);
    enum percuss_result result =
        traced
            ? percuss_solve_traced(asking->client, &run->request, timeout, &run->reply, &run->trace)
            : percuss_solve(asking->client, &run->request, timeout, &run->reply);
    if (result != PERCUSS_RESULT_OK)
        return complain_result(result);
    /* the spread of the answer by that of the speed */
    bool spreads = query->speed_sigma > 0.0 && run->reply.contact_count > 0;
    const double share = scene_normal_share(&query->scene);
    if (spreads)
        result = spread_ask(asking->client, &run->request, share * speed,
                            share * query->speed_sigma, timeout, &spread);
    waiting_end();
    query_output_add(&asking->output, run, speed, spreads && !result ? &spread : NULL);
    if (spreads && !result && !query->common->json)
        spread_print(query->speed_sigma, &spread);
    if (run->reply.status == PERCUSS_UNKNOWN_BODY)
        explain_unknown(asking, &run->request);
    percuss_ensemble_reply_free(&spread);
    return result == PERCUSS_RESULT_OK ? status_exit_code(run->reply.status)
                                       : complain_result(result);
}

/* The page of the one answer. */
static int write_page(const struct asking *asking)
{
    const struct query *query = asking->query;
    struct percuss_body_list list;
    enum percuss_result result =
        percuss_bodies(asking->client, common_timeout(query->common), &list);
    int code = result == PERCUSS_RESULT_OK
                   ? html_impact(query->html, &asking->runs[0], &list,
                                 query->file ? NULL : asking->text.title, query->common)
                   : complain_result(result);
    percuss_body_list_free(&list);
    return code;
}

/* Files of the histories; a refused one has none. */
static int write_files(const struct asking *asking)
{
    const struct query *query = asking->query;
    for (size_t k = 0; k < asking->count; k++)
        if (asking->runs[k].trace.contact_count == 0)
            return EXIT_ANSWERED;
    int code = EXIT_ANSWERED;
    if (query->trace)
        code = write_trace_csv(query->trace, &asking->runs[0].trace, query->common->units);
    size_t speeds = query->file ? 1 : query->speed_count;
    const struct impact_picture picture = {speeds,
                                           asking->count / speeds,
                                           asking->runs,
                                           query->file ? NULL : query->speeds,
                                           query->file ? NULL : asking->text.title,
                                           query->measured_count,
                                           query->measured};
    if (code == EXIT_ANSWERED && plot_wanted(&query->plot))
        code = plot_impact(&query->plot, &picture);
    if (code == EXIT_ANSWERED && query->html)
        code = write_page(asking);
    return code;
}

/* Ends the output that `ask` began, and writes files; the exit code of both. */
static int finish(struct asking *asking, int code)
{
    query_output_end(&asking->output);
    int written = write_files(asking);
    return written != EXIT_ANSWERED ? written : code;
}

static int scene_question(const struct query *query, const struct scene_bodies *bodies,
                          double speed, struct percuss_request *request)
{
    int code = scene_request(&query->scene, bodies, speed, request);
    for (int i = 0; code == EXIT_ANSWERED && i < 2; i++)
        if (query->specimens[i])
            strcpy(request->bodies[i].specimen, query->specimens[i]); /* it fits: it was parsed */
    return code;
}

/* All speeds by all models; the worst of the replies decides about the exit code. */
static int ask_each(struct asking *asking, const struct scene_bodies *bodies)
{
    const struct query *query = asking->query;
    size_t models = asking->count / query->speed_count;
    int code = EXIT_ANSWERED, worst = EXIT_ANSWERED;
    for (size_t k = 0; k < asking->count && code == EXIT_ANSWERED; k++) {
        struct impact_run *run = &asking->runs[k];
        double speed = query->speeds[k / models];
        code = scene_question(query, bodies, speed, &run->request);
        if (code != EXIT_ANSWERED)
            break;
        if (models > 1)
            run->request.options.contact_model = query->scene.models[k % models];
        int asked = ask(asking, run, speed);
        worst = asked > worst ? asked : worst;
        /* without a reply there are no others */
        code = asking->output.count > k ? EXIT_ANSWERED : asked;
    }
    return code > worst ? code : worst;
}

static int ask_scene(const struct query *query, struct asking *asking)
{
    struct scene_bodies bodies;
    int code = open_client(query->common, NULL, &asking->client);
    if (code != EXIT_ANSWERED)
        return code;
    /* bodies of the catalogue, placed in contact */
    code = scene_find_bodies(&query->scene, query->common, asking->client, &bodies);
    if (code == EXIT_ANSWERED) {
        asking->text = scene_describe(&query->scene, &bodies);
        asking->output.scene = &asking->text;
        code = finish(asking, ask_each(asking, &bodies));
    }
    percuss_body_list_free(&bodies.list);
    return code;
}

static int ask_file(const struct query *query, struct asking *asking)
{
    struct json_fault fault;
    struct json_request *request = malloc(sizeof *request);
    if (!request)
        return complain_memory();
    int code = EXIT_USAGE;
    if (!request_json_load(query->file, request, &fault))
        complain("%s", fault.text);
    else
        code = open_client(query->common, request->has_client ? request->client : NULL,
                           &asking->client);
    if (code == EXIT_ANSWERED) {
        asking->runs[0].request = request->request;
        code = finish(asking, ask(asking, &asking->runs[0], NAN));
    }
    free(request);
    return code;
}

int command_query(int argc, char **argv, struct common *common)
{
    struct query query = {.common = common, .scene = scene_default()};
    struct asking asking;
    argp_parse(&query_argp, argc, argv, 0, NULL, &query);
    for (size_t i = 0; i < query.speed_count && !common->json; i++)
        scene_doubt_speed(query.speeds[i]);
    int code = !begin(&asking, &query) ? complain_memory()
               : query.file            ? ask_file(&query, &asking)
                                       : ask_scene(&query, &asking);
    end(&asking);
    for (size_t i = 0; i < query.measured_count; i++)
        history_motion_free(&query.measured[i].motion);
    return code;
}
