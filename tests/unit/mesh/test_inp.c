/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Of mesh/inp.c and card.c: one brick and one tetrahedron in the order of nodes of the
 * manuals of Abaqus and CalculiX, sets, materials, and decks that are refused. */
#include "unit/mesh/files.h"

/* the cube of 2 mm: corners below and above, then mid nodes below, above and between. In N, mm, s
 */
static const char BRICK[] =
    "** made by hand\n*Heading\nanything, at all\n"
    "*NODE, NSET=ALL\n1, 0,0,0\n2, 2,0,0\n3, 2,2,0\n4, 0,2,0\n5, 0,0,2\n6, 2,0,2\n7, 2,2,2\n"
    "8, 0,2,2\n9, 1,0,0\n10, 2,1,0\n11, 1,2,0\n12, 0,1,0\n13, 1,0,2\n14, 2,1,2\n15, 1,2,2\n"
    "16, 0,1,2\n17, 0,0,1\n18, 2,0,1\n19, 2,2,1\n20, 0,2,1\n99, 5,5,5\n"
    "*Element, type=C3D20R, elset=Block\n"
    "4, 1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,\n16,17,18,19,20\n"
    "*NSET, NSET=low, GENERATE\n1, 4, 1\n9, 12\n"
    "*NSET, NSET=HELD\nLOW, 17,\n"
    "*SURFACE, NAME=top, TYPE=ELEMENT\nblock, S2\n"
    "*MATERIAL, NAME=Steel\n*ELASTIC\n210000., .3\n*DENSITY\n7.8e-9\n"
    "*PLASTIC\n500., 0.\n600., .01\n"
    "*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL\n"
    "*STEP\n*NODE PRINT\n*END STEP\n";

static const char TETRAHEDRON[] = "*NODE\n1, 0,0,0\n2, 2,0,0\n3, 0,2,0\n4, 0,0,2\n"
                                  "5, 1,0,0\n6, 1,1,0\n7, 0,1,0\n8, 0,0,1\n9, 1,0,1\n10, 0,1,1\n"
                                  "*ELEMENT, TYPE=S6, ELSET=foot\n1, 1,2,3,5,6,7\n"
                                  "*ELEMENT, TYPE=C3D10M\n2, 1,2,3,4,5,6,7,8,9,10\n"
                                  "*SURFACE, NAME=slope\n2, S3\n";

static const struct mesh_set *set_of(const struct solid_mesh *mesh, const char *name)
{
    for (size_t i = 0; i < mesh->set_count; i++)
        if (strcmp(mesh->set[i].name, name) == 0)
            return &mesh->set[i];
    fail_msg("no set %s", name);
    return NULL;
}

static void reads_a_brick(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct bulk bulk;
    assert_int_equal(file_read(".inp", BRICK, 0.001, &mesh), PERCUSS_OK);
    assert_int_equal(mesh.node_count, 20);
    assert_int_equal(mesh.types[0], ELEMENT_HEX20);
    assert_int_equal(mesh.element_labels[0], 4);
    /* any order but the right one gives other volumes and shapes */
    bulk_of(&mesh, &bulk);
    near_relative(bulk.volume, 8e-9, 1e-13);
    near(bulk.smallest_det, 1.0, 1e-12);

    /* 210 GPa, 7800 kg/m^3; hardening 10 GPa: 210*10/220 */
    assert_int_equal(mesh.part_count, 1);
    const struct mesh_part *part = &mesh.part[0];
    assert_true(part->has_material);
    assert_string_equal(part->name, "Block");
    assert_string_equal(part->material.name, "Steel");
    near_relative(part->material.young, 210e9, 1e-14);
    near_relative(part->material.poisson, 0.3, 0.0);
    near_relative(part->material.density, 7800.0, 1e-14);
    near_relative(part->material.yield, 500e6, 1e-14);
    near_relative(part->material.tangent, 210e9 / 22.0, 1e-13);

    assert_int_equal(set_of(&mesh, "ALL")->count, 20);
    assert_int_equal(set_of(&mesh, "low")->count, 8);
    assert_int_equal(set_of(&mesh, "HELD")->count, 9);
    const struct mesh_set *top = set_of(&mesh, "top");
    assert_int_equal(top->count, 8);
    for (size_t i = 0; i < top->count; i++)
        near(mesh.points[top->nodes[i]][2], 0.002, 1e-18);
    solid_mesh_free(&mesh);
}

static void reads_a_tetrahedron(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct bulk bulk;
    assert_int_equal(file_read(".inp", TETRAHEDRON, 1.0, &mesh), PERCUSS_OK);
    bulk_of(&mesh, &bulk);
    near_relative(bulk.volume, 8.0 / 6.0, 1e-13);
    near(bulk.smallest_det, 1.0, 1e-12);
    assert_string_equal(mesh.part[0].name, "body");
    assert_false(mesh.part[0].has_material);
    assert_int_equal(set_of(&mesh, "foot")->count, 6);
    const struct mesh_set *slope = set_of(&mesh, "slope");
    assert_int_equal(slope->count, 6);
    for (size_t i = 0; i < slope->count; i++) {
        const double *x = mesh.points[slope->nodes[i]];
        near(x[0] + x[1] + x[2], 2.0, 0.0);
    }
    solid_mesh_free(&mesh);
}

/* one instance of one part, as Abaqus/CAE writes it, and a reference point beside it */
static void reads_one_instance(void **state)
{
    (void)state;
    char deck[4000];
    snprintf(deck, sizeof deck,
             "*PART, NAME=a\n%s*END PART\n*ASSEMBLY, NAME=b\n*INSTANCE, NAME=c, PART=a\n"
             "*END INSTANCE\n*NODE\n1, 7,7,7\n*NSET, NSET=point\n1\n"
             "*NSET, NSET=tip, INSTANCE=c\n4\n*END ASSEMBLY\n",
             TETRAHEDRON);
    struct solid_mesh mesh;
    assert_int_equal(file_read(".inp", deck, 1.0, &mesh), PERCUSS_OK);
    assert_int_equal(mesh.node_count, 10);
    assert_int_equal(set_of(&mesh, "tip")->count, 1);
    solid_mesh_free(&mesh);
    file_refused(".inp", file_with(deck, "*END INSTANCE\n", "1, 0, 0\n*END INSTANCE\n"),
                 "*INSTANCE: is moved or turned");
    file_refused(".inp", file_with(deck, "*END INSTANCE\n", "*END INSTANCE\n*INSTANCE, PART=a\n"),
                 "*INSTANCE: is the second one: must be one body");
}

/* nodes in a file of their own, in the middle of a block */
static void includes_files(void **state)
{
    (void)state;
    char deck[4000], name[64];
    const char *cut = strstr(TETRAHEDRON, "6, 1,1,0");
    snprintf(name, sizeof name, "/tmp/percuss-test-%d.more", (int)getpid());
    FILE *stream = fopen(name, "w");
    assert_non_null(stream);
    fprintf(stream, "6, 1,1,0\n");
    fclose(stream);
    snprintf(deck, sizeof deck, "%.*s*INCLUDE, INPUT=%s\n%s", (int)(cut - TETRAHEDRON), TETRAHEDRON,
             strrchr(name, '/') + 1, cut + strlen("6, 1,1,0\n"));
    struct solid_mesh mesh;
    assert_int_equal(file_read(".inp", deck, 1.0, &mesh), PERCUSS_OK);
    assert_int_equal(mesh.node_count, 10);
    solid_mesh_free(&mesh);

    /* itself, again and again */
    stream = fopen(name, "w");
    assert_non_null(stream);
    fprintf(stream, "*INCLUDE, INPUT=%s\n", name);
    fclose(stream);
    file_refused(".inp", deck, "*INCLUDE: must not be more than 8 deep");
    unlink(name);
    file_refused(".inp", deck, ".more: No such file or directory");
}

/* a mark at the beginning and the ends of lines as editors of Windows write them */
static void reads_text_of_windows(void **state)
{
    (void)state;
    char text[2 * sizeof BRICK + 4] = "\xEF\xBB\xBF", *to = text + strlen(text);
    for (const char *from = BRICK; *from; from++) {
        if (*from == '\n')
            *to++ = '\r';
        *to++ = *from;
    }
    *to = '\0';
    struct solid_mesh plain, mesh;
    assert_int_equal(file_read(".inp", BRICK, 0.001, &plain), PERCUSS_OK);
    assert_int_equal(file_read(".inp", text, 0.001, &mesh), PERCUSS_OK);
    assert_int_equal(mesh.node_count, plain.node_count);
    assert_int_equal(mesh.set_count, plain.set_count);
    assert_memory_equal(mesh.points, plain.points, plain.node_count * sizeof *plain.points);
    solid_mesh_free(&mesh);
    solid_mesh_free(&plain);
}

static void refuses_with_the_line(void **state)
{
    (void)state;
    file_refused(".inp", file_with(BRICK, "C3D20R", "C3D8"),
                 "*ELEMENT: TYPE=C3D8: must be of second order (C3D10, C3D20), as linear ones are");
    file_refused(".inp", file_with(BRICK, "C3D20R", "C3D15"), "must be C3D10 or C3D20");
    file_refused(".inp", file_with(BRICK, "2, 2,0,0", "2, two,0,0"),
                 ".inp:6: *NODE: two: must be a number");
    file_refused(".inp", file_with(BRICK, "2, 2,0,0", "2, 1e999,0,0"),
                 "node 2: inf: coordinates must be finite numbers");
    file_refused(".inp", file_with(BRICK, "16,17,18,19,20", "16,17,18,19"),
                 "*ELEMENT: 4: has 19 nodes: must have more");
    file_refused(".inp", file_with(BRICK, "16,17,18,19,20", "16,17,18,19,20,99"),
                 "*ELEMENT: 4: must have 20 nodes");
    file_refused(".inp", file_with(BRICK, "LOW, 17", "HIGH, 17"),
                 "set: HIGH: must be the name of a set above");
    file_refused(".inp", file_with(BRICK, "1, 4, 1", "1, 400000000, 1"),
                 "GENERATE: 1 to 400000000: must be at most");
    file_refused(".inp", file_with(BRICK, "block, S2", "block, S7"), "must be: element or set, S1");
    file_refused(".inp", file_with(BRICK, "*ELASTIC\n", "*ELASTIC, TYPE=ORTHO\n"),
                 "*ELASTIC: TYPE=ORTHO: must be ISOTROPIC");
    file_refused(".inp", file_with(BRICK, "*DENSITY\n7.8e-9", "*DENSITY\n7800"),
                 "*DENSITY: 7800 is 7.8e+15 kg/m^3 in units of N, s and the file's length");
    file_refused(".inp", file_with(BRICK, "210000., .3", "210000., .5"), "material Steel: poisson");
    file_refused(".inp", file_with(BRICK, "*STEP", "*NGEN\n1, 9, 1\n*STEP"),
                 "*NGEN: is not read: nodes and elements must be written out");
    file_refused(".inp", file_with(BRICK, "*NODE, NSET=ALL", "*NODE, SYSTEM=C"), "must be R");
    file_refused(".inp", file_with(TETRAHEDRON, "2, 1,2,3,4", "1, 1,2,3,4"),
                 "element 1: is there twice");
    file_refused(".inp", "\xFF\xFE*\n", ".inp:1: must begin with a keyword, such as *NODE");
    file_refused(".inp", "1, 0, 0, 0\n*NODE\n", ".inp:1: must begin with a keyword");
    file_survives(".inp", BRICK, strlen(BRICK), 150);
    file_survives(".inp", TETRAHEDRON, strlen(TETRAHEDRON), 150);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_a_brick),         cmocka_unit_test(reads_a_tetrahedron),
        cmocka_unit_test(reads_one_instance),    cmocka_unit_test(includes_files),
        cmocka_unit_test(reads_text_of_windows), cmocka_unit_test(refuses_with_the_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
