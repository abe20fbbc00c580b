/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Materials that a mesh's file states, in units of N, s and the file's length. */
#ifndef PERCUSS_MESH_FILE_MATERIAL_H
#define PERCUSS_MESH_FILE_MATERIAL_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"
#include "model/material.h"

struct file_material {
    const char *file, *name;                 /* for messages: "part.bdf:12", "MAT1 3" */
    const char *young_field, *density_field; /* how the file calls them */
    double young, poisson, density;
};

/* The material in SI, elastic; `unit`: m of one unit of length. Numbers that are NAN are not
 * stated, and stay so. PERCUSS_BAD_REQUEST: a modulus, density or speed of waves that no solid has,
 * as in other units. */
enum percuss_status file_material_convert(const struct file_material *from, double unit,
                                          struct material *to, struct fault *fault);

/* What may be wrong with a material that was converted, for the user; "": nothing. A deck in inches
 * may be in pounds-force, and waves as slow as in rubber may come of a modulus in another unit. */
void file_material_doubt(const struct file_material *from, double unit, const struct material *to,
                         char *doubt, size_t size);

#endif
