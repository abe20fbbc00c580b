/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Radiation of a half-space: waves that leave a contact through it. */
#ifndef PERCUSS_MODEL_HALF_SPACE_H
#define PERCUSS_MODEL_HALF_SPACE_H

#include "model/material.h"

/* To a normal force F(t) at a point of its surface, slow against the time that waves take over the
 * contact, a half-space answers with C F - lag F': it radiates lag F'^2 (Miller and Pursey, Proc.
 * R. Soc. A 233 (1955) 55; Hunter, J. Mech. Phys. Solids 5 (1957) 162); to a force along the surface
 * with another lag. */
struct half_space_waves {
    double lag;        /* m s/N */
    double lag_along;  /* of a tangential force, m s/N */
    double rayleigh;   /* speed of Rayleigh's waves, m/s, which take most of it */
    double transverse; /* of shear waves, m/s */
};

struct half_space_waves half_space_waves_of(const struct material *material);

#endif
