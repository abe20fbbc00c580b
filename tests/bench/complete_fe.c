/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Complete finite elements on three meshes each: e against the mesh, its extrapolation and error,
 * the energy balance and the user time of the process.
 * usage: complete_fe [--csv] [--quick] [--cells N] [--scene PART-OF-A-NAME] [--speed V] */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "fe/impact_complete.h"

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
    double speed; /* only this one; 0: all */
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
        printf("scene,yield_mpa,speed,cells,elements,plastic_elements,steps,restitution,"
               "peak_force,contact_us,energy_closure,user_s\n");
    else
        printf("%-9s %6s %5s %6s %8s %8s %9s %9s %9s %8s %9s %7s\n", "scene", "yield", "m/s",
               "cells", "elements", "plastic", "e", "+-", "peak N", "us", "closure", "user s");
}

/* One line; `error` is NAN but for an extrapolated one, which has cells 0. */
static void line(const struct settings *settings, const char *name,
                 const struct complete_problem *problem, const struct complete_result *result,
                 double restitution, double error, double seconds)
{
    double yield = 1e-6 * problem->b.material.yield;
    double closure = result->energy.closure / result->energy.available;
    if (settings->csv && isnan(error))
        printf("%s,%g,%g,%u,%zu,%zu,%zu,%.6f,%.2f,%.3f,%.1e,%.2f\n", name, yield, problem->speed,
               problem->cells, result->elements, result->plastic_elements, result->steps,
               restitution, result->peak_force, 1e6 * result->contact_time, closure, seconds);
    else if (settings->csv)
        printf("%s,%g,%g,extrapolated,,,,%.6f,,,%.1e,%.2f\n", name, yield, problem->speed,
               restitution, error, seconds);
    else if (isnan(error))
        printf("%-9s %6g %5g %6u %8zu %8zu %9.6f %9s %9.2f %8.3f %9.1e %7.2f\n", name, yield,
               problem->speed, problem->cells, result->elements, result->plastic_elements,
               restitution, "", result->peak_force, 1e6 * result->contact_time, closure, seconds);
    else
        printf("%-9s %6g %5g %6s %8s %8s %9.6f %9.6f\n", name, yield, problem->speed, "limit", "",
               "", restitution, error);
    fflush(stdout);
}

/* Three meshes; the time of each is measured by solving them one by one. */
static bool run(const struct settings *settings, const char *name,
                const struct complete_problem *problem)
{
    struct complete_convergence convergence;
    struct fault fault = {""};
    double e[3];
    for (int i = 0; i < 3; i++) {
        struct complete_problem one = *problem;
        one.cells = problem->cells >> (2 - i);
        double start = user_seconds();
        if (impact_complete_solve(&one, &convergence.result[i], &fault) != PERCUSS_OK) {
            fprintf(stderr, "complete_fe: %s: %s\n", name, fault.text);
            return false;
        }
        e[i] = convergence.result[i].restitution;
        line(settings, name, &one, &convergence.result[i], e[i], NAN, user_seconds() - start);
    }
    impact_complete_extrapolate(&convergence);
    line(settings, name, problem, &convergence.result[2], convergence.restitution,
         convergence.error, 0.0);
    return fabs(convergence.result[2].energy.closure) <
           1e-3 * convergence.result[2].energy.available;
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
    return settings->cells >= 16;
}

int main(int argc, char **argv)
{
    struct settings settings = {.cells = 24, .scene = ""};
    if (!parse(argc, argv, &settings)) {
        fprintf(stderr, "usage: complete_fe [--csv] [--quick] [--cells N >= 16] [--scene NAME] "
                        "[--speed V]\n");
        return 2;
    }
    if (settings.quick)
        settings.cells = 16;
    bool ok = true;
    header(&settings);
    for (size_t t = 0; t < COUNT(targets); t++)
        for (size_t i = 0; i < COUNT(loads); i++) {
            if ((t > 0 && loads[i].rod_only) || !strstr(targets[t].name, settings.scene) ||
                (settings.speed > 0.0 && loads[i].speed != settings.speed) ||
                (settings.quick && !(targets[t].quick && loads[i].quick)))
                continue;
            struct complete_problem problem = {
                .a = {COMPLETE_SPHERE, 0.015, 0.0, steel},
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
