/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Warm solves of the rod and the beam, for counting instructions: instructions.sh. */
#include <stdio.h>
#include <stdlib.h>

#include "scenes.h"

/* What is counted: everything this function does and calls. */
__attribute__((noinline)) enum percuss_status counted_solve(struct solve_workspace *workspace,
                                                            const struct body_set *catalogue,
                                                            const struct solve_request *request,
                                                            struct solve_result *result);

enum percuss_status counted_solve(struct solve_workspace *workspace,
                                  const struct body_set *catalogue,
                                  const struct solve_request *request, struct solve_result *result)
{
    return solve(workspace, catalogue, request, result);
}

/* solve_once rod|beam TOLERANCE: solves twice to fill the caches, then once more, counted. */
int main(int argc, char **argv)
{
    static struct bench_catalogue catalogue;
    static struct solve_result result;
    const struct bench_scene *scene = argc == 3 ? bench_scene_find(argv[1]) : NULL;
    double tolerance = argc == 3 ? strtod(argv[2], NULL) : 0.0;
    if (!scene || !(tolerance > 0.0)) {
        fprintf(stderr, "usage: solve_once SCENE TOLERANCE\n");
        return 2;
    }
    struct solve_workspace *workspace = solve_workspace_create();
    struct solve_request request = bench_request(scene, tolerance);
    enum percuss_status status = PERCUSS_INTERNAL;
    if (workspace && bench_catalogue_make(&catalogue, 0)) {
        status = solve(workspace, &catalogue.set, &request, &result);
        if (!status)
            status = solve(workspace, &catalogue.set, &request, &result);
        if (!status)
            status = counted_solve(workspace, &catalogue.set, &request, &result);
    }
    printf("%s %s: e = %.9f\n", argv[1], argv[2], result.contacts[0].restitution);
    solve_workspace_free(workspace);
    return status ? EXIT_FAILURE : EXIT_SUCCESS;
}
