/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/materials.h"

#include <math.h>
#include <string.h>

#include "catalogue/catalogue.h"

static void give(struct mesh_part *part, const struct material *material)
{
    part->material = *material;
    part->has_material = true;
}

/* The material of one part that the command line names. */
static enum percuss_status assign_part(const struct options *options,
                                       const struct part_option *option, struct solid_mesh *mesh,
                                       struct fault *fault)
{
    struct material material;
    size_t i = 0;
    while (i < mesh->part_count && strcmp(mesh->part[i].name, option->part) != 0)
        i++;
    if (i == mesh->part_count)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "--part: %s: the mesh has %zu part%s, the first is \"%s\"", option->part,
                         mesh->part_count, mesh->part_count == 1 ? "" : "s", mesh->part[0].name);
    enum percuss_status status =
        catalogue_material(options->catalogue, option->material, &material, fault);
    if (!status)
        give(&mesh->part[i], &material);
    return status;
}

/* One for all, then those of single parts. */
static enum percuss_status assign_named(const struct options *options, struct solid_mesh *mesh,
                                        struct fault *fault)
{
    struct material material;
    enum percuss_status status = PERCUSS_OK;
    if (options->material)
        status = catalogue_material(options->catalogue, options->material, &material, fault);
    for (size_t i = 0; options->material && !status && i < mesh->part_count; i++)
        give(&mesh->part[i], &material);
    for (size_t k = 0; !status && k < options->part_count; k++)
        status = assign_part(options, &options->parts[k], mesh, fault);
    return status;
}

enum percuss_status materials_assign(const struct options *options, struct solid_mesh *mesh,
                                     struct fault *fault)
{
    /* one material given by numbers is that of every part */
    struct fault inner = {""};
    if (!isnan(options->young)) {
        struct material material = {"given",          options->young, options->poisson,
                                    options->density, INFINITY,       0.0};
        for (size_t i = 0; i < mesh->part_count; i++)
            give(&mesh->part[i], &material);
    }
    /* names on the command line go before it */
    enum percuss_status status = assign_named(options, mesh, fault);
    /* each part has one that is good */
    for (size_t i = 0; !status && i < mesh->part_count; i++) {
        const struct mesh_part *part = &mesh->part[i];
        if (!part->has_material)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "part \"%s\": has no material: give --material NAME --catalogue FILE, "
                             "or --young, --poisson and --density",
                             part->name);
        if (material_check(&part->material, &inner))
            return fault_set(fault, PERCUSS_BAD_REQUEST, "material of part \"%s\": %s", part->name,
                             inner.text);
    }
    return status;
}
