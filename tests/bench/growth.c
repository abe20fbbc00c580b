/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How the cost of a contact step grows with the modes and with the contacts of a scene: see
 * docs/lab/performance.md. Processor time, medians. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure.h"
#include "scenes.h"

static const char usage[] =
    "usage: growth [--quick]\n"
    "Solves scenes of 10 to 3000 modes, and of 1 to 63 contacts, with steps of equal accuracy, "
    "and\n"
    "prints CSV: kind,number,modes,steps,seconds,seconds_per_step,slope. The slope is that of the\n"
    "logarithms, from the line before.\n"
    "  modes      a sphere on a pinned beam with so many modes, the first blow\n"
    "  contacts   so many spheres at once on a beam with 40 modes, their first blow\n"
    "  pairs      so many pairs of spheres, which share nothing but the steps (1 to 32)\n"
    "  --quick    a few of each, for tests\n";

/* s to spend on one median */
static const double BUDGET = 0.3;
static const double ACCURACY = 1e-6;
enum { BEAM_MODES = 40 };
/* Numbers of contacts: of pairs the last one would be too many bodies. */
enum { COUNTS = 7 };
/* s: till then the first blow is over. */
static const double FIRST_BLOW = 1.5e-4;

/* One scene, solved again and again. */
struct run {
    const struct scene *scene;
    struct impact_settings settings;
    struct arena arena;
    struct impact_outcome outcome;
};

static bool solve_again(void *solver)
{
    struct run *run = solver;
    arena_reset(&run->arena);
    return impact_create(&run->outcome, run->scene, &run->arena) &&
           impact_modal(run->scene, &run->settings, &run->arena, &run->outcome) == PERCUSS_OK;
}

/* What the line before of a kind cost. */
struct before {
    double number, seconds;
};

static bool line(const char *kind, unsigned number, struct fixed_scene *fixed, double horizon,
                 struct before *before)
{
    if (!fixed)
        return false;
    struct run run = {
        .scene = fixed->scene,
        .settings = {.accuracy = ACCURACY, .horizon = horizon, .max_work = 1e12},
    };
    double seconds = measure(solve_again, &run, BUDGET);
    if (seconds >= 0.0) {
        unsigned long steps = run.outcome.steps + run.outcome.rejected;
        double one = seconds / (double)steps;
        printf("%s,%u,%zu,%lu,%.4e,%.4e,", kind, number, fixed->assembly.all_modes, steps, seconds,
               one);
        if (before->number > 0.0)
            printf("%.2f", log(one / before->seconds) / log(number / before->number));
        printf("\n");
        fflush(stdout);
        *before = (struct before){number, one};
    }
    arena_release(&run.arena);
    fixed_scene_free(fixed);
    return seconds >= 0.0;
}

/* A scene so often, side by side: with one struck body for all, or each with its own. */
static struct solve_request side_by_side(const struct bench_scene *scene, bool shared,
                                         unsigned count)
{
    struct solve_request one = bench_request(scene, 1e-6), request = one;
    unsigned struck = shared ? 1 : count;
    for (unsigned i = 0; i < count; i++) {
        double place = -0.48 + 0.96 * (i + 0.5) / count;
        request.bodies[i] = one.bodies[0];
        request.contacts[i] = one.contacts[0];
        request.bodies[i].position[0] = request.contacts[i].point[0] = place;
        request.contacts[i].a = i;
        request.contacts[i].b = count + (shared ? 0 : i);
    }
    for (unsigned i = 0; i < struck; i++) {
        request.bodies[count + i] = one.bodies[1];
        if (!shared)
            request.bodies[count + i].position[0] = request.bodies[i].position[0];
    }
    request.body_count = count + struck;
    request.contact_count = count;
    return request;
}

int main(int argc, char **argv)
{
    static const unsigned modes[] = {10, 20, 50, 100, 200, 500, 1000, 2000, 3000};
    static const unsigned contacts[COUNTS] = {1, 2, 4, 8, 16, 32, 63};
    bool quick = argc == 2 && strcmp(argv[1], "--quick") == 0, good = true;
    if (argc > 1 && !quick) {
        fputs(usage, strcmp(argv[1], "--help") == 0 ? stdout : stderr);
        return strcmp(argv[1], "--help") == 0 ? EXIT_SUCCESS : 2;
    }
    const struct bench_scene *beam = bench_scene_find("beam");
    const struct bench_scene *pinned = bench_scene_find("pinned");
    const struct bench_scene *spheres = bench_scene_find("spheres");
    printf("kind,number,modes,steps,seconds,seconds_per_step,slope\n");
    struct before before = {0};
    for (size_t i = 0; good && i < (quick ? 3 : sizeof modes / sizeof *modes); i++)
        good = line("modes", modes[i], fixed_scene_create(pinned, modes[i], true), FIRST_BLOW,
                    &before);
    for (int pairs = 0; pairs < 2; pairs++) {
        before = (struct before){0};
        for (size_t i = 0; good && i < (quick ? 2 : COUNTS - (size_t)pairs); i++) {
            struct solve_request request =
                side_by_side(pairs ? spheres : beam, !pairs, contacts[i]);
            good = line(pairs ? "pairs" : "contacts", contacts[i],
                        fixed_scene_of(&request, BEAM_MODES), FIRST_BLOW, &before);
        }
    }
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
