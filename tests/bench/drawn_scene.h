/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Random scenes of the campaign: every shape, support and theory, damping, groups of contacts,
 * gaps, accelerations. Scene number n is the same scene on every machine. */
#ifndef PERCUSS_BENCH_DRAWN_SCENE_H
#define PERCUSS_BENCH_DRAWN_SCENE_H

#include "physics/support.h"

struct drawn {
    struct solve_request request;
    bool passive; /* one contact, bodies at rest but for their rigid motion, no acceleration */
    char text[256];
};

/* Random numbers: the logarithm uniform; 0 ... count - 1. */
double log_between(uint64_t *r, double low, double high);
int pick(uint64_t *r, int count);
void draw_scene(struct lab *lab, uint64_t number, struct drawn *drawn);

#endif
