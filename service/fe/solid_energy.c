/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "fe/solid_parts.h"

double solid_flow(const struct solid *solid)
{
    double most = 0.0;
    for (size_t e = 0; e < solid->zone; e++)
        for (int p = 0; p < QUAD_POINTS; p++)
            most = fmax(most, solid->present.history[e][p].accumulated);
    return most;
}

double solid_plastic_work(const struct solid *solid)
{
    /* while a point flows its equivalent stress is yield + hardening p: the integral over p */
    double work = 0.0;
    for (size_t e = 0; e < solid->zone; e++)
        for (int p = 0; p < QUAD_POINTS; p++) {
            double flow = solid->present.history[e][p].accumulated;
            if (flow > 0.0)
                work += solid->quads[e].volume[p] * flow *
                        (solid->law.yield + 0.5 * solid->law.hardening * flow);
        }
    return work;
}

double solid_elastic_energy(struct solid *solid)
{
    double energy = 0.0;
    double moduli[STRESS_COMPONENTS * STRESS_COMPONENTS];
    solid_settle(solid);
    plastic_law_moduli(&solid->law, moduli);
    for (size_t e = 0; e < solid->mesh->elements; e++) {
        double local[QUAD_FREEDOMS];
        solid_gather(solid, e, local);
        for (int p = 0; p < QUAD_POINTS; p++) {
            /* half of the elastic strain times its stress */
            double strain[STRESS_COMPONENTS];
            double density = 0.0;
            quad_strain(&solid->quads[e], p, local, strain);
            for (int i = 0; i < STRESS_COMPONENTS; i++)
                strain[i] -= solid->present.history[e][p].strain[i];
            for (int i = 0; i < STRESS_COMPONENTS; i++)
                for (int j = 0; j < STRESS_COMPONENTS; j++)
                    density += 0.5 * strain[i] * moduli[4 * i + j] * strain[j];
            energy += solid->quads[e].volume[p] * density;
        }
    }
    return energy;
}
