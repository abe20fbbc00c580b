/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A whole scene as one system of ordinary differential equations, for a general solver
 * (reference.c). */
#ifndef PERCUSS_IMPACT_REFERENCE_SYSTEM_H
#define PERCUSS_IMPACT_REFERENCE_SYSTEM_H

#include "contact/friction.h"
#include "impact/memory_rates.h"
#include "impact/motion.h"

/* A contact beside lossy laws. */
struct followed {
    double stiffness, fades;       /* slope of the force, N/m, and its rate at the same d, N/s */
    size_t state;                  /* where in y its memory is */
    struct memory_rates *memory;   /* of a law that remembers, else NULL */
    struct memory_instant present; /* of that, */
    double *rate;                  /* the rates of its state, */
    double turning;                /* and of its width, or of d while it shrinks, m/s */
    double parted_at, parted_rate; /* s; of the gap there, m/s */
};

/* y: [rows] gaps, [rows] gap rates, [rows] impulses, 1 damping loss, of each contact with friction
 * its normal work in compression and in release, where a law is lossy the work of all forces on
 * their approaches and what each contact remembers, then every group's q and v. Root functions: per
 * contact the local indentation, the approach rate and, where a law yields, the indentation beyond
 * the elastic limit; of one that remembers the rate of its width, and whether its middle bears a
 * force.
 *
 * Friction depends on the way: its force in a state is that of the cells walked from the last step
 * that was accepted to there, straight, which is a continuous function of the state. An accepted
 * step takes the walk to its end for good. */
struct reference_system {
    const struct scene *scene;
    size_t rows;
    size_t roots;                                           /* root functions of a contact */
    size_t size;                                            /* of y */
    struct motion motion;                                   /* a state unpacked */
    double *approach, *rate, *indentation, *force, *matrix; /* [row], local; matrix: contacts^2 */
    double *absolute;                                       /* [size] absolute tolerances */
    double *absolute_force;    /* [contact] of a collision with all the energy, N */
    double *duration;          /* [contact] of such a collision, s */
    double *pressed;           /* [contact] approaches less the tangents' effect */
    struct friction *taken;    /* [frictions]: histories up to the last accepted step */
    struct friction *trial;    /* [frictions]: to the state of the last evaluation */
    struct followed *followed; /* [contact]; NULL: no law is lossy */
    bool remembers;            /* any of them */
};

/* Memory from the arena. False: out of memory. */
bool reference_system_create(struct reference_system *system, const struct scene *scene,
                             struct arena *arena);
bool reference_frictions_create(struct reference_system *system, double accuracy,
                                struct arena *arena);

/* Sets the absolute tolerances from the energy of a motion, so that they are independent of
 * units. */
void reference_system_tolerate(struct reference_system *system, const struct motion *motion,
                               double relative);

/* Places in y: the damping loss, the works of friction `i`'s contact, that of all forces beside
 * lossy laws. */
size_t reference_damping_loss(const struct reference_system *system);
size_t reference_normal_work(const struct reference_system *system, size_t i);
size_t reference_lossy_work(const struct reference_system *system);

/* Gaps, rates and modes of a state, and the state of a motion with all else 0. */
void reference_system_unpack(const struct reference_system *system, const double *y,
                             struct motion *motion);
void reference_system_pack(const struct reference_system *system, const struct motion *motion,
                           double *y);

/* Finds motion, approaches, local indentations and forces of a state. */
void reference_system_forces(struct reference_system *system, double t, const double *y);

/* dy/dt and the root functions, see ode.h; `context`: the system. */
void reference_system_rates(double t, const double *y, double *rate, void *context);
void reference_system_roots(double t, const double *y, double *values, void *context);

/* The cells of friction `i`, all open, at the present displacement. */
void reference_friction_begin(struct reference_system *system, size_t i, double depth);

/* Of a contact that remembers, else NULL. */
struct followed *reference_memory_of(const struct reference_system *system, size_t contact);

/* Reduction of a row's approach by the residual flexibility under the rows from `first` to `end`.
 */
double reference_residual(const struct reference_system *system, size_t row, size_t first,
                          size_t end);

#endif
