/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/axi_element.h"

#include <math.h>
#include <string.h>

#include "numeric/linear.h"

/* Corners of the unit square, counter-clockwise, and the Gauss points beside them. */
static const double corner[AXI_NODES][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

/* Shape functions and their derivatives by (r, z) at one point; the Jacobian's determinant. */
static double shape_at(const double at[AXI_NODES][2], const double xi[2], double n[AXI_NODES],
                       double gradient[AXI_NODES][3])
{
    double local[AXI_NODES][2];
    double j[2][2] = {{0.0}};
    for (int a = 0; a < AXI_NODES; a++) {
        double p = 1.0 + corner[a][0] * xi[0];
        double q = 1.0 + corner[a][1] * xi[1];
        n[a] = 0.25 * p * q;
        local[a][0] = 0.25 * corner[a][0] * q;
        local[a][1] = 0.25 * p * corner[a][1];
        for (int i = 0; i < 2; i++)
            for (int k = 0; k < 2; k++)
                j[i][k] += local[a][i] * at[a][k];
    }
    double det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    for (int a = 0; a < AXI_NODES; a++) {
        gradient[a][0] = (j[1][1] * local[a][0] - j[0][1] * local[a][1]) / det;
        gradient[a][1] = (j[0][0] * local[a][1] - j[1][0] * local[a][0]) / det;
    }
    return det;
}

bool axi_element_make(struct axi_element *element, const double at[AXI_NODES][2])
{
    memset(element, 0, sizeof *element);
    for (int p = 0; p < AXI_POINTS; p++) {
        double xi[2] = {corner[p][0] / sqrt(3.0), corner[p][1] / sqrt(3.0)};
        double n[AXI_NODES];
        double det = shape_at(at, xi, n, element->gradient[p]);
        double r = 0.0;
        for (int a = 0; a < AXI_NODES; a++)
            r += n[a] * at[a][0];
        if (!(det > 0.0) || !(r > 0.0))
            return false;
        double weight = 2.0 * M_PI * r * det;
        element->weight[p] = weight;
        element->volume += weight;
        for (int a = 0; a < AXI_NODES; a++) {
            double *g = element->gradient[p][a];
            g[2] = n[a] / r;
            element->share[a] += weight * n[a];
            element->mean[2 * a] += weight * (g[0] + g[2]);
            element->mean[2 * a + 1] += weight * g[1];
        }
    }
    for (int i = 0; i < AXI_DOFS; i++)
        element->mean[i] /= element->volume;
    return true;
}

/* Strain (rr, zz, tt, gamma rz) at point p without the mean dilatation's correction. */
static void strain_at(const struct axi_element *element, int p, const double u[AXI_DOFS],
                      double strain[4])
{
    memset(strain, 0, 4 * sizeof *strain);
    for (int a = 0; a < AXI_NODES; a++) {
        const double *g = element->gradient[p][a];
        strain[0] += g[0] * u[2 * a];
        strain[1] += g[1] * u[2 * a + 1];
        strain[2] += g[2] * u[2 * a];
        strain[3] += g[1] * u[2 * a] + g[0] * u[2 * a + 1];
    }
}

/* Deviatoric stress (rr, zz, tt, rz) of an elastic strain. */
static void deviator(double shear_modulus, const double strain[4], double s[4])
{
    double third = (strain[0] + strain[1] + strain[2]) / 3.0;
    for (int i = 0; i < 3; i++)
        s[i] = 2.0 * shear_modulus * (strain[i] - third);
    s[3] = shear_modulus * strain[3];
}

void axi_element_stiffness(const struct axi_element *element, const struct material *material,
                           double stiffness[AXI_DOFS][AXI_DOFS])
{
    double g = material_shear_modulus(material);
    double bulk = material->young / (3.0 * (1.0 - 2.0 * material->poisson));
    for (int j = 0; j < AXI_DOFS; j++) {
        double u[AXI_DOFS] = {0.0};
        u[j] = 1.0;
        for (int i = 0; i < AXI_DOFS; i++)
            stiffness[i][j] = bulk * element->volume * element->mean[i] * element->mean[j];
        for (int p = 0; p < AXI_POINTS; p++) {
            double strain[4], s[4];
            strain_at(element, p, u, strain);
            deviator(g, strain, s);
            for (int a = 0; a < AXI_NODES; a++) {
                const double *b = element->gradient[p][a];
                double w = element->weight[p];
                stiffness[2 * a][j] += w * (b[0] * s[0] + b[2] * s[2] + b[1] * s[3]);
                stiffness[2 * a + 1][j] += w * (b[1] * s[1] + b[0] * s[3]);
            }
        }
    }
}

double axi_element_highest_frequency(const struct axi_element *element,
                                     const struct material *material)
{
    double k[AXI_DOFS][AXI_DOFS];
    double square[AXI_DOFS];
    axi_element_stiffness(element, material, k);
    for (int i = 0; i < AXI_DOFS; i++)
        for (int j = 0; j < AXI_DOFS; j++)
            k[i][j] /= material->density * sqrt(element->share[i / 2] * element->share[j / 2]);
    if (!linear_symmetric_eigen(AXI_DOFS, &k[0][0], square))
        return NAN;
    return sqrt(square[AXI_DOFS - 1]);
}

double axi_element_mises(const struct axi_element *element, const struct material *material,
                         const double u[AXI_DOFS])
{
    double largest = 0.0;
    for (int p = 0; p < AXI_POINTS; p++) {
        double strain[4], s[4];
        strain_at(element, p, u, strain);
        deviator(material_shear_modulus(material), strain, s);
        double square = s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2.0 * s[3] * s[3];
        largest = fmax(largest, sqrt(1.5 * square));
    }
    return largest;
}
