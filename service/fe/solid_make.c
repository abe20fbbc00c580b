/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fe/boussinesq.h"
#include "fe/solid_parts.h"

void solid_gather(const struct solid *solid, size_t element, double local[QUAD_FREEDOMS])
{
    const uint32_t *nodes = solid->mesh->quads[element];
    for (size_t i = 0; i < QUAD_FREEDOMS; i++)
        local[i] = solid->present.displacement[2 * nodes[i / 2] + i % 2];
}

void solid_elastic_force(const struct solid *solid, size_t element, double force[QUAD_FREEDOMS])
{
    double local[QUAD_FREEDOMS];
    solid_gather(solid, element, local);
    for (size_t i = 0; i < QUAD_FREEDOMS; i++) {
        force[i] = 0.0;
        for (size_t k = 0; k < QUAD_FREEDOMS; k++)
            force[i] += solid->stiffness[element][QUAD_FREEDOMS * i + k] * local[k];
    }
}

void solid_scatter(const struct solid *solid, size_t element, const double *local, double *forces)
{
    const uint32_t *nodes = solid->mesh->quads[element];
    for (size_t i = 0; i < QUAD_FREEDOMS; i++)
        if (nodes[i / 2] < solid->free_nodes && !is_fixed(solid, nodes[i / 2], i % 2))
            forces[freedom(solid, nodes[i / 2]) + i % 2] += local[i];
}

void solid_assemble(const struct solid *solid, size_t element, const double *local, size_t first,
                    struct band *matrix)
{
    const uint32_t *nodes = solid->mesh->quads[element];
    for (size_t i = 0; i < QUAD_FREEDOMS; i++) {
        size_t a = nodes[i / 2];
        if (a >= solid->free_nodes)
            continue;
        for (size_t k = 0; k < QUAD_FREEDOMS; k++) {
            size_t b = nodes[k / 2];
            if (b >= solid->free_nodes)
                continue;
            /* lower triangle from `first` on; a fixed freedom keeps its diagonal alone */
            size_t row = freedom(solid, a) + i % 2;
            size_t column = freedom(solid, b) + k % 2;
            bool fixed = is_fixed(solid, a, i % 2) || is_fixed(solid, b, k % 2);
            if (row >= column && column >= first && (row == column || !fixed))
                *band_entry(matrix, row, column) += local[QUAD_FREEDOMS * i + k];
        }
    }
}

static bool snapshot_make(const struct mesh *mesh, size_t candidates, struct snapshot *snapshot)
{
    snapshot->settled = true;
    snapshot->forces = calloc(candidates, sizeof *snapshot->forces);
    snapshot->displacement = calloc(2 * mesh->nodes, sizeof *snapshot->displacement);
    snapshot->history = calloc(mesh->elements, sizeof *snapshot->history);
    return snapshot->displacement && snapshot->history && snapshot->forces;
}

static void snapshot_free(struct snapshot *snapshot)
{
    free(snapshot->displacement);
    free(snapshot->history);
    free(snapshot->forces);
}

static size_t half_width(const struct mesh *mesh)
{
    size_t width = 0;
    for (size_t e = 0; e < mesh->elements; e++)
        for (size_t i = 0; i < 4; i++)
            for (size_t k = 0; k < 4; k++)
                if (mesh->quads[e][i] > mesh->quads[e][k] + width)
                    width = mesh->quads[e][i] - mesh->quads[e][k];
    return 2 * width + 1;
}

static bool loads_make(struct solid_loads *loads, size_t candidates, size_t n)
{
    loads->stride = candidates;
    loads->forward = calloc(candidates * n, sizeof(double));
    loads->common = calloc(candidates * candidates, sizeof(double));
    loads->share = calloc(candidates, sizeof(double));
    return loads->forward && loads->common && loads->share;
}

static void loads_free(struct solid_loads *loads)
{
    free(loads->forward);
    free(loads->common);
    free(loads->share);
}

static bool allocate(struct solid *solid, size_t candidates)
{
    const struct mesh *mesh = solid->mesh;
    size_t n = freedoms(solid);
    size_t width = half_width(mesh);
    solid->elastic = (struct band){n, width, calloc(n * (width + 1), sizeof(double))};
    solid->tangent = (struct band){n, width, calloc(n * (width + 1), sizeof(double))};
    solid->far = calloc(2 * mesh->far.count, sizeof(double));
    solid->pull = calloc(n, sizeof(double));
    solid->pulled = calloc(n, sizeof(double));
    solid->stiffness = calloc(mesh->elements, sizeof *solid->stiffness);
    solid->balance = calloc(n, sizeof(double));
    solid->residual = calloc(n, sizeof(double));
    solid->boundary = calloc(n, sizeof(double));
    return solid->elastic.values && solid->tangent.values && solid->far && solid->pull &&
           solid->pulled && solid->stiffness && solid->balance && solid->residual &&
           solid->boundary && loads_make(&solid->unloading, candidates, n) &&
           loads_make(&solid->flowing, candidates, n) &&
           snapshot_make(mesh, candidates, &solid->committed) &&
           snapshot_make(mesh, candidates, &solid->start) &&
           snapshot_make(mesh, candidates, &solid->present);
}

/* the elastic matrix and its factor */
static bool prepare_elastic(struct solid *solid)
{
    double moduli[STRESS_COMPONENTS * STRESS_COMPONENTS];
    plastic_law_moduli(&solid->law, moduli);
    for (size_t e = 0; e < solid->mesh->elements; e++) {
        for (int p = 0; p < QUAD_POINTS; p++)
            quad_add_stiffness(&solid->quads[e], p, moduli, solid->stiffness[e]);
        solid_assemble(solid, e, solid->stiffness[e], 0, &solid->elastic);
    }
    return band_factor(&solid->elastic);
}

void solid_move_far(struct solid *solid, double force)
{
    for (size_t i = 0; i < solid->mesh->far.count; i++)
        for (size_t c = 0; c < 2; c++)
            solid->present.displacement[2 * solid->mesh->far.index[i] + c] =
                force * solid->far[2 * i + c];
    solid->present.force = force;
}

/* The far nodes follow the field of the contact force taken as a point load: what its spread and
 * the plastic strains add falls off with the square of the distance. */
static void prepare_far(struct solid *solid, const struct material *material)
{
    const struct mesh *mesh = solid->mesh;
    for (size_t i = 0; i < mesh->far.count; i++) {
        size_t node = mesh->far.index[i];
        boussinesq_displacement(material->young, material->poisson, mesh->r[node], mesh->z[node],
                                &solid->far[2 * i]);
    }
    solid_move_far(solid, 1.0);
    for (size_t e = 0; e < mesh->elements; e++) {
        double forces[QUAD_FREEDOMS];
        solid_elastic_force(solid, e, forces);
        solid_scatter(solid, e, forces, solid->pull);
    }
    solid_move_far(solid, 0.0);
    memcpy(solid->pulled, solid->pull, freedoms(solid) * sizeof *solid->pull);
    band_forward(&solid->elastic, 0, freedoms(solid), solid->pulled);
}

struct solid *solid_create(const struct mesh *mesh, const struct quad *quads,
                           const struct material *material, size_t candidates)
{
    struct solid *solid = calloc(1, sizeof *solid);
    if (!solid)
        return NULL;
    solid->mesh = mesh;
    solid->quads = quads;
    solid->law = plastic_law_make(material);
    solid->linear = isinf(solid->law.yield);
    solid->free_nodes = mesh->nodes - mesh->far.count;
    if (!allocate(solid, candidates) || !prepare_elastic(solid)) {
        solid_destroy(solid);
        return NULL;
    }
    prepare_far(solid, material);
    return solid;
}

void solid_destroy(struct solid *solid)
{
    if (!solid)
        return;
    free(solid->elastic.values);
    free(solid->tangent.values);
    free(solid->far);
    free(solid->pull);
    free(solid->pulled);
    free(solid->stiffness);
    free(solid->balance);
    free(solid->residual);
    free(solid->boundary);
    loads_free(&solid->unloading);
    loads_free(&solid->flowing);
    snapshot_free(&solid->committed);
    snapshot_free(&solid->start);
    snapshot_free(&solid->present);
    free(solid);
}
