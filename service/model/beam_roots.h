/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The eigenvalues b = omega sqrt(rhoA L^4/EI) of a Timoshenko beam, one after the other. Private to
 * the files beam_*.c.
 *
 * No root is missed and none is sought by steps. The pinned-pinned roots are closed forms. Changing
 * one degree of freedom at an end (letting the deflection go, or holding the slope) moves the
 * number of roots below any b by at most one (Rayleigh; Wittrick and Williams 1971, Q. J. Mech.
 * Appl. Math. 24, 263), so that between neighbouring roots of the one beam lies exactly one of the
 * other: pinned-pinned -> free at both ends (one change in the even class, one in the odd), clamped
 * at both ends (the same), clamped-pinned, pinned-free -> clamped-free. Every elastic root of the
 * right side thus has its own bracket, however close the roots are, also where two families
 * interleave above the cut-off. */
#ifndef PERCUSS_MODEL_BEAM_ROOTS_H
#define PERCUSS_MODEL_BEAM_ROOTS_H

#include "model/beam_wave.h"

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

#endif
