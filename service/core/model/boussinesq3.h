/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Half-space under a point load of 1 N on its surface, along its inward normal (Boussinesq;
 * Johnson, Contact Mechanics, section 3.4), in any place and direction.
 *
 * With x from the point, e inward, z = x.e, R = |x|, mu the shear modulus
 *
 *     4 pi mu u = z x / R^3 + (3 - 4 nu) e / R - (1 - 2 nu) grad ln(R + z).
 *
 * The field holds in all space but on the line that leaves the point outwards, where R + z is 0. A
 * concave body crosses that line. A `reach` L takes it off beyond the distance L: the gradient of
 * ln(R' + z') with R', z' from the point x = -L e is added, which is in equilibrium by itself and
 * regular wherever the body is. Tractions of the order 1 / L^2 are left on the half-space's
 * surface.
 */
#ifndef PERCUSS_MODEL_BOUSSINESQ3_H
#define PERCUSS_MODEL_BOUSSINESQ3_H

#include <stddef.h>

struct boussinesq3 {
    double point[3], inward[3]; /* m, unit */
    double young, poisson;
    double reach; /* m, INFINITY: the half-space's own field */
};

/* Displacement (m/N) and stress (xx yy zz xy yz zx, 1/m^2) at x off that line; NULL: not wanted. */
void boussinesq3_field(const struct boussinesq3 *load, const double x[3], double displacement[3],
                       double stress[6]);

/* Stress that the reach adds; 0 where it is infinite. */
void boussinesq3_added_stress(const struct boussinesq3 *load, const double x[3], double stress[6]);

/* The part that the reach adds to the displacement of the loaded point along the load, m/N. */
double boussinesq3_added_displacement(const struct boussinesq3 *load);

/* The same of a point load of 1 N along the surface, `along` (unit, normal to the load's inward
 * normal; Cerruti; Johnson, section 3.6): with s = R + z and x = along.x,
 *
 *     4 pi mu u = x x_vector / R^3 + along / R + (1 - 2 nu) (1 - 2 e e^T) grad (x / s).
 *
 * x/s grows along the line outwards. A reach takes it off by (1 - 2 e e^T) grad (x/s' + L
 * d/dx ln s'), which with -2 along (1/R' + L z'/R'^3) is in equilibrium by itself and regular. */
void cerruti3_field(const struct boussinesq3 *load, const double along[3], const double x[3],
                    double displacement[3], double stress[6]);
void cerruti3_added_stress(const struct boussinesq3 *load, const double along[3], const double x[3],
                           double stress[6]);
double cerruti3_added_displacement(const struct boussinesq3 *load);

/* The same fields of three loads at one place, [0] along the inward normal and [1], [2] along two
 * directions of the surface, at `count` points at once: displacements u[point][load] (m/N), and
 * tractions t[point][load] on areas (m^2 as vectors, so that t is of N/N) where both are not NULL.
 * What cerruti3_field and boussinesq3_field say but for rounding, in a fifth of the time. */
void boussinesq3_fields(const struct boussinesq3 *load, const double along[2][3], size_t count,
                        const double (*x)[3], const double (*areas)[3], double (*u)[3][3],
                        double (*t)[3][3]);

/* On a curved surface the tractions of Cerruti's field, times its displacements, leave a
 * flexibility along the surface that changes by S ln(r'/r) from the radius r' to r: the integral of
 * both along a ring, with the curvatures k (> 0 where convex) and their mean H
 *
 *     S = (1 + nu)/(2 pi E) ((3/2 - nu + 2 nu^2) H (1 - n n^T) + (1/4 + 3/2 nu - nu^2) (k - H (1 -
 *         n n^T))).
 *
 * Adds `factor` S to the tensor xx yy zz xy yz zx; curvature: row-major, across the unit `normal`.
 */
void cerruti3_add_slope(double young, double poisson, const double normal[3],
                        const double curvature[9], double factor, double tensor[6]);

/* Adds the flexibility of a contact of the radius a less C(a): the mean over pairs of its points,
 * half way between a traction that sticks throughout and one that slides. */
void cerruti3_add_contact(double young, double poisson, const double normal[3],
                          const double curvature[9], double tensor[6]);

/* What that may be wrong by, m/N: of the traction's kind, and as it is tilted with the surface,
 * along a direction of the given curvature; `mean`: H. */
double cerruti3_contact_doubt(double young, double poisson, double curvature, double mean);

/* t = s n */
static inline void boussinesq3_traction(const double s[6], const double n[3], double t[3])
{
    t[0] = s[0] * n[0] + s[3] * n[1] + s[5] * n[2];
    t[1] = s[3] * n[0] + s[1] * n[1] + s[4] * n[2];
    t[2] = s[5] * n[0] + s[4] * n[1] + s[2] * n[2];
}

#endif
