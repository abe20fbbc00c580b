/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/longitudinal.h"

#include <math.h>

#include "model/modal_basis.h"

/* Ends that hold the axis: any support does. */
static int held_ends(const struct body *body)
{
    return (body->supports[0] != SUPPORT_FREE) + (body->supports[1] != SUPPORT_FREE);
}

/* Wave number of mode k = 0, 1, ..., rad/m. */
static double wave_number_of(const struct body *body, size_t k)
{
    double half_waves = held_ends(body) == 1 ? (double)k + 0.5 : (double)k + 1.0;
    return half_waves * M_PI / body->span;
}

/* Lateral inertia: kinetic energy grows by this share, (nu r_p k)^2 with the polar radius of
 * gyration (Love; Graff, Wave Motion in Elastic Solids, section 2.5.3). */
static double lateral_share(const struct body *body, double wave_number)
{
    if (!body->lateral_inertia)
        return 0.0;
    double x = body->material.poisson * wave_number * body->radius * M_SQRT1_2;
    return x * x;
}

static void find(const struct body *body, struct modal_family *modes)
{
    double speed = sqrt(body->material.young / body->material.density);
    for (size_t k = 0; k < modes->count; k++) {
        double wave_number = wave_number_of(body, k);
        modes->omega[k] = wave_number * speed / sqrt(1.0 + lateral_share(body, wave_number));
    }
}

static bool is_right(const struct family_load *load)
{
    return load->bar.x > 0.0;
}

/* u_k = sqrt(2/M) cos or sin, largest at a free end; sign by the number of half waves between:
 * free-free cos(k pi (x/L + 1/2)) with k from 1; one end held: +1 at the free end. */
static void participations(const struct body *body, const struct modal_family *modes,
                           const size_t *which, size_t count, const struct family_load *load,
                           double *row)
{
    (void)modes;
    int held = held_ends(body);
    for (size_t i = 0; i < count; i++) {
        size_t k = which[i];
        double share = lateral_share(body, wave_number_of(body, k));
        double amplitude = held == 2 ? 0.0 : sqrt(2.0 / (body->mass * (1.0 + share)));
        bool flips = held == 0 && is_right(load) && k % 2 == 0;
        row[i] = flips ? -amplitude * load->bar.force : amplitude * load->bar.force;
    }
}

/* Free-free: L/(3EA) at the same end, -L/(6EA) across, both with inertia relief (u along x); one
 * end held: L/(EA). */
static double compliance(const struct body *body, size_t family, const struct family_load *i,
                         const struct family_load *j)
{
    (void)family;
    double full = body->span / (body->material.young * body->area);
    double share = 1.0;
    if (held_ends(body) == 0)
        share = is_right(i) == is_right(j) ? 1.0 / 3.0 : -1.0 / 6.0;
    else if (held_ends(body) == 2)
        share = 0.0;
    return share * full * i->bar.force * j->bar.force;
}

static bool crowds(const struct body *body)
{
    return body->lateral_inertia;
}

const struct mode_family longitudinal_family = {
    .find = find,
    .participations = participations,
    .compliance = compliance,
    .crowds = crowds,
};
