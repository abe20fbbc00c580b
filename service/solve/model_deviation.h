/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How far the models of a contact may be from its bodies: what of it is uncertain, and by how much.
 * The figures are of complete finite elements and of three-dimensional meshes (docs/accuracy.md).
 */
#ifndef PERCUSS_SOLVE_MODEL_DEVIATION_H
#define PERCUSS_SOLVE_MODEL_DEVIATION_H

#include "impact/impact.h"
#include "solve/assembly.h"
#include "solve/problem.h"

/* Deviations that nineteen of twenty stay below. */
struct model_deviation {
    double force;      /* share of the law's force: patches against radii, theories of vibration */
    double compliance; /* m/N in series: what of the bodies' regular one is not known */
    double yield;      /* share of what a contact that flows gives back by itself */
};

/* Hertz's parabolas and half-spaces: share of the force by (half-axis / radius)^2. */
static const double MODEL_DEVIATION_PATCH = 0.3;

/* Normal deviates are that often within the deviations above. */
static const double MODEL_DEVIATION_SIGMAS = 2.0;

/* One blow as it is judged by. */
struct model_blow {
    double force, indentation;      /* largest, N and m */
    double duration;                /* of the longest contact, s */
    struct contact_history history; /* of the law after it; zero where nothing yielded */
};

/* That of a solution. */
struct model_blow model_blow_of(const struct problem *problem, const struct impact_outcome *outcome,
                                size_t contact);

/* That of bodies which would be rigid but for the contact, before anything is solved. */
struct model_blow model_blow_expected(const struct problem *problem, size_t contact);

/* The same of an elastic contact that closes as the fastest of all does: what rests on a body hands
 * on the blow that it gets. */
struct model_blow model_blow_fastest(const struct problem *problem, size_t contact);

struct model_deviation model_deviation_of(const struct problem *problem, size_t contact,
                                          const struct model_blow *blow);

/* Share of the stiffness that a compliance in series with a contact changes, per m/N. */
double model_blow_stiffness(const struct model_blow *blow);

/* Deviation of the stiffness, as a share: of the law's force and the compliance together. */
double model_deviation_stiffness(const struct model_deviation *deviation,
                                 const struct model_blow *blow);

/* Where within that the stiffness grows most: force and compliance each by its own share of it. */
struct model_stiffening {
    double force;      /* change of its logarithm */
    double compliance; /* m/N in series, negative */
};

struct model_stiffening model_deviation_stiffening(const struct model_deviation *deviation,
                                                   const struct model_blow *blow);

/* What the body on one side of a contact, if it is taken as rigid, would keep as vibration of its
 * own, as a part of the restitution: waves along it, and bending (model/plate.h). */
double model_deviation_side(const struct problem *problem, size_t contact, int which,
                            const struct model_blow *blow);

/* The same of both bodies, with the bending across broad beams. */
double model_deviation_ringing(const struct problem *problem, size_t contact,
                               const struct model_blow *blow);

/* Energy that a blow leaves in waves that no mode has, J: within bars, whose theory has none of
 * them, before they come back from the far side; in a body whose modes end before the blow's
 * spectrum does. */
double model_deviation_waves(const struct problem *problem, const struct assembly *assembly,
                             const struct impact_outcome *outcome, size_t contact,
                             const struct model_blow *blow);

#endif
