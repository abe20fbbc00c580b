/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/mesh/unv.c: two bricks of bent lines and a tetrahedron in each dataset of
 * nodes, elements and groups. */
#include "unit/mesh/blocks.h"
#include "unit/mesh/files.h"

/* I-deas' node of each node of Gmsh's: round the lower face, the edges up, round the upper face */
static const unsigned char TET[10] = {0, 2, 4, 9, 1, 3, 5, 6, 8, 7};
static const unsigned char HEX[20] = {0, 2, 4, 6, 12, 14, 16, 18, 1,  7,
                                      8, 3, 9, 5, 10, 11, 13, 19, 15, 17};

static void bend(const double cube[3], double point[3])
{
    double bulge = 0.1 * sin(M_PI * cube[0]) * sin(M_PI * cube[1]) * sin(M_PI * cube[2]);
    for (int k = 0; k < 3; k++)
        point[k] = (k == 0 ? 2.0 : 1.0) * cube[k] + (k + 1) * bulge;
}

static char text[100000];
static size_t filled;

static void say(const char *format, ...) __attribute__((format(printf, 1, 2)));

static void say(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    filled += (size_t)vsnprintf(text + filled, sizeof text - filled, format, args);
    va_end(args);
    assert_true(filled < sizeof text);
}

static void write_nodes(const struct solid_mesh *mesh, int dataset)
{
    say("    -1\n%6d\n", dataset);
    for (size_t i = 0; i < mesh->node_count; i++) {
        const double *at = mesh->points[i];
        say("%10zu%10d%10d%10d", i + 1, 1, 1, 11);
        if (dataset == 15)
            say("%13.5E%13.5E%13.5E\n", at[0], at[1], at[2]);
        else
            say("\n%24.16E%25.16E%25.16E\n", at[0], at[1], at[2]);
        /* Fortran's exponents */
        for (char *c = text + filled - 76; dataset != 15 && *c; c++)
            if (*c == 'E')
                *c = 'D';
    }
    say("    -1\n");
}

static void write_elements(const struct solid_mesh *mesh, int dataset)
{
    bool tet = mesh->types[0] == ELEMENT_TET10;
    const unsigned char *order = tet ? TET : HEX;
    say("    -1\n%6d\n", dataset);
    /* a beam with its cross section, and a face */
    say(dataset == 780 ? "100 21 1 5 1 1 7 2\n" : "100 21 5 1 7 2\n");
    say("         0         1         1\n         1         2\n");
    say(dataset == 780 ? "101 91 1 5 1 1 7 3\n" : "101 91 5 1 7 3\n");
    say("         1         2         3\n");
    for (size_t e = 0; e < mesh->element_count; e++) {
        int count = tet ? 10 : 20, kind = tet ? 118 : 116;
        if (dataset == 780)
            say("%10zu%10d%10d%10d%10d%10d%10d%10d\n", e + 1, kind, 1, 5, 1, 1, 7, count);
        else
            say("%10zu%10d%10d%10d%10d%10d\n", e + 1, kind, 5, 1, 7, count);
        for (int v = 0; v < count; v++) {
            int at = 0;
            while (order[at] != v)
                at++;
            say("%10zu%s", mesh->nodes[mesh->first[e] + (size_t)at] + 1,
                v % 8 == 7 || v == count - 1 ? "\n" : "");
        }
    }
    say("    -1\n");
}

/* "left": the first solid; "all": all of them; "foot": face and a node; "rim": the beam */
static void write_groups(size_t elements, int dataset)
{
    bool four = dataset == 2435 || dataset == 2452 || dataset == 2467 || dataset == 2477;
    const char *more = four ? "         0         0" : "";
    const char *ends = dataset == 2417 ? "" : "         0         0";
    say("    -1\n%6d\n", dataset);
    say("%10d%10d%10d%10d%10d%s%10d\nleft\n%10d%10d%s\n", 1, 0, 0, 0, 0, ends, 1, 8, 1, more);
    say("%10d%10d%10d%10d%10d%s%10zu\n all it has \n", 2, 0, 0, 0, 0, ends, elements);
    for (size_t e = 0; e < elements; e++)
        say("%10d%10zu%s%s", 8, e + 1, more,
            (e + 1) % (four ? 2 : 4) && e + 1 < elements ? "" : "\n");
    say("%10d%10d%10d%10d%10d%s%10d\nfoot\n%10d%10d%s%10d%10d%s\n", 3, 0, 0, 0, 0, ends, 2, 8, 101,
        more, 7, 4, more);
    say("%10d%10d%10d%10d%10d%s%10d\nrim\n%10d%10d%s\n", 4, 0, 0, 0, 0, ends, 1, 8, 100, more);
    say("    -1\n");
}

static void reads_every_dataset(void **state)
{
    (void)state;
    static const int NODES[] = {2411, 781, 15}, ELEMENTS[] = {2412, 780};
    static const int GROUPS[] = {2467, 2477, 2452, 2435, 2432, 2430, 2429, 2417};
    for (size_t i = 0; i < 2 * COUNT(GROUPS); i++) {
        struct block block = {
            .type = i % 2 ? ELEMENT_HEX20 : ELEMENT_TET10, .cells = {2, 1, 1}, .map = bend};
        struct solid_mesh made = block_make(&block), mesh;
        struct bulk expected, bulk;
        made.part[0].material.density = 1.0;
        bulk_of(&made, &expected);
        filled = 0;
        say("    -1\n   164\n         1  SI: Meters (newton)         2\n    -1\n");
        /* groups may stand before what they are of */
        if (i % 3 == 1)
            write_groups(made.element_count, GROUPS[i / 2]);
        write_nodes(&made, NODES[i % 3]);
        write_elements(&made, ELEMENTS[i / 2 % 2]);
        if (i % 3 != 1)
            write_groups(made.element_count, GROUPS[i / 2]);
        if (file_read(".unv", text, 1.0, &mesh) != PERCUSS_OK)
            fail_msg("%zu: %s", i, file_fault.text);
        bulk_of(&mesh, &bulk);
        near_relative(bulk.volume, expected.volume, i % 3 == 2 ? 1e-5 : 1e-12);
        near(bulk.smallest_det, expected.smallest_det, i % 3 == 2 ? 1e-4 : 1e-12);
        /* a solid is in the first group that has it */
        assert_int_equal(mesh.part_count, 2);
        assert_string_equal(mesh.part[0].name, "left");
        assert_string_equal(mesh.part[1].name, "all it has");
        assert_int_equal(mesh.parts[0], 0);
        assert_int_equal(mesh.parts[1], 1);
        assert_int_equal(mesh.set_count, 2);
        assert_string_equal(mesh.set[0].name, "foot");
        assert_int_equal(mesh.set[0].count, 4);
        assert_int_equal(mesh.set[1].count, 2);
        solid_mesh_free(&mesh);
        solid_mesh_free(&made);
    }
}

static const char LINEAR[] =
    "    -1\n  2411\n 1 1 1 11\n 0.0D+00 0.0 0.0\n 2 1 1 11\n 1.0D+00 0.0 0.0\n 3 1 1 11\n 0.0 1.0 "
    "0.0\n 4 1 1 11\n 0.0 0.0 1.0\n    -1\n    -1\n  2412\n 7 111 3 1 7 4\n 1 2 3 4\n    -1\n";

static void raises_and_refuses(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct bulk bulk;
    file_write(".dat", LINEAR, strlen(LINEAR));
    struct mesh_options options = {.unit = 1.0, .raise = true};
    assert_int_equal(mesh_read(file_path, &options, &mesh, &file_fault), PERCUSS_OK);
    unlink(file_path);
    bulk_of(&mesh, &bulk);
    near_relative(bulk.volume, 1.0 / 6.0, 1e-13);
    assert_string_equal(mesh.part[0].name, "property 3");
    solid_mesh_free(&mesh);
    /* the file's unit is told where it is not the caller's */
    for (int i = 0; i < 2; i++) {
        filled = 0;
        say("    -1\n   164\n         5SI: mm (milli-newton)         2\n  1.0D+03  1.0D+00  "
            "1.0D+00\n"
            "  2.7D+02\n    -1\n%s",
            LINEAR);
        file_write(".unv", text, filled);
        options.unit = i == 0 ? 1.0 : 0.001;
        assert_int_equal(mesh_read(file_path, &options, &mesh, &file_fault), PERCUSS_OK);
        unlink(file_path);
        assert_int_equal(mesh.remark_count, i == 0 ? 2 : 1);
        if (i == 0)
            assert_string_equal(mesh.remarks[0],
                                "the file states a unit of 0.001 m (SI: mm (milli-newton), dataset "
                                "164); it is read in 1 m, that of --unit");
        solid_mesh_free(&mesh);
    }
    file_refused(
        ".unv", LINEAR,
        ".unv:15: element 7: linear tetrahedron (111): must be parabolic (118, 116, 113), as");
    file_refused(".unv", file_with(LINEAR, "7 111 ", "7 114 "),
                 "kind 114: must be a parabolic tetra");
    file_refused(".unv", file_with(LINEAR, "7 111 ", "7 91 "),
                 ": has 1 shells or lines and no solid: mesh the volume and export it, too");
    file_refused(".unv", file_with(LINEAR, "1 7 4\n", "1 7 5\n"),
                 ".unv:15: must have 5 whole numbers");
    file_refused(".unv", file_with(LINEAR, "1.0D+00", "x.0"),
                 ".unv:6: x.0 0.0 0.0: must be a coord");
    file_refused(".unv", "    -1\n  2411\n 1 1 1 11\n 0 0 0\n",
                 ".unv:4: a dataset must end with -1: is the file whole?");
    file_refused(".unv", file_with(LINEAR, " 1 2 3 4\n", ""), "ends within a record");
    file_refused(".unv", file_with(LINEAR, "-1\n    -1\n  2412", "-1\n 2412"),
                 "must be -1, between");
    struct block block = {.type = ELEMENT_TET10, .cells = {1, 1, 1}, .map = bend};
    struct solid_mesh made = block_make(&block);
    filled = 0;
    write_nodes(&made, 2411);
    write_elements(&made, 2412);
    write_groups(made.element_count, 2467);
    file_survives(".unv", text, filled, 100);
    solid_mesh_free(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_every_dataset),
        cmocka_unit_test(raises_and_refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
