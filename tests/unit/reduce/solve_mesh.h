/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A mesh all the way to its modes. */
#ifndef PERCUSS_TEST_SOLVE_MESH_H
#define PERCUSS_TEST_SOLVE_MESH_H

#include <stdio.h>

#include "check.h"
#include "reduce/modes.h"
#include "shapes/solid_shapes.h"

struct solved {
    struct bulk bulk;
    struct matrices matrices;
    size_t rigid_count;
    double *rigid, scale;
    struct modes modes;
    struct factor *factor;
};

/* Modes below `hertz`, at most `most`; the first `held` sets of the mesh are held. */
static inline void solve_mesh(const struct solid_mesh *mesh, size_t held, double hertz, size_t most,
                              struct solved *solved)
{
    struct fault fault = {""};
    solved->factor = NULL;
    bulk_of(mesh, &solved->bulk);
    assert_int_equal(matrices_make(mesh, &solved->matrices, &fault), PERCUSS_OK);
    for (size_t i = 0; i < held; i++)
        assert_int_equal(matrices_hold(&solved->matrices, &mesh->set[i], &fault), PERCUSS_OK);
    solved->scale = rigid_modes_scale(mesh, &solved->bulk);
    assert_int_equal(rigid_modes_make(mesh, &solved->matrices, solved->scale, &solved->rigid_count,
                                      &solved->rigid, &fault),
                     PERCUSS_OK);
    struct modes_task task = {
        .matrices = &solved->matrices,
        .rigid = {solved->matrices.stiffness.n, solved->rigid_count, solved->rigid},
        .scale = solved->scale,
        .below = 2.0 * M_PI * hertz,
        .most = most,
        .known = SIZE_MAX};
    if (modes_find(&task, &solved->modes, &solved->factor, &fault) != PERCUSS_OK) {
        print_error("%s\n", fault.text);
        fail();
    }
}

static inline void solved_free(struct solved *solved)
{
    factor_free(solved->factor);
    modes_free(&solved->modes);
    matrices_free(&solved->matrices);
    free(solved->rigid);
}

#endif
