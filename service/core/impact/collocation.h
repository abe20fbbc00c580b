/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Four-node Gauss collocation of the contact forces on a step, in the step's own time s = 0..1: a
 * force is sum_j F(node_j) L_j(s) with Lagrange's L_j(s) = prod_(i != j) (s - node_i)/(node_j -
 * node_i). Integrals of it are exact to s^7, so that the step is of order eight. */
#ifndef PERCUSS_IMPACT_COLLOCATION_H
#define PERCUSS_IMPACT_COLLOCATION_H

/* the nodes and the step's end */
enum { NODES = 4, STEP_POINTS = NODES + 1 };

struct collocation {
    double node[NODES];
    double weight[NODES];          /* of the integral over the step */
    double monomial[NODES][NODES]; /* Lagrange polynomial j = sum_m monomial[j][m] s^m */
    double velocity[NODES][NODES]; /* [i][j]: integral of polynomial j from 0 to node i */
    double position[NODES][NODES]; /* [i][j]: its double integral */
    double position_end[NODES];    /* double integral from 0 to 1 */
    double highest[NODES];         /* coefficient of the Legendre polynomial of degree 3 */
    double slopes[NODES][NODES];   /* integral of the product of two polynomials' derivatives */
    double end[4][NODES]; /* [m]: coefficient of (s - 1)^m of the polynomials, the values first */
};

extern const struct collocation collocation;

/* Polynomial through the nodal values at s in 0..1, and its integral from 0 to s. */
double collocation_value(const double values[NODES], double s);
double collocation_integral(const double values[NODES], double s);

/* Where the polynomial turns from rising to falling, outside 0..1: nowhere on the step; and its
 * largest value there. */
double collocation_turn(const double values[NODES]);
double collocation_peak(const double values[NODES]);

/* The polynomial at the step's end. */
static inline double collocation_last(const double values[NODES])
{
    const double *at = collocation.end[0];
    return (at[0] * values[0] + at[1] * values[1]) + (at[2] * values[2] + at[3] * values[3]);
}

#endif
