/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The sites that were added to a reduced body, in a file of text beside it, BODY.sites (see
 * docs/reference/body-file.md). */
#ifndef PERCUSS_MESH_SITES_FILE_H
#define PERCUSS_MESH_SITES_FILE_H

#include "base/fault.h"
#include "model/mesh_body.h"

/* Reads the sites of a body whose faces, path and hash are there; none where there is no file, or
 * one of another body, such as the mesh's former one. PERCUSS_BAD_REQUEST with the
 * file's name and the line, PERCUSS_INTERNAL without memory. */
enum percuss_status sites_file_read(struct mesh_body *body, struct fault *fault);

/* Adds sites to the file and to the body, whose search structures are there
 * (mesh_surface_prepare); those that another process has added meanwhile stay. Where a site is
 * within reach of an earlier one, that one stays alone. The file is replaced whole. `*added`
 * becomes how many are new. PERCUSS_BAD_REQUEST with the file's name and the reason,
 * PERCUSS_INTERNAL without memory. */
enum percuss_status sites_file_add(struct mesh_body *body, size_t count,
                                   const struct mesh_body_site *sites, size_t *added,
                                   struct fault *fault);

#endif
