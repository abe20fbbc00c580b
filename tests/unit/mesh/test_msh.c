/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Of mesh/msh.c: one tetrahedron as text and as bytes, its names, and files that are refused. */
#include "unit/mesh/files.h"

/* nodes in another order than their numbers; a triangle of the surface, a node in no element */
static const char TEXT[] = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
                           "$PhysicalNames\n2\n2 5 \"held here\"\n3 1 \"bracket\"\n"
                           "$EndPhysicalNames\n"
                           "$Entities\n1 0 1 1\n1 0 0 0 0\n"
                           "7 0 0 0 1 1 0 1 5 0\n"
                           "9 0 0 0 1 1 1 1 1 1 7\n$EndEntities\n"
                           "$Comment\nany words\n$EndComment\n"
                           "$Nodes\n2 11 1 40\n"
                           "2 7 1 3\n1\n2\n3\n0 0 0 0 0\n2 0 0 0 0\n0 2 0 0 0\n"
                           "3 9 0 8\n10\n5\n6\n7\n8\n9\n4\n40\n"
                           "1 0 1\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n0 1 1\n0 0 2\n9 9 9\n$EndNodes\n"
                           "$Elements\n2 2 1 2\n2 7 9 1\n1 1 2 3 5 6 7\n"
                           "3 9 11 1\n2 1 2 3 4 5 6 7 8 9 10\n$EndElements\n";

static void reads_one_tetrahedron(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct bulk bulk;
    assert_int_equal(file_read(".msh", TEXT, 0.001, &mesh), PERCUSS_OK);
    assert_int_equal(mesh.node_count, 10);
    assert_int_equal(mesh.element_count, 1);
    assert_int_equal(mesh.element_labels[0], 2);
    assert_int_equal(mesh.labels[mesh.nodes[9]], 10);
    assert_string_equal(mesh.part[0].name, "bracket");
    assert_false(mesh.part[0].has_material);
    assert_int_equal(mesh.set_count, 1);
    assert_string_equal(mesh.set[0].name, "held here");
    assert_int_equal(mesh.set[0].count, 6);
    /* straight edges 2 mm long: one det J, by rounding */
    bulk_of(&mesh, &bulk);
    near_relative(bulk.volume, 8e-9 / 6.0, 1e-13);
    near(bulk.smallest_det, 1.0, 1e-12);
    solid_mesh_free(&mesh);

    /* without names, numbers are */
    assert_int_equal(file_read(".msh",
                               file_with(TEXT, "2\n2 5 \"held here\"\n3 1 \"bracket\"\n", "0\n"),
                               1.0, &mesh),
                     PERCUSS_OK);
    assert_string_equal(mesh.part[0].name, "volume 1");
    assert_string_equal(mesh.set[0].name, "surface 5");
    solid_mesh_free(&mesh);
}

/* appends numbers as bytes */
struct bytes {
    size_t size;
    char data[4000];
};

static void text(struct bytes *bytes, const char *words)
{
    memcpy(bytes->data + bytes->size, words, strlen(words));
    bytes->size += strlen(words);
}

static void integers(struct bytes *bytes, int count, const int *values)
{
    memcpy(bytes->data + bytes->size, values, (size_t)count * sizeof *values);
    bytes->size += (size_t)count * sizeof *values;
}

static void sizes(struct bytes *bytes, size_t count, const size_t *values)
{
    memcpy(bytes->data + bytes->size, values, count * sizeof *values);
    bytes->size += count * sizeof *values;
}

static void reals(struct bytes *bytes, size_t count, const double *values)
{
    memcpy(bytes->data + bytes->size, values, count * sizeof *values);
    bytes->size += count * sizeof *values;
}

/* the same tetrahedron, as the manual of Gmsh lays it out */
static void make_binary(struct bytes *bytes)
{
    bytes->size = 0;
    text(bytes, "$MeshFormat\n4.1 1 8\n");
    integers(bytes, 1, (int[]){1});
    text(bytes, "\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"bracket\"\n$EndPhysicalNames\n"
                "$Entities\n");
    sizes(bytes, 4, (size_t[]){0, 0, 0, 1});
    integers(bytes, 1, (int[]){9});
    reals(bytes, 6, (double[]){0, 0, 0, 2, 2, 2});
    sizes(bytes, 1, (size_t[]){1});
    integers(bytes, 1, (int[]){1});
    sizes(bytes, 1, (size_t[]){1});
    integers(bytes, 1, (int[]){7});
    text(bytes, "\n$EndEntities\n$Nodes\n");
    sizes(bytes, 4, (size_t[]){1, 10, 1, 10});
    integers(bytes, 3, (int[]){3, 9, 0});
    sizes(bytes, 11, (size_t[]){10, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    reals(bytes, 30, (double[]){0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 1, 0, 0,
                                1, 1, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1, 0, 1});
    text(bytes, "\n$EndNodes\n$Elements\n");
    sizes(bytes, 4, (size_t[]){1, 1, 2, 2});
    integers(bytes, 3, (int[]){3, 9, 11});
    sizes(bytes, 12, (size_t[]){1, 2, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    text(bytes, "\n$EndElements\n");
}

static void reads_bytes(void **state)
{
    (void)state;
    struct bytes bytes;
    struct solid_mesh mesh;
    struct bulk bulk;
    make_binary(&bytes);
    file_write(".msh", bytes.data, bytes.size);
    assert_int_equal(
        mesh_read(file_path, &(struct mesh_options){.unit = 0.001}, &mesh, &file_fault),
        PERCUSS_OK);
    assert_int_equal(mesh.node_count, 10);
    assert_string_equal(mesh.part[0].name, "bracket");
    bulk_of(&mesh, &bulk);
    near_relative(bulk.volume, 8e-9 / 6.0, 1e-13);
    near(bulk.smallest_det, 1.0, 1e-12);
    solid_mesh_free(&mesh);

    /* cut off: where, in bytes */
    file_write(".msh", bytes.data, bytes.size - 40);
    assert_int_equal(mesh_read(file_path, &(struct mesh_options){.unit = 1.0}, &mesh, &file_fault),
                     PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(file_fault.text, ".msh: byte "));
    unlink(file_path);
    file_survives(".msh", bytes.data, bytes.size, 150);
}

static void has_its_names(const char *written)
{
    struct solid_mesh mesh;
    if (file_read(".msh", written, 1.0, &mesh) != PERCUSS_OK)
        fail_msg("%s in\n%s", file_fault.text, written);
    assert_string_equal(mesh.part[0].name, "bracket");
    assert_int_equal(mesh.set_count, 1);
    assert_string_equal(mesh.set[0].name, "held here");
    assert_int_equal(mesh.set[0].count, 6);
    assert_int_equal(mesh.remark_count, 0);
    solid_mesh_free(&mesh);
}

/* of a volume 1 without a group and a surface; each partition has a part of them */
static const char PARTITIONS[] = "$EndEntities\n$PartitionedEntities\n2\n0\n0 0 2 2\n"
                                 "7 2 3 1 1 0 0 0 1 1 0 1 5 0\n"
                                 "8 3 9 2 1 2 0 0 0 1 1 0 1 1 0\n"
                                 "9 3 4 1 1 0 0 0 1 1 1 1 1 0\n"
                                 "10 3 4 1 2 0 0 0 1 1 1 0 0\n$EndPartitionedEntities\n";

static void names_by_groups(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    static char partitioned[20000], split[20000];
    /* turned over in the group */
    has_its_names(file_with(TEXT, "0 1 1 0 1 5 0", "0 1 1 0 1 -5 0"));
    has_its_names(file_with(TEXT, "1 1 1 1 1 1 7", "1 1 1 1 -1 1 7"));
    /* entities of partitions alone are in groups */
    strcpy(split,
           file_with(TEXT, "1 0 1 1\n1 0 0 0 0\n7 0 0 0 1 1 0 1 5 0\n9 0 0 0 1 1 1 1 1 1 7\n",
                     "0 0 0 0\n"));
    strcpy(partitioned, file_with(split, "$EndEntities\n", PARTITIONS));
    has_its_names(partitioned);
    /* a volume in no group has the name of the geometry's, and is told of */
    strcpy(split, file_with(partitioned, "$Elements\n2 2 1 2\n", "$Elements\n3 3 1 3\n"));
    if (file_read(
            ".msh",
            file_with(split, "$EndElements", "3 10 11 1\n3 1 2 3 4 5 6 7 8 9 10\n$EndElements"),
            1.0, &mesh) != PERCUSS_OK)
        fail_msg("%s", file_fault.text);
    assert_int_equal(mesh.part_count, 2);
    assert_string_equal(mesh.part[1].name, "volume 4");
    assert_string_equal(mesh.remarks[0], "in no physical group, and part of the body: volume 4");
    solid_mesh_free(&mesh);
    /* one partition's file is not the body */
    file_refused(".msh", file_with(partitioned, "10 3 4 1 2", "10 3 4 1 1"),
                 ": holds 1 of 2 partitions: must be whole");
    file_survives(".msh", partitioned, strlen(partitioned), 100);
}

/* the last two nodes of Gmsh's tetrahedron lead from the corner 4 to 3 and 2 */
static void turns_over_and_raises(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct bulk bulk;
    const char *reversed = file_with(TEXT, "2 1 2 3 4 5 6 7 8 9 10\n", "2 1 3 2 4 7 6 5 8 10 9\n");
    assert_int_equal(file_read(".msh", reversed, 1.0, &mesh), PERCUSS_OK);
    bulk_of(&mesh, &bulk);
    near_relative(bulk.volume, 8.0 / 6.0, 1e-13);
    near(bulk.smallest_det, 1.0, 1e-12);
    assert_string_equal(mesh.remarks[0],
                        "1 elements (element 2 first) had their nodes the wrong way round, as in a "
                        "mirrored mesh: they were turned over");
    solid_mesh_free(&mesh);
    const char *linear = file_with(TEXT, "3 9 11 1\n2 1 2 3 4 5 6 7 8 9 10", "3 9 4 1\n2 1 2 3 4");
    file_write(".msh", linear, strlen(linear));
    struct mesh_options options = {.unit = 1.0, .raise = true};
    assert_int_equal(mesh_read(file_path, &options, &mesh, &file_fault), PERCUSS_OK);
    unlink(file_path);
    bulk_of(&mesh, &bulk);
    near_relative(bulk.volume, 8.0 / 6.0, 1e-13);
    assert_int_equal(mesh.node_count, 10);
    solid_mesh_free(&mesh);
}

static void refuses_with_the_line(void **state)
{
    (void)state;
    file_refused(".msh", "", ": no solid elements: must have 10-node tetrahedra");
    file_refused(".msh", "solid part\n",
                 ".msh:1: solid part: a mesh of Gmsh must begin with $MeshFormat");
    file_refused(".msh", file_with(TEXT, "40\n2 7", "40\n2 x"), ".msh:20: entity: x: must be");
    file_refused(".msh", file_with(TEXT, "1 1 0\n", "1 one 0\n"),
                 "coordinate of a node: one: must be a number");
    file_refused(".msh", file_with(TEXT, "1 1 0\n", "1 nan 0\n"),
                 ": node 6: nan: coordinates must be finite numbers");
    file_refused(".msh", file_with(TEXT, "3 9 0 8\n", "3 9 0 800000\n"),
                 "nodes of a block: 800000: the file is too short for so many");
    file_refused(".msh", file_with(TEXT, "2 1 2 3 4 5 6 7 8 9 10\n", "2 1 2 3 4 5 6 7 8 9 77\n"),
                 ": element 2: node 77: must be one of the file's nodes");
    file_refused(".msh", file_with(TEXT, "\n4\n40\n", "\n4\n4\n"), ": node 4: is there twice");
    file_refused(".msh", file_with(TEXT, "\n40\n", "\n18446744073709551615\n"),
                 ": number of a node: 18446744073709551615: must be a whole number from 0 to "
                 "9223372036854775807");
    file_refused(".msh", file_with(TEXT, "3 9 11 1\n2 1 2 3 4 5 6 7 8 9 10", "3 9 4 1\n2 1 2 3 4"),
                 "4-node tetrahedron: must be of second order, as linear ones are too stiff");
    file_refused(".msh", file_with(TEXT, "3 9 11 1\n", "3 9 13 1\n"),
                 "18-node prism: must be 10-node tetrahedra, 20- or 27-node hexahedra");
    file_refused(".msh", file_with(TEXT, "3 9 11 1\n", "3 9 29 1\n"),
                 ": element 2: type 29: must be one of second order");
    file_refused(
        ".msh", file_with(TEXT, "3 9 11 1\n2 1 2 3 4 5 6 7 8 9 10\n", "2 8 2 1\n2 1 2 3\n"),
        ": has 2 faces, lines and points and no solid: must be meshed in three dimensions");
    /* by its contents, whatever its name */
    file_refused(".msh", "*NODE\n1, x\n", ".msh:2: *NODE: x: must be a number");
    file_refused(".inp", file_with(TEXT, "1 1 0\n", "1 one 0\n"), "coordinate of a node: one");
    file_refused(".msh", file_with(TEXT, "$EndElements", "$End"),
                 "$Elements: must end with $EndElements: is the file whole?");
    file_survives(".msh", TEXT, strlen(TEXT), 150);
}

static void refuses_what_is_asked_badly(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    assert_int_equal(
        mesh_read("/nowhere/part.msh", &(struct mesh_options){.unit = 1.0}, &mesh, &file_fault),
        PERCUSS_BAD_REQUEST);
    assert_string_equal(file_fault.text, "/nowhere/part.msh: No such file or directory");
    assert_int_equal(mesh_read("part.txt", &(struct mesh_options){.unit = 1.0}, &mesh, &file_fault),
                     PERCUSS_BAD_REQUEST);
    assert_non_null(
        strstr(file_fault.text,
               "part.txt: its name must end with .msh, .inp, .bdf, .nas, .vtk, .unv, .step"));
    assert_int_equal(mesh_read("part.msh", &(struct mesh_options){.unit = 0.0}, &mesh, &file_fault),
                     PERCUSS_BAD_REQUEST);
    assert_string_equal(file_fault.text, "unit: 0: must be > 0 m");
    /* other programs' files, by name or contents: what to export instead */
    file_refused(".med", "\x89HDF\r\n",
                 "Modification, Convert to/from quadratic, and File, Export, UNV");
    file_refused(".cdb", "/COM,ANSYS RELEASE 19.0\n",
                 "is an archive of ANSYS (CDWRITE): save the geom");
    file_refused(".inp", "$# LS-PrePost\n*KEYWORD\n*NODE\n", "is a keyword file of LS-DYNA");
    file_refused(".vtu", "<VTKFile type=\"UnstructuredGrid\">\n", "as legacy VTK (.vtk)");
    file_refused(".msh", "(0 \"Fluent mesh\")\n(2 3)\n",
                 "is a mesh of Fluent, whose cells are linear");
    file_refused(".sldprt", "x", "is a part of a CAD program: save it as STEP");
    near(mesh_read_unit("in"), 0.0254, 0.0);
    near(mesh_read_unit("yard"), 0.0, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_one_tetrahedron), cmocka_unit_test(reads_bytes),
        cmocka_unit_test(names_by_groups),       cmocka_unit_test(turns_over_and_raises),
        cmocka_unit_test(refuses_with_the_line), cmocka_unit_test(refuses_what_is_asked_badly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
