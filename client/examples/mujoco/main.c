/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* MuJoCo stays on the slow scale and asks percussd at every impact. run.sh starts all that is
 * needed. */
#include <argp.h>
#include <errno.h>
#include <math.h>
#include <percuss/slow_link.h>
#include <stdlib.h>
#include <string.h>

#include "records.h"
#include "scenes.h"

struct choice {
    unsigned domain;
    double restitution, tolerance, step;
    bool alone, total, falls_back;
    const char *scenes, *output, *only;
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct choice *choice = state->input;
    char *end = NULL;
    switch (key) {
    /* numbers, checked below */
    case 'd':
        choice->domain = (unsigned)strtoul(text, &end, 10);
        break;
    case 'e':
        choice->restitution = strtod(text, &end);
        break;
    case 't':
        choice->tolerance = strtod(text, &end);
        break;
    case 'h':
        choice->step = strtod(text, &end);
        if (!(choice->step > 0.0 && choice->step < INFINITY))
            argp_error(state, "--fixed-steps: '%s': a number of seconds > 0 is needed", text);
        break;
    /* how impacts are taken */
    case 'n':
        choice->alone = true;
        break;
    case 'T':
        choice->total = true;
        break;
    case 'f':
        choice->falls_back = true;
        break;
    /* which scenes, and where they go */
    case 's':
        choice->scenes = text;
        break;
    case 'o':
        choice->output = text;
        break;
    case 'S':
        choice->only = text;
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    if (end && *end)
        argp_error(state, "'%s' is not a number", text);
    return 0;
}

static const struct argp_option options[] = {
    {"domain", 'd', "N", 0, "DDS domain of percussd (0)", 0},
    {"no-service", 'n', 0, 0, "ask nobody: every impact has the declared restitution", 0},
    {"restitution", 'e', "E", 0, "declared, for --no-service and --fall-back (0.4)", 0},
    {"fall-back", 'f', 0, 0, "go on with the declared restitution when no answer comes", 0},
    {"tolerance", 't', "T", 0, "on the restitution asked for (1e-4)", 0},
    {"total", 'T', 0, 0, "apply the whole impulse at the start, not each sub-impact at its time",
     0},
    {"fixed-steps", 'h', "S", 0,
     "never go back to a touch: steps of S seconds, each touch found behind it", 0},
    {"scenes", 's', "DIR", 0, "where the models are (scenes)", 0},
    {"scene", 'S', "NAME", 0, "only this one", 0},
    {"output", 'o', "DIR", 0, "where the CSV files go (.)", 0},
    {0}};

static FILE *create(const struct choice *choice, const char *scene, const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s%s", choice->output, scene, name);
    FILE *file = fopen(path, "w");
    if (!file) {
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
        exit(EXIT_FAILURE);
    }
    return file;
}

static bool open_scene(const struct choice *choice, const struct scene *scene,
                       struct engine *engine)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s.xml", choice->scenes, scene->name);
    if (!engine_open(engine, path, scene->body_count, scene->bodies))
        return false;
    scene_start(scene, engine);
    return true;
}

/* The same scene with MuJoCo's own contact: its first impact. */
static void run_mujoco_alone(const struct choice *choice, const struct scene *scene)
{
    struct engine engine;
    struct percuss_slow_contact contacts[ENGINE_CONTACTS], touching = {0};
    if (!open_scene(choice, scene, &engine))
        exit(EXIT_FAILURE);
    for (int i = 0; i < engine.model->ngeom; i++)
        engine.model->geom_margin[i] = engine.model->geom_gap[i] = 0.0;
    double first = NAN, before = NAN;
    while (engine.data->time < scene->duration) {
        mj_step(engine.model, engine.data);
        mj_forward(engine.model, engine.data);
        if (engine_contacts(&engine, false, contacts)) {
            touching = contacts[0];
            if (isnan(first)) {
                first = engine.data->time;
                before = engine_gap_rate(&engine, &touching);
            }
        } else if (!isnan(first)) {
            printf("  MuJoCo alone, default contact: e = %.4f, bodies together for %.0f ms\n",
                   -engine_gap_rate(&engine, &touching) / before,
                   1e3 * (engine.data->time - first));
            engine_close(&engine);
            return;
        }
    }
    printf("  MuJoCo alone, default contact: the bodies stay together\n");
    engine_close(&engine);
}

static void write_motion(struct engine *engine, FILE *file)
{
    struct percuss_slow_contact contacts[ENGINE_CONTACTS];
    size_t count = engine_contacts(engine, false, contacts);
    fprintf(file, "%.9g,%.12g", engine->data->time, engine_kinetic_energy(engine));
    for (uint32_t body = 0; body + 1 < engine->body_count; body++) {
        double gap = NAN, rate = NAN;
        for (size_t i = 0; i < count; i++)
            if (contacts[i].a == body || contacts[i].b == body) {
                gap = contacts[i].gap;
                rate = engine_gap_rate(engine, &contacts[i]);
            }
        const double *place = engine->data->xipos + 3 * engine->bodies[body];
        fprintf(file, ",%.9g,%.9g,%.12g", place[0], gap, rate);
    }
    fprintf(file, ",%.9g\n",
            engine->data->xipos[3 * engine->bodies[engine->body_count - 1]]); /* the bar */
}

/* Runs a scene with the slow scale; false: said on stderr. */
static bool run(const struct choice *choice, const struct scene *scene, struct records *records,
                struct percuss_slow_service service)
{
    struct engine engine;
    struct percuss_slow_body bodies[ENGINE_BODIES] = {{0}};
    struct percuss_slow *slow;
    if (!open_scene(choice, scene, &engine))
        return false;
    for (size_t i = 0; i < scene->body_count; i++)
        bodies[i] = (struct percuss_slow_body){.id = scene->bodies[i].id};
    struct percuss_slow_config config = percuss_slow_config_default();
    config.body_count = scene->body_count;
    config.bodies = bodies;
    engine.fixed = choice->step > 0.0;
    if (engine.fixed)
        engine.model->opt.timestep = choice->step;
    engine_configure(&engine, &config);
    config.service = service;
    config.options.tolerance = choice->tolerance;
    config.application = choice->total ? PERCUSS_SLOW_TOTAL : PERCUSS_SLOW_LIST;
    config.restitution = choice->restitution;
    config.fall_back = choice->falls_back;
    config.report = records_report;
    config.report_context = records;
    records->engine = &engine;
    enum percuss_result result = percuss_slow_create(&config, &slow);
    FILE *motion = create(choice, scene->name, ".csv");
    double step = engine.model->opt.timestep; /* s */
    while (!result && engine.data->time < scene->duration) {
        result = engine_step(&engine, slow, step);
        write_motion(&engine, motion);
    }
    fclose(motion);
    if (result)
        fprintf(stderr, "%s: %s\n", scene->name, percuss_slow_error_text());
    records_finish(records);
    if (slow) {
        struct percuss_slow_counts counts = percuss_slow_counts(slow);
        printf("  the impulses took %.12g J from MuJoCo's bodies\n", engine.taken);
        printf("  %llu impacts, %llu requests (%llu repeated, %llu preempted), %llu declared\n",
               (unsigned long long)counts.impacts, (unsigned long long)counts.requests,
               (unsigned long long)counts.repeated, (unsigned long long)counts.preempted,
               (unsigned long long)counts.declared);
    }
    percuss_slow_free(slow);
    engine_close(&engine);
    return !result;
}

/* Connects to percussd; the service that asks it. */
static struct percuss_slow_service connect_service(const struct choice *choice,
                                                   struct percuss_slow_link *link)
{
    struct percuss_client_config config = percuss_client_config_default();
    struct percuss_client *client;
    config.domain = choice->domain;
    if (percuss_client_create(&config, &client) || percuss_client_connect(client, 5.0)) {
        fprintf(stderr, "%s\n", percuss_error_text());
        exit(EXIT_FAILURE);
    }
    *link = percuss_slow_link_default(client);
    return percuss_slow_link_service(link);
}

int main(int argc, char **argv)
{
    struct choice choice = {
        .restitution = 0.4, .tolerance = 1e-4, .scenes = "scenes", .output = "."};
    struct argp argp = {options, parse, NULL, "Impacts of MuJoCo scenes, by percussd.", 0, 0, 0};
    argp_parse(&argp, argc, argv, 0, NULL, &choice);
    static struct records records;
    struct percuss_slow_link link = {0};
    struct percuss_slow_service service = {0};
    if (!choice.alone)
        service = connect_service(&choice, &link);
    FILE *impacts = create(&choice, "impacts", ".csv");
    FILE *sub_impacts = create(&choice, "sub_impacts", ".csv");
    fprintf(impacts, "scene,impact,contact,time,gap_rate,impulse,applied,restitution,"
                     "restitution_reply,sub_impacts,source,delassus\n");
    fprintf(sub_impacts, "scene,impact,contact,time,start,end,peak_force,impulse,gap_rate_after\n");
    bool good = true;
    for (size_t i = 0; i < scene_count; i++) {
        if (choice.only && strcmp(choice.only, scenes[i].name) != 0)
            continue;
        printf("%s\n  impact     time/s  rate/(m/s)  W/(1/kg)  impulse/Ns  restitution  "
               "sub-impacts\n",
               scenes[i].name);
        records = (struct records){.scene = scenes[i].name, .sub_impacts = sub_impacts};
        good = run(&choice, &scenes[i], &records, service) && good;
        records_write(&records, impacts);
        run_mujoco_alone(&choice, &scenes[i]);
    }
    fclose(impacts);
    fclose(sub_impacts);
    percuss_client_free(link.client);
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
