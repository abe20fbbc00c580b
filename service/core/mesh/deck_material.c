/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/deck_material.h"

#include <math.h>
#include <stdio.h>

#include "mesh/file_material.h"

enum { PLACE_SIZE = 200 };

/* The tangent, the slope of stress over total strain, from the first two rows of *PLASTIC with H =
 * d stress/d plastic strain: E H/(E + H). */
static void give_plastic(const struct deck_material *from, double stress, struct material *to)
{
    to->yield = from->stress_count ? from->stress[0] * stress : INFINITY;
    to->tangent = 0.0;
    if (!from->elastic || from->stress_count < 2 || !(from->strain[1] > from->strain[0]))
        return;
    double hardening =
        (from->stress[1] - from->stress[0]) / (from->strain[1] - from->strain[0]) * stress;
    to->tangent = hardening > 0.0 ? to->young * hardening / (to->young + hardening) : 0.0;
}

enum percuss_status deck_material_give(struct deck *deck, const struct deck_material *from,
                                       double unit, struct mesh_part *part, struct fault *fault)
{
    struct material *to = &part->material;
    char where[PLACE_SIZE], doubt[MESH_REMARK_SIZE];
    snprintf(where, sizeof where, "%s:%zu", deck->files[from->place.file], from->place.line);
    const struct file_material stated = {.file = where,
                                         .name = from->name,
                                         .young_field = "*ELASTIC",
                                         .density_field = "*DENSITY",
                                         .young = from->elastic ? from->young : NAN,
                                         .poisson = from->elastic ? from->poisson : NAN,
                                         .density = from->dense ? from->density : NAN};
    if (from->refused[0])
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s", from->refused);
    enum percuss_status status = file_material_convert(&stated, unit, to, fault);
    if (status != PERCUSS_OK)
        return status;
    file_material_doubt(&stated, unit, to, doubt, sizeof doubt);
    if (doubt[0] && !deck_tell(deck, "%s", doubt))
        return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", deck->files[0]);
    give_plastic(from, 1.0 / (unit * unit), to);
    part->has_material = from->elastic && from->dense;
    if (!part->has_material)
        snprintf(part->lacks, sizeof part->lacks, "*MATERIAL, NAME=%s has no %s", from->name,
                 from->dense     ? "*ELASTIC"
                 : from->elastic ? "*DENSITY"
                                 : "*ELASTIC and no *DENSITY");
    /* limits of every material, its yield with them */
    struct fault inner;
    if (part->has_material && material_check(to, &inner) != PERCUSS_OK)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s: %.400s", where, from->name,
                         inner.text);
    return PERCUSS_OK;
}
