/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One elastic contact of bodies without vibration: a conservative motion with one degree of
 * freedom, solved by its energy. Nothing is lost, so e = 1 to the last bits at any tolerance. */
#include <math.h>

#include "contact/hertz.h"
#include "contact/plastic.h"
#include "impact/energy.h"
#include "impact/impact.h"
#include "impact/impact_scale.h"

/* Newton's method takes some six rounds to the last bit from a start within a few times the
 * solution. */
enum { MAX_ROUNDS = 60 };
static const double ROUNDING = 1e-16;

/* Of the compression by a force k d^(3/2), with B Euler's beta function: its duration over depth by
 * speed, int dx / sqrt(1 - x^(5/2)) = 2/5 B(2/5, 1/2), and int F'^2 dt over K^2 at the largest
 * indentation times depth by speed, int x sqrt(1 - x^(5/2)) dx = 2/5 B(4/5, 3/2). */
static const double HERTZ_TIME = 1.4716375921623523;
static const double HERTZ_VISCOSITY = 0.35373658745353381;

/* Panels of four Gauss nodes: the integrands are smooth, and their error is that of rounding. */
enum { PANELS = 24 };

/* Whether the approach is too weak to make a law yield. */
static bool stays_elastic(const struct scene *scene)
{
    const struct contact_law *law = &scene->laws[0];
    double speed = scene->gap_rate[0];
    return !law->operations->curve || 0.5 * speed * speed / scene->w[0] <=
                                          law->operations->stored(law, contact_law_limit(law));
}

bool impact_is_rigid_pair(const struct scene *scene)
{
    return scene->rows == 1 && scene->groups == 0 && scene->gap_acceleration[0] == 0.0 &&
           scene->residual[0] == 0.0 && scene->gap_rate[0] < 0.0 &&
           !scene->laws[0].operations->lossy && stays_elastic(scene);
}

/* Integrals of a compression. */
struct compression {
    double indentation; /* largest, m */
    double duration;    /* s */
    double viscosity;   /* int F'^2 dt, for the effect of omitted viscosity, N^2/s */
};

static struct compression compress_hertz(const struct contact_law *law, double energy, double speed)
{
    double stiffness;
    double k = contact_law_force(law, 1.0, &stiffness);
    struct compression compression = {.indentation = pow(energy / (HERTZ_WORK * k), 0.4)};
    contact_law_force(law, compression.indentation, &stiffness);
    compression.duration = HERTZ_TIME * compression.indentation / speed;
    compression.viscosity =
        HERTZ_VISCOSITY * stiffness * stiffness * compression.indentation * speed;
    return compression;
}

/* Largest indentation: the law stores all the energy. Newton's method; the force is the derivative.
 */
static double largest_indentation(const struct contact_law *law, double start, double energy)
{
    double d = start;
    for (int i = 0; i < MAX_ROUNDS; i++) {
        double stiffness;
        double force = contact_law_force(law, d, &stiffness);
        double change = (law->operations->stored(law, d) - energy) / force;
        d -= change;
        if (!(fabs(change) > ROUNDING * d))
            break;
    }
    return d;
}

/* From touch to the largest indentation: the time int dd / sqrt(v^2 (1 - U(d)/E)), and int F'^2 dt.
 * With d = d_max sin^2(phi) the integrands are smooth at both ends for a force like d^(3/2) or d.
 */
static struct compression compress(const struct contact_law *law, double start, double energy,
                                   double speed)
{
    double largest = largest_indentation(law, start, energy);
    double sum = 0.0;
    double squares = 0.0;
    for (int p = 0; p < PANELS; p++) {
        for (int j = 0; j < NODES; j++) {
            /* dd = d_max 2 sin(phi) cos(phi) dphi, at the speed v sqrt(1 - U(d)/E) */
            double phi = 0.5 * M_PI * (p + collocation.node[j]) / PANELS;
            double s = sin(phi);
            double left = 1.0 - law->operations->stored(law, largest * s * s) / energy;
            double stiffness;
            contact_law_force(law, largest * s * s, &stiffness);
            double weight = collocation.weight[j] * 2.0 * s * cos(phi);
            sum += weight / sqrt(left);
            squares += weight * sqrt(left) * stiffness * stiffness;
        }
    }
    double panel = 0.5 * M_PI / PANELS * largest;
    return (struct compression){largest, sum * panel / speed, squares * panel * speed};
}

enum percuss_status impact_rigid_pair(const struct scene *scene,
                                      const struct impact_settings *settings, struct arena *arena,
                                      struct impact_outcome *outcome)
{
    double speed = -scene->gap_rate[0];
    double w = scene->w[0];
    double energy = 0.5 * speed * speed / w;
    double touch = scene->gap[0] / speed;
    /* the bodies separate at the speed of their approach */
    impact_begin(outcome, scene);
    motion_start(&outcome->motion, scene);
    outcome->time_shift = touch;
    outcome->end_reason = PERCUSS_END_SEPARATED;
    /* depth and duration: rebound takes the time of compression */
    const struct contact_law *law = &scene->laws[0];
    struct compression compression =
        law->operations == &contact_law_HERTZ
            ? compress_hertz(law, energy, speed)
            : compress(law, impact_scale_of(scene, 0, speed).indentation, energy, speed);
    double half = compression.duration;
    if (touch + 2.0 * half > settings->horizon)
        return impact_modal(scene, settings, arena, outcome);

    /* the one sub-impact */
    outcome->tracks[0].viscosity = 2.0 * compression.viscosity;
    track_open(&outcome->tracks[0], touch, -speed);
    struct sub_impact *open = &outcome->tracks[0].open;
    open->compression_end = touch + half;
    open->compression_impulse = speed / w;
    open->impulse = 2.0 * speed / w;
    open->max_indentation = compression.indentation;
    track_close(&outcome->tracks[0], law, touch + 2.0 * half, speed);
    /* and the motion at its end */
    outcome->motion.gap[0] = 0.0;
    outcome->motion.gap_rate[0] = speed;
    outcome->motion.time = outcome->window = touch + 2.0 * half;
    static const double open_at_end = 0.0;
    const struct energy_end end = {&open_at_end, NULL, NULL, 0.0};
    return energy_audit(scene, &end, arena, outcome) ? PERCUSS_OK : PERCUSS_INTERNAL;
}
