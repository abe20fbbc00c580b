/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Matrices of another program, of one tetrahedron: stiffness, mass and, where there are three
 * parts, degrees of freedom, with a line "====" between. */
#include "mesh/matrices_read.h"

#include <math.h>

#include "fuzz.h"
#include "mesh/inp.h"

static const char DECK[] = "*NODE\n1, 0,0,0\n2, 2,0,0\n3, 0,2,0\n4, 0,0,2\n"
                           "5, 1,0,0\n6, 1,1,0\n7, 0,1,0\n8, 0,0,1\n9, 1,0,1\n10, 0,1,1\n"
                           "*ELEMENT, TYPE=C3D10, ELSET=body\n2, 1,2,3,4,5,6,7,8,9,10\n";

static const char BETWEEN[] = "====\n";

static const struct solid_mesh *tetrahedron(void)
{
    static struct solid_mesh mesh;
    struct fault fault = {""};
    if (!mesh.node_count)
        FUZZ_REQUIRE(!inp_read(fuzz_file(3, (const uint8_t *)DECK, sizeof DECK - 1), 1.0, NULL,
                               false, &mesh, &fault),
                     "%s", fault.text);
    return &mesh;
}

static const char *file_of(int slot, struct fuzz_bytes *bytes)
{
    struct fuzz_bytes part = fuzz_part(bytes, BETWEEN);
    return part.left ? fuzz_file(slot, part.data, part.left) : NULL;
}

static void require_symmetric_rows(const struct sparse *matrix)
{
    for (size_t i = 0; i < matrix->n; i++)
        for (size_t p = matrix->start[i]; p < matrix->start[i + 1]; p++)
            FUZZ_REQUIRE(matrix->column[p] >= i && matrix->column[p] < matrix->n &&
                             isfinite(matrix->value[p]),
                         "row %zu: column %u, value %g", i, matrix->column[p], matrix->value[p]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct matrices matrices = {0};
    struct fault fault = {""};
    struct fuzz_bytes bytes = {data, size};
    struct matrices_files files;
    files.stiffness = file_of(0, &bytes);
    files.mass = file_of(1, &bytes);
    files.freedoms = file_of(2, &bytes);
    if (!files.stiffness || !files.mass)
        return 0;
    enum percuss_status status = matrices_read(&files, tetrahedron(), &matrices, &fault);
    if (status) {
        fuzz_refused(status, fault.text);
    } else {
        require_symmetric_rows(&matrices.stiffness);
        require_symmetric_rows(&matrices.mass);
    }
    matrices_free(&matrices);
    return 0;
}
