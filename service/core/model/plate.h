/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Estimate of the energy that bending takes in an impact on a box that is computed as rigid. */
#ifndef PERCUSS_MODEL_PLATE_H
#define PERCUSS_MODEL_PLATE_H

#include "model/material.h"

/* A free box hit along its height. */
struct plate {
    const struct material *material;
    double height, sides[2]; /* m */
    double at[2];            /* place of the impact along the sides from the middle, m */
    double mass;             /* kg */
};

/* Share of the energy of an approach with the reduced mass (kg) that a half-sine force of this
 * duration (s) leaves in bending: flexural waves of a large plate (Zener 1941), the modes of a
 * small one or of a bar. To first order: it may exceed 1. */
double plate_share(const struct plate *plate, double reduced, double duration);

/* The part of bending that a bar along the first side lacks: its section bends across the second
 * one. Modes with a half period longer than the impact take energy, faster ones also yield as
 * springs. */
struct plate_across {
    double share;      /* of the energy, as above */
    double compliance; /* m/N */
};

struct plate_across plate_across_of(const struct plate *plate, double reduced, double duration);

#endif
