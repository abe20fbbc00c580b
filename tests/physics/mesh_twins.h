/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A round bar, built in and as the mesh that it would be reduced from. */
#ifndef PERCUSS_TEST_MESH_TWINS_H
#define PERCUSS_TEST_MESH_TWINS_H

#include "bodies/made_mesh.h"
#include "model/mesh_surface.h"
#include "physics/support.h"

enum { MODES = 60, REMOVED = 12 };

/* A lab with a bar, its mesh under "mesh", and a ball. */
struct twins {
    struct lab *lab;
    const struct body *bar, *mesh;
    struct mesh_body *surface;
};

static inline struct body body_of(struct mesh_body *surface)
{
    struct body body = make_body(&mesh_kind, surface->materials[0]);
    body.mesh = surface;
    body.scale = 1.0;
    return body;
}

static inline struct twins make_twins(struct body bar, size_t modes, double end_flexibility)
{
    struct twins twins = {.lab = lab_create()};
    lab_add(twins.lab, "ball", make_sphere(STEEL, 0.015));
    bar.modes = (unsigned)modes;
    twins.bar = lab_add(twins.lab, "bar", bar);
    struct made_mesh wanted = {.bar = twins.bar,
                               .modes = modes,
                               .removed = REMOVED,
                               .around = 16,
                               .along = 40,
                               .end_flexibility = end_flexibility};
    twins.surface = made_mesh_bar(&wanted);
    assert_non_null(twins.surface);
    assert_true(mesh_surface_prepare(twins.surface));
    twins.mesh = lab_add(twins.lab, "mesh", body_of(twins.surface));
    return twins;
}

static inline void twins_free(struct twins *twins)
{
    lab_free(twins->lab);
    mesh_body_free(twins->surface);
}

static inline double answer(const struct twins *twins, const struct spot *spot, const char *id,
                            double speed, enum percuss_compliance compliance,
                            struct solve_result *result)
{
    struct spot own = *spot;
    own.id = id;
    struct solve_request request = strike(sphere_spot("ball", 0.015), own, speed);
    request.options.tolerance = 1e-6;
    request.options.compliance = compliance;
    lab_solve(twins->lab, &request, result);
    return result->contacts[0].restitution;
}

#endif
