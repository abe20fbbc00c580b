/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bulk data of Nastran, universal files and VTK's, by the input's first byte, whose highest bit
 * asks for raised elements: a mesh that keeps its rules, or a refusal in words. */
#include "fuzz.h"
#include "mesh/bdf.h"
#include "mesh/unv.h"
#include "mesh/vtk_legacy.h"
#include "mesh_parts.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static enum percuss_status (*const READERS[])(const char *, double, bool, struct solid_mesh *,
                                                  struct fault *) = {bdf_read, unv_read,
                                                                     vtk_legacy_read};
    struct solid_mesh mesh = {0};
    struct fault fault = {""};
    if (size == 0)
        return 0;
    enum percuss_status status = READERS[data[0] % 3u](fuzz_file(0, data + 1, size - 1), 1e-3,
                                                       data[0] >= 0x80, &mesh, &fault);
    if (status)
        fuzz_refused(status, fault.text);
    else
        fuzz_mesh(&mesh);
    solid_mesh_free(&mesh);
    return 0;
}
