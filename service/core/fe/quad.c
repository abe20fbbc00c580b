/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/quad.h"

#include <math.h>
#include <string.h>

#include "numeric/linear.h"

static const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

/* shape values and their slopes in r and z at (s, t); returns the Jacobian */
static double shapes(const double r[4], const double z[4], const double at[2], double value[4],
                     double slope[4][2])
{
    double ds[4], dt[4];
    double rs = 0.0, rt = 0.0, zs = 0.0, zt = 0.0;
    /* bilinear on the square, and the slopes of the map from it to r and z */
    for (int i = 0; i < 4; i++) {
        double a = 1.0 + corner[i][0] * at[0];
        double b = 1.0 + corner[i][1] * at[1];
        value[i] = 0.25 * a * b;
        ds[i] = 0.25 * corner[i][0] * b;
        dt[i] = 0.25 * corner[i][1] * a;
        rs += ds[i] * r[i];
        rt += dt[i] * r[i];
        zs += ds[i] * z[i];
        zt += dt[i] * z[i];
    }
    /* their slopes in r and z, by the map's inverse */
    double jacobian = rs * zt - rt * zs;
    for (int i = 0; i < 4; i++) {
        slope[i][0] = (zt * ds[i] - zs * dt[i]) / jacobian;
        slope[i][1] = (rs * dt[i] - rt * ds[i]) / jacobian;
    }
    return jacobian;
}

bool quad_make(const double r[4], const double z[4], struct quad *quad)
{
    memset(quad, 0, sizeof *quad);
    double mean[QUAD_FREEDOMS] = {0.0};
    double whole = 0.0;
    for (int p = 0; p < QUAD_POINTS; p++) {
        /* shape functions at a point, radius and volume there */
        double at[2] = {corner[p][0] / sqrt(3.0), corner[p][1] / sqrt(3.0)};
        double value[4], slope[4][2];
        double jacobian = shapes(r, z, at, value, slope);
        double radius = 0.0;
        for (int i = 0; i < 4; i++)
            radius += value[i] * r[i];
        if (!(jacobian > 0.0 && radius > 0.0))
            return false;
        quad->volume[p] = 2.0 * M_PI * radius * jacobian;
        whole += quad->volume[p];
        /* strains by nodal displacements: rr, zz, hoop, rz */
        for (int i = 0; i < 4; i++) {
            quad->strain[p][0][2 * i] = slope[i][0];
            quad->strain[p][1][2 * i + 1] = slope[i][1];
            quad->strain[p][2][2 * i] = value[i] / radius;
            quad->strain[p][3][2 * i] = slope[i][1];
            quad->strain[p][3][2 * i + 1] = slope[i][0];
        }
        /* the mean change of volume */
        for (int k = 0; k < QUAD_FREEDOMS; k++)
            mean[k] += quad->volume[p] *
                       (quad->strain[p][0][k] + quad->strain[p][1][k] + quad->strain[p][2][k]);
    }
    /* every point gets the mean change of volume */
    for (int p = 0; p < QUAD_POINTS; p++)
        for (int k = 0; k < QUAD_FREEDOMS; k++) {
            double own = quad->strain[p][0][k] + quad->strain[p][1][k] + quad->strain[p][2][k];
            for (int c = 0; c < 3; c++)
                quad->strain[p][c][k] += (mean[k] / whole - own) / 3.0;
        }
    return true;
}

void quad_add_force(const struct quad *quad, int point, const double stress[STRESS_COMPONENTS],
                    double force[QUAD_FREEDOMS])
{
    for (int c = 0; c < STRESS_COMPONENTS; c++) {
        double pull = quad->volume[point] * stress[c];
        for (int k = 0; k < QUAD_FREEDOMS; k++)
            force[k] += pull * quad->strain[point][c][k];
    }
}

void quad_add_stiffness(const struct quad *quad, int point,
                        const double moduli[STRESS_COMPONENTS * STRESS_COMPONENTS],
                        double stiffness[QUAD_FREEDOMS * QUAD_FREEDOMS])
{
    double stress[STRESS_COMPONENTS][QUAD_FREEDOMS] = {{0.0}};
    for (int c = 0; c < STRESS_COMPONENTS; c++)
        for (int d = 0; d < STRESS_COMPONENTS; d++)
            for (int k = 0; k < QUAD_FREEDOMS; k++)
                stress[c][k] += quad->volume[point] * moduli[4 * c + d] * quad->strain[point][d][k];
    for (int c = 0; c < STRESS_COMPONENTS; c++)
        for (int i = 0; i < QUAD_FREEDOMS; i++)
            for (int k = 0; k < QUAD_FREEDOMS; k++)
                stiffness[QUAD_FREEDOMS * i + k] += quad->strain[point][c][i] * stress[c][k];
}

void quad_strain(const struct quad *quad, int point, const double displacement[QUAD_FREEDOMS],
                 double strain[STRESS_COMPONENTS])
{
    for (int c = 0; c < STRESS_COMPONENTS; c++) {
        strain[c] = 0.0;
        for (int k = 0; k < QUAD_FREEDOMS; k++)
            strain[c] += quad->strain[point][c][k] * displacement[k];
    }
}

/* ---- properties for explicit dynamics ---- */

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
