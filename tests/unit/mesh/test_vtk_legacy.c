/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/mesh/vtk_legacy.c: boxes of 2 x 1 x 1 with bent elements, whose volume and
 * least det J are right in one order of nodes alone. */
#include "unit/mesh/blocks.h"
#include "unit/mesh/files.h"

/* VTK's node of each node of Gmsh's, as vtkQuadraticTetra and its kin list them */
static const unsigned char TET[10] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
static const unsigned char HEX[27] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 16, 9,  17, 10,
                                      18, 19, 12, 15, 13, 14, 24, 22, 20, 21, 23, 25, 26};

/* a box whose inner lines are bent, which keeps its volume */
static void bend(const double cube[3], double point[3])
{
    double bulge = 0.1 * sin(M_PI * cube[0]) * sin(M_PI * cube[1]) * sin(M_PI * cube[2]);
    for (int k = 0; k < 3; k++)
        point[k] = (k == 0 ? 2.0 : 1.0) * cube[k] + (k + 1) * bulge;
}

static unsigned char data[200000];
static size_t filled;

static void say(const char *format, ...) __attribute__((format(printf, 1, 2)));

static void say(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    filled += (size_t)vsnprintf((char *)data + filled, sizeof data - filled, format, args);
    va_end(args);
    assert_true(filled < sizeof data);
}

/* the most significant byte first */
static void put(uint64_t word, size_t size)
{
    while (size-- > 0)
        data[filled++] = (unsigned char)(word >> (8 * size));
}

/* one number in text, or in the bytes of its type */
static void number(bool binary, bool real, size_t size, double value)
{
    uint64_t word = (uint64_t)(int64_t)value;
    if (!binary) {
        say(real ? "%.17g\n" : "%.0f ", value);
        return;
    }
    if (real)
        memcpy(&word, &value, sizeof word);
    put(word, size);
}

/* a text of 70 letters: in binary files its length has two bytes */
static void put_text(bool binary)
{
    if (binary)
        put(2u << 14 | 70u, 2);
    say("%070d%s", 7, binary ? "" : "\n");
}

/* data as VTK writes them round what names the groups: numbers of the cells themselves, colours,
 * texts, bits and METADATA */
static void write_data(const struct solid_mesh *mesh, bool binary)
{
    size_t cells = mesh->element_count;
    say("\nCELL_DATA %zu\nSCALARS quality float 1\nLOOKUP_TABLE mine\n", cells + 1);
    for (size_t e = 0; e <= cells; e++)
        binary ? put(0, 4) : say("0\n");
    say("\nLOOKUP_TABLE mine 2\n");
    for (int i = 0; i < 8; i++)
        number(binary, false, 1, i % 2);
    say("\nCOLOR_SCALARS hue 3\n");
    for (size_t i = 0; i < 3 * (cells + 1); i++)
        number(binary, false, 1, 1);
    say("\nFIELD FieldData 6\nvtkGhostType 1 %zu unsigned_char\n", cells + 1);
    for (size_t e = 0; e <= cells; e++)
        number(binary, false, 1, 0);
    say("\nMETADATA\nCOMPONENT_NAMES\nX%%20X\n\nGlobalElementId 1 %zu int\n", cells + 1);
    for (size_t e = 0; e <= cells; e++)
        number(binary, false, 4, (double)e + 1.0);
    say("\nMETADATA\nINFORMATION 1\nNAME RANGE LOCATION vtkDataArray\nDATA 2 1 2\n\n");
    say("names 1 %zu string\n", cells + 1);
    for (size_t e = 0; e <= cells; e++)
        put_text(binary);
    say("\nis_shown 1 %zu bit\n", cells + 1);
    for (size_t e = 0; e <= cells; e += binary ? 8 : 1)
        number(binary, false, 1, 1);
    say("\nattribute 1 %zu int\n", cells + 1);
    for (size_t e = 0; e <= cells; e++)
        number(binary, false, 4, 5.0);
    say("\nMaterialIds 1 %zu int\n", cells + 1);
    for (size_t e = 0; e <= cells; e++)
        number(binary, false, 4, e < cells ? (double)(e % 2) : -7.0);
    say("\nPOINT_DATA %zu\nTEXTURE_COORDINATES map 1 float\n", mesh->node_count);
    for (size_t i = 0; i < mesh->node_count; i++)
        binary ? put(0, 4) : say("0\n");
    say("\nUNKNOWN data\n");
}

/* the file of a mesh; each cell is of its own group, and the last one a face of the first */
static void write_vtk(const struct solid_mesh *mesh, bool binary, bool split)
{
    size_t cells = mesh->element_count, total = mesh->first[cells], at = 0;
    bool tet = mesh->types[0] == ELEMENT_TET10;
    filled = 0;
    say("# vtk DataFile Version %s\na body\n%s\nDATASET UNSTRUCTURED_GRID\n", split ? "5.1" : "3.0",
        binary ? "BINARY" : "ASCII");
    say("FIELD FieldData 1\nTIME 1 1 double\n");
    number(binary, true, 8, 0.5);
    say("\nPOINTS %zu double\n", mesh->node_count);
    for (size_t i = 0; i < 3 * mesh->node_count; i++)
        number(binary, true, 8, mesh->points[i / 3][i % 3]);
    if (split) {
        say("\nMETADATA\nINFORMATION 0\n\nCELLS %zu %zu\nOFFSETS vtktypeint64\n", cells + 2,
            total + 3);
        for (size_t e = 0; e <= cells; e++)
            number(binary, false, 8, (double)mesh->first[e]);
        number(binary, false, 8, (double)total + 3.0);
        say("\nCONNECTIVITY vtktypeint64\n");
    } else {
        say("\nCELLS %zu %zu\n", cells + 1, total + cells + 4);
    }
    size_t size = split ? 8 : 4;
    for (size_t e = 0; e < cells; e++) {
        size_t count = mesh->first[e + 1] - mesh->first[e];
        if (!split)
            number(binary, false, size, (double)count);
        for (size_t v = 0; v < count; v++) {
            for (at = 0; (tet ? TET : HEX)[at] != v; at++)
                ;
            number(binary, false, size, (double)mesh->nodes[mesh->first[e] + at]);
        }
    }
    if (!split)
        number(binary, false, size, 3.0);
    for (size_t i = 0; i < 3; i++)
        number(binary, false, size, (double)mesh->nodes[i]);
    say("\nCELL_TYPES %zu\n", cells + 1);
    static const int CODES[] = {24, 25, 29};
    for (size_t e = 0; e < cells; e++)
        number(binary, false, 4, CODES[mesh->types[0]]);
    number(binary, false, 4, 5.0);
    write_data(mesh, binary);
}

static enum percuss_status read_data_as(double unit, bool raise, struct solid_mesh *mesh)
{
    file_write(".vtk", data, filled);
    struct mesh_options options = {.unit = unit, .raise = raise};
    enum percuss_status status = mesh_read(file_path, &options, mesh, &file_fault);
    unlink(file_path);
    return status;
}

static void reads_every_version_and_cell(void **state)
{
    (void)state;
    for (int i = 0; i < 12; i++) {
        struct block block = {.type = (enum element_type)(i % 3), .cells = {2, 2, 2}, .map = bend};
        struct solid_mesh made = block_make(&block), mesh;
        struct bulk expected, bulk;
        for (size_t p = 0; p < made.part_count; p++)
            made.part[p].material.density = 1.0;
        bulk_of(&made, &expected);
        write_vtk(&made, i / 3 % 2, i / 6);
        if (read_data_as(1.0, false, &mesh) != PERCUSS_OK)
            fail_msg("%d: %s", i, file_fault.text);
        bulk_of(&mesh, &bulk);
        near_relative(bulk.volume, expected.volume, 1e-12);
        near(bulk.smallest_det, expected.smallest_det, 1e-12);
        assert_int_equal(mesh.node_count, made.node_count);
        /* parts by the group of the cell, the face's nodes by its own */
        assert_int_equal(mesh.part_count, 2);
        assert_string_equal(mesh.part[0].name, "MaterialIds 0");
        assert_int_equal(mesh.set_count, 1);
        assert_string_equal(mesh.set[0].name, "MaterialIds -7");
        assert_int_equal(mesh.set[0].count, 3);
        assert_string_equal(mesh.remarks[0],
                            "UNKNOWN: is not read, nor the data behind it, such as groups");
        solid_mesh_free(&mesh);
        solid_mesh_free(&made);
    }
}

static const char LINEAR[] = "# vtk DataFile Version 2.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                             "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\n"
                             "CELL_TYPES 1\n10\n";

/* four of them */
static const char FOUR[] = "# vtk DataFile Version 2.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                           "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 4 20\n"
                           "4 0 1 2 3 4 0 1 2 3 4 0 1 2 3 4 0 1 2 3\n"
                           "CELL_TYPES 4\n10 10 10 10\n";

static void raises_and_refuses(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct bulk bulk;
    filled = 0;
    say("%s", LINEAR);
    assert_int_equal(read_data_as(1.0, true, &mesh), PERCUSS_OK);
    bulk_of(&mesh, &bulk);
    near_relative(bulk.volume, 1.0 / 6.0, 1e-13);
    assert_int_equal(mesh.node_count, 10);
    solid_mesh_free(&mesh);
    file_refused(".vtk", LINEAR,
                 ".vtk: cell 0: tetrahedron of 4 nodes (type 10): must be of second order");
    file_refused(".vtk", file_with(LINEAR, "1\n10", "1\n14"), ": cell 0: type 14: must be a tetra");
    file_refused(".vtk", file_with(LINEAR, "1\n10", "1\n24"),
                 "tetrahedron: has 4 nodes: must have 10");
    file_refused(".vtk", file_with(LINEAR, "4 0 1 2 3", "4 0 1 2 9"),
                 ": cell 0: its nodes must be numbers of points, from 0");
    file_refused(".vtk", file_with(LINEAR, "4 0 1 2 3", "5 0 1 2 3"),
                 "CELLS: cell 0: must have as many nodes as it says");
    file_refused(".vtk", file_with(LINEAR, "UNSTRUCTURED_GRID", "POLYDATA"),
                 ".vtk:4: DATASET POLYDATA: must be DATASET UNSTRUCTURED_GRID");
    file_refused(".vtk", file_with(LINEAR, "4 float", "40000 float"),
                 ".vtk:5: POINTS: 120000 numbers: the file ends before: it must be whole");
    file_refused(".vtk", file_with(LINEAR, "0 1 0 0", "0 1 x 0"), ".vtk:6: POINTS: x: must be");
    file_refused(".vtk", file_with(LINEAR, "ASCII", "TEXT"), "third line must be ASCII or BINARY");
    /* the first whole numbers name parts, but for those that number the cells; in wrong numbers
     * they are refused */
    static const char *const GROUPS[][2] = {
        {"a 1 4 int\n3 3 3 3\nb 1 4 int\n1 1 2 2\n", "a 3"},
        {"id 1 4 int\n3 4 5 6\nb 1 4 int\n1 1 2 2\n", "b 1"},
        {"id 1 4 int\n3 4 5 6\nn 1 4 double\n1 1 2 2\n", "body"}};
    char four[1024];
    for (size_t i = 0; i < COUNT(GROUPS); i++) {
        filled = 0;
        snprintf(four, sizeof four, "%sCELL_DATA 4\nFIELD f 2\n%s", FOUR, GROUPS[i][0]);
        file_refused(".vtk", file_with(four, "CELL_DATA 4", "CELL_DATA 3"),
                     ": CELL_DATA 3: must be of all 4 cells");
        file_refused(".vtk", file_with(four, " 1 4 int\n3", " 1 3 int\n"),
                     ": must be of all 4 cells");
        say("%s", four);
        assert_int_equal(read_data_as(1.0, true, &mesh), PERCUSS_OK);
        assert_string_equal(mesh.part[0].name, GROUPS[i][1]);
        solid_mesh_free(&mesh);
    }
    for (int binary = 0; binary < 2; binary++) {
        struct block block = {.type = ELEMENT_HEX20, .cells = {1, 1, 1}, .map = bend};
        struct solid_mesh made = block_make(&block);
        write_vtk(&made, binary, binary);
        file_survives(".vtk", data, filled, 100);
        solid_mesh_free(&made);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_every_version_and_cell),
        cmocka_unit_test(raises_and_refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
