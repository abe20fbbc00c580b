/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdlib.h>

#include "fe/region_parts.h"

/* The point load's field at the boundary leaves out what falls off with its square and cube: at 30
 * contact radii a thousandth of the indentation. */
static const double EXTENT = 30.0;

static double plane_modulus(const struct material *material)
{
    return material->young / (1.0 - material->poisson * material->poisson);
}

/* Contact radius at which the weaker body first yields: p0 = 1.6 yield (Johnson, section 6.1), a =
 * pi p0 R / (2 E*). */
static double first_yield_radius(const struct region_input *input)
{
    double modulus = 1.0 / (1.0 / plane_modulus(&input->materials[0]) +
                            1.0 / plane_modulus(&input->materials[1]));
    double yield = fmin(input->materials[0].yield, input->materials[1].yield);
    return 0.5 * M_PI * 1.6 * yield * input->radius / modulus;
}

static enum percuss_status check_input(const struct region_input *input, struct fault *fault)
{
    if (!(input->radius > 0.0 && isfinite(input->radius)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "contact radius: %g m: must be > 0",
                         input->radius);
    /* small strains, flat surfaces: the contact radius stays below a fifth of the bodies' */
    if (!(input->indentation > 0.0 && input->indentation <= 0.02 * input->radius))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "indentation: %g m: must be > 0 and at most 0.02 of the radius %g m",
                         input->indentation, input->radius);
    if (input->resolution < 4 || input->resolution > 60)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "resolution: %zu: must be 4 ... 60",
                         input->resolution);
    if (!(input->phase >= 0.0 && input->phase < 1.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "phase: %g: must be 0 <= phase < 1",
                         input->phase);
    /* elastic constants, and a yield with hardening below the modulus */
    for (int i = 0; i < 2; i++) {
        const struct material *m = &input->materials[i];
        if (!(m->young > 0.0 && m->poisson > -1.0 && m->poisson < 0.5 && m->yield > 0.0 &&
              m->tangent >= 0.0 && m->tangent < m->young))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "material %s: young %g, poisson %g, yield %g, tangent %g: must be "
                             "> 0, in (-1, 0.5), > 0, in [0, young)",
                             m->name, m->young, m->poisson, m->yield, m->tangent);
    }
    return PERCUSS_OK;
}

/* Elements about 1/resolution of the contact radius at every load from first yield to the largest:
 * the core lies within the smallest, rings grow with their radius. */
static enum percuss_status make_mesh(struct region *region, const struct region_input *input,
                                     struct fault *fault)
{
    /* contact radii at the largest load and at first yield */
    double top = region->top = sqrt(2.0 * input->radius * input->indentation);
    region->first_yield = first_yield_radius(input);
    double low = fmax(fmin(region->first_yield, 0.4 * top), REGION_FINEST * top);
    double core = (double)input->resolution;
    struct mesh_grade grade = {
        .size = 0.7 * low / core, .core = input->resolution, .growth = 1.0 + 0.25 * M_PI / core};
    /* the whole mesh larger by the phase's part of a ring */
    double scale = pow(grade.growth, input->phase);
    grade.size *= scale;
    enum percuss_status status =
        mesh_half_space(EXTENT * top * scale, &grade, &region->mesh, fault);
    if (status != PERCUSS_OK)
        return status;
    /* nodes that may come to touch */
    const struct mesh_nodes *contact = &region->mesh.contact;
    while (region->candidates < contact->count &&
           region->mesh.r[contact->index[region->candidates]] < 1.5 * top)
        region->candidates++;
    region->candidates += 4; /* beyond the last that is to carry force */
    /* elements */
    region->quads = malloc(region->mesh.elements * sizeof *region->quads);
    if (!region->quads)
        return fault_set(fault, PERCUSS_INTERNAL, "contact region: no memory");
    for (size_t e = 0; e < region->mesh.elements; e++) {
        double r[4], z[4];
        for (int i = 0; i < 4; i++) {
            r[i] = region->mesh.r[region->mesh.quads[e][i]];
            z[i] = region->mesh.z[region->mesh.quads[e][i]];
        }
        if (!quad_make(r, z, &region->quads[e]))
            return fault_set(fault, PERCUSS_INTERNAL, "contact region: element %zu is not convex",
                             e);
    }
    return PERCUSS_OK;
}

static bool state_make(struct contact_state *state, size_t n)
{
    state->forces = calloc(n, sizeof *state->forces);
    state->active = calloc(n, sizeof *state->active);
    return state->forces && state->active;
}

static void state_free(struct contact_state *state)
{
    free(state->forces);
    free(state->active);
}

static bool make_work(struct region *region, const struct region_input *input)
{
    size_t n = region->candidates;
    /* arrays */
    region->gaps = calloc(n, sizeof(double));
    region->offsets = calloc(n, sizeof(double));
    region->initial = calloc(n, sizeof(double));
    region->compliance = calloc(n * n, sizeof(double));
    region->more = calloc(n * n, sizeof(double));
    region->scratch = calloc((n + 1) * (n + 3), sizeof(double));
    if (!region->gaps || !region->offsets || !region->initial || !region->compliance ||
        !region->more || !region->scratch || !state_make(&region->committed, n) ||
        !state_make(&region->start, n) || !state_make(&region->present, n))
        return false;
    /* gap of the virgin surfaces: a parabola */
    for (size_t i = 0; i < n; i++) {
        double r = region->mesh.r[region->mesh.contact.index[i]];
        region->gaps[i] = 0.5 * r * r / input->radius;
    }
    /* both half-spaces */
    for (int i = 0; i < 2; i++) {
        region->solids[i] = solid_create(&region->mesh, region->quads, &input->materials[i], n);
        if (!region->solids[i])
            return false;
    }
    return true;
}

enum percuss_status region_create(const struct region_input *input, struct region **region,
                                  struct fault *fault)
{
    *region = NULL;
    enum percuss_status status = check_input(input, fault);
    if (status != PERCUSS_OK)
        return status;
    /* all of it, or nothing */
    struct region *made = calloc(1, sizeof *made);
    if (!made)
        return fault_set(fault, PERCUSS_INTERNAL, "contact region: no memory");
    status = make_mesh(made, input, fault);
    if (status == PERCUSS_OK && !make_work(made, input))
        status = fault_set(fault, PERCUSS_INTERNAL, "contact region: no memory");
    if (status != PERCUSS_OK) {
        region_destroy(made);
        return status;
    }
    made->effort.nodes = 2 * made->mesh.nodes;
    *region = made;
    return PERCUSS_OK;
}

void region_destroy(struct region *region)
{
    if (!region)
        return;
    solid_destroy(region->solids[0]);
    solid_destroy(region->solids[1]);
    mesh_free(&region->mesh);
    free(region->quads);
    free(region->gaps);
    free(region->offsets);
    free(region->initial);
    free(region->compliance);
    free(region->more);
    free(region->scratch);
    state_free(&region->committed);
    state_free(&region->start);
    state_free(&region->present);
    free(region);
}
