/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The contact models side by side on the paper's rods: restitution, processor time of one solve,
 * and of what is computed once beforehand: the table, and the first solve's preparation of the
 * bodies. The tolerance is the default, 1e-3.
 * usage: contact_models [--csv] [--quick] [--speed V]... [--model NAME] [--case NAME] */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "measure.h"
#include "solve/solve.h"
#include "store/table_curves.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

enum { MAX_SPEEDS = 16, STRIKER, ROD, ROD_1, ROD_2, BODIES };

static const double sphere_radius = 0.015;

struct rods {
    struct body bodies[BODIES - STRIKER];
    struct body_set set;
};

static const struct {
    const char *name;
    int rod;
} cases[] = {{"rod-elastic", ROD}, {"rod-205", ROD_1}, {"rod-575", ROD_2}};

static const enum percuss_contact_model models[] = {
    PERCUSS_CONTACT_COMPLETE_FE, PERCUSS_CONTACT_CONCURRENT_FE, PERCUSS_CONTACT_TABLE,
    PERCUSS_CONTACT_CLOSED_FORM, PERCUSS_CONTACT_HERTZ};

struct settings {
    bool csv, quick;
    double speeds[MAX_SPEEDS];
    size_t speed_count;
    const char *model, *scene; /* only these; NULL: all */
};

/* One case and one model: what is solved again and again. */
struct question {
    const struct rods *rods;
    struct solve_workspace *workspace;
    struct solve_context means;
    struct solve_request request;
    struct solve_result result;
};

static bool fail(const char *text)
{
    fprintf(stderr, "contact_models: %s\n", text);
    return false;
}

static bool make_rods(struct rods *rods)
{
    static const double yields[] = {INFINITY, INFINITY, 205e6, 575e6};
    static const char *const ids[] = {"ball", "rod", "rod-1", "rod-2"};
    *rods = (struct rods){.set = {.bodies = rods->bodies,
                                  .count = COUNT(ids),
                                  .compliance = PERCUSS_COMPLIANCE_MATCHED,
                                  .revision = "contact_models"}};
    for (size_t i = 0; i < COUNT(ids); i++) {
        struct body *body = &rods->bodies[i];
        struct fault fault;
        *body = (struct body){.kind = &sphere_kind, .radius = sphere_radius};
        body->material = (struct material){"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
        if (i > 0) {
            body->material = (struct material){"aluminium", 70e9, 0.33, 2700.0, yields[i], 0.0};
            body->kind = &rod_kind;
            body->radius = 0.010;
            body->length = 1.0;
            body->tip_radius = INFINITY;
        }
        snprintf(body->id, sizeof body->id, "%s", ids[i]);
        if (body_complete(body, &fault))
            return fail(fault.text);
    }
    return true;
}

static void ask(struct question *question, int rod, enum percuss_contact_model model, double speed)
{
    struct solve_request *request = &question->request;
    const struct body *struck = &question->rods->bodies[rod - STRIKER];
    *request = (struct solve_request){.body_count = 2, .contact_count = 1};
    for (int i = 0; i < 2; i++)
        request->bodies[i].orientation[0] = 1.0;
    snprintf(request->bodies[0].id, sizeof request->bodies[0].id, "ball");
    snprintf(request->bodies[1].id, sizeof request->bodies[1].id, "%s", struck->id);
    request->bodies[0].position[0] = 0.5 * struck->length + sphere_radius;
    request->bodies[0].velocity[0] = -speed;
    request->contacts[0] =
        (struct solve_contact){.a = 0, .b = 1, .point = {0.5 * struck->length}, .normal = {1.0}};
    request->options.contact_model = model;
}

static bool solve_it(void *context)
{
    struct question *question = context;
    enum percuss_status status =
        solve(question->workspace, &question->means, &question->request, &question->result);
    return status == PERCUSS_OK || fail(question->result.fault.text);
}

static double seconds_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static const struct contact_curves *find_curves(void *context, const struct contact_pair *pair)
{
    (void)pair;
    return context;
}

/* The table of a pair, deep enough for a speed: the indentation of an elastic impact on a fixed
 * body, which takes all of the energy, and 30 % for flow. */
static struct contact_curves *make_curves(const struct rods *rods, int rod, double speed,
                                          bool quick)
{
    const struct body *ball = &rods->bodies[0];
    const struct body *struck = &rods->bodies[rod - STRIKER];
    struct region_input input = {
        .materials = {ball->material, struck->material},
        .radius = sphere_radius,
        .resolution = quick ? 8 : 12,
    };
    double compliance = 0.0;
    for (int i = 0; i < 2; i++)
        compliance += (1.0 - input.materials[i].poisson * input.materials[i].poisson) /
                      input.materials[i].young;
    double hertz = 4.0 / 3.0 / compliance * sqrt(sphere_radius);
    input.indentation = 1.3 * pow(0.5 * ball->mass * speed * speed / (0.4 * hertz), 0.4);
    struct indentation_table table;
    struct fault fault;
    if (indentation_table_make(&input, NULL, &table, &fault)) {
        fail(fault.text);
        return NULL;
    }
    struct contact_curves *curves;
    table_curves_make(&table, NULL, &curves, &fault);
    indentation_table_free(&table);
    if (!curves)
        fail(fault.text);
    return curves;
}

/* One line. */
static bool compare(const struct settings *settings, struct question *question, size_t which,
                    enum percuss_contact_model model, double speed)
{
    char name[64];
    struct contact_curves *curves = NULL;
    double start = seconds_now();
    double budget = settings->quick ? 0.05 : 0.5;
    /* finite elements within a solve prepare nothing, and are too long to be repeated */
    bool once = model == PERCUSS_CONTACT_COMPLETE_FE || model == PERCUSS_CONTACT_CONCURRENT_FE;
    if (model == PERCUSS_CONTACT_TABLE) {
        curves = make_curves(question->rods, cases[which].rod, speed, settings->quick);
        if (!curves)
            return false;
    }
    struct contact_table_source source = {.context = curves, .find = find_curves};
    question->workspace = solve_workspace_create();
    if (!question->workspace)
        return fail("out of memory");
    question->means = (struct solve_context){&question->rods->set, curves ? &source : NULL, {0}};
    ask(question, cases[which].rod, model, speed);
    if (settings->quick && once)
        question->request.options.tolerance = 0.01;
    bool ok = solve_it(question);
    double before = seconds_now() - start;
    double seconds = once ? before : measure(solve_it, question, budget);
    before = once ? 0.0 : before;
    snprintf(name, sizeof name, "%s-%g", cases[which].name, speed);
    const char *form =
        settings->csv ? "%s,%s,%.6f,%.4e,%.4e\n" : "%-16s %-14s %9.6f %11.3e %11.3e\n";
    if (ok)
        printf(form, name, contact_model_name(model), question->result.contacts[0].restitution,
               seconds, before);
    fflush(stdout);
    solve_workspace_free(question->workspace);
    contact_curves_free(curves);
    return ok;
}

static bool parse(int argc, char **argv, struct settings *settings)
{
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--csv") == 0)
            settings->csv = true;
        else if (strcmp(argv[i], "--quick") == 0)
            settings->quick = true;
        else if (strcmp(argv[i], "--model") == 0 && i + 1 < argc)
            settings->model = argv[++i];
        else if (strcmp(argv[i], "--case") == 0 && i + 1 < argc)
            settings->scene = argv[++i];
        else if (strcmp(argv[i], "--speed") == 0 && i + 1 < argc &&
                 settings->speed_count < MAX_SPEEDS)
            settings->speeds[settings->speed_count++] = strtod(argv[++i], NULL);
        else
            return false;
    }
    if (settings->speed_count == 0)
        settings->speeds[settings->speed_count++] = 0.3;
    return true;
}

int main(int argc, char **argv)
{
    struct settings settings = {0};
    static struct rods rods;
    static struct question question = {.rods = &rods};
    bool ok = true;
    if (!parse(argc, argv, &settings)) {
        fprintf(stderr, "usage: contact_models [--csv] [--quick] [--speed V]... [--model NAME] "
                        "[--case NAME]\n");
        return 2;
    }
    if (!make_rods(&rods))
        return 1;
    printf(settings.csv ? "%s,%s,%s,%s,%s\n" : "%-16s %-14s %9s %11s %11s\n", "case", "model",
           "restitution", "seconds", "precompute_seconds");
    for (size_t c = 0; c < COUNT(cases) - settings.quick; c++) {
        if (settings.scene && strcmp(settings.scene, cases[c].name) != 0)
            continue;
        for (size_t s = 0; s < settings.speed_count; s++)
            for (size_t m = 0; m < COUNT(models); m++)
                if (!settings.model || strcmp(settings.model, contact_model_name(models[m])) == 0)
                    ok = compare(&settings, &question, c, models[m], settings.speeds[s]) && ok;
    }
    return ok ? 0 : 1;
}
