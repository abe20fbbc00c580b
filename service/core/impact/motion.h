/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The state of a scene at one instant and its exact motion while no contact acts. */
#ifndef PERCUSS_IMPACT_MOTION_H
#define PERCUSS_IMPACT_MOTION_H

#include <stdbool.h>

#include "base/arena.h"
#include "impact/collocation.h"
#include "impact/scene.h"

struct motion {
    double time; /* s from the stated instant */
    double *gap; /* [row], rigid */
    double *gap_rate;
    double **q, **v; /* [group][stride] */
};

/* Memory for a state from the arena. False: out of memory. */
bool motion_create(struct motion *motion, const struct scene *scene, struct arena *arena);

/* Sets the state of the stated instant. */
void motion_start(struct motion *motion, const struct scene *scene);

void motion_copy(struct motion *to, const struct motion *from, const struct scene *scene);

/* Free motion over `time` >= 0. */
void motion_advance(struct motion *motion, const struct scene *scene, double time);

/* The same for time >= 0, as exact but to other bits: all modes of a group at once where their
 * angles are within FLIGHT_TURN_ANGLE. */
void motion_turn(struct motion *motion, const struct scene *scene, double time);

/* Tables of motion_turn for a time, [group]; NULL for a group that moves mode by mode. False: out
 * of memory. motion_turn_by moves by them, to the same bits. */
bool motion_turn_tables(const struct scene *scene, double time, struct arena *arena,
                        double **tables);
void motion_turn_by(struct motion *motion, const struct scene *scene, double time,
                    double *const *tables);

/* Undamped free motion back over `time` >= 0: damping run backward would amplify the rounding of
 * fast modes without bound. The vibration's energy is constant. */
void motion_rewind(struct motion *motion, const struct scene *scene, double time);

/* Free motion over the step of a level, with tables that are ready, from `from` into `to`, which
 * may be the same. */
void motion_step(struct motion *to, const struct motion *from, const struct scene *scene,
                 int level);

/* Adds the effect of the contact forces at the nodes of such a step to its end. */
void motion_push(struct motion *end, const struct scene *scene, int level,
                 double (*const force)[NODES]);

/* Whether a row bears a force at any node: many of a group are open most of the time. */
static inline bool motion_bears(const double force[NODES])
{
    return force[0] != 0.0 || force[1] != 0.0 || force[2] != 0.0 || force[3] != 0.0;
}

/* Integral and double integral, over a step of length h, of the forces at its nodes. */
static inline void motion_integrate(const double force[NODES], double h, double *impulse,
                                    double *travel)
{
    const double *weight = collocation.weight;
    const double *position = collocation.position_end;
    double sum =
        weight[0] * force[0] + weight[1] * force[1] + weight[2] * force[2] + weight[3] * force[3];
    double twice = position[0] * force[0] + position[1] * force[1] + position[2] * force[2] +
                   position[3] * force[3];
    *impulse = sum * h;
    *travel = twice * (h * h);
}

/* The rigid part of motion_step (with the time) and of motion_push. */
void motion_step_gaps(struct motion *to, const struct motion *from, const struct scene *scene,
                      int level);
void motion_push_gaps(struct motion *end, const struct scene *scene, int level, size_t row,
                      const double force[NODES]);

/* d and its rate of one row. */
void motion_approach(const struct motion *motion, const struct scene *scene, size_t row,
                     double *approach, double *rate);

/* The same after a free motion over `time`, or a rewind where it is negative, without touching the
 * state. */
void motion_approach_at(const struct motion *motion, const struct scene *scene, size_t row,
                        double time, double *approach, double *rate);

/* Vibration energy of one body, J. */
double motion_vibration(const struct motion *motion, const struct scene *scene, size_t body);

/* Energy that damping takes during a free motion over `time` >= 0, J. */
double motion_free_loss(const struct motion *motion, const struct scene *scene, double time);

#endif
