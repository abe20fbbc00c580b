/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Deviations of the models of a contact from its bodies. The figures are of complete finite
 * elements and of three-dimensional meshes (docs/lab/accuracy.md). */
#ifndef PERCUSS_SOLVE_ERROR_DEVIATION_H
#define PERCUSS_SOLVE_ERROR_DEVIATION_H

#include "impact/impact.h"
#include "solve/assembly.h"
#include "solve/problem.h"

/* Deviations that nineteen of twenty stay below. */
struct deviation {
    double force;      /* share of the law's force: patches against radii, theories of vibration */
    double compliance; /* m/N in series: the unknown part of the bodies' regular one */
    double yield;      /* share of the rebound of a contact that flows */
};

/* Normal deviates are that often within the deviations above. */
static const double DEVIATION_SIGMAS = 2.0;

/* The figures by which one impact is judged. */
struct model_impact {
    double force, indentation;      /* largest, N and m */
    double duration;                /* of the longest contact, s */
    struct contact_history history; /* of the law after it; zero where nothing yielded */
};

/* That of a solution. */
struct model_impact model_impact_of(const struct problem *problem,
                                    const struct impact_outcome *outcome, size_t contact);

/* That of bodies which would be rigid but for the contact, before anything is solved. */
struct model_impact model_impact_expected(const struct problem *problem, size_t contact);

/* The same of an elastic contact that closes as the fastest of all does: a body at rest on another
 * hands the impact on. */
struct model_impact model_impact_fastest(const struct problem *problem, size_t contact);

struct deviation deviation_of(const struct problem *problem, size_t contact,
                              const struct model_impact *impact);

/* Share of the stiffness that a compliance in series with a contact changes, per m/N. */
double model_impact_stiffness(const struct model_impact *impact);

/* Shares of its limit by which the tangential impulse of a contact with friction may differ. */
struct deviation_along {
    double stiffness; /* by the unknown part of the bodies' tangential flexibility */
    double waves;     /* by the waves that leave along half-spaces */
};

struct deviation_along deviation_along(const struct problem *problem,
                                       const struct contact_friction *friction);

/* Deviation of the stiffness, as a share: of the law's force and the compliance together. */
double deviation_stiffness(const struct deviation *deviation, const struct model_impact *impact);

/* Where within that the stiffness grows most: force and compliance each by its own share of it. */
struct stiffening {
    double force;      /* change of its logarithm */
    double compliance; /* m/N in series, negative */
};

struct stiffening deviation_stiffening(const struct deviation *deviation,
                                       const struct model_impact *impact);

/* Vibration that the body on one side of a contact, if it is taken as rigid, would keep, as a part
 * of the restitution: waves along it, and bending (model/plate.h). */
double deviation_of_rigid(const struct problem *problem, size_t contact, int which,
                          const struct model_impact *impact);

/* The same of both bodies, with the bending across broad beams. */
double deviation_ringing(const struct problem *problem, size_t contact,
                         const struct model_impact *impact);

/* Energy that an impact leaves in waves that no mode has, J: within bars, which have none of them
 * by their theory, before they come back from the far side; in a body with modes that end before
 * the impact's spectrum does. */
double deviation_waves(const struct problem *problem, const struct assembly *assembly,
                       const struct impact_outcome *outcome, size_t contact,
                       const struct model_impact *impact);

/* Shifts the laws in use, all by the same deviates, and the compliances in series. To be called
 * again where other laws or compliances were chosen. PERCUSS_OK or PERCUSS_INTERNAL. */
enum percuss_status deviation_shift(struct problem *problem, struct fault *fault);

#endif
