/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The regular static flexibility of a meshed body: how far a force of 1 N at a place of its
 * surface moves that place, beyond the half-space's own local indentation and without rigid motion
 * and the first modes.
 *
 * The half-space's field u_B of the force (boussinesq3.h) is split off; the smooth rest w = x -
 * Psi g is solved for on the mesh, which needs no refinement about the place. With t the field's
 * tractions on the surface, f = -integral of N^T t, Psi the rigid and the removed modes, p = Psi^T
 * N^T(place) e, g = Psi^T integral of rho N^T u_B, and x orthogonal to Psi,
 *
 *     K x = f - M Psi Psi^T f,    C = f.x - integral of t.u_B - sum (2 p_k g_k - w_k^2 g_k^2),
 *
 * no difference of large numbers. At held nodes w is -u_B.
 *
 * On a surface of mean curvature H > 0 the integral of t.u_B grows like a logarithm as the radius r
 * that it begins at shrinks: C(r) = C(r') + slope ln(r' / r), slope = (1 + nu)(1 - 2 nu)^2 H / (2
 * pi E). The same r is the distance of two points that a force and its displacement are at; a
 * contact's is the mean over pairs of its points.
 *
 * Forces along the surface alike, with Cerruti's field for Boussinesq's: what a tangential traction
 * on a half-space does is the contact's own, as friction's cells have it. C is a quadratic form of
 * the force; between two forces i, j it is, with both orders' mean,
 *
 *     C_ij = f_i.x_j - integral of t_i.u_j - sum (2 p_ki g_kj - w_k^2 g_ki g_kj). */
#ifndef PERCUSS_REDUCE_FLEXIBILITY_H
#define PERCUSS_REDUCE_FLEXIBILITY_H

#include "base/fault.h"
#include "mesh/matrices.h"
#include "reduce/factor.h"
#include "reduce/flexibility_place.h"
#include "reduce/rates.h"

/* Columns that are solved for together: of a factor of 47,000 unknowns one of 63 takes 0.8 times
 * what one of 30 does. */
enum { FLEXIBILITY_BLOCK = 63 };

/* All borrowed. The mesh has elements of the surface's faces and a material for each part. */
struct flexibility_body {
    const struct solid_mesh *mesh;
    const struct surface *surface;
    const struct matrices *matrices;
    struct factor *factor; /* of K + shift M */
    double shift;          /* 1/s^2, at most of the order of the first elastic eigenvalue */
    size_t rigid_count, removed;
    const double *rigid;  /* [rigid_count][3 node_count], M-orthonormal */
    const double *shapes; /* [removed][3 node_count], M-orthonormal; the first ones */
    const double *omega;  /* [removed], rad/s */
};

struct flexibility_answer {
    double value;     /* C at `radius`, m/N; NAN: the forces do not balance */
    double tensor[6]; /* the same between all directions, xx yy zz xy yz zx of the mesh's frame;
                       * NAN: not wanted (place->loads), or the forces do not balance */
    double radius;    /* m; of no meaning where the surface is plane */
    double imbalance; /* of the nodal forces, over the force: round-off where all is well */
};

struct flexibility;

/* NULL: no memory. */
struct flexibility *flexibility_make(const struct flexibility_body *body);
void flexibility_free(struct flexibility *flexibility);

/* Quadrature and edges of the body's surface. */
const struct surface_rule *flexibility_rule(const struct flexibility *flexibility);
const struct flexibility_edges *flexibility_edges(const struct flexibility *flexibility);

/* Flexibility at places, solved for together: all of one number of loads, which times their count
 * is at most FLEXIBILITY_BLOCK. */
enum percuss_status flexibility_solve(struct flexibility *flexibility, size_t count,
                                      const struct flexibility_place *places,
                                      struct flexibility_answer *answers, struct fault *fault);

/* The integrals of one place alone, without a solution: a sample of their time. */
void flexibility_integrate(struct flexibility *flexibility, const struct flexibility_place *place);

/* Seconds of one column in a block of them but for its integrals: its solution, and its products
 * with M and with `removed` modes. */
double flexibility_column_seconds(const struct rates *rates, const struct factor_cost *cost,
                                  const struct sparse *mass, size_t removed);

/* Change of a flexibility with the logarithm of its radius, m/N: C(r) = C(r') + slope ln(r' / r).
 */
double flexibility_slope(double young, double poisson, double mean_curvature);

/* Flexibility of a contact of the radius a less C(a): its pressure is Hertz's, a mean of ln r, and
 * normal to the surface everywhere, which tilts it, m/N. */
double flexibility_of_contact(double young, double poisson, double mean_curvature);

/* Displacement of a place along one of its loads in a removed mode, 1/sqrt(kg). */
double flexibility_mode(const struct flexibility *flexibility, size_t mode,
                        const struct flexibility_place *place, int load);

/* How far the normal force at places[solved] of the last flexibility_solve moves another place
 * along the place's inward normal, the half-space's field included, without rigid motion and
 * removed modes, m/N. */
double flexibility_response(const struct flexibility *flexibility, size_t solved,
                            const struct flexibility_place *other);

#endif
