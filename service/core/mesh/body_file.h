/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A reduced body as one HDF5 file, see docs/reference/body-file.md. One thread at a time. */
#ifndef PERCUSS_MESH_BODY_FILE_H
#define PERCUSS_MESH_BODY_FILE_H

#include "base/fault.h"
#include "model/mesh_body.h"

/* Writes the file anew (base/atomic_file: a former file stays if the new one cannot be written
 * whole, a link is replaced). PERCUSS_OK, or PERCUSS_BAD_REQUEST with the file's name and the
 * reason. */
enum percuss_status body_file_write(const char *path, const struct mesh_body *body,
                                    struct fault *fault);

/* Reads a file: *body is for mesh_body_free; NULL after a fault, which names the file, the dataset
 * and the allowed values: PERCUSS_BAD_REQUEST, or PERCUSS_INTERNAL without memory. */
enum percuss_status body_file_read(const char *path, struct mesh_body **body, struct fault *fault);

#endif
