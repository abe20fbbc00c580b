/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The whole loop in one process: free bodies, the slow scale, and the solver as its service, with
 * states under numbers as tokens. Bodies hold their places and only gaps change, also by gravity: W
 * and n are fixed. */
#ifndef PERCUSS_TEST_LOOP_H
#define PERCUSS_TEST_LOOP_H

#include "physics/support.h"

#include <percuss/slowscale.h>

enum { LOOP_BODIES = 6, LOOP_CONTACTS = 6, LOOP_STATES = 256 };

struct loop {
    struct lab *lab;
    double time;
    size_t body_count, pair_count;
    struct percuss_body_motion bodies[LOOP_BODIES];
    struct percuss_slow_inertia inertias[LOOP_BODIES];
    char ids[LOOP_BODIES][PERCUSS_ID_SIZE];
    struct percuss_slow_contact pairs[LOOP_CONTACTS]; /* that may touch: a above b along z */
    double falls[LOOP_BODIES];                        /* m/s^2, downwards */
    struct percuss_slow *slow;
    size_t states;
    struct body_state *state[LOOP_STATES];
    struct solve_result result;
    /* of the last impact, and sums */
    double vibration;  /* J, of all bodies, by the last reply */
    double time_shift; /* s, of the earliest reply */
    double restitution[LOOP_CONTACTS], restitution_reply[LOOP_CONTACTS];
    size_t reports;
    char message[512], notes[4096]; /* of the last report, and of all */
    bool silent;                    /* does not state accelerations */
};

void loop_ask(struct loop *loop, const struct percuss_request *request);
struct percuss_sub_impact loop_sub_impact(const struct solve_contact_result *from, size_t i);

/* Adds a body of the lab at (x, 0, z) with a speed along z; returns its index. */
uint32_t loop_add(struct loop *loop, const char *id, double x, double z, double speed);

/* A pair that may touch above b at a's x and height z. */
void loop_pair(struct loop *loop, uint32_t a, uint32_t b, double z, double gap);

/* The solver, of loop->lab, for another engine. */
struct percuss_slow_service loop_service(struct loop *loop);

void loop_start_moving(struct loop *loop, enum percuss_slow_application application,
                       double tolerance, bool moves);
void loop_start(struct loop *loop, enum percuss_slow_application application, double tolerance);

/* Exact motion. */
void loop_fly(struct loop *loop, double dt);

void loop_step(struct loop *loop, double dt);

/* Until `end` in steps of at most `step`, each of which ends where something is due. */
void loop_run(struct loop *loop, double end, double step);

double loop_kinetic(const struct loop *loop);
void loop_free(struct loop *loop);

#endif
