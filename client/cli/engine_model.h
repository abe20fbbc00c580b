/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What other simulators compute of an impact: two rigid bodies, and between them one spring with
 * one damper that never pull. Their parameters from answers of percuss. */
#ifndef PERCUSS_CLI_ENGINE_MODEL_H
#define PERCUSS_CLI_ENGINE_MODEL_H

#include <stddef.h>

/* A spring with a linear damper, m x'' = -k x - c x' as long as that presses; ratio = c / (2 sqrt(k
 * m)) >= 0. Of Newton's restitution, and of the contact's time in units of sqrt(m / k); Schwager
 * and Poeschel, Granular Matter 9, 465 (2007), eqs. 18 to 22, in one formula. */
double spring_restitution(double ratio);
double spring_time(double ratio);

/* The ratio with which that restitution comes about; restitution in (0, 1]. */
double spring_ratio(double restitution);

/* Hunt and Crossley's damper on a linear spring, m x'' = -k x (1 + d x'): its restitution, which
 * depends on the dissipation d (s/m) and the speed (m/s) alone. */
double hunt_crossley_restitution(double dissipation, double speed);

/* One answer of percuss, and what the other simulator makes of that speed. */
struct engine_point {
    double speed;       /* m/s */
    double restitution; /* percuss's */
    double error;       /* of that, by steps, modes and models */
    double duration;    /* of the sub-impact with the largest impulse, s */
    double model;       /* the other simulator's restitution */
};

/* How a simulator's restitution depends on the speed: not at all, or by Hunt and Crossley. */
enum engine_law { ENGINE_CONSTANT, ENGINE_HUNT_CROSSLEY };

/* SI units. */
struct engine_fit {
    double restitution;        /* ENGINE_CONSTANT */
    double mass;               /* effective, of the pair */
    double duration;           /* of the contact in the other simulator */
    double step;               /* of its time, at most */
    double stiffness, damping; /* damping: ENGINE_CONSTANT */
    double dissipation;        /* ENGINE_HUNT_CROSSLEY */
    double worst;              /* largest |model - restitution| of the points */
};

/* Parameters with the least largest error of the restitution, for a pair of the effective mass
 * (kg). The contact lasts as long as the points' in the geometric mean, or ENGINE_STEPS steps of
 * the simulator (`step`, s; 0: any), where that is longer: the restitution stays. Fills the points'
 * `model`. The restitutions' middle must be in (0, 1]. */
enum { ENGINE_STEPS = 50 };
struct engine_fit engine_fit(enum engine_law law, struct engine_point *points, size_t count,
                             double mass, double step);

#endif
