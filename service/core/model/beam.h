/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Transverse vibration and static compliance of a straight uniform beam in one plane of bending:
 * Timoshenko's theory; Euler-Bernoulli's is its limit without shear and rotatory inertia. */
#ifndef PERCUSS_MODEL_BEAM_H
#define PERCUSS_MODEL_BEAM_H

#include <stdbool.h>
#include <stddef.h>

#include "model/body.h"

/* Sections broader than this many depths bend across their breadth as well, which no theory of
 * beams has. */
#define BEAM_BROADEST 2.5

/* One plane of bending. x runs from -length/2 to +length/2. */
struct beam_plane {
    double length;
    double bending_stiffness; /* E I, N m^2 */
    double shear_stiffness;   /* kappa G A, N; INFINITY: Euler-Bernoulli */
    double line_mass;         /* rho A, kg/m */
    double line_inertia;      /* rho I, kg m; 0: Euler-Bernoulli */
    enum support supports[2]; /* at -length/2, +length/2 */
};

/* One elastic mode, mass-normalised: integral of rho A w^2 + rho I psi^2 over the length is 1. With
 * s = x/length the deflection is
 *   w = even[0] C(s) + even[1] cos(beta s) + odd[0] S(s) + odd[1] sin(beta s),
 * where C, S are the hyperbolic functions of alpha s over cosh(alpha/2) below the cut-off frequency
 * and the trigonometric ones of alpha s above it; alpha > 0 also at the cut-off. Between equal
 * supports the even or the odd factors are exactly zero. Sign: at x = +length/2 w is positive on a
 * free end, psi on a pinned and the moment on a clamped one. */
struct beam_mode {
    double omega; /* rad/s */
    double alpha, beta;
    double even[2], odd[2];             /* of w, 1/sqrt(kg) */
    double even_slope[2], odd_slope[2]; /* of psi: factors of S, sin and C, cos, 1/(m sqrt(kg)) */
    bool above_cutoff;
};

/* The same of all beams with its proportions, Poisson's ratio and supports. Fields are private. */
struct beam_unit_mode {
    double b; /* omega sqrt(rhoA L^4/EI) */
    double alpha, beta, alpha_squared, hyper, trig;
    double amplitudes[4];
    double norm, end; /* integral of w^2 + r^2 Psi^2 over s; the value that makes the sign */
};

/* The first `count` elastic modes (without rigid ones), frequencies ascending, relative error of
 * omega some 1e-15. No mode is missed: each root has its own bracket, see beam.c. Shapes are good
 * to 1e-12 of their amplitude unless frequencies are close: two waves with a relative gap between
 * their frequencies mix with an error of some 1e-16/gap per half-wave. */
void beam_modes(const struct beam_plane *plane, size_t count, struct beam_mode *modes);

/* The eigenvalues b = omega sqrt(rhoA L^4/EI) of such a beam, one after the other. */
struct beam_ratios {
    double inertia; /* r^2 */
    double shear;   /* q^2 */
};

/* Even deflections are a combination of C(s) and cos(beta s), odd ones of alpha^2 P(s)/beta and
 * sin(beta s); COUPLED ones of all four, which unequal supports need. */
enum beam_parity { BEAM_EVEN, BEAM_ODD, BEAM_COUPLED };

/* Which solution a mode of a pinned-pinned beam consists of. Both: every other beam. */
enum beam_family { BEAM_BENDING_FAMILY, BEAM_SHEAR_FAMILY, BEAM_BOTH_FAMILIES };

struct beam_root {
    double b;
    enum beam_parity parity;
    enum beam_family family;
};

/* Walks through the closed-form roots of the pinned-pinned beam in one class. */
struct beam_pinned_walk {
    struct beam_ratios ratios;
    enum beam_parity parity;
    unsigned step; /* between the wave numbers (in units of pi) of the class */
    unsigned wave_number[2];
    double next[2];
};

/* Walks through roots of which each lies between two neighbours of a given sequence. */
struct beam_interlaced_walk {
    struct beam_ratios ratios;
    enum support supports[2];
    enum beam_parity parity;
    double low;   /* the next root is not below */
    double value; /* of the determinant there */
    double sign;  /* of the determinant just above */
};

/* All roots of a beam, ascending. Fields are private. */
struct beam_root_walk {
    enum support supports[2];
    bool symmetric, pinned, cantilever;
    struct beam_pinned_walk closed[2];
    struct beam_interlaced_walk interlaced[2];
    struct beam_root next[2];
};

/* The left support must not be looser than the right one (free < pinned < clamped). */
void beam_root_walk_start(struct beam_root_walk *walk, const struct beam_ratios *ratios,
                          const enum support supports[2]);

/* The next elastic root; rigid motions are not among them. */
struct beam_root beam_root_walk_next(struct beam_root_walk *walk);

/* The modes by parts: a walk is started, and then gives the next `count` modes, or passes over them
 * (NULL). */
void beam_modes_start(const struct beam_plane *plane, struct beam_root_walk *walk);
void beam_modes_next(const struct beam_plane *plane, struct beam_root_walk *walk, size_t count,
                     struct beam_unit_mode *modes);

/* Whether two planes have the same unit modes, to the last bit. */
bool beam_planes_alike(const struct beam_plane *a, const struct beam_plane *b);

/* A plane's mode and its frequency (rad/s) from the unit mode. */
struct beam_mode beam_mode_of(const struct beam_plane *plane, const struct beam_unit_mode *unit);
double beam_frequency_of(const struct beam_plane *plane, const struct beam_unit_mode *unit);

/* Deflection w and rotation psi of the section at x (m) for unit modal coordinate. For
 * Euler-Bernoulli psi = dw/dx. Sign: psi = +dw/dx where shear vanishes. */
void beam_mode_at(const struct beam_plane *plane, const struct beam_mode *mode, double x, double *w,
                  double *psi);

/* One plane of bending of a completed beam: 0 along y, 1 along z. */
struct beam_plane beam_plane_of(const struct body *body, int plane);

/* A transverse force and a moment (conjugate to psi) acting at x, and a load (N m^2) conjugate to
 * the mean of psi' over the part of `window` about x on the beam. For the other waves of a bar the
 * force acts along it and the moment about it. */
struct beam_load {
    double x;
    double force;
    double moment;
    double curvature, window;
};

/* Displacement of a mode at a load, along it, for unit modal coordinate. */
double beam_mode_on(const struct beam_plane *plane, const struct beam_mode *mode,
                    const struct beam_load *load);

/* The section of a bent bar deforms. With z along the deflection, y across and nu Poisson's ratio,
 * a plane of bending moves a point by
 *
 *     u_z = w + nu/2 (z^2 - y^2 - m) psi',    u_y = nu y z psi',    m = (I_z - I_y)/A,
 *
 * w being the mean over the section (Love, Mathematical Theory of Elasticity, section 87; I_z the
 * integral of z^2). The load on the plane 0 (along y) or 1 (along z) of a completed body due to
 * a force along `direction` at `point` (body frame) of the side. Zero for Euler-Bernoulli with
 * its rigid sections and for strips, which bend across as plates do. */
struct beam_load beam_side_load(const struct body *body, int plane, const double point[3],
                                const double direction[3]);

/* The fit of a side's compliance ends at this share of half the breadth from the axis. */
static const double BEAM_SIDE_FARTHEST = 0.85;

/* Compliance of a point of the side beyond its half-space's and the bar's own there (that of
 * beam_side_load and of twist), m/N; usually negative. */
double beam_side_compliance(const struct body *body, const double point[3],
                            const double outward[3]);

/* Static compliance between two loads, m/N for unit forces: work of load `i` on the displacement
 * due to load `j`. Rigid motions that the supports allow are balanced by the inertia of that
 * motion, and the displacement is orthogonal to them (inertia relief); so it equals the sum over
 * all elastic modes of phi_i phi_j / omega^2. Exact but for rounding, some 1e-15. Loads act
 * within the span, its ends included. */
double beam_compliance(const struct beam_plane *plane, const struct beam_load *i,
                       const struct beam_load *j);

/* Shear factors. Cowper 1966 (circle, rectangle: independent of the direction); Hutchinson 2001
 * (circle; rectangle of `depth` along the deflection and `breadth` across it). The latter has a
 * pole and is negative beyond it for wide sections and large Poisson ratios: the caller checks. */
double beam_shear_cowper_circle(double poisson);
double beam_shear_cowper_rectangle(double poisson);
double beam_shear_hutchinson_circle(double poisson);
double beam_shear_hutchinson_rectangle(double poisson, double depth, double breadth);

#endif
