/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/bdf_material.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

#include "mesh/file_material.h"
#include "mesh/grow.h"

/* G and E/2(1 + NU) may differ by rounded digits of a data sheet */
static const double OTHER_SHEAR = 0.02;

/* ---- cards ---- */

enum percuss_status bdf_property_read(struct bdf_materials *materials, const struct bdf_card *card,
                                      const char *file)
{
    struct bdf_property property = {.line = card->line, .file = file};
    if (!bdf_label(card, 2, &property.label) || !bdf_label(card, 3, &property.material))
        return PERCUSS_BAD_REQUEST;
    if (!bdf_is_blank(card, 8) && strcasecmp(bdf_field(card, 8), "SMECH") != 0)
        return bdf_refuse(card, "%zu: FCTN %s: must be a structure's, SMECH", property.label,
                          bdf_field(card, 8));
    if (!GROW(materials->properties, materials->property_count, materials->property_room))
        return fault_set(card->scan->fault, PERCUSS_INTERNAL, "%s: out of memory", file);
    materials->properties[materials->property_count++] = property;
    return PERCUSS_OK;
}

/* two of E, G and NU give the third */
static enum percuss_status check_elastic(const struct bdf_card *card, struct bdf_material *material)
{
    double *young = &material->young, *poisson = &material->poisson, shear = 0.0;
    bool has_young = !bdf_is_blank(card, 3), has_shear = !bdf_is_blank(card, 4);
    bool has_poisson = !bdf_is_blank(card, 5);
    if (!bdf_real(card, 3, young) || !bdf_real(card, 4, &shear) || !bdf_real(card, 5, poisson))
        return PERCUSS_BAD_REQUEST;
    if (has_young + has_shear + has_poisson < 2)
        return bdf_refuse(card, "%zu: two of E, G and NU must be there", material->label);
    if (!has_young)
        *young = 2.0 * shear * (1.0 + *poisson);
    if (!has_poisson)
        *poisson = 0.5 * *young / shear - 1.0;
    if (has_young && has_shear && has_poisson &&
        !(fabs(2.0 * shear * (1.0 + *poisson) - *young) <= OTHER_SHEAR * *young))
        return bdf_refuse(card, "%zu: E %g, G %g, NU %g: G must be E/2(1 + NU) = %g, or blank",
                          material->label, *young, shear, *poisson,
                          0.5 * *young / (1.0 + *poisson));
    return PERCUSS_OK;
}

enum percuss_status bdf_material_read(struct bdf_materials *materials, const struct bdf_card *card,
                                      const char *file)
{
    struct bdf_material material = {.line = card->line, .file = file};
    if (!bdf_label(card, 2, &material.label) || !bdf_real(card, 6, &material.density))
        return PERCUSS_BAD_REQUEST;
    enum percuss_status status = check_elastic(card, &material);
    if (status != PERCUSS_OK)
        return status;
    material.has_density = material.density != 0.0;
    if (!GROW(materials->materials, materials->material_count, materials->material_room))
        return fault_set(card->scan->fault, PERCUSS_INTERNAL, "%s: out of memory", file);
    materials->materials[materials->material_count++] = material;
    return PERCUSS_OK;
}

/* other parameters do not change the body */
enum percuss_status bdf_parameter_read(struct bdf_materials *materials, const struct bdf_card *card)
{
    if (strcasecmp(bdf_field(card, 2), "WTMASS") != 0)
        return PERCUSS_OK;
    return bdf_real(card, 3, &materials->mass_factor) ? PERCUSS_OK : PERCUSS_BAD_REQUEST;
}

/* ---- one of each label ---- */

static int compare_materials(const void *left, const void *right)
{
    const struct bdf_material *a = left, *b = right;
    return a->label < b->label ? -1 : a->label > b->label;
}

static int compare_properties(const void *left, const void *right)
{
    const struct bdf_property *a = left, *b = right;
    return a->label < b->label ? -1 : a->label > b->label;
}

/* the first of two lines of one file is the upper one */
static enum percuss_status refuse_second(const char *name, size_t label, const char *files[2],
                                         size_t lines[2], struct fault *fault)
{
    bool turned = files[0] == files[1] && lines[0] > lines[1];
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "%s:%zu: %s %zu: differs from that of %s:%zu: each must have a number of its "
                     "own",
                     files[!turned], lines[!turned], name, label, files[turned], lines[turned]);
}

/* sorts by label; a card that is there again as it was does no harm */
static enum percuss_status sort_materials(struct bdf_materials *of, struct fault *fault)
{
    if (of->material_count)
        qsort(of->materials, of->material_count, sizeof *of->materials, compare_materials);
    if (of->property_count)
        qsort(of->properties, of->property_count, sizeof *of->properties, compare_properties);
    for (size_t i = 1; i < of->material_count; i++) {
        const struct bdf_material *a = &of->materials[i - 1], *b = a + 1;
        if (a->label == b->label &&
            !(a->young == b->young && a->poisson == b->poisson && a->density == b->density))
            return refuse_second("MAT1", a->label, (const char *[]){a->file, b->file},
                                 (size_t[]){a->line, b->line}, fault);
    }
    for (size_t i = 1; i < of->property_count; i++) {
        const struct bdf_property *a = &of->properties[i - 1], *b = a + 1;
        if (a->label == b->label && a->material != b->material)
            return refuse_second("PSOLID", a->label, (const char *[]){a->file, b->file},
                                 (size_t[]){a->line, b->line}, fault);
    }
    return PERCUSS_OK;
}

/* ---- parts ---- */

size_t bdf_property_part(struct builder *builder, size_t property)
{
    char name[MESH_NAME_SIZE];
    snprintf(name, sizeof name, "PSOLID %zu", property);
    return builder_part(builder, name);
}

static enum percuss_status give_material(const struct bdf_material *material, double factor,
                                         double unit, struct builder *builder,
                                         struct mesh_part *part, struct fault *fault)
{
    char where[BDF_PATH_SIZE + 32], name[48], doubt[MESH_REMARK_SIZE];
    snprintf(where, sizeof where, "%s:%zu", material->file, material->line);
    snprintf(name, sizeof name, "MAT1 %zu", material->label);
    struct file_material stated = {.file = where,
                                   .name = name,
                                   .young_field = "E",
                                   .density_field = "RHO",
                                   .young = material->young,
                                   .poisson = material->poisson,
                                   .density =
                                       material->has_density ? material->density * factor : NAN};
    part->has_material = material->has_density;
    if (!part->has_material)
        snprintf(part->lacks, sizeof part->lacks, "%s has no RHO", name);
    enum percuss_status status = file_material_convert(&stated, unit, &part->material, fault);
    if (status != PERCUSS_OK)
        return status;
    file_material_doubt(&stated, unit, &part->material, doubt, sizeof doubt);
    return !doubt[0] || builder_remark(builder, "%s", doubt)
               ? PERCUSS_OK
               : fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", where);
}

enum percuss_status bdf_materials_give(struct bdf_materials *materials, double unit,
                                       struct builder *builder, struct fault *fault)
{
    size_t parts = builder->part_count;
    enum percuss_status status = sort_materials(materials, fault);
    for (size_t i = 0; i < materials->property_count && status == PERCUSS_OK; i++) {
        const struct bdf_property *property = &materials->properties[i];
        struct bdf_material key = {.label = property->material};
        const struct bdf_material *material =
            materials->material_count
                ? bsearch(&key, materials->materials, materials->material_count, sizeof key,
                          compare_materials)
                : NULL;
        if (!material || (i > 0 && property[-1].label == property->label))
            continue;
        /* builder_finish drops the part of a PSOLID without elements */
        size_t part = bdf_property_part(builder, property->label);
        if (part == SIZE_MAX)
            return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", property->file);
        if (part < parts)
            status = give_material(material, materials->mass_factor, unit, builder,
                                   &builder->parts[part], fault);
    }
    return status;
}

void bdf_materials_free(struct bdf_materials *materials)
{
    free(materials->materials);
    free(materials->properties);
}
