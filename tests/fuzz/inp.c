/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Input decks of Abaqus and CalculiX: a mesh that keeps its rules, or a refusal in words. */
#include "mesh/inp.h"
#include "fuzz.h"
#include "mesh_parts.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct solid_mesh mesh = {0};
    struct fault fault = {""};
    enum percuss_status status =
        inp_read(fuzz_file(0, data, size), 1e-3, NULL, size % 2, &mesh, &fault);
    if (status)
        fuzz_refused(status, fault.text);
    else
        fuzz_mesh(&mesh);
    solid_mesh_free(&mesh);
    return 0;
}
