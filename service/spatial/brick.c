/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/brick.h"

#include <math.h>
#include <string.h>

/* adds the part of one point: lambda g_i g_j' + mu (g_j g_i' + (g_i . g_j) 1) for each two nodes */
static void add_point(const double *shape, double (*gradient)[3], const double modulus[3],
                      double stiffness[BRICK_FREEDOMS][BRICK_FREEDOMS],
                      double mass[BRICK_NODES][BRICK_NODES])
{
    double lambda = modulus[0], mu = modulus[1];
    for (int i = 0; i < BRICK_NODES; i++)
        for (int j = 0; j <= i; j++) {
            const double *a = gradient[i], *b = gradient[j];
            double dot = mu * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
            for (int x = 0; x < 3; x++)
                for (int y = 0; y < 3; y++)
                    stiffness[3 * i + x][3 * j + y] +=
                        lambda * a[x] * b[y] + mu * b[x] * a[y] + (x == y ? dot : 0.0);
            mass[i][j] += modulus[2] * shape[i] * shape[j];
        }
}

bool brick_matrices(double points[ELEMENT_MOST_NODES][3], const struct material *material,
                    double stiffness[BRICK_FREEDOMS][BRICK_FREEDOMS],
                    double mass[BRICK_NODES][BRICK_NODES])
{
    memset(stiffness, 0, sizeof(double) * BRICK_FREEDOMS * BRICK_FREEDOMS);
    memset(mass, 0, sizeof(double) * BRICK_NODES * BRICK_NODES);
    double mu = material_shear_modulus(material);
    double lambda = 2.0 * mu * material->poisson / (1.0 - 2.0 * material->poisson);
    struct element_rule rule;
    element_rule_make(ELEMENT_HEX27, &rule);
    /* the lower triangle point by point; the map has one hand throughout */
    double hand = 0.0;
    for (size_t p = 0; p < rule.point_count; p++) {
        struct element_point point;
        element_at(&rule, p, points, &point);
        hand = p == 0 ? point.volume : hand;
        if (!(point.volume * hand > 0.0))
            return false;
        double volume = fabs(point.volume);
        double modulus[3] = {lambda * volume, mu * volume, material->density * volume};
        add_point(rule.shape[p], point.gradient, modulus, stiffness, mass);
    }
    /* the upper one */
    for (int i = 0; i < BRICK_FREEDOMS; i++)
        for (int j = 0; j < i; j++)
            stiffness[j][i] = stiffness[i][j];
    for (int i = 0; i < BRICK_NODES; i++)
        for (int j = 0; j < i; j++)
            mass[j][i] = mass[i][j];
    return true;
}
