/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A meshed body made ready for its static flexibility, and places on it. */
#ifndef PERCUSS_TEST_FLEXED_H
#define PERCUSS_TEST_FLEXED_H

#include <string.h>

#include "check.h"
#include "model/vector.h"
#include "reduce/flexibility.h"
#include "shapes/solid_shapes.h"

struct flexed {
    struct solid_mesh mesh;
    struct surface surface;
    struct matrices matrices;
    struct factor *factor;
    double *rigid; /* [6][n] */
    struct flexibility_body body;
    struct flexibility *flexibility;
};

/* six rigid motions, orthonormal with the mass */
static inline double *flexed_rigid(const struct solid_mesh *mesh, const struct sparse *mass)
{
    size_t n = 3 * mesh->node_count;
    double *rigid = calloc(6 * n, sizeof *rigid), *image = malloc(n * sizeof *image);
    assert_true(rigid && image);
    for (size_t i = 0; i < mesh->node_count; i++)
        for (size_t k = 0; k < 3; k++) {
            double axis[3] = {0.0, 0.0, 0.0};
            axis[k] = 1.0;
            rigid[k * n + 3 * i + k] = 1.0;
            cross3(axis, mesh->points[i], rigid + (3 + k) * n + 3 * i);
        }
    for (size_t k = 0; k < 6; k++) {
        double *own = rigid + k * n;
        /* twice, for rounding */
        for (size_t j = 0; j < 2 * k; j++) {
            double *other = rigid + j % k * n, product = sparse_product(mass, own, other);
            for (size_t i = 0; i < n; i++)
                own[i] -= product * other[i];
        }
        double scale = 1.0 / sqrt(sparse_product(mass, own, own));
        for (size_t i = 0; i < n; i++)
            own[i] *= scale;
    }
    free(image);
    return rigid;
}

/* `mesh` is taken over; held: its set "low" */
static inline void flexed_make(struct flexed *flexed, struct solid_mesh *mesh, double shift,
                               bool held)
{
    struct fault fault;
    memset(flexed, 0, sizeof *flexed);
    flexed->mesh = *mesh;
    assert_int_equal(surface_make(&flexed->mesh, &flexed->surface, &fault), PERCUSS_OK);
    assert_int_equal(matrices_make(&flexed->mesh, &flexed->matrices, &fault), PERCUSS_OK);
    if (held)
        assert_int_equal(matrices_hold(&flexed->matrices, &flexed->mesh.set[0], &fault),
                         PERCUSS_OK);
    else
        flexed->rigid = flexed_rigid(&flexed->mesh, &flexed->matrices.mass);
    assert_int_equal(
        factor_analyse(&flexed->matrices, FACTOR_POSITIVE, NULL, &flexed->factor, &fault),
        PERCUSS_OK);
    assert_int_equal(factor_compute(flexed->factor, shift, &fault), PERCUSS_OK);
    flexed->body = (struct flexibility_body){.mesh = &flexed->mesh,
                                             .surface = &flexed->surface,
                                             .matrices = &flexed->matrices,
                                             .factor = flexed->factor,
                                             .shift = shift,
                                             .rigid_count = held ? 0 : 6,
                                             .rigid = flexed->rigid};
    flexed->flexibility = flexibility_make(&flexed->body);
    assert_non_null(flexed->flexibility);
}

static inline void flexed_free(struct flexed *flexed)
{
    flexibility_free(flexed->flexibility);
    factor_free(flexed->factor);
    matrices_free(&flexed->matrices);
    surface_free(&flexed->surface);
    solid_mesh_free(&flexed->mesh);
    free(flexed->rigid);
}

/* the place nearest to a point */
static inline struct flexibility_place flexed_place(const struct flexed *flexed, double x, double y,
                                                    double z)
{
    const double point[3] = {x, y, z};
    struct surface_place near_it = surface_near(&flexed->mesh, &flexed->surface, point);
    return flexibility_place_make(flexibility_rule(flexed->flexibility),
                                  flexibility_edges(flexed->flexibility), near_it.face,
                                  near_it.foot.u, near_it.foot.v);
}

/* a shape's displacement along a place's inward normal */
static inline double flexed_shape(const struct flexed *flexed,
                                  const struct flexibility_place *place, const double *shape)
{
    const struct surface_face *face = &flexed->surface.faces[place->face];
    double values[FACE_MOST_NODES], sum = 0.0;
    facet_shape(face->count, place->u, place->v, values, NULL, NULL);
    for (size_t i = 0; i < face->count; i++)
        sum += values[i] * dot3(shape + 3 * face->nodes[i], place->load.inward);
    return sum;
}

/* flexibility at one place */
static inline struct flexibility_answer flexed_solve(struct flexed *flexed,
                                                     const struct flexibility_place *place)
{
    struct flexibility_answer answer;
    struct fault fault;
    enum percuss_status status = flexibility_solve(flexed->flexibility, 1, place, &answer, &fault);
    if (status != PERCUSS_OK)
        print_error("%s\n", fault.text);
    assert_int_equal(status, PERCUSS_OK);
    return answer;
}

#endif
