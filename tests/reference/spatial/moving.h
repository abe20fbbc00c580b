/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A meshed body in motion, pressed at the nodes that may touch: its steps in time, and the factors
 * that they are solved with. */
#ifndef PERCUSS_SPATIAL_MOVING_H
#define PERCUSS_SPATIAL_MOVING_H

#include <complex.h>

#include "spatial/system.h"

/* Steps of linear vibration M u'' + K u = f by collocation at two places with a matrix of one pair
 * of complex eigenvalues: one complex solution is a step. Radau's (places 1/3, 1; third order)
 * follows modes too stiff for the step statically and is made for contact; Gauss's (fourth order)
 * keeps energy to rounding and is made for free flight. Hairer, Wanner: Solving Ordinary
 * Differential Equations II, section IV.8. */
enum rational_rule { RATIONAL_RADAU, RATIONAL_GAUSS };

/* With s = 1 / (pole h)^2: (K + s M) p = s M (u0 + pole h v0) + start f0 + end f1 for forces that
 * go linearly from f0 to f1, q = (p - u0) / (pole h), then u1 = keep u0 + 2 Re(weight p),  v1 =
 * keep v0 + 2 Re(weight q). */
struct rational {
    double complex pole, weight, start, end;
    double keep;
};

struct rational rational_make(enum rational_rule rule);

/* The factor of K + s M for a complex s, made once and used for every step (MUMPS, sequential). */
struct kept_factor;

/* OK, or INTERNAL with the error code of MUMPS. */
enum percuss_status kept_factor_create(const struct system3 *system, double complex s,
                                       struct kept_factor **factor, struct fault *fault);
void kept_factor_free(struct kept_factor *factor);

/* Solves (K + s M) x = right in place for `count` vectors, one after the other. False: it failed.
 */
bool kept_factor_solve(struct kept_factor *factor, size_t count, double complex *right);

/* Numbers in the factor. */
double kept_factor_size(const struct kept_factor *factor);

/* One size of steps. */
struct pace3 {
    struct rational rule;
    double step; /* s */
    struct kept_factor *factor;
};

/* Where forces act: `count` nodes of the system, each with a direction. */
struct pressed {
    size_t count;
    size_t *nodes;
    double (*directions)[3]; /* of a positive force on this body */
};

struct moving {
    const struct system3 *system; /* borrowed, as `pressed` is */
    const struct pressed *pressed;
    double *u, *v;           /* m, m/s: the state */
    double *next_u, *next_v; /* after the step that is tried */
    double *scratch;         /* 2 freedoms */
};

/* At rest; `rise` is its speed along z. OK, or INTERNAL: no memory. */
enum percuss_status moving_create(const struct system3 *system, const struct pressed *pressed,
                                  double rise, struct moving *moving, struct fault *fault);
void moving_free(struct moving *moving);

/* OK, or INTERNAL. */
enum percuss_status pace3_create(const struct system3 *system, enum rational_rule rule, double step,
                                 struct pace3 *pace, struct fault *fault);
void pace3_free(struct pace3 *pace);

/* A step is tried in three parts, so that those of several bodies of one mesh can be solved at
 * once: the right-hand side of a step with forces (N; NULL: none) that go from `start` to 0, its
 * solution by the pace's factor, and the state after the step. */
void moving_load(struct moving *moving, const struct pace3 *pace, const double *start,
                 double complex *right);
void moving_try(struct moving *moving, const struct pace3 *pace, const double complex *solution);

/* The same for forces that go from 0 to `end`, added to it. */
void moving_load_end(const struct moving *moving, const struct pace3 *pace, const double *end,
                     double complex *right);
void moving_press(struct moving *moving, const struct pace3 *pace, const double complex *solution);

/* The tried state becomes the state. */
void moving_accept(struct moving *moving);

/* Displacement of a pressed node along its direction, m: now, or as tried. */
double moving_at(const struct moving *moving, size_t i, bool tried);

/* compliance[i * count + j] += the displacement of i by then under a force on j that reaches 1 N at
 * the end of a step. False: the factor failed, or no memory. */
bool pressed_add_compliance(const struct system3 *system, const struct pressed *pressed,
                            const struct pace3 *pace, double *compliance);

/* J: kinetic energy beyond that of the mean motion along z, and strain energy. */
double moving_vibration(struct moving *moving);

#endif
