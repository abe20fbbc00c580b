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

/* Shear modulus E / (2 (1 + nu)), Pa. */
static inline double material_shear_modulus(const struct material *material)
{
    return material->young / (2.0 * (1.0 + material->poisson));
}

/* PERCUSS_OK, or PERCUSS_BAD_REQUEST with "field: value: must be ...", the field under its
 * catalogue name, so that a loader can find its line. */
enum percuss_status material_check(const struct material *material, struct fault *fault);

#endif
