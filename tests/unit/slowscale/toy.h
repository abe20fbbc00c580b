/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An engine small enough to read: free spheres that move along x in straight lines, and a service
 * that answers what the test wrote down. */
#ifndef PERCUSS_TEST_TOY_H
#define PERCUSS_TEST_TOY_H

#include <percuss/slowscale.h>
#include <stdio.h>
#include <string.h>

#include "check.h"

enum { TOY_BODIES = 4, TOY_REPLIES = 8, TOY_SUBS = 6 };

/* Linear plus angular momentum about a point, one number that notices any change. */
double toy_momentum(const struct percuss_body_motion *bodies,
                    const struct percuss_slow_inertia *inertias, size_t count,
                    const double about[3]);

/* What the service answers: per contact a list of sub-impacts. */
struct toy_answer {
    enum percuss_result result;
    enum percuss_status status;
    bool truncated, spent; /* at the horizon; for the effort */
    double window;
    const char *revision; /* of its catalogue; NULL: not said */
    double friction;      /* its sub-impacts have tangential impulses, along y and z */
    double inverse_mass;  /* of every contact; 0: that of two of the spheres */
    uint32_t count[TOY_BODIES];
    struct percuss_sub_impact subs[TOY_BODIES][TOY_SUBS];
};

/* Two hits: the first leaves the bodies approaching (e < 0 meanwhile), 5 ms later the second. */
static const struct toy_answer two_hits = {
    .window = 6e-3,
    .count = {2},
    .subs = {{{.start = 0.0, .compression_end = 1e-4, .end = 2e-4, .impulse = 0.008},
              {.start = 5e-3, .compression_end = 5.1e-3, .end = 5.2e-3, .impulse = 0.006}}},
};

struct toy {
    double time;
    double radius;
    bool flips; /* at every look, the contacts have their bodies the other way round */
    size_t looks;
    double friction, tangent[3]; /* of all contacts */
    double tilt;                 /* rad, of all normals about y */
    size_t count;
    struct percuss_body_motion bodies[TOY_BODIES];
    struct percuss_slow_inertia inertias[TOY_BODIES];
    struct percuss_slow *slow;
    /* the service: answers in order; questions as they came */
    size_t asked, answers;
    struct toy_answer answer[TOY_REPLIES];
    struct percuss_request question[TOY_REPLIES];
    double matrix[TOY_REPLIES][9 * TOY_BODIES * TOY_BODIES];
    size_t released;
    /* the last report */
    size_t reports;
    double impulse[TOY_BODIES], restitution[TOY_BODIES], applied[TOY_BODIES];
    bool service_used;
    uint64_t declared;
    char message[512];
};

size_t toy_contacts(struct toy *toy, struct percuss_slow_contact *contacts);
bool toy_probe(void *context, struct percuss_slow_view *view);
bool toy_oblique(void *context, size_t count, const struct percuss_slow_contact *contacts,
                 double *delassus);
bool toy_apply(void *context, const struct percuss_slow_contact *contact, double impulse);
bool toy_push(void *context, uint32_t body, const double impulse[3], const double point[3]);
bool toy_apply_vector(void *context, const struct percuss_slow_contact *contact,
                      const double impulse[3]);
bool toy_shift_vector(void *context, const struct percuss_slow_contact *contact,
                      const double moment[3]);
bool toy_shift(void *context, const struct percuss_slow_contact *contact, double moment);
double toy_now(void *context);

/* Spheres of 0.1 kg and 10 mm in a row, each just touching the next; the first comes with 0.2 m/s.
 * They are pushed one by one where wishes->engine.push says so, else told of the pair. */
struct toy *toy_create(size_t count, const struct percuss_slow_config *wishes);

/* Default settings with the service's answers. */
struct percuss_slow_config toy_wishes(void);

/* Straight motion for dt. */
void toy_move(struct toy *toy, double dt);

/* The same, then the slow scale. */
void toy_step(struct toy *toy, double dt);

/* Steps of at most dt until `end`, ending where a sub-impact is due. */
void toy_run(struct toy *toy, double end, double dt);

void toy_free(struct toy *toy);

#endif
