/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The regular flexibility of a place on plane ground two ways (physics/reduce/patch.h): by the
 * half-space's field split off, and by a Hertz pressure on the elements less the half-space.
 * usage: mesh_patch [--matrices STI MAS DOF] MESH UNIT YOUNG POISSON X Y Z [RADIUS]...
 * with places and radii in mm and, if they are named, matrices of another program for the material;
 * prints, in m/N: point,C   and   patch,RADIUS,LONGEST EDGE,C,C BY POINTS */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/bulk.h"
#include "mesh/matrices_read.h"
#include "mesh/mesh_read.h"
#include "physics/reduce/patch.h"
#include "reduce/modes.h"

/* of the first eigenvalue, about: what makes the factor positive */
static const double SHIFT = 0.1;
/* of any: inertia only balances, and the answer is statics' */
static const double DENSITY = 2700.0;

struct patched {
    struct matrices_files files; /* NULL: none are named */
    struct solid_mesh mesh;
    struct surface surface;
    struct matrices matrices;
    struct bulk bulk;
    struct factor *factor;
    double *rigid;
    struct flexibility_body body;
    struct flexibility *flexibility;
};

static enum percuss_status make(char **arguments, struct patched *all, struct fault *fault)
{
    /* the mesh, of one material */
    struct mesh_options how = {.unit = mesh_read_unit(arguments[1])};
    enum percuss_status status = mesh_read(arguments[0], &how, &all->mesh, fault);
    if (status)
        return status;
    for (size_t i = 0; i < all->mesh.part_count; i++)
        all->mesh.part[i].material = (struct material){
            "metal", atof(arguments[2]), atof(arguments[3]), DENSITY, INFINITY, 0.0};
    bulk_of(&all->mesh, &all->bulk);
    /* its matrices, rigid motions and factor */
    double scale = rigid_modes_scale(&all->mesh, &all->bulk);
    size_t rigid_count = 0;
    status = surface_make(&all->mesh, &all->surface, fault);
    if (!status)
        status = all->files.stiffness
                     ? matrices_read(&all->files, &all->mesh, &all->matrices, fault)
                     : matrices_make(&all->mesh, &all->matrices, fault);
    if (!status)
        status =
            rigid_modes_make(&all->mesh, &all->matrices, scale, &rigid_count, &all->rigid, fault);
    if (!status)
        status = factor_analyse(&all->matrices, FACTOR_POSITIVE, NULL, &all->factor, fault);
    if (!status)
        status = factor_compute(all->factor, SHIFT * scale, fault);
    if (status)
        return status;
    /* and what flexibility takes of them */
    all->body = (struct flexibility_body){.mesh = &all->mesh,
                                          .surface = &all->surface,
                                          .matrices = &all->matrices,
                                          .factor = all->factor,
                                          .shift = SHIFT * scale,
                                          .rigid_count = rigid_count,
                                          .rigid = all->rigid};
    all->flexibility = flexibility_make(&all->body);
    return all->flexibility ? PERCUSS_OK : fault_set(fault, PERCUSS_INTERNAL, "out of memory");
}

static enum percuss_status compare(struct patched *all, const struct flexibility_place *place,
                                   double radius, struct fault *fault)
{
    struct patch_answer pressed;
    double mean;
    enum percuss_status status = patch_press(&all->body, place, radius, &pressed, fault);
    if (!status)
        status = patch_of_points(&all->body, all->flexibility, place, radius, &mean, fault);
    if (!status)
        printf("patch,%.9g,%.3g,%.9g,%.9g\n", 1e3 * radius, 1e3 * pressed.element,
               pressed.flexibility, mean);
    return status;
}

static enum percuss_status run(int count, char **arguments, struct patched *all,
                               struct fault *fault)
{
    double point[3];
    struct flexibility_answer answer;
    enum percuss_status status = make(arguments, all, fault);
    if (status)
        return status;
    fprintf(stderr, "%zu unknowns\n", all->matrices.stiffness.n);
    /* the nearest place of the surface */
    for (int axis = 0; axis < 3; axis++)
        point[axis] = 1e-3 * atof(arguments[4 + axis]);
    struct surface_place at = surface_near(&all->mesh, &all->surface, point);
    struct flexibility_place place =
        flexibility_place_make(flexibility_rule(all->flexibility),
                               flexibility_edges(all->flexibility), at.face, at.foot.u, at.foot.v);
    /* one way, and the other */
    status = flexibility_solve(all->flexibility, 1, &place, &answer, fault);
    if (!status)
        printf("point,%.9g\n", answer.value);
    for (int i = 7; i < count && !status; i++)
        status = compare(all, &place, 1e-3 * atof(arguments[i]), fault);
    return status;
}

int main(int argc, char **argv)
{
    struct fault fault = {""};
    struct patched all = {0};
    if (argc > 4 && strcmp(argv[1], "--matrices") == 0) {
        all.files = (struct matrices_files){argv[2], argv[3], argv[4]};
        argc -= 4;
        argv += 4;
    }
    if (argc < 8) {
        fprintf(stderr, "usage: mesh_patch [--matrices STI MAS DOF] MESH UNIT YOUNG POISSON X Y Z "
                        "[RADIUS]...\n");
        return 2;
    }
    enum percuss_status status = run(argc - 1, argv + 1, &all, &fault);
    if (status)
        fprintf(stderr, "%s\n", fault.text);
    flexibility_free(all.flexibility);
    factor_free(all.factor);
    free(all.rigid);
    matrices_free(&all.matrices);
    surface_free(&all.surface);
    solid_mesh_free(&all.mesh);
    return status != PERCUSS_OK;
}
