/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The paper's steel sphere on the middle of its aluminium beam by modes: model B with the elliptic
 * contact region solved in every step, model C with the table of that region, and the same with
 * Hertz's elliptic law (H); service/spatial. A line of CSV each, the first with the names.
 * usage: beam_modal [--speed V]... [--resolution N] [--modes N] [--step S] [--history PREFIX]
 *                   [--no-header] */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "contact/table.h"
#include "spatial/beam_modal.h"

enum { MOST_SPEEDS = 16 };

static const struct material aluminium = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0};
static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
static const double BEAM_RADIUS = 0.01, BEAM_LENGTH = 1.0, SPHERE_RADIUS = 0.015;
/* Above what a blow of the fastest speed exerts: 0.3 m/s has 350 N. */
static const double FORCE_PER_SPEED = 1300.0;

struct choice {
    size_t resolution, modes;
    double step;
    double speeds[MOST_SPEEDS], fastest;
    size_t speed_count;
    const char *history;
    bool headless;
};

static double user_seconds(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec;
}

static bool take(struct choice *choice, const char *name, const char *value)
{
    double number = atof(value);
    if (strcmp(name, "--speed") == 0 && choice->speed_count < MOST_SPEEDS)
        choice->speeds[choice->speed_count++] = number;
    else if (strcmp(name, "--resolution") == 0)
        choice->resolution = (size_t)number;
    else if (strcmp(name, "--modes") == 0)
        choice->modes = (size_t)number;
    else if (strcmp(name, "--step") == 0)
        choice->step = number;
    else if (strcmp(name, "--history") == 0)
        choice->history = value;
    else
        return false;
    return true;
}

static bool read_arguments(int count, char **words, struct choice *choice)
{
    *choice = (struct choice){.resolution = 6, .modes = 80, .step = 0.5e-6};
    for (int i = 1; i < count; i++) {
        if (strcmp(words[i], "--no-header") == 0) {
            choice->headless = true;
            continue;
        }
        if (i + 1 == count || !take(choice, words[i], words[i + 1])) {
            fprintf(stderr, "beam_modal: %s: see the top of tests/bench/beam_modal.c\n", words[i]);
            return false;
        }
        i++;
    }
    if (choice->speed_count == 0)
        choice->speeds[choice->speed_count++] = 0.2;
    for (size_t i = 0; i < choice->speed_count; i++)
        choice->fastest = fmax(choice->fastest, choice->speeds[i]);
    return true;
}

static bool make_modal(size_t modes, struct beam_modal *modal)
{
    double r = BEAM_RADIUS, area = M_PI * r * r, second = 0.25 * area * r * r;
    struct beam_plane plane = {
        .length = BEAM_LENGTH,
        .bending_stiffness = aluminium.young * second,
        .shear_stiffness = beam_shear_hutchinson_circle(aluminium.poisson) *
                           material_shear_modulus(&aluminium) * area,
        .line_mass = aluminium.density * area,
        .line_inertia = aluminium.density * second,
    };
    double sphere = steel.density * 4.0 / 3.0 * M_PI * pow(SPHERE_RADIUS, 3.0);
    return beam_modal_create(&plane, sphere, modes, modal);
}

/* time, where the bodies are along the blow, the sphere's velocity, force */
static void record(void *context, size_t which, const struct collision *now)
{
    (void)which;
    fprintf(context, "%.9g,%.6e,%.6e,%.6e,%.6g\n", now->time, -now->place[PAIR_SPHERE],
            -now->middle, -now->speed[PAIR_SPHERE], now->force);
}

/* one model, all speeds; a history of the first */
static enum percuss_status solve_all(const struct choice *choice, const char *model,
                                     const struct beam_modal *modal,
                                     const struct beam_modal_contact *contact, double setup)
{
    struct fault fault;
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; i < choice->speed_count && status == PERCUSS_OK; i++) {
        FILE *history = NULL;
        if (choice->history && i == 0) {
            char name[512];
            snprintf(name, sizeof name, "%s-%s.csv", choice->history, model);
            history = fopen(name, "w");
            if (!history)
                return PERCUSS_BAD_REQUEST;
            fprintf(history, "time,sphere,beam,velocity,force\n");
        }
        struct beam_modal_settings settings = {.approach = choice->speeds[i],
                                               .step = choice->step,
                                               .horizon = 0.010,
                                               .record = history ? record : NULL,
                                               .context = history};
        struct collision found;
        double begun = user_seconds();
        status = beam_modal_run(modal, contact, &settings, &found, &fault);
        double seconds = user_seconds() - begun;
        if (history)
            fclose(history);
        if (status != PERCUSS_OK) {
            fprintf(stderr, "beam_modal: %s\n", fault.text);
            break;
        }
        printf("%s,%g,%zu,%zu,%g,%.6f,%d,%.6g,%.2e,%.2f,%.3f,", model, choice->speeds[i],
               choice->resolution, choice->modes, choice->step, found.restitution, found.over,
               found.time, (found.available - found.rebound - found.vibration) / found.available,
               setup, seconds);
        for (size_t k = 0; k < found.sub_impacts; k++)
            printf("%s%.7g:%.7g:%.7g:%.5g", k ? " " : "", found.sub_impact[k].start,
                   found.sub_impact[k].end, found.sub_impact[k].impulse,
                   found.sub_impact[k].peak_force);
        printf("\n");
        fflush(stdout);
    }
    return status;
}

/* model C: what is kept is force against indentation alone */
static enum percuss_status solve_by_table(const struct choice *choice,
                                          const struct beam_modal *modal, struct patch *patch,
                                          double force, double setup)
{
    struct patch_table samples;
    struct contact_curves *curves;
    struct fault fault;
    double begun = user_seconds();
    if (!patch_tabulate(patch, force, &samples))
        return PERCUSS_INTERNAL;
    struct contact_table table = {.points = PATCH_SAMPLES + 1,
                                  .indentation = samples.indentation,
                                  .force = samples.force,
                                  .contact_radius = samples.radius,
                                  .yield = samples.indentation[PATCH_SAMPLES],
                                  .error = samples.error};
    enum percuss_status status = contact_curves_create(&table, &curves, &fault);
    if (status != PERCUSS_OK) {
        fprintf(stderr, "beam_modal: %s\n", fault.text);
        return status;
    }
    fprintf(stderr, "table: %zu freedoms, force within %.2e of Hertz's ellipse (%.6g N/m^1.5)\n",
            patch->freedoms, samples.error, patch->hertz.stiffness);
    struct contact_law law = contact_law_table(curves);
    struct beam_modal_contact contact = beam_modal_law(&law);
    status = solve_all(choice, "C", modal, &contact, setup + user_seconds() - begun);
    contact_curves_free(curves);
    return status;
}

int main(int count, char **words)
{
    struct choice choice;
    struct beam_modal modal;
    struct patch patch;
    struct fault fault;
    if (!read_arguments(count, words, &choice))
        return 2;
    if (!choice.headless)
        printf("model,speed,resolution,modes,step,restitution,over,end,closure,setup_s,run_s,"
               "sub_impacts:start:end:impulse:peak\n");
    double curve = 0.5 / SPHERE_RADIUS, force = FORCE_PER_SPEED * choice.fastest;
    struct patch_input input = {.materials = {aluminium, steel},
                                .curvature = {curve, curve + 0.5 / BEAM_RADIUS},
                                .force = force,
                                .resolution = choice.resolution};
    enum percuss_status status = patch_create(&input, &patch, &fault);
    if (status != PERCUSS_OK) {
        fprintf(stderr, "beam_modal: %s\n", fault.text);
        return 1;
    }
    double setup = user_seconds();
    if (!make_modal(choice.modes, &modal))
        return 1;
    /* B, C, and the law that both approach */
    struct beam_modal_contact region = beam_modal_patch(&patch);
    status = solve_all(&choice, "B", &modal, &region, setup);
    if (status == PERCUSS_OK)
        status = solve_by_table(&choice, &modal, &patch, force, setup);
    struct contact_law hertz = contact_law_hertz(patch.hertz.stiffness);
    struct beam_modal_contact by_law = beam_modal_law(&hertz);
    if (status == PERCUSS_OK)
        status = solve_all(&choice, "H", &modal, &by_law, 0.0);
    beam_modal_free(&modal);
    patch_free(&patch);
    return status == PERCUSS_OK ? 0 : 1;
}
