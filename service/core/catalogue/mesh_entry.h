/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The entry of a body from a mesh in a catalogue, beside its keys: its file, the order of its
 * reduction where the file is a mesh, and named sites. */
#ifndef PERCUSS_CATALOGUE_MESH_ENTRY_H
#define PERCUSS_CATALOGUE_MESH_ENTRY_H

#include "catalogue/reader.h"
#include "model/body.h"

/* The files of a set, each read once. */
struct mesh_files {
    char **paths; /* of set->meshes */
};
void mesh_files_free(struct mesh_files *files, const struct body_set *set);

/* Reads `file` (a path from the catalogue's own folder) and `sites` of a body's mapping; a body
 * without a material gets the file's. PERCUSS_OK, PERCUSS_BAD_REQUEST or PERCUSS_INTERNAL. */
enum percuss_status mesh_entry_read(struct reader *reader, struct entry entry,
                                    struct mesh_files *files, struct body_set *set,
                                    struct body *body);

#endif
