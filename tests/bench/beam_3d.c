/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The paper's steel sphere on the middle of its aluminium beam as complete finite elements in three
 * dimensions (service/spatial): restitution, sub-impacts, energy balance and time; a line of CSV
 * each, the first with the names.
 * usage: beam_3d [--speed V]... [--levels N] [--across N] [--bricks N] [--contact-step S]
 *                [--flight-step S] [--horizon S] [--history FILE] [--no-header] */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "model/beam.h"
#include "spatial/collision.h"

enum { MOST_SPEEDS = 16 };

struct choice {
    struct pair_input input;
    double contact_step, flight_step, horizon;
    double speeds[MOST_SPEEDS];
    size_t speed_count;
    const char *history;
    bool headless;
};

/* the handbook's materials, PHYSICS.md */
static const struct choice defaults = {
    .input = {.materials = {{"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0},
                            {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0}},
              .beam_radius = 0.01,
              .beam_length = 1.0,
              .sphere_radius = 0.015,
              .bricks = 60,
              .across = 2,
              .levels = 6},
    .contact_step = 2e-6,
    .flight_step = 8e-6,
    .horizon = 0.010,
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
    else if (strcmp(name, "--levels") == 0)
        choice->input.levels = (unsigned)number;
    else if (strcmp(name, "--across") == 0)
        choice->input.across = (size_t)number;
    else if (strcmp(name, "--bricks") == 0)
        choice->input.bricks = (size_t)number;
    else if (strcmp(name, "--contact-step") == 0)
        choice->contact_step = number;
    else if (strcmp(name, "--flight-step") == 0)
        choice->flight_step = number;
    else if (strcmp(name, "--horizon") == 0)
        choice->horizon = number;
    else if (strcmp(name, "--history") == 0)
        choice->history = value;
    else
        return false;
    return true;
}

static bool read_arguments(int count, char **words, struct choice *choice)
{
    *choice = defaults;
    for (int i = 1; i < count; i++) {
        if (strcmp(words[i], "--no-header") == 0) {
            choice->headless = true;
            continue;
        }
        if (i + 1 == count || !take(choice, words[i], words[i + 1])) {
            fprintf(stderr, "beam_3d: %s: see the top of tests/bench/beam_3d.c\n", words[i]);
            return false;
        }
        i++;
    }
    if (choice->speed_count == 0)
        choice->speeds[choice->speed_count++] = 0.2;
    for (size_t i = 0; i < choice->speed_count; i++)
        choice->input.velocity = fmax(choice->input.velocity, choice->speeds[i]);
    return true;
}

/* of the beam's middle, to bound what vibration can do: Timoshenko's, 3-D to 1e-3 */
static double middle_compliance(const struct pair_input *input)
{
    const struct material *material = &input->materials[PAIR_BEAM];
    double r = input->beam_radius, area = M_PI * r * r, second = 0.25 * area * r * r;
    struct beam_plane plane = {
        .length = input->beam_length,
        .bending_stiffness = material->young * second,
        .shear_stiffness = beam_shear_hutchinson_circle(material->poisson) *
                           material_shear_modulus(material) * area,
        .line_mass = material->density * area,
        .line_inertia = material->density * second,
    };
    struct beam_load load = {.x = 0.0, .force = 1.0};
    return beam_compliance(&plane, &load, &load);
}

/* of the first speed: time, where the bodies are along the blow, the sphere's velocity, force */
static void record(void *context, size_t which, const struct collision *now)
{
    if (which == 0)
        fprintf(context, "%.9g,%.6e,%.6e,%.6e,%.6g\n", now->time, -now->place[PAIR_SPHERE],
                -now->middle, -now->speed[PAIR_SPHERE], now->force);
}

static void print_header(void)
{
    printf(
        "model,speed,bricks,across,levels,contact_step,flight_step,freedoms,contact_nodes,"
        "restitution,over,end,closure,setup_s,run_s_of_all,sub_impacts:start:end:impulse:peak\n");
}

static void print_found(const struct choice *choice, const struct pair *pair, double speed,
                        const struct collision *found, const double seconds[2])
{
    const struct pair_input *input = &choice->input;
    printf("A,%g,%zu,%zu,%u,%g,%g,%zu,%zu,%.6f,%d,%.6g,%.2e,%.1f,%.1f,", speed, input->bricks,
           input->across, input->levels, choice->contact_step, choice->flight_step,
           pair->systems[0].freedoms + pair->systems[1].freedoms, pair->pressed[0].count,
           found->restitution, found->over, found->time,
           (found->available - found->rebound - found->vibration) / found->available, seconds[0],
           seconds[1]);
    for (size_t i = 0; i < found->sub_impacts; i++) {
        const struct collision_sub_impact *sub = &found->sub_impact[i];
        printf("%s%.7g:%.7g:%.7g:%.5g", i ? " " : "", sub->start, sub->end, sub->impulse,
               sub->peak_force);
    }
    printf("\n");
    fflush(stdout);
}

static enum percuss_status solve_all(const struct choice *choice, const struct collider *collider,
                                     double setup, struct fault *fault)
{
    FILE *history = choice->history ? fopen(choice->history, "w") : NULL;
    if (choice->history && !history)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: cannot be written", choice->history);
    if (history)
        fprintf(history, "time,sphere,beam,velocity,force\n");
    struct collision found[MOST_SPEEDS];
    struct collision_settings settings = {
        .horizon = choice->horizon,
        .compliance = middle_compliance(&choice->input),
        .record = history ? record : NULL,
        .context = history,
    };
    double begun = user_seconds();
    enum percuss_status status =
        collider_run(collider, &settings, choice->speed_count, choice->speeds, found, fault);
    for (size_t i = 0; i < choice->speed_count && status == PERCUSS_OK; i++)
        print_found(choice, collider->pair, choice->speeds[i], &found[i],
                    (const double[2]){setup, user_seconds() - begun});
    if (history)
        fclose(history);
    return status;
}

int main(int count, char **words)
{
    struct choice choice;
    struct fault fault;
    struct pair pair;
    struct collider collider;
    if (!read_arguments(count, words, &choice))
        return 2;
    if (!choice.headless)
        print_header();
    enum percuss_status status = pair_create(&choice.input, &pair, &fault);
    if (status == PERCUSS_OK) {
        status = collider_create(&pair, choice.contact_step, choice.flight_step, &collider, &fault);
        if (status == PERCUSS_OK) {
            status = solve_all(&choice, &collider, user_seconds(), &fault);
            collider_free(&collider);
        }
        pair_free(&pair);
    }
    if (status != PERCUSS_OK)
        fprintf(stderr, "beam_3d: %s\n", fault.text);
    return status == PERCUSS_OK ? 0 : 1;
}
