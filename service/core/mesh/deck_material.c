/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/deck_material.h"

#include <math.h>
#include <stdio.h>

/* no solid is softer, stiffer, lighter or heavier: values outside are in other units */
static const double LEAST_YOUNG = 1e4, MOST_YOUNG = 5e12, LEAST_DENSITY = 5.0, MOST_DENSITY = 3e4;

static enum percuss_status refuse_value(const struct deck *deck, const struct deck_material *from,
                                        bool young, double value, struct fault *fault)
{
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "%s: material %s: %s: %g is %g %s in units of N, s and the file's length: must "
        "be %g to %g; is the unit of length right?",
        deck->files[0], from->name, young ? "*ELASTIC" : "*DENSITY",
        young ? from->young : from->density, value, young ? "Pa" : "kg/m^3",
        young ? LEAST_YOUNG : LEAST_DENSITY, young ? MOST_YOUNG : MOST_DENSITY);
}

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

/* stresses in N per square of the length; the unit of mass is 1 N s^2/unit of length */
enum percuss_status deck_material_give(const struct deck *deck, const struct deck_material *from,
                                       double unit, struct mesh_part *part, struct fault *fault)
{
    struct material *to = &part->material;
    double stress = 1.0 / (unit * unit), density = stress * stress;
    if (from->refused[0])
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s", from->refused);
    snprintf(to->name, sizeof to->name, "%.*s", (int)sizeof to->name - 1, from->name);
    to->young = from->elastic ? from->young * stress : NAN;
    to->poisson = from->elastic ? from->poisson : NAN;
    to->density = from->dense ? from->density * density : NAN;
    give_plastic(from, stress, to);
    /* values outside these limits have a wrong unit; the message is in the deck's terms */
    if (from->elastic && !(to->young >= LEAST_YOUNG && to->young <= MOST_YOUNG))
        return refuse_value(deck, from, true, to->young, fault);
    if (from->dense && !(to->density >= LEAST_DENSITY && to->density <= MOST_DENSITY))
        return refuse_value(deck, from, false, to->density, fault);
    part->has_material = from->elastic && from->dense;
    if (!part->has_material)
        snprintf(part->lacks, sizeof part->lacks, "*MATERIAL, NAME=%s has no %s", from->name,
                 from->dense     ? "*ELASTIC"
                 : from->elastic ? "*DENSITY"
                                 : "*ELASTIC and no *DENSITY");
    /* limits of every material */
    struct fault inner;
    if (part->has_material && material_check(to, &inner) != PERCUSS_OK)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: material %s: %.400s", deck->files[0],
                         from->name, inner.text);
    return PERCUSS_OK;
}
