/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/quad_dynamics.h"

#include <math.h>
#include <string.h>

#include "numeric/linear.h"

void quad_dilatation(const struct quad *quad, double dilatation[QUAD_FREEDOMS])
{
    for (int k = 0; k < QUAD_FREEDOMS; k++)
        dilatation[k] = quad->strain[0][0][k] + quad->strain[0][1][k] + quad->strain[0][2][k];
}

void quad_slopes(const struct quad *quad, int point, double slope[QUAD_NODES][3])
{
    double dilatation[QUAD_FREEDOMS];
    quad_dilatation(quad, dilatation);
    for (int a = 0; a < QUAD_NODES; a++) {
        slope[a][0] = quad->strain[point][3][2 * a + 1];
        slope[a][1] = quad->strain[point][3][2 * a];
        /* tt = N/r + (dilatation - dN/dr - N/r) / 3 */
        slope[a][2] = 1.5 * quad->strain[point][2][2 * a] + 0.5 * (slope[a][0] - dilatation[2 * a]);
    }
}

void quad_shares(const struct quad *quad, double share[QUAD_NODES])
{
    memset(share, 0, QUAD_NODES * sizeof *share);
    for (int p = 0; p < QUAD_POINTS; p++) {
        double slope[QUAD_NODES][3];
        double sum = 0.0; /* of N/r: the values N add up to 1 */
        quad_slopes(quad, p, slope);
        for (int a = 0; a < QUAD_NODES; a++)
            sum += slope[a][2];
        for (int a = 0; a < QUAD_NODES; a++)
            share[a] += quad->volume[p] * slope[a][2] / sum;
    }
}

void quad_elastic_stiffness(const struct quad *quad, const struct material *material,
                            double stiffness[QUAD_FREEDOMS][QUAD_FREEDOMS])
{
    struct plastic_law law = plastic_law_make(material);
    double moduli[STRESS_COMPONENTS * STRESS_COMPONENTS];
    plastic_law_moduli(&law, moduli);
    memset(stiffness, 0, QUAD_FREEDOMS * sizeof *stiffness);
    for (int p = 0; p < QUAD_POINTS; p++)
        quad_add_stiffness(quad, p, moduli, &stiffness[0][0]);
}

double quad_highest_frequency(const struct quad *quad, const struct material *material)
{
    double k[QUAD_FREEDOMS][QUAD_FREEDOMS];
    double square[QUAD_FREEDOMS];
    double share[QUAD_NODES];
    quad_elastic_stiffness(quad, material, k);
    quad_shares(quad, share);
    for (int i = 0; i < QUAD_FREEDOMS; i++)
        for (int j = 0; j < QUAD_FREEDOMS; j++)
            k[i][j] /= material->density * sqrt(share[i / 2] * share[j / 2]);
    if (!linear_symmetric_eigen(QUAD_FREEDOMS, &k[0][0], square))
        return NAN;
    return sqrt(square[QUAD_FREEDOMS - 1]);
}

double quad_mises(const struct quad *quad, const struct material *material,
                  const double u[QUAD_FREEDOMS])
{
    struct plastic_law law = plastic_law_make(material);
    double largest = 0.0;
    law.yield = INFINITY;
    for (int p = 0; p < QUAD_POINTS; p++) {
        struct plastic_state virgin = {0};
        double strain[STRESS_COMPONENTS], stress[STRESS_COMPONENTS];
        quad_strain(quad, p, u, strain);
        plasticity_return(&law, &virgin, strain, &virgin, stress, NULL);
        largest = fmax(largest, stress_equivalent(stress));
    }
    return largest;
}
