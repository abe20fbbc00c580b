/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Complete finite elements on three meshes and six phases each: e against the mesh and what its
 * phases still hide, the limit and its error, and of the solution nearest it peak force, contact
 * time and energy balance; the user time of all.
 * usage: complete_fe [--csv] [--quick] [--cells N] [--scene PART-OF-A-NAME] [--speed V] */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "fe/complete_converge.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
static const struct material aluminium = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0};

/* what a steel sphere of 15 mm hits; the cylinder has the rod's mass */
static const struct {
    const char *name;
    struct complete_body target;
    bool quick;
} targets[] = {
    {"rod", {.shape = COMPLETE_CYLINDER, .radius = 0.01, .length = 1.0}, true},
    {"cylinder", {.shape = COMPLETE_CYLINDER, .radius = 0.0369, .length = 0.073443}, true},
    {"block", {.shape = COMPLETE_CYLINDER, .radius = 0.1, .length = 0.1}, false},
    {"sphere", {.shape = COMPLETE_SPHERE, .radius = 0.015}, false},
};

static const struct {
    double yield, speed;
    bool rod_only, quick;
} loads[] = {
    {INFINITY, 0.05, true, false}, {INFINITY, 0.1, true, false}, {INFINITY, 0.3, false, true},
    {INFINITY, 0.5, true, false},  {205e6, 0.05, true, false},   {205e6, 0.1, true, false},
    {205e6, 0.3, false, true},     {205e6, 0.5, true, false},    {575e6, 0.3, true, false},
    {575e6, 0.5, true, false},
};

struct settings {
    bool csv, quick;
    unsigned cells; /* of the finest mesh */
    const char *scene;
    double speed;     /* only this one; 0: all */
    double tolerance; /* 0: all meshes and phases */
};

static double user_seconds(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec;
}

static void header(const struct settings *settings)
{
    if (settings->csv)
        printf("scene,yield_mpa,speed,cells,restitution,error,elements,plastic_elements,"
               "peak_force,contact_us,energy_closure,user_s\n");
    else
        printf("%-9s %6s %5s %6s %9s %9s %8s %8s %9s %8s %9s %7s\n", "scene", "yield", "m/s",
               "cells", "e", "+-", "elements", "plastic", "peak N", "us", "closure", "user s");
}

static void print_found(const struct settings *settings, const char *name,
                        const struct complete_problem *problem,
                        const struct complete_convergence *found, double seconds)
{
    double yield = 1e-6 * problem->b.material.yield;
    const char *form = settings->csv ? "%s,%g,%g,%u,%.6f,%.6f\n" : "%-9s %6g %5g %6u %9.6f %9.6f\n";
    for (unsigned m = 0; m < found->meshes; m++)
        printf(form, name, yield, problem->speed, found->swing[m].cells, found->swing[m].mean,
               found->swing[m].jitter);
    form = settings->csv ? "%s,%g,%g,limit,%.6f,%.6f,%zu,%zu,%.2f,%.3f,%.1e,%.2f\n"
                         : "%-9s %6g %5g  limit %9.6f %9.6f %8zu %8zu %9.2f %8.3f %9.1e %7.2f\n";
    const struct complete_result *result = &found->result;
    printf(form, name, yield, problem->speed, found->restitution, found->error, result->elements,
           result->plastic_elements, result->peak_force, 1e6 * result->contact_time,
           result->energy.closure / result->energy.available, seconds);
    fflush(stdout);
}

static bool run(const struct settings *settings, const char *name,
                const struct complete_problem *problem)
{
    static struct complete_convergence found;
    struct fault fault = {""};
    double start = user_seconds();
    if (complete_converge(problem, settings->tolerance, &found, &fault) != PERCUSS_OK) {
        fprintf(stderr, "complete_fe: %s: %s\n", name, fault.text);
        return false;
    }
    print_found(settings, name, problem, &found, user_seconds() - start);
    return fabs(found.result.energy.closure) < 1e-3 * found.result.energy.available;
}

static bool parse(int argc, char **argv, struct settings *settings)
{
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--csv") == 0)
            settings->csv = true;
        else if (strcmp(argv[i], "--quick") == 0)
            settings->quick = true;
        else if (strcmp(argv[i], "--cells") == 0 && i + 1 < argc)
            settings->cells = (unsigned)strtoul(argv[++i], NULL, 10);
        else if (strcmp(argv[i], "--scene") == 0 && i + 1 < argc)
            settings->scene = argv[++i];
        else if (strcmp(argv[i], "--speed") == 0 && i + 1 < argc)
            settings->speed = strtod(argv[++i], NULL);
        else
            return false;
    }
    return settings->cells >= 16 && settings->cells % 4 == 0;
}

int main(int argc, char **argv)
{
    struct settings settings = {.cells = 24, .scene = ""};
    if (!parse(argc, argv, &settings)) {
        fprintf(stderr, "usage: complete_fe [--csv] [--quick] [--cells N >= 16] [--scene NAME] "
                        "[--speed V]\n");
        return 2;
    }
    if (settings.quick) {
        settings.cells = 16;
        settings.tolerance = 4e-3; /* two meshes */
    }
    bool ok = true;
    header(&settings);
    for (size_t t = 0; t < COUNT(targets); t++)
        for (size_t i = 0; i < COUNT(loads); i++) {
            if ((t > 0 && loads[i].rod_only) || !strstr(targets[t].name, settings.scene) ||
                (settings.speed > 0.0 && loads[i].speed != settings.speed) ||
                (settings.quick && !(targets[t].quick && loads[i].quick)))
                continue;
            struct complete_problem problem = {
                .a = {.shape = COMPLETE_SPHERE, .radius = 0.015, .material = steel},
                .b = targets[t].target,
                .speed = loads[i].speed,
                .cells = settings.cells,
                .horizon = 5e-3,
            };
            problem.b.material = aluminium;
            problem.b.material.yield = loads[i].yield;
            ok = run(&settings, targets[t].name, &problem) && ok;
        }
    return ok ? 0 : 1;
}
