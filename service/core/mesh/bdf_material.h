/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Materials of bulk data: MAT1, the PSOLID that has one, and PARAM,WTMASS. */
#ifndef PERCUSS_MESH_BDF_MATERIAL_H
#define PERCUSS_MESH_BDF_MATERIAL_H

#include "mesh/bdf_card.h"
#include "mesh/builder.h"

struct bdf_material {
    size_t label, line;
    const char *file;
    bool has_density;
    double young, poisson, density;
};

struct bdf_property {
    size_t label, line, material;
    const char *file;
};

/* Zero it but for the factor of masses, 1, before use. */
struct bdf_materials {
    size_t material_count, material_room, property_count, property_room;
    struct bdf_material *materials;
    struct bdf_property *properties;
    double mass_factor; /* PARAM,WTMASS: masses are RHO times this one */
};

/* Cards PSOLID, MAT1, PARAM; `file` names theirs, and outlives the materials. */
enum percuss_status bdf_property_read(struct bdf_materials *materials, const struct bdf_card *card,
                                      const char *file);
enum percuss_status bdf_material_read(struct bdf_materials *materials, const struct bdf_card *card,
                                      const char *file);
enum percuss_status bdf_parameter_read(struct bdf_materials *materials,
                                       const struct bdf_card *card);

/* The part of a PSOLID; SIZE_MAX: out of memory. */
size_t bdf_property_part(struct builder *builder, size_t property);

/* Gives each part the MAT1 of its PSOLID, in SI; parts without one are the caller's to state.
 * PERCUSS_BAD_REQUEST: a label of two cards that differ, or a material that no solid has. */
enum percuss_status bdf_materials_give(struct bdf_materials *materials, double unit,
                                       struct builder *builder, struct fault *fault);

void bdf_materials_free(struct bdf_materials *materials);

#endif
