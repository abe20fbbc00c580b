/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Puts together the content of a body's file, but for the flexibility of its surface. */
#ifndef PERCUSS_REDUCE_REDUCED_BODY_H
#define PERCUSS_REDUCE_REDUCED_BODY_H

#include "base/sha256.h"
#include "mesh/bulk.h"
#include "mesh/surface.h"
#include "model/mesh_body.h"
#include "reduce/modes.h"

/* All borrowed. `surface` has normals and curvatures. */
struct reduced_parts {
    const struct solid_mesh *mesh;
    const struct surface *surface;
    const struct bulk *bulk;
    const struct modes *modes;
    const bool *held;               /* degrees of freedom; NULL: none */
    const struct matrices *foreign; /* where they are not the mesh's own; else NULL */
    size_t site_count;              /* places that flexibility is wanted at exactly */
    const double (*sites)[3];       /* m */
    const char *source, *supports;
    /* where flexibilities are solved for later: the mesh's file, and how it is read (recipe.h);
     * NULL: ahead */
    const char *mesh_path, *mesh_options;
};

/* Faces stand in the order of the surface's, their flexibility unknown (NAN). For mesh_body_free.
 * PERCUSS_BAD_REQUEST: more than 256 parts; PERCUSS_INTERNAL without memory. */
enum percuss_status reduced_body_make(const struct reduced_parts *parts, struct mesh_body **body,
                                      struct fault *fault);

/* Hash of a mesh with its materials and held degrees of freedom (NULL: none): that of a body's
 * origin, if it is of that mesh. */
void reduced_body_hash_mesh(const struct solid_mesh *mesh, const bool *held,
                            char text[SHA256_TEXT]);

/* By the divergence theorem: the integral of x.n/3 over the surface, m^3. */
double reduced_body_enclosed(const struct solid_mesh *mesh, const struct surface *surface);

#endif
