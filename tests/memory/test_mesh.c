/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests mesh/: a mesh is read whole, checked and given its surface, or memory ran out. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "memory/failing.h"
#include "mesh/matrices_read.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_read.h"

static char path[64];

/* a tetrahedron with names for all */
static const char MSH[] =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n2\n2 5 \"held\"\n3 1 \"part\"\n$EndPhysicalNames\n"
    "$Entities\n0 0 1 1\n7 0 0 0 1 1 0 1 5 0\n9 0 0 0 1 1 1 1 1 1 7\n"
    "$EndEntities\n$Nodes\n1 10 1 10\n3 9 0 10\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n"
    "0 0 0\n2 0 0\n0 2 0\n0 0 2\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n0 1 1\n1 0 1\n"
    "$EndNodes\n$Elements\n2 2 1 2\n2 7 9 1\n1 1 2 3 5 6 7\n"
    "3 9 11 1\n2 1 2 3 4 5 6 7 8 9 10\n$EndElements\n";

static const char DECK[] = "*NODE, NSET=ALL\n1, 0,0,0\n2, 2,0,0\n3, 0,2,0\n4, 0,0,2\n"
                           "5, 1,0,0\n6, 1,1,0\n7, 0,1,0\n8, 0,0,1\n9, 1,0,1\n10, 0,1,1\n"
                           "*ELEMENT, TYPE=S6, ELSET=foot\n1, 1,2,3,5,6,7\n"
                           "*ELEMENT, TYPE=C3D10, ELSET=body\n2, 1,2,3,4,5,6,7,8,9,10\n"
                           "*NSET, NSET=some\n1, 2, 3\n*SURFACE, NAME=slope\nbody, S3\n"
                           "*MATERIAL, NAME=steel\n*ELASTIC\n210e9, .3\n*DENSITY\n7800\n"
                           "*SOLID SECTION, ELSET=body, MATERIAL=steel\n";

/* linear, in a system of its own; its mid nodes are made */
static const char BULK[] =
    "GRID,1,7,0.,0.,0.\nGRID,2,7,2.,0.,0.\nGRID,3,7,0.,2.,0.\nGRID,4,7,0.,0.,2.\n"
    "CORD2R,7,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCTETRA,1,3,1,2,3,4\n"
    "SPC1,2,123,1,2,3\nCTRIA3,9,4,1,2,3\nRBE2,8,1,123,2,3\nCONM2,5,1,,2.\n"
    "PSOLID,3,5\nMAT1,5,210.+9,,.3,7800.\n";

static const char UNIVERSAL[] =
    "-1\n2411\n1 1 1 1\n0 0 0\n2 1 1 1\n2 0 0\n3 1 1 1\n0 2 0\n4 1 1 1\n0 0 2\n-1\n"
    "-1\n2412\n1 111 1 1 7 4\n1 2 3 4\n2 91 1 1 7 3\n1 2 3\n-1\n"
    "-1\n2467\n1 0 0 0 0 0 0 2\nall\n8 1 0 0 8 2 0 0\n-1\n";

static const char VTK[] = "# vtk DataFile Version 5.1\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                          "POINTS 4 float\n0 0 0 2 0 0 0 2 0 0 0 2\nCELLS 3 7\nOFFSETS int\n0 4 7\n"
                          "CONNECTIVITY int\n0 1 2 3 0 1 2\nCELL_TYPES 2\n10 5\n"
                          "CELL_DATA 2\nSCALARS g int 1\nLOOKUP_TABLE default\n1 2\n";

static void write_file(const char *suffix, const char *text)
{
    snprintf(path, sizeof path, "/tmp/percuss-memory-%d%s", (int)getpid(), suffix);
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
}

static bool reads_and_checks(void *context)
{
    (void)context;
    struct solid_mesh mesh = {0};
    struct surface surface = {0};
    struct mesh_findings findings;
    struct fault fault = {""};
    struct mesh_options options = {.unit = 1.0, .raise = true};
    failing_begin();
    enum percuss_status status = mesh_read(path, &options, &mesh, &fault);
    if (!status)
        status = surface_make(&mesh, &surface, &fault);
    if (!status)
        status = surface_fit(&mesh, &surface, &fault);
    if (!status)
        status = mesh_check(&mesh, &surface, &findings, &fault);
    failing_end();
    bool whole = !is_out_of_memory(status, fault.text);
    if (whole) {
        assert_int_equal(mesh.element_count, 1);
        assert_int_equal(mesh.node_count, 10);
        assert_int_equal(surface.face_count, 4);
        assert_true(mesh.set_count >= 1 && mesh.set[mesh.set_count - 1].count > 0);
    }
    surface_free(&surface);
    solid_mesh_free(&mesh);
    return whole;
}

static bool reads_matrices(void *context)
{
    const struct solid_mesh *mesh = context;
    struct matrices matrices = {0};
    struct fault fault = {""};
    failing_begin();
    enum percuss_status status =
        matrices_read(&(struct matrices_files){path, path, NULL}, mesh, &matrices, &fault);
    failing_end();
    bool whole = !is_out_of_memory(status, fault.text);
    assert_true(!whole || matrices.mass.n == 30);
    matrices_free(&matrices);
    return whole;
}

static void files_of_gmsh(void **state)
{
    (void)state;
    write_file(".msh", MSH);
    assert_true(fail_each("msh", reads_and_checks, NULL, 200) > 20);
    unlink(path);
}

static void decks(void **state)
{
    (void)state;
    write_file(".inp", DECK);
    assert_true(fail_each("inp", reads_and_checks, NULL, 200) > 20);
    unlink(path);
}

static void other_files(void **state)
{
    (void)state;
    static const struct {
        const char *suffix, *text;
    } FILES[] = {{".bdf", BULK}, {".unv", UNIVERSAL}, {".vtk", VTK}};
    for (size_t i = 0; i < COUNT(FILES); i++) {
        write_file(FILES[i].suffix, FILES[i].text);
        assert_true(fail_each(FILES[i].suffix, reads_and_checks, NULL, 200) > 20);
        unlink(path);
    }
}

static void matrices(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct fault fault;
    char text[1000] = "";
    write_file(".inp", DECK);
    assert_int_equal(mesh_read(path, &(struct mesh_options){.unit = 1.0}, &mesh, &fault),
                     PERCUSS_OK);
    unlink(path);
    for (int i = 1; i <= 30; i++)
        sprintf(text + strlen(text), "%d %d 1\n", i, i);
    write_file(".mas", text);
    assert_true(fail_each("matrices", reads_matrices, &mesh, 100) > 5);
    unlink(path);
    solid_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_of_gmsh),
        cmocka_unit_test(decks),
        cmocka_unit_test(other_files),
        cmocka_unit_test(matrices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
