/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Values that friction is checked against: a foundation of 2000 cells in 40000 steps, a program of
 * its own, and the annuli of Maw, Barber and Fawcett; four digits. */
#ifndef PERCUSS_TEST_OBLIQUE_VALUES_H
#define PERCUSS_TEST_OBLIQUE_VALUES_H

/* A solid sphere on a half-space of its own material, nu = 0.3: psi before and after, the surface's
 * tangential speed times kappa over the coefficient and the speed of approach. From 4.76 on it
 * slides throughout. */
static const double SPHERE_PSI[][2] = {{0.25, 0.0416}, {0.5, 0.0478},   {0.75, 0.0142},
                                       {1.0, -0.0597}, {1.25, -0.2188}, {1.5, -0.4280},
                                       {2.0, -0.8372}, {2.5, -1.1623},  {3.0, -1.3797},
                                       {3.5, -1.4773}, {4.0, -1.4365},  {4.5, -1.2176}};

/* It falls straight into a right-angled groove of its own material, without spin: the coefficient,
 * and rebound over approach, whatever the speed and the mass. */
static const double GROOVE_REBOUND[][2] = {{0.05, 0.95690}, {0.1, 0.92604}, {0.2, 0.89271},
                                           {0.3, 0.88597},  {0.5, 0.91490}, {0.9, 1.0}};

#endif
