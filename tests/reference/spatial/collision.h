/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Complete elastodynamics of a meshed pair in frictionless contact: the paper's model A of the beam
 * in three dimensions. Forces are unknowns at the nodes that may touch, found at the end of each
 * step so that none pulls and none overlaps; in between they go linearly. */
#ifndef PERCUSS_SPATIAL_COLLISION_H
#define PERCUSS_SPATIAL_COLLISION_H

#include "base/watch.h"
#include "contact/hertz.h"
#include "spatial/moving.h"

/* A sphere above the middle of a round beam's side, both meshed, with nodes that face each other
 * where they may touch. */

enum { PAIR_BEAM, PAIR_SPHERE };

struct pair_input {
    struct material materials[2]; /* beam, sphere */
    double beam_radius, beam_length, sphere_radius;
    double velocity; /* m/s, the highest approach that the mesh is for */
    size_t bricks;   /* along half the beam */
    size_t across;   /* on 0.7 of its radius: 1 ... 4; 1 makes frequencies 9e-4 high, 2 1e-4 */
    unsigned levels; /* halvings at the contact */
};

/* Owns its arrays. */
struct pair {
    struct pair_input input;
    struct hertz_contact hertz;
    double axes[2]; /* m, of the ellipse within which nodes may touch */
    struct refined meshes[2];
    struct system3 systems[2];
    struct pressed pressed[2]; /* node i of one faces node i of the other */
    double *initial;           /* m: gaps of the touching bodies */
    double mass[2];            /* kg, of the whole bodies */
    size_t axis;               /* the beam's node on its axis below the contact */
};

/* OK; BAD_REQUEST naming the field and its allowed range; INTERNAL: no memory. */
enum percuss_status pair_create(const struct pair_input *input, struct pair *pair,
                                struct fault *fault);
void pair_free(struct pair *pair);

enum { COLLISION_SUB_IMPACTS = 32 };

struct collision_sub_impact {
    double start, end, impulse, peak_force; /* s, s, N s, N */
};

/* State of an impact at a time, and at its end. */
struct collision {
    double time;        /* s */
    double force;       /* N */
    double impulse;     /* N s */
    double place[2];    /* m, of the bodies' centres of mass along z since the first touch */
    double speed[2];    /* m/s */
    double middle;      /* m, along z, of the beam's axis below the contact */
    double restitution; /* impulse W / approach - 1 */
    size_t active;      /* nodes that press now */
    size_t sub_impacts;
    struct collision_sub_impact sub_impact[COLLISION_SUB_IMPACTS];
    double available, rebound, vibration; /* J: of the relative motion before and now, the rest */
    bool over;                            /* vibration can no longer cause a contact */
    size_t contact_steps, flight_steps, refused; /* flights tried that ended in a contact */
    double factor;                               /* complex numbers kept */
};

/* Counts a step that has just ended, along which the force went from `before` to `after` (N). */
void collision_keep(struct collision *collision, double before, double after, double step);

/* The factors of both bodies for both lengths of step, and the compliance between contact nodes. */
struct collider {
    const struct pair *pair;          /* borrowed */
    double contact_step, flight_step; /* s */
    struct pace3 contact[2], flight[2];
    double *compliance; /* of the nodes that face each other, in a contact step, m/N */
};

/* Some seconds. OK, or INTERNAL. */
enum percuss_status collider_create(const struct pair *pair, double contact_step,
                                    double flight_step, struct collider *collider,
                                    struct fault *fault);
void collider_free(struct collider *collider);

struct collision_settings {
    double horizon; /* s */
    /* m/N: vibration of energy E moves the beam's middle by at most sqrt(2 E compliance); an impact
     * that is open by more than that is over. 0: it goes on to the horizon */
    double compliance;
    struct pace *pace; /* borrowed; NULL: never stopped */
    /* receives the state of an impact after each step; may be NULL */
    void (*record)(void *context, size_t which, const struct collision *collision);
    void *context;
};

/* The sphere flies at the beam, `count` times, each with its own approach (m/s) and all
 * independent: solved side by side they take hardly longer than one. Both bodies are free of stress
 * and touch in one point. OK; TIMEOUT where the pace stopped it; INTERNAL where no set of pressing
 * nodes was found, or without memory. */
enum percuss_status collider_run(const struct collider *collider,
                                 const struct collision_settings *settings, size_t count,
                                 const double *approach, struct collision *collisions,
                                 struct fault *fault);

#endif
