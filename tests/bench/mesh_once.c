/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Warm solves on a bar, and on the same bar as a mesh's modes and surface, for counting
 * instructions: mesh_cost.sh. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bodies/made_mesh.h"
#include "counting.h"
#include "model/mesh_surface.h"
#include "scenes.h"

/* What is counted: everything this function does and calls. */
__attribute__((noinline)) enum percuss_status counted_solve(struct solve_workspace *workspace,
                                                            const struct solve_context *means,
                                                            const struct solve_request *request,
                                                            struct solve_result *result);

enum percuss_status counted_solve(struct solve_workspace *workspace,
                                  const struct solve_context *means,
                                  const struct solve_request *request, struct solve_result *result)
{
    return solve(workspace, means, request, result);
}

/* The bar becomes a mesh of its own name, with as many modes of each family as it had. */
static struct mesh_body *make_mesh(struct body *bar)
{
    struct fault fault = {0};
    struct made_mesh wanted = {
        .bar = bar, .modes = bar->modes, .removed = 12, .around = 16, .along = 40};
    struct mesh_body *made = made_mesh_bar(&wanted);
    if (!made || !mesh_surface_prepare(made))
        return NULL;
    struct body body = {.material = bar->material,
                        .kind = &mesh_kind,
                        .tip_radius = INFINITY,
                        .mesh = made,
                        .scale = 1.0,
                        .modes = bar->modes};
    snprintf(body.id, sizeof body.id, "%s", bar->id);
    if (body.modes > 0 && made->mode_count > body.modes)
        body.modes = (unsigned)made->mode_count;
    *bar = body;
    return body_complete(bar, &fault) ? NULL : made;
}

static struct body *find_body(struct bench_catalogue *catalogue, const char *id)
{
    for (size_t i = 0; i < catalogue->set.count; i++)
        if (strcmp(catalogue->bodies[i].id, id) == 0)
            return &catalogue->bodies[i];
    return NULL;
}

/* mesh_once rod|beam bar|mesh MODES [free]: the scene with so many modes of each family; free: of
 * them as many as the tolerance asks for. */
int main(int argc, char **argv)
{
    static struct bench_catalogue catalogue;
    static struct solve_result result;
    const struct bench_scene *scene = argc >= 4 ? bench_scene_find(argv[1]) : NULL;
    unsigned modes = argc >= 4 ? (unsigned)strtoul(argv[3], NULL, 10) : 0;
    bool free_modes = argc == 5 && strcmp(argv[4], "free") == 0;
    if (!scene || !modes || argc != 4 + free_modes ||
        (strcmp(argv[2], "bar") != 0 && strcmp(argv[2], "mesh") != 0)) {
        fprintf(stderr, "usage: mesh_once SCENE bar|mesh MODES [free]\n");
        return 2;
    }
    const struct solve_context means = {.catalogue = &catalogue.set};
    struct solve_workspace *workspace = solve_workspace_create();
    struct solve_request request = bench_request(scene, 1e-3);
    struct mesh_body *made = NULL;
    bool good = workspace && bench_catalogue_make(&catalogue, modes);
    if (good && strcmp(argv[2], "mesh") == 0)
        good = (made = make_mesh(find_body(&catalogue, scene->b))) != NULL;
    for (size_t i = 0; free_modes && i < catalogue.set.count; i++)
        catalogue.bodies[i].modes = 0;
    /* as a beam's mesh asks for by itself, closed forms of flexibility apart */
    request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
    enum percuss_status status = good ? PERCUSS_OK : PERCUSS_INTERNAL;
    for (int i = 0; i < 2 && !status; i++)
        status = solve(workspace, &means, &request, &result);
    counting_begins();
    if (!status)
        status = counted_solve(workspace, &means, &request, &result);
    printf("%s %s: e = %.9f, %zu modes, %u sub-impacts, %s\n", argv[1], argv[2],
           result.contacts[0].restitution, (size_t)result.bodies[1].modes,
           (unsigned)result.contacts[0].sub_impact_count, status ? result.fault.text : "good");
    solve_workspace_free(workspace);
    mesh_body_free(made);
    return status ? EXIT_FAILURE : EXIT_SUCCESS;
}
