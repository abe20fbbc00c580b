/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_MODEL_MATERIAL_H
#define PERCUSS_MODEL_MATERIAL_H

#include "base/fault.h"
#include "percuss/vocabulary.h"

struct material {
    char name[PERCUSS_ID_SIZE];
    double young;   /* Pa */
    double poisson; /* -1 < poisson < 0.5 */
    double density; /* kg/m^3 */
    double yield;   /* Pa; INFINITY: stays elastic */
    double tangent; /* Pa, slope of the stress-strain curve beyond yield; 0: ideally plastic */
};

/* Handbook values of materials. Yield strain that most metals have or exceed, and that hardly any
 * exceeds (hardened steels yield at 2 GPa; Ashby, Materials Selection in Mechanical Design, chapter
 * 4). No metal, glass or ceramic of bodies is softer than SOFT (lead: 16 GPa): softer ones are
 * plastics, rubber, woods, foams, with a loss factor of 0.01 to 2 (Gerdeen, Lord, Rorrer,
 * Engineering Design with Polymers and Composites, chapter 12). */
#define MATERIAL_USUAL_YIELD_STRAIN 0.002
#define MATERIAL_MOST_YIELD_STRAIN  0.01
#define MATERIAL_SOFT               10e9
#define MATERIAL_SOFT_LOSS          0.01

/* Friction between two materials of a catalogue, which may be the same one. */
struct friction_pair {
    char between[2][PERCUSS_ID_SIZE]; /* their names, the first not after the second in order */
    double coefficient;               /* of Coulomb's law */
    double deviation;                 /* standard deviation of the coefficient */
};

/* Deviation of a coefficient that is stated without one, as a share of it. */
#define FRICTION_USUAL_DEVIATION 0.2

/* Shear modulus E / (2 (1 + nu)), Pa. */
static inline double material_shear_modulus(const struct material *material)
{
    return material->young / (2.0 * (1.0 + material->poisson));
}

/* PERCUSS_OK, or PERCUSS_BAD_REQUEST with "field: value: must be ...", the field under its
 * catalogue name, so that a loader can find its line. */
enum percuss_status material_check(const struct material *material, struct fault *fault);

#endif
