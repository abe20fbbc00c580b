/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh_parts.h"

#include <math.h>

#include "fuzz.h"
#include "mesh/matrices.h"
#include "mesh/mesh_check.h"

/* Larger ones only cost time. */
static const size_t MOST_ELEMENTS = 200;

static void require_whole(const struct solid_mesh *mesh)
{
    FUZZ_REQUIRE(mesh->node_count && mesh->element_count && mesh->part_count, "an empty mesh");
    for (size_t i = 0; i < mesh->node_count; i++)
        for (int k = 0; k < 3; k++)
            FUZZ_REQUIRE(isfinite(mesh->points[i][k]), "node %zu is nowhere", i);
    for (size_t e = 0; e < mesh->element_count; e++) {
        FUZZ_REQUIRE(mesh->parts[e] < mesh->part_count, "element %zu of part %zu", e,
                     mesh->parts[e]);
        for (size_t i = mesh->first[e]; i < mesh->first[e + 1]; i++)
            FUZZ_REQUIRE(mesh->nodes[i] < mesh->node_count, "element %zu has node %zu", e,
                         mesh->nodes[i]);
    }
    for (size_t s = 0; s < mesh->set_count; s++)
        for (size_t i = 0; i < mesh->set[s].count; i++)
            FUZZ_REQUIRE(mesh->set[s].nodes[i] < mesh->node_count, "set %zu has node %zu", s,
                         mesh->set[s].nodes[i]);
}

static void make_matrices(const struct solid_mesh *mesh)
{
    struct matrices matrices = {0};
    struct fault fault = {""};
    for (size_t i = 0; i < mesh->part_count; i++)
        if (!mesh->part[i].has_material)
            return;
    enum percuss_status status = matrices_make(mesh, &matrices, &fault);
    if (!status && mesh->set_count)
        status = matrices_hold(&matrices, &mesh->set[0], &fault);
    if (status)
        fuzz_refused(status, fault.text);
    matrices_free(&matrices);
}

void fuzz_mesh(const struct solid_mesh *mesh)
{
    struct surface surface = {0};
    struct mesh_findings findings;
    struct fault fault = {""};
    require_whole(mesh);
    if (mesh->element_count > MOST_ELEMENTS)
        return;
    enum percuss_status status = surface_make(mesh, &surface, &fault);
    if (!status)
        status = mesh_check(mesh, &surface, &findings, &fault);
    if (!status)
        status = surface_fit(mesh, &surface, &fault);
    if (!status) {
        surface_near(mesh, &surface, (double[3]){0.1, 0.2, -0.3});
        make_matrices(mesh);
    } else {
        fuzz_refused(status, fault.text);
    }
    surface_free(&surface);
}
