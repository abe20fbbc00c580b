/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The regular flexibility of a body's file at a place of its surface: all of the static compliance
 * under a force along the normal beyond the half-space's, C = flexibility + sum over the removed
 * modes of phi^2/omega^2, m/N.
 * usage: mesh_flexibility BODY.h5 X Y Z    (in the mesh's frame and unit) */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "mesh/body_file.h"
#include "model/facet.h"
#include "model/mesh_surface.h"

/* Displacement of the place along its normal in a mode. */
static double shape_at(const struct mesh_body *body, const struct mesh_place *place,
                       const double normal[3], size_t mode)
{
    const struct mesh_body_face *face = &body->faces[place->face];
    double shape[FACET_MOST_NODES], sum = 0.0;
    facet_shape(face->count, place->u, place->v, shape, NULL, NULL);
    for (int n = 0; n < face->count; n++)
        for (size_t axis = 0; axis < 3; axis++)
            sum += shape[n] * normal[axis] *
                   (double)body->shapes[(face->nodes[n] * 3 + axis) * body->mode_count + mode];
    return sum;
}

int main(int argc, char **argv)
{
    struct fault fault = {""};
    struct mesh_body *body;
    struct mesh_place place;
    double point[3];
    if (argc != 5) {
        fprintf(stderr, "usage: mesh_flexibility BODY.h5 X Y Z\n");
        return 2;
    }
    if (body_file_read(argv[1], &body, &fault)) {
        fprintf(stderr, "%s\n", fault.text);
        return 1;
    }
    /* the nearest place of the surface */
    for (int axis = 0; axis < 3; axis++)
        point[axis] = atof(argv[2 + axis]) * body->unit - body->centre[axis];
    if (!mesh_surface_prepare(body) || mesh_surface_find(body, point, 0.0, &place, 1) < 1)
        return 1;
    struct mesh_spot spot = mesh_surface_at(body, place.face, place.u, place.v);
    double flexibility = spot.flexibility;
    /* with what was taken from it */
    for (size_t k = 0; k < body->removed; k++) {
        double phi = shape_at(body, &place, spot.normal, k);
        flexibility += phi * phi / (body->omega[k] * body->omega[k]);
    }
    printf("%.9g\n", flexibility);
    mesh_body_free(body);
    return 0;
}
