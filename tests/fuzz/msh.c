/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Gmsh's files, text and binary: a mesh that keeps its rules, or a refusal in words. */
#include "mesh/msh.h"
#include "fuzz.h"
#include "mesh_parts.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct solid_mesh mesh = {0};
    struct fault fault = {""};
    /* as the user's own, and as what Gmsh has made */
    struct msh_source source = {fuzz_file(0, data, size), "body.msh", size % 2};
    enum percuss_status status = msh_read(&source, 1e-3, size / 2 % 2, &mesh, &fault);
    if (status)
        fuzz_refused(status, fault.text);
    else
        fuzz_mesh(&mesh);
    solid_mesh_free(&mesh);
    return 0;
}
