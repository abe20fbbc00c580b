/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* All the bytes that a mesh is read from. */
#ifndef PERCUSS_MESH_MESH_DIGEST_H
#define PERCUSS_MESH_MESH_DIGEST_H

#include "base/fault.h"
#include "base/sha256.h"

/* Adds a file's bytes, and those of the files that a deck (.inp) takes in by *INCLUDE as far as it
 * is read. PERCUSS_BAD_REQUEST: one of them cannot be read. */
enum percuss_status mesh_digest(const char *path, struct sha256 *hash, struct fault *fault);

#endif
