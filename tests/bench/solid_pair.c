/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The paper's models A and C of an impact, and A's mesh for another program: peers/solids.py.
 *
 * solid_pair rod|balls solve CELLS: complete finite elements on one mesh of 4 to 96 elements across
 * the contact; prints e and the seconds of the processor.
 *
 * solid_pair rod|beam modal TOLERANCE: the modal answer, warm; prints the same.
 *
 * solid_pair rod|balls|plate mesh CELLS: prints speed and expected contact radius, and of each
 * body, the one that is hit first, in its own frame (z <= 0, the contact point at the origin): the
 * numbers of nodes, elements and nodes of the surface; r and z of every node, m; the four nodes of
 * every element, counter-clockwise, from 0; the surface's nodes, outward from the axis. Of the
 * plate's scene the sphere only. CELLS: 2 to 96. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fe/impact_complete.h"
#include "fe/mesh.h"
#include "scenes.h"

#define STEEL "steel", 210e9, 0.30, 7800.0, INFINITY, 0.0

static const struct pair {
    const char *name;
    struct complete_problem problem;
} pairs[] = {
    {"rod",
     {.a = {.shape = COMPLETE_SPHERE, .radius = 0.015, .material = {STEEL}},
      .b = {.shape = COMPLETE_CYLINDER,
            .radius = 0.010,
            .length = 1.0,
            .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0}},
      .speed = 0.3,
      .horizon = 5e-3}},
    {"balls",
     {.a = {.shape = COMPLETE_SPHERE, .radius = 0.015, .material = {STEEL}},
      .b = {.shape = COMPLETE_SPHERE, .radius = 0.015, .material = {STEEL}},
      .speed = 1.0,
      .horizon = 1e-3}},
    {"plate",
     {.a = {.shape = COMPLETE_SPHERE, .radius = 0.005, .material = {STEEL}},
      .b = {.shape = COMPLETE_CYLINDER,
            .radius = 0.120,
            .length = 0.008,
            .material = {"glass", 70e9, 0.22, 2500.0, INFINITY, 0.0}},
      .speed = 1.0,
      .horizon = 1e-4}},
};

/* Radius of the contact that two half-spaces and rigid masses would have, m. */
static double expected_patch(const struct complete_problem *problem)
{
    double inverse = 0.0, curvature = 0.0, compliance = 0.0;
    const struct complete_body *bodies[] = {&problem->a, &problem->b};
    for (int i = 0; i < 2; i++) {
        const struct complete_body *body = bodies[i];
        double r = body->radius;
        bool sphere = body->shape == COMPLETE_SPHERE;
        double volume = sphere ? 4.0 / 3.0 * M_PI * r * r * r : M_PI * r * r * body->length;
        inverse += 1.0 / (volume * body->material.density);
        curvature += sphere ? 1.0 / r : 0.0;
        compliance +=
            (1.0 - body->material.poisson * body->material.poisson) / body->material.young;
    }
    double stiffness = 4.0 / 3.0 / (compliance * sqrt(curvature));
    double indentation = pow(1.25 * problem->speed * problem->speed / (inverse * stiffness), 0.4);
    return sqrt(indentation / curvature);
}

static enum percuss_status print_body(const struct complete_body *body, double patch,
                                      unsigned cells, struct fault *fault)
{
    /* the core reaches half as far again as the contact; rings and a rod's rows grow outward */
    size_t core = (3 * (size_t)cells + 1) / 2;
    struct mesh_grade grade = {.size = 1.5 * patch / (double)core,
                               .core = core,
                               .growth = 1.0 + 1.2 / (double)core,
                               .matched = 1.8 * patch,
                               .coarse = 4.0 * body->radius / cells};
    struct mesh mesh;
    enum percuss_status status =
        body->shape == COMPLETE_SPHERE
            ? mesh_sphere(body->radius, &grade, &mesh, fault)
            : mesh_cylinder(body->radius, body->length, &grade, &mesh, fault);
    if (status != PERCUSS_OK)
        return status;
    printf("%zu %zu %zu\n", mesh.nodes, mesh.elements, mesh.contact.count);
    for (size_t i = 0; i < mesh.nodes; i++)
        printf("%.15g %.15g\n", mesh.r[i], mesh.z[i]);
    for (size_t e = 0; e < mesh.elements; e++)
        printf("%u %u %u %u\n", mesh.quads[e][0], mesh.quads[e][1], mesh.quads[e][2],
               mesh.quads[e][3]);
    for (size_t i = 0; i < mesh.contact.count; i++)
        printf("%u\n", mesh.contact.index[i]);
    mesh_free(&mesh);
    return PERCUSS_OK;
}

/* Rings that reach from the contact to a plate's rim would be slivers, which are far too stiff. */
static bool flat(const struct complete_body *body)
{
    return body->shape == COMPLETE_CYLINDER && body->length < body->radius;
}

static enum percuss_status print_meshes(const struct complete_problem *problem, struct fault *fault)
{
    double patch = expected_patch(problem);
    printf("%g %.15g\n", problem->speed, patch);
    enum percuss_status status =
        flat(&problem->b) ? PERCUSS_OK : print_body(&problem->b, patch, problem->cells, fault);
    return status == PERCUSS_OK ? print_body(&problem->a, patch, problem->cells, fault) : status;
}

static enum percuss_status complete(const struct complete_problem *problem, struct fault *fault)
{
    struct complete_result result;
    clock_t began = clock();
    enum percuss_status status = impact_complete_solve(problem, &result, fault);
    if (status == PERCUSS_OK)
        printf("%.8f %.6g\n", result.restitution, (double)(clock() - began) / CLOCKS_PER_SEC);
    return status;
}

/* The rod at 0.3 m/s or the beam at 0.2, as the service computes them by default. */
static enum percuss_status modal(const char *name, double tolerance, struct fault *fault)
{
    enum { TIMES = 1000, BEAM = 2 };
    static struct bench_catalogue catalogue;
    static struct solve_result result;
    struct solve_workspace *workspace = solve_workspace_create();
    if (!workspace || !bench_catalogue_make(&catalogue, 0))
        return fault_set(fault, PERCUSS_INTERNAL, "no memory for the bodies");
    catalogue.set.compliance = PERCUSS_COMPLIANCE_MATCHED;
    catalogue.bodies[BEAM].shear_rule = SHEAR_HUTCHINSON;
    enum percuss_status status = body_complete(&catalogue.bodies[BEAM], fault);
    const struct solve_context means = {.catalogue = &catalogue.set};
    struct bench_scene scene = *bench_scene_find(name);
    scene.speed = strcmp(name, "rod") == 0 ? 0.3 : 0.2;
    struct solve_request request = bench_request(&scene, tolerance);
    /* once for the modes */
    clock_t began = 0;
    for (int i = 0; i <= TIMES && status == PERCUSS_OK; i++) {
        status = solve(workspace, &means, &request, &result);
        if (i == 0)
            began = clock();
        if (status != PERCUSS_OK)
            fault_set(fault, status, "%s: %s", name, result.fault.text);
    }
    if (status == PERCUSS_OK)
        printf("%.8f %.6g\n", result.contacts[0].restitution,
               (double)(clock() - began) / CLOCKS_PER_SEC / TIMES);
    solve_workspace_free(workspace);
    return status;
}

int main(int count, char **words)
{
    const struct pair *pair = NULL;
    for (size_t i = 0; count == 4 && i < sizeof pairs / sizeof *pairs; i++)
        if (strcmp(words[1], pairs[i].name) == 0)
            pair = &pairs[i];
    const char *what = count == 4 ? words[2] : "";
    double number = count == 4 ? strtod(words[3], NULL) : 0.0;
    bool meshes = pair && strcmp(what, "mesh") == 0 && number >= 2.0 && number <= 96.0;
    bool solves = pair && !flat(&pair->problem.b) && strcmp(what, "solve") == 0 && number >= 4.0 &&
                  number <= 96.0;
    bool modes = strcmp(what, "modal") == 0 && number > 0.0 &&
                 (strcmp(words[1], "rod") == 0 || strcmp(words[1], "beam") == 0);
    if (!meshes && !solves && !modes) {
        fprintf(stderr, "usage: solid_pair rod|balls solve CELLS, rod|beam modal TOLERANCE, or "
                        "rod|balls|plate mesh CELLS\n");
        return 2;
    }
    struct fault fault = {""};
    enum percuss_status status;
    if (modes) {
        status = modal(words[1], number, &fault);
    } else {
        struct complete_problem problem = pair->problem;
        problem.cells = (unsigned)number;
        status = meshes ? print_meshes(&problem, &fault) : complete(&problem, &fault);
    }
    if (status != PERCUSS_OK)
        fprintf(stderr, "solid_pair: %s\n", fault.text);
    return status == PERCUSS_OK ? 0 : 1;
}
