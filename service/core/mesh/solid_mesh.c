/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/solid_mesh.h"

#include <stdlib.h>
#include <string.h>

void solid_mesh_free(struct solid_mesh *mesh)
{
    free(mesh->points);
    free(mesh->labels);
    free(mesh->types);
    free(mesh->first);
    free(mesh->nodes);
    free(mesh->parts);
    free(mesh->element_labels);
    free(mesh->part);
    for (size_t i = 0; i < mesh->set_count; i++)
        free(mesh->set[i].nodes);
    free(mesh->set);
    free(mesh->remarks);
    memset(mesh, 0, sizeof *mesh);
}
