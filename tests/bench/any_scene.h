/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Random valid requests of every kind: the scenes of tests/bench/drawn_scene.h, with
 * metals from soft to hard, overlaps, contact models, compliances, traces and blows on bodies that
 * ring and have dents. Scene number n is the same scene everywhere. */
#ifndef PERCUSS_BENCH_ANY_SCENE_H
#define PERCUSS_BENCH_ANY_SCENE_H

#include "bench/drawn_scene.h"

enum { ANY_SCENE_MOST_BLOWS = 4 };

struct any_scene {
    struct drawn drawn;                   /* the first blow */
    size_t blows;                         /* later ones strike the bodies as they were left */
    double elapsed[ANY_SCENE_MOST_BLOWS]; /* s, before each blow */
    double faster[ANY_SCENE_MOST_BLOWS];  /* velocities of each, times the first one's */
    double horizon[ANY_SCENE_MOST_BLOWS];
};

/* The bodies of `lab` become those of the scene. */
void any_scene_draw(struct lab *lab, uint64_t number, struct any_scene *scene);

/* The request of a blow; states of the bodies are the caller's matter. */
struct solve_request any_scene_request(const struct any_scene *scene, size_t blow);

/* Writes PREFIX.yaml, the catalogue, and PREFIX-1.json, PREFIX-2.json ..., a request for each blow:
 * what percussd --catalogue and percuss query --request take, to the last bit. In later ones the
 * tokens of the reply before belong in the members `state`. False: errno says why not. */
bool any_scene_save(const struct lab *lab, const struct any_scene *scene, const char *prefix);

#endif
