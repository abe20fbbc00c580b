/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "beam_case.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

static bool take(const char *name, const char *value, const struct beam_case_option *own,
                 struct beam_case *asked)
{
    double number = atof(value);
    /* those of all */
    if (strcmp(name, "--speed") == 0 && asked->speed_count < BEAM_CASE_SPEEDS) {
        asked->speeds[asked->speed_count++] = number;
        return true;
    }
    if (strcmp(name, "--history") == 0) {
        asked->history = value;
        return true;
    }
    /* the benchmark's own */
    while (own->name && strcmp(name, own->name) != 0)
        own++;
    if (own->number)
        *own->number = number;
    else if (own->count)
        *own->count = (size_t)number;
    return own->name;
}

bool beam_case_read(int count, char **words, const struct beam_case_option *own,
                    struct beam_case *asked)
{
    *asked = (struct beam_case){.headless = false};
    for (int i = 1; i < count; i++) {
        if (strcmp(words[i], "--no-header") == 0) {
            asked->headless = true;
            continue;
        }
        if (i + 1 == count || !take(words[i], words[i + 1], own, asked)) {
            fprintf(stderr, "%s: %s: see the top of its source in tests/bench\n", words[0],
                    words[i]);
            return false;
        }
        i++;
    }
    /* the paper's speed where none is given */
    if (asked->speed_count == 0)
        asked->speeds[asked->speed_count++] = 0.2;
    for (size_t i = 0; i < asked->speed_count; i++)
        asked->fastest = fmax(asked->fastest, asked->speeds[i]);
    return true;
}

struct beam_plane beam_case_plane(void)
{
    const struct material *material = &BEAM_CASE_BEAM;
    double r = BEAM_CASE_RADIUS, area = M_PI * r * r, second = 0.25 * area * r * r;
    return (struct beam_plane){
        .length = BEAM_CASE_LENGTH,
        .bending_stiffness = material->young * second,
        .shear_stiffness = beam_shear_hutchinson_circle(material->poisson) *
                           material_shear_modulus(material) * area,
        .line_mass = material->density * area,
        .line_inertia = material->density * second,
    };
}

double beam_case_seconds(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec;
}

FILE *beam_case_history(const char *name)
{
    FILE *file = fopen(name, "w");
    if (file)
        fprintf(file, "time,sphere,beam,velocity,force\n");
    return file;
}

void beam_case_record(void *context, size_t which, const struct collision *now)
{
    if (which == 0)
        fprintf(context, "%.9g,%.6e,%.6e,%.6e,%.6g\n", now->time, -now->place[PAIR_SPHERE],
                -now->middle, -now->speed[PAIR_SPHERE], now->force);
}

void beam_case_print_sub_impacts(const struct collision *found)
{
    for (size_t i = 0; i < found->sub_impacts; i++) {
        const struct collision_sub_impact *sub = &found->sub_impact[i];
        printf("%s%.7g:%.7g:%.7g:%.5g", i ? " " : "", sub->start, sub->end, sub->impulse,
               sub->peak_force);
    }
    printf("\n");
    fflush(stdout);
}
