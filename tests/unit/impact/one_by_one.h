/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A ball on a viscoelastic half-space by the circles of the contact, one by one, in small steps of
 * the leapfrog rule: what the tests of memories and of micro-slip compare with. */
#ifndef PERCUSS_TEST_ONE_BY_ONE_H
#define PERCUSS_TEST_ONE_BY_ONE_H

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "model/relaxation.h"

/* The body that is hit: an oscillator with the participation phi, which hits the ball again. */
struct wall {
    double omega, phi;
    double until; /* s; 0: a rigid wall, until the ball parts */
};

/* Friction and the slip before the impact; 0: none. */
struct spin {
    double coefficient, kappa, slip;
    double inverse_mass; /* along the surface */
};

/* Speeds after it. */
struct rebound {
    double up, along;
};

enum { CIRCLES = 900 };

/* Displacements of the circles along one axis, and their arms m, time m' = u - m. */
struct springs {
    double arm[RELAXATION_MOST][CIRCLES], displaced[CIRCLES];
};

/* The arms' exact steps under displacements that are linear in a step. */
struct arms {
    const struct relaxation *of;
    double kept[RELAXATION_MOST], half[RELAXATION_MOST], now;
};

static inline struct arms arms_of(const struct relaxation *of, double h)
{
    struct arms arms = {.of = of, .now = 1.0};
    for (size_t k = 0; k < of->count; k++) {
        double z = h / of->time[k];
        arms.kept[k] = exp(-z);
        arms.half[k] = 1.0 + expm1(-z) / z; /* of the change of u within the step */
        arms.now -= of->share[k] * arms.half[k];
    }
    return arms;
}

static inline double arms_past(const struct arms *arms, const struct springs *springs, int c)
{
    double past = 0.0;
    for (size_t k = 0; k < arms->of->count; k++)
        past +=
            arms->of->share[k] * (arms->kept[k] * springs->arm[k][c] +
                                  (1.0 - arms->kept[k] - arms->half[k]) * springs->displaced[c]);
    return past;
}

static inline void arms_step(const struct arms *arms, struct springs *springs, int c, double u)
{
    for (size_t k = 0; k < arms->of->count; k++)
        springs->arm[k][c] = arms->kept[k] * springs->arm[k][c] + arms->half[k] * u +
                             (1.0 - arms->kept[k] - arms->half[k]) * springs->displaced[c];
    springs->displaced[c] = u;
}

/* A unit mass at unit speed on k = 1, with circles of equal depths. One that is free has u - sum
 * share m = 0. Forces are (1 + dissipation d') times those of the circles. */
static inline struct rebound one_by_one(const struct relaxation *of, double dissipation,
                                        const struct wall *wall, const struct spin *spin)
{
    static struct springs normal, tangent;
    const double h = 4e-4, widest = 1.5;
    const struct arms arms = arms_of(of, h);
    double x = 0.0, v = 1.0, q = 0.0, p = 0.0, force = 0.0, u = spin->slip, drag = 0.0;
    memset(&normal, 0, sizeof normal);
    memset(&tangent, 0, sizeof tangent);
    for (double t = 0.0;; t += h) {
        bool any = false;
        v -= 0.5 * h * force;
        u -= 0.5 * h * spin->inverse_mass * drag;
        p += 0.5 * h * (wall->phi * force - wall->omega * wall->omega * q);
        x += h * v;
        q += h * p;
        double d = x - wall->phi * q;
        /* the rate at the step's end, to second order */
        double scale = larger(1.0 + dissipation * (v - 0.5 * h * force - wall->phi * p), 0.0);
        force = drag = 0.0;
        for (int c = 0; c < CIRCLES; c++) {
            double y = widest * ((c + 0.5) * (c + 0.5)) / (CIRCLES * (double)CIRCLES);
            if (d < y && normal.displaced[c] == 0.0)
                break; /* nothing has touched yet */
            /* dx = sqrt(widest) / CIRCLES, and F = 3/2 int f dx */
            const double unit = 1.5 * sqrt(widest) / CIRCLES * scale;
            double past = arms_past(&arms, &normal, c), f = (d - y) * arms.now - past;
            any = any || f * scale > 0.0;
            force += unit * larger(f, 0.0);
            arms_step(&arms, &normal, c, f > 0.0 ? d - y : past / arms.now);
            if (!(spin->coefficient > 0.0))
                continue;
            double was = arms_past(&arms, &tangent, c);
            double e = (tangent.displaced[c] + h * u) * arms.now - was;
            double limit = spin->coefficient * scale * larger(f, 0.0) / spin->kappa;
            e = larger(smaller(e, limit), -limit);
            drag += 1.5 * sqrt(widest) / CIRCLES * spin->kappa * e;
            arms_step(&arms, &tangent, c, (e + was) / arms.now);
        }
        v -= 0.5 * h * force;
        u -= 0.5 * h * spin->inverse_mass * drag;
        p += 0.5 * h * (wall->phi * force - wall->omega * wall->omega * q);
        if (wall->until > 0.0 ? t > wall->until : !any && t > 0.1)
            return (struct rebound){-v, u};
    }
}

#endif
