/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Speed against error: the library and general methods on the same problems, see
 * docs/lab/work-precision.md. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure.h"
#include "methods.h"

static const char usage[] =
    "usage: work_precision [--csv] [--quick] [--scene NAME]\n"
    "Solves the benchmark's scenes by several methods and prints the median time of a solve and\n"
    "its error in the restitution against a converged solution of the same model.\n"
    "  --csv         scene,method,setting,restitution,error,seconds\n"
    "  --quick       the small scenes and few settings, some seconds\n"
    "  --scene NAME  one scene only\n"
    "Methods modal, cvode-adams, cvode-bdf, arkode-explicit, verlet solve the same modes: their\n"
    "error is that of the time integration. modal-solve is the whole answer at a tolerance, with\n"
    "its own choice of modes and error estimate, modal-first the same by a workspace that knows "
    "no\n"
    "body yet; modal-modes and modal-plain vary the number of modes with and without residual\n"
    "flexibility; their error is against all modes.\n";

struct options {
    bool quick;
    const char *scene; /* NULL: all */
};

/* A method at a range of settings on the fixed problem. */
struct bench {
    struct report report;
    const struct fixed_scene *fixed;
    bool quick;
};

static bool run_modal(void *method)
{
    return method_run_modal(method);
}

static bool run_phases(void *method)
{
    return method_run_phases(method);
}

static bool run_whole(void *method)
{
    return method_run_whole(method);
}

static bool run_verlet(void *method)
{
    return method_run_verlet(method);
}

static void measure_method(const struct bench *bench, const char *name, const char *setting,
                           solver_run *run, struct method *method, bool opened)
{
    double seconds = opened ? measure(run, method, bench->report.budget) : -1.0;
    report_line(&bench->report, name, setting, method->restitution, seconds);
    method_close(method);
}

static void sweep_modal(const struct bench *bench)
{
    for (int digits = 1; digits <= 13; digits += bench->quick ? 3 : 1) {
        struct method method;
        char setting[64];
        double accuracy = pow(10.0, -digits);
        snprintf(setting, sizeof setting, "accuracy=1e-%02d", digits);
        bool opened = method_open_modal(&method, bench->fixed, accuracy);
        measure_method(bench, "modal", setting, run_modal, &method, opened);
    }
}

/* A method of SUNDIALS with what can be chosen. */
struct candidate {
    const char *name;
    integrator_maker *make;
    int order;
    bool energetic, whole;
    int loosest, tightest, stride; /* decimal digits of the tolerance */
};

static const struct candidate candidates[] = {
    {"cvode-adams", integrator_adams, 0, true, false, 3, 14, 1},
    {"cvode-adams", integrator_adams, 0, false, false, 3, 14, 1},
    {"cvode-adams", integrator_adams, 0, false, true, 5, 13, 2},
    {"cvode-bdf", integrator_bdf, 0, true, false, 3, 13, 1},
    {"cvode-bdf", integrator_bdf, 0, false, false, 3, 13, 1},
    {"cvode-bdf", integrator_bdf, 0, false, true, 6, 12, 2},
    {"arkode-explicit", integrator_explicit, 5, false, false, 2, 13, 1},
    {"arkode-explicit", integrator_explicit, 8, false, false, 3, 13, 2},
    {"arkode-explicit", integrator_explicit, 5, false, true, 3, 11, 2},
};

static void sweep_candidate(const struct bench *bench, const struct candidate *candidate)
{
    for (int digits = candidate->loosest; digits <= candidate->tightest;
         digits += bench->quick ? 4 : candidate->stride) {
        struct method method;
        char setting[64];
        char order[16] = "";
        struct integrator_settings settings = {.tolerance = pow(10.0, -digits),
                                               .energetic = candidate->energetic,
                                               .order = candidate->order};
        if (candidate->order)
            snprintf(order, sizeof order, " order=%d", candidate->order);
        snprintf(setting, sizeof setting, "tolerance=1e-%02d %s %s%s", digits,
                 candidate->whole ? "whole" : "phases",
                 candidate->energetic ? "energetic" : "uniform", order);
        bool opened = method_open_integrator(&method, bench->fixed, candidate->make, &settings);
        measure_method(bench, candidate->name, setting, candidate->whole ? run_whole : run_phases,
                       &method, opened);
    }
}

static void sweep_verlet(const struct bench *bench)
{
    double largest = bench->quick ? 1e3 : 1e5;
    for (double steps = 10.0; steps < 1.01 * largest; steps *= sqrt(10.0)) {
        struct method method;
        char setting[64];
        snprintf(setting, sizeof setting, "steps=%.0f phases", steps);
        bool opened = method_open_verlet(&method, bench->fixed, steps);
        measure_method(bench, "verlet", setting, run_verlet, &method, opened);
    }
}

/* The converged solution of these modes: CVODE's at the tightest tolerance, so that the library is
 * not its own judge. Two spheres return all energy. */
static bool converge(struct bench *bench, const char *title)
{
    struct method modal;
    struct method other;
    struct integrator_settings settings = {.tolerance = 1e-14, .energetic = true};
    bool solved = method_open_modal(&modal, bench->fixed, 1e-14) && method_run_modal(&modal) &&
                  method_open_integrator(&other, bench->fixed, integrator_adams, &settings) &&
                  method_run_phases(&other);
    if (!solved) {
        fprintf(stderr, "work_precision: %s: no converged solution\n", bench->report.scene);
        return false;
    }
    bench->report.expected = other.ode.count > 1 ? other.restitution : 1.0;
    fprintf(stderr, "%s: %s; %zu oscillators, e = %.12f, modal at 1e-14 differs by %.1e\n",
            bench->report.scene, title, other.ode.count - 1, bench->report.expected,
            fabs(modal.restitution - bench->report.expected));
    method_close(&modal);
    method_close(&other);
    return true;
}

static bool compare_methods(struct bench *bench, const struct bench_scene *scene)
{
    struct fixed_scene *fixed = fixed_scene_create(scene, scene->modes, true);
    if (!fixed) {
        fprintf(stderr, "work_precision: %s: cannot be set up\n", scene->name);
        return false;
    }
    bench->fixed = fixed;
    bool solved = converge(bench, scene->title);
    if (solved) {
        sweep_modal(bench);
        for (size_t i = 0; i < sizeof candidates / sizeof candidates[0]; i++)
            sweep_candidate(bench, &candidates[i]);
        sweep_verlet(bench);
    }
    fixed_scene_free(fixed);
    return solved;
}

/* Error of a number of modes; the steps are accurate enough not to matter. */
static void sweep_modes(const struct bench *bench, const struct bench_scene *scene, bool residual)
{
    for (unsigned modes = 5; modes <= (bench->quick ? 20 : 1280); modes *= 2) {
        struct method method;
        char setting[64];
        struct fixed_scene *fixed = fixed_scene_create(scene, modes, residual);
        if (!fixed)
            return;
        snprintf(setting, sizeof setting, "modes=%u accuracy=1e-8", modes);
        bool opened = method_open_modal(&method, fixed, 1e-8);
        measure_method(bench, residual ? "modal-modes" : "modal-plain", setting, run_modal, &method,
                       opened);
        fixed_scene_free(fixed);
    }
}

/* The library's own entrance. */
struct entrance {
    struct bench_catalogue catalogue;
    struct solve_workspace *workspace;
    struct solve_request request;
    struct solve_result result;
};

static bool run_entrance(void *context)
{
    struct entrance *entrance = context;
    const struct solve_context means = {.catalogue = &entrance->catalogue.set};
    return solve(entrance->workspace, &means, &entrance->request, &entrance->result) == PERCUSS_OK;
}

/* The same when nothing is known of the bodies: with a workspace of its own. */
static bool run_first(void *context)
{
    struct entrance *entrance = context;
    struct solve_workspace *kept = entrance->workspace;
    entrance->workspace = solve_workspace_create();
    bool good = entrance->workspace && run_entrance(entrance);
    solve_workspace_free(entrance->workspace);
    entrance->workspace = kept;
    return good;
}

static void measure_entrance(const struct bench *bench, const char *method, solver_run *run,
                             struct entrance *entrance)
{
    char setting[64];
    snprintf(setting, sizeof setting, "tolerance=1e-%02.0f",
             -log10(entrance->request.options.tolerance));
    double seconds = measure(run, entrance, bench->report.budget);
    report_line(&bench->report, method, setting, entrance->result.contacts[0].restitution, seconds);
}

static bool sweep_entrance(struct bench *bench, const struct bench_scene *scene)
{
    static struct entrance entrance;
    entrance.workspace = solve_workspace_create();
    bool ready = entrance.workspace && bench_catalogue_make(&entrance.catalogue, 0);
    entrance.request = bench_request(scene, bench->quick ? 1e-7 : 3e-9);
    ready = ready && run_entrance(&entrance);
    if (ready) {
        bench->report.expected = entrance.result.contacts[0].restitution;
        fprintf(stderr, "%s: all modes: e = %.10f, estimated error %.1e\n", scene->name,
                bench->report.expected,
                entrance.result.restitution_time + entrance.result.restitution_modes);
    }
    for (int digits = 2; ready && digits <= (bench->quick ? 4 : 7); digits++) {
        entrance.request.options.tolerance = pow(10.0, -digits);
        measure_entrance(bench, "modal-solve", run_entrance, &entrance);
        measure_entrance(bench, "modal-first", run_first, &entrance);
    }
    solve_workspace_free(entrance.workspace);
    return ready;
}

static bool bench_one(const struct options *options, bool csv, const struct bench_scene *scene)
{
    struct bench bench = {.report = {.csv = csv, .scene = scene->name}, .quick = options->quick};
    bench.report.budget = options->quick ? 0.005 : 0.1;
    if (!compare_methods(&bench, scene))
        return false;
    if (scene->few)
        return true;
    if (!sweep_entrance(&bench, scene))
        return false;
    if (scene->modes) {
        sweep_modes(&bench, scene, true);
        sweep_modes(&bench, scene, false);
    }
    return true;
}

int main(int argc, char **argv)
{
    struct options options = {0};
    struct report report = {0};
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--csv") == 0) {
            report.csv = true;
        } else if (strcmp(argv[i], "--quick") == 0) {
            options.quick = true;
        } else if (strcmp(argv[i], "--scene") == 0 && i + 1 < argc) {
            options.scene = argv[++i];
        } else {
            bool help = strcmp(argv[i], "--help") == 0;
            fputs(usage, help ? stdout : stderr);
            return help ? EXIT_SUCCESS : 2;
        }
    }
    if (options.scene && !bench_scene_find(options.scene)) {
        fprintf(stderr, "work_precision: --scene %s: no such scene\n", options.scene);
        return 2;
    }
    report_header(&report);
    for (int i = 0; i < BENCH_SCENES; i++) {
        const struct bench_scene *scene = &bench_scenes[i];
        bool small = scene->few || scene->modes == 0;
        if (options.scene ? strcmp(options.scene, scene->name) != 0 : options.quick && !small)
            continue;
        if (!bench_one(&options, report.csv, scene))
            return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
