/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the physics tests share: a catalogue built in C, scenes of two bodies that touch in given
 * spots, and repeatable random numbers. */
#ifndef PERCUSS_TEST_SUPPORT_H
#define PERCUSS_TEST_SUPPORT_H

#include <stdio.h>
#include <string.h>

#include "check.h"
#include "model/vector.h"
#include "solve/solve.h"

/* The handbook materials of the numbers in the physics notes. */
#define STEEL     ((struct material){"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0})
#define ALUMINIUM ((struct material){"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0})
#define GLASS     ((struct material){"glass", 48e9, 0.20, 2800.0, INFINITY, 0.0})

/* A catalogue of up to 32 bodies and a workspace. Bodies stay where they are. */
struct lab {
    struct body bodies[32];
    struct body_set set;
    struct solve_context means; /* the set, no tables, nobody waits: until a test says otherwise */
    struct solve_workspace *workspace;
};

struct lab *lab_create(void);
void lab_free(struct lab *lab);

/* Adds a body under an id; the catalogue becomes a new revision. */
const struct body *lab_add(struct lab *lab, const char *id, struct body body);

static inline struct body make_body(const struct body_kind *kind, struct material material)
{
    return (struct body){.material = material, .kind = kind, .tip_radius = INFINITY};
}

struct body make_sphere(struct material material, double radius);
struct body make_bar(const struct body_kind *kind, struct material material, double radius,
                     double length);
struct body make_supported(struct body bar, enum support left, enum support right);
/* With Cowper's shear factor, which many a recorded number is of. */
struct body make_cowper(struct body beam);

/* A place on a body's surface, body frame; roll turns the body about the contact's normal. */
struct spot {
    const char *id;
    double point[3];
    double outward[3];
    double roll;
};

static inline struct spot sphere_spot(const char *id, double radius)
{
    return (struct spot){id, {0.0, 0.0, -radius}, {0.0, 0.0, -1.0}, 0.0};
}

/* The end face at +length/2. */
static inline struct spot end_spot(const char *id, double length)
{
    return (struct spot){id, {0.5 * length, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.0};
}

/* The side of a beam at x, at the angle `about` (rad) from z towards y. */
struct spot side_spot(const char *id, double x, double radius, double about);

/* A wall of vanishing 1 - nu^2 and endless shear modulus: E* is that of the other body to 3e-16,
 * and no wave leaves. */
struct body rigid_wall(void);

static inline struct spot wall_spot(const char *id)
{
    return (struct spot){id, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.0};
}

/* Shortest rotation that takes the unit vector `from` to `to`, then `roll` about `to`. */
void aim(const double from[3], const double to[3], double roll, double q[4]);

void put(struct solve_body *body, const struct spot *spot, const double outward[3]);

/* One contact in the world's origin with the normal +z: body 0 (a) above comes down with `speed` on
 * body 1 (b) at rest. */
struct solve_request strike(struct spot a, struct spot b, double speed);

/* Turns and shifts the whole scene; every body gets the extra velocity. */
void move_scene(struct solve_request *request, const double q[4], const double shift[3],
                const double velocity[3]);

/* Solves; anything but OK fails the test. */
void lab_solve(struct lab *lab, const struct solve_request *request, struct solve_result *result);

/* Repeatable random numbers (xorshift64*, Vigna 2016), uniform in [low, high). */
double random_between(uint64_t *state, double low, double high);

/* Uniform over the rotations (Marsaglia's method on the 3-sphere by rejection). */
void random_rotation(uint64_t *state, double q[4]);

/* E* of two materials and k of a sphere on a plane, by the textbook's formulas. */
double sphere_plane_stiffness(struct material a, struct material b, double radius);

#endif
