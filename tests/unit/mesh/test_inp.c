/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Of mesh/inp.c, card.c, deck.c and their kin: one brick and one tetrahedron in the order of nodes
 * of the manuals of Abaqus and CalculiX, sets, materials, and decks that are refused. */
#include <sys/stat.h>

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

/* two cubes of the brick in a row, as CAE writes them: names of a part, and the same in the
 * assembly
 */
static const char ASSEMBLY[] =
    "*Part, name=Bar\n"
    "*Node\n1, 0,0,0\n2, 2,0,0\n3, 2,2,0\n4, 0,2,0\n5, 0,0,2\n6, 2,0,2\n7, 2,2,2\n"
    "8, 0,2,2\n9, 1,0,0\n10, 2,1,0\n11, 1,2,0\n12, 0,1,0\n13, 1,0,2\n14, 2,1,2\n15, 1,2,2\n"
    "16, 0,1,2\n17, 0,0,1\n18, 2,0,1\n19, 2,2,1\n20, 0,2,1\n"
    "*Element, type=C3D20R\n1, 1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20\n"
    "*Nset, nset=Set-1\n1, 2, 3, 4\n"
    "*Elset, elset=Set-1\n1\n"
    "*Solid Section, elset=Set-1, material=Steel\n,\n"
    "*End Part\n"
    "*Part, name=Point\n*End Part\n"
    "*Assembly, name=Whole\n"
    "*Instance, name=Bar-1, part=Bar\n10, 20, 30\n0, 0, 0, 0, 0, 1, 90\n*End Instance\n"
    "*Instance, name=Point-1, part=Point\n*End Instance\n"
    "*Node\n1, 7, 7, 7\n*Nset, nset=m_Set-2\n1\n"
    "*Nset, nset=Set-1, instance=Bar-1\n5, 6, 7, 8, 13\n"
    "*Elset, elset=Set-1, internal, instance=Bar-1\n1\n"
    "*Nset, nset=Both\nBar-1.Set-1, Bar-1.5\n"
    "*Elset, elset=_Top_S2, internal, instance=Bar-1\n1\n"
    "*Surface, type=ELEMENT, name=Top\n_Top_S2, S2\n"
    "*Surface, type=NODE, name=Top_CNS_, internal\nBoth, 1.\n"
    "*End Assembly\n"
    "*Material, name=Steel\n*Density\n7.8e-9,\n*Elastic\n210000., 0.3\n";

static size_t nodes_called(const struct solid_mesh *mesh, const char *name)
{
    size_t index;
    if (solid_mesh_find_set(mesh, name, &index, &file_fault))
        fail_msg("%s", file_fault.text);
    return mesh->set[index].count;
}

/* the message has these words */
static void not_called(const struct solid_mesh *mesh, const char *name, const char *words)
{
    size_t index;
    assert_int_equal(solid_mesh_find_set(mesh, name, &index, &file_fault), PERCUSS_BAD_REQUEST);
    if (!strstr(file_fault.text, words))
        fail_msg("\"%s\" has not \"%s\"", file_fault.text, words);
}

/* an instance stands where the assembly puts it, and names mean what they mean in their scope */
static void reads_an_assembly(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct bulk bulk;
    if (file_read(".inp", ASSEMBLY, 0.001, &mesh))
        fail_msg("%s", file_fault.text);
    assert_int_equal(mesh.node_count, 20);
    assert_string_equal(mesh.part[0].name, "Set-1");
    assert_int_equal(mesh.remark_count, 0);
    /* the middle of the brick, (1, 1, 1), is moved to (11, 21, 31) and turned to (-21, 11, 31) */
    bulk_of(&mesh, &bulk);
    near_relative(bulk.mass, 7.8e-6 * 8.0, 1e-12);
    near(bulk.centre[0], -21e-3, 1e-15);
    near(bulk.centre[1], 11e-3, 1e-15);
    near(bulk.centre[2], 31e-3, 1e-15);
    /* by the part, the instance, the assembly; alone it could be either */
    assert_int_equal(nodes_called(&mesh, "Bar.Set-1"), 4);
    assert_int_equal(nodes_called(&mesh, "bar-1.set-1"), 4);
    assert_int_equal(nodes_called(&mesh, "Whole.Set-1"), 5);
    assert_int_equal(nodes_called(&mesh, "Both"), 5);
    assert_int_equal(nodes_called(&mesh, "Top"), 8);
    assert_int_equal(nodes_called(&mesh, "Top_CNS_"), 5);
    not_called(&mesh, "Set-1",
               "several sets: must be one of: Bar.Set-1 (nodes), 4 nodes; Whole.Set-1 (nodes), 5");
    not_called(&mesh, "Set-3", "must be the name of a set of nodes: Bar.Set-1, ");
    not_called(&mesh, "m_Set-2", "must be the name of a set of nodes");
    solid_mesh_free(&mesh);
    /* the same nodes under one name are no two sets */
    const char *same = file_with(ASSEMBLY, "5, 6, 7, 8, 13", "4, 3, 2, 1");
    assert_int_equal(file_read(".inp", same, 0.001, &mesh), PERCUSS_OK);
    assert_int_equal(nodes_called(&mesh, "Set-1"), 4);
    solid_mesh_free(&mesh);
}

/* a section outside the part is no part's */
static void tells_of_a_section_outside(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    const char *deck = file_with(ASSEMBLY, "*End Assembly",
                                 "*Solid Section, elset=Bar-1.Set-1, material=X\n*End Assembly");
    assert_int_equal(file_read(".inp", deck, 0.001, &mesh), PERCUSS_OK);
    assert_int_equal(mesh.remark_count, 1);
    assert_string_equal(mesh.remarks[0], "*SOLID SECTION, ELSET=Bar-1.Set-1 (line 57): left out: "
                                         "must be in the *PART");
    assert_string_equal(mesh.part[0].material.name, "Steel");
    solid_mesh_free(&mesh);
}

/* a node of an instance is no name for --fixed, a set of it is */
static void tells_of_an_instance_s_supports(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    const char *deck = file_with(ASSEMBLY, "*Material",
                                 "*Boundary\nBar-1.5, ENCASTRE\nBar-1.Set-1, 1, 3\n*Material");
    assert_int_equal(file_read(".inp", deck, 0.001, &mesh), PERCUSS_OK);
    assert_int_equal(mesh.remark_count, 2);
    assert_non_null(
        strstr(mesh.remarks[0], "*BOUNDARY: single nodes are not held here: name them"));
    assert_non_null(strstr(mesh.remarks[1], "here: --fixed Bar-1.Set-1 holds it"));
    assert_int_equal(nodes_called(&mesh, "Bar-1.Set-1"), 4);
    solid_mesh_free(&mesh);
}

/* one body at a time: the others are listed */
static void chooses_an_instance(void **state)
{
    (void)state;
    static const char FURTHER[] =
        "*End Instance\n*Instance, name=Bar-2, part=Bar\n0, 0, 5\n*End Instance\n";
    const char *two = file_with(ASSEMBLY, "*End Instance\n", FURTHER);
    struct solid_mesh mesh;
    struct mesh_options how = {.unit = 0.001, .instance = "bar-2"};
    file_refused(".inp", two, "2 bodies (Bar-1, Bar-2): must be one: choose by --instance NAME");
    file_write(".inp", two, strlen(two));
    assert_int_equal(mesh_read(file_path, &how, &mesh, &file_fault), PERCUSS_OK);
    assert_int_equal(mesh.element_count, 1);
    assert_int_equal(nodes_called(&mesh, "Set-1"), 4);
    solid_mesh_free(&mesh);
    how.instance = "Bar-3";
    assert_int_equal(mesh_read(file_path, &how, &mesh, &file_fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(file_fault.text, "Bar-3: must be one of those with solids: Bar-1, Bar"));
    unlink(file_path);
    file_refused(".inp", file_with(ASSEMBLY, "name=Bar-1", "name=Point-1"), "the second of this");
    file_refused(".inp", file_with(ASSEMBLY, "_Top_S2, S2", "_Top_S1, S2"),
                 "set Top: _Top_S1: must be the name of a set of elements");
    file_refused(".inp", file_with(ASSEMBLY, "instance=Bar-1\n5", "instance=Bar-4\n5"),
                 "*NSET: INSTANCE=Bar-4: must be the name of an instance");
    file_refused(".inp", file_with(ASSEMBLY, "0, 0, 0, 0, 0, 1, 90", "0, 0, 0, 0, 0, 0, 90"),
                 "its axis must have two different points");
    file_refused(".inp", file_with(ASSEMBLY, "10, 20, 30\n0, 0, 0,", "\n0, 0, 0,"),
                 ".inp:37: *INSTANCE: 0: its first line must be the shift, three numbers");
    file_survives(".inp", ASSEMBLY, strlen(ASSEMBLY), 100);
}

/* as ccx and Abaqus read them: blanks in keywords, D exponents, names in quotes, sets before what
 * they name, steps that lead down, nodes written twice, nodes of a set of elements */
static void reads_what_solvers_read(void **state)
{
    (void)state;
    static const char *const CHANGES[][2] = {
        {"*SOLID SECTION", "* Solid section"},
        {"*SOLID SECTION", "*SOLIDSECTION"},
        {"7.8e-9", "7.8D-9"},
        {"ELSET=BLOCK, MATERIAL=STEEL", "ELSET = \"bl"
                                        "ock\", MATERIAL= STE EL"},
        {"1, 4, 1\n9, 12", "4, 1, -1\n12, 9, -1"},
        {"99, 5,5,5\n", "99, 5,5,5\n*NODE\n1, 0, 0, 0\n"},
        {"*NSET, NSET=HELD\nLOW, 17,\n", "*NSET, NSET=HELD\nlater\n*NSET, NSET=later\n17, low\n"},
        /* names of 80 letters, as the solvers take them */
        {"*STEP", "*NSET, NSET=A1234567890123456789012345678901234567890123456789012345678901234567"
                  "8901234567890\n1\n*STEP"},
        {"*ELASTIC\n", "*EXPANSION\n1e-5\n*ELASTIC\n"},
        /* a comma at the end of a keyword line: before data, before a comment, and before more */
        {"elset=Block\n", "elset=Block,\n"},
        {"NSET=HELD\nLOW", "NSET=HELD,\n** of the next\nLOW"},
        {"NSET=low, GENERATE", "NSET=low,\n\n** of it\ngenerate,"},
        {"ELSET=BLOCK, MATERIAL=STEEL\n", "ELSET=BLOCK,\nMATERIAL=STEEL,\n,\n"},
        {"*ELASTIC\n210000., .3\n*DENSITY\n", "*ELASTIC,\n210000., .3\n*DENSITY,\n"},
        {"*STEP", "*MATERIAL, NAME=other\n*HYPERELASTIC, OGDEN\n1, 2, 3\n*DENSITY\n1e9\n*STEP"},
        {"*STEP", "*MATERIAL, NAME=other\n*ELASTIC, TYPE=ORTHO\n1, 2, 3\n*PLASTIC\nx\n*STEP"}};
    for (size_t i = 0; i < COUNT(CHANGES); i++) {
        struct solid_mesh mesh;
        const char *deck = file_with(BRICK, CHANGES[i][0], CHANGES[i][1]);
        if (file_read(".inp", deck, 0.001, &mesh))
            fail_msg("%s: %s", CHANGES[i][1], file_fault.text);
        near_relative(mesh.part[0].material.density, 7800.0, 1e-14);
        assert_int_equal(nodes_called(&mesh, "low"), 8);
        assert_int_equal(nodes_called(&mesh, "held"), 9);
        assert_int_equal(mesh.remark_count, 0);
        solid_mesh_free(&mesh);
    }
    struct solid_mesh mesh;
    const char *nodes = "*NSET, NSET=\"a, b = c\", ELSET=block\n*STEP";
    assert_int_equal(file_read(".msh", file_with(BRICK, "*STEP", nodes), 0.001, &mesh), PERCUSS_OK);
    assert_int_equal(nodes_called(&mesh, "A, B = C"), 20);
    solid_mesh_free(&mesh);
    /* a set of nodes and a surface of one name */
    assert_int_equal(file_read(".inp", file_with(BRICK, "NAME=top", "NAME=low"), 0.001, &mesh),
                     PERCUSS_OK);
    assert_int_equal(nodes_called(&mesh, "low (surface)"), 8);
    not_called(&mesh, "low", "must be one of: low (nodes), 8 nodes; low (surface), 8 nodes");
    solid_mesh_free(&mesh);
}

static const char BRICK_LINE[] = "4, 1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,\n16,17,18,19,20\n";
static const char WEDGE_NODES[] = "*NODE\n30, 1,1,0\n31, 1,1,2\n*NSET";
/* the brick's nodes that a wedge, or a tetrahedron, takes more than once */
static void reads_collapsed_bricks(void **state)
{
    (void)state;
    static const char TET_NODES[] = "*NODE\n30, 1,1,0\n31, 1,0,1\n32, 1,1,1\n*NSET";
    static const struct {
        const char *nodes, *line;
        enum element_type type;
        double volume;
    } CASES[] = {{WEDGE_NODES, "4, 1,2,3,3,5,6,7,7,9,10,3,30,13,14,7,\n31,17,18,19,19\n",
                  ELEMENT_WEDGE15, 4e-9},
                 /* the same brick, its nodes counted from another corner */
                 {WEDGE_NODES, "4, 2,3,3,1,6,7,7,5,10,3,30,9,14,7,31,\n13,18,19,19,17\n",
                  ELEMENT_WEDGE15, 4e-9},
                 {TET_NODES, "4, 1,2,3,3,5,5,5,5,9,10,3,30,5,5,5,\n5,17,31,32,32\n", ELEMENT_TET10,
                  4e-9 / 3}};
    for (size_t i = 0; i < COUNT(CASES); i++) {
        char deck[20000];
        struct solid_mesh mesh;
        struct bulk bulk;
        snprintf(deck, sizeof deck, "%s", file_with(BRICK, BRICK_LINE, CASES[i].line));
        if (file_read(".inp", file_with(deck, "*NSET", CASES[i].nodes), 0.001, &mesh))
            fail_msg("%s", file_fault.text);
        assert_int_equal(mesh.types[0], CASES[i].type);
        bulk_of(&mesh, &bulk);
        near_relative(bulk.volume, CASES[i].volume, 1e-13);
        near(bulk.smallest_det, 1.0, 1e-12);
        /* the top face of the brick, that of the wedge, the tip of the tetrahedron */
        assert_int_equal(nodes_called(&mesh, "top"), CASES[i].type == ELEMENT_WEDGE15 ? 6 : 1);
        solid_mesh_free(&mesh);
    }
}

/* a wedge by its own name, with the faces S1 to S5 of its kind */
static void reads_wedges(void **state)
{
    (void)state;
    char deck[20000];
    struct solid_mesh mesh;
    struct bulk bulk;
    snprintf(deck, sizeof deck, "%s",
             file_with(BRICK, BRICK_LINE, "4, 1,2,3,5,6,7,9,10,30,13,14,31,17,18,19\n"));
    snprintf(deck, sizeof deck, "%s", file_with(deck, "C3D20R", "C3D15"));
    snprintf(deck, sizeof deck, "%s", file_with(deck, "block, S2", "block, S5"));
    assert_int_equal(file_read(".inp", file_with(deck, "*NSET", WEDGE_NODES), 0.001, &mesh),
                     PERCUSS_OK);
    bulk_of(&mesh, &bulk);
    near_relative(bulk.volume, 4e-9, 1e-13);
    near(bulk.smallest_det, 1.0, 1e-12);
    /* from corner to corner: x = y */
    assert_int_equal(nodes_called(&mesh, "top"), 8);
    for (size_t i = 0; i < mesh.set_count; i++)
        for (size_t k = 0; strcmp(mesh.set[i].name, "top") == 0 && k < 8; k++) {
            const double *x = mesh.points[mesh.set[i].nodes[k]];
            near(x[0], x[1], 1e-18);
        }
    solid_mesh_free(&mesh);
    /* a pyramid is none of these, and a tetrahedron has ten nodes */
    file_refused(
        ".inp",
        file_with(BRICK, BRICK_LINE, "4, 1,2,3,4,5,5,5,5,9,10,11,12,5,5,5,\n5,17,18,19,20\n"),
        "element 4: node 5: is in it more than once, and it is neither a wedge nor");
    file_refused(".inp", file_with(TETRAHEDRON, "2, 1,2,3,4,5", "2, 1,2,3,4,4"),
                 ".inp:15: element 2: node 4: is in it more than once");
}

/* before *STEP, and what is told of it */
static const char *const LEFT_OUT[][2] = {
    {"*BOUNDARY\nHELD, 1, 3\n", "*BOUNDARY: HELD is not held here: --fixed HELD holds it"},
    {"*BOUNDARY\nHELD, 1\nheld, 2, 2, 0.\n*BOUNDARY\nHeld, 3, 6\nlow, 4, 6\nlow, 11, 11\n",
     "*BOUNDARY: HELD is not held here: --fixed HELD holds it"},
    {"*BOUNDARY\nHELD, pinned\n", "*BOUNDARY: HELD is not held here: --fixed HELD holds it"},
    {"*BOUNDARY\nHELD, wedged\n", "*BOUNDARY: HELD is not held here: --fixed HELD holds it"},
    {"*BOUNDARY\nHELD, 2, 3\n",
     "*BOUNDARY: HELD is not held here: in direction 2 and 3 alone it cannot be, as --fixed"},
    {"*BOUNDARY\nHELD, XSYMM\nHELD, ZSYMM\n", "here: in direction 1 and 3 alone it cannot"},
    {"*STEP\n*FREQUENCY\n5\n*BOUNDARY\n1, 1, 3\n", "*BOUNDARY: single nodes are not held here"},
    {"*ELEMENT, TYPE=MASS, ELSET=m\n77, 1\n*MASS, ELSET=m\n1e-3\n",
     "masses on nodes (1, of 1 kg in all) are part of the body"},
    {"*SHELL SECTION, ELSET=s, MATERIAL=Steel\n1\n", "*SHELLSECTION (line 45): left out"},
    {"*TIE, NAME=t\na, b\n", "*TIE (line 45): left out: the body here is free of it"},
    {"*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n", "*EQUATION (line 45): left out"},
    {"*RIGID BODY, NSET=low\n", "*RIGIDBODY (line 45): left out: the body is elastic"},
    {"*INITIAL CONDITIONS, TYPE=STRESS\n4, 1\n", "the body has no prestress"},
    {"*STEP\n*STATIC\n", "*STATIC (line 46): the body here is unloaded"},
    {"*NSET, NSET=g, GENERAT\n1, 4, 1\n",
     "*NSET (line 45): GENERAT: is no parameter known here: left out"},
    /* in two lines: 4 is no label here, of which there is one */
    {"*ELEMENT, TYPE=DC3D20, ELSET=heat\n1, 1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,\n"
     "4,17,18,19,20\n",
     "*ELEMENT, TYPE=DC3D20: left out: no solids of second order"},
    {"*NSET, NSET=LOW\n17\n", "the sets low and LOW are one: names are the same in any case"},
    {"*NSET, NSET=s\n1, 2, 300\n*NSET, NSET=t\ns, 301\n",
     "set t (nodes): 2 of the nodes or elements that it names are not there"},
    {"*ELSET, ELSET=Block, GENERATE\n4, 9\n",
     "set Block (elements): 5 of the elements that it names are not there"},
    {"*SURFACE, NAME=s\nblock, S5\n5, S1\nblock, S6\n",
     "set s (surface): 1 of the faces or nodes that it names are not there"},
    {"*ELEMENT, TYPE=S4, ELSET=Block\n9, 1,2,3,4\n",
     "*SOLID SECTION, ELSET=BLOCK: elements that are no solids are left out"},
    {"*WHATEVER\n1, 2\n", "*WHATEVER (line 45): is not known here: left out"}};

/* what is left out is told in a line each */
static void tells_what_is_left_out(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    for (size_t i = 0; i < COUNT(LEFT_OUT); i++) {
        char whole[400];
        snprintf(whole, sizeof whole, "%s*STEP", LEFT_OUT[i][0]);
        assert_int_equal(file_read(".inp", file_with(BRICK, "*STEP", whole), 0.001, &mesh),
                         PERCUSS_OK);
        bool told = false;
        for (size_t k = 0; k < mesh.remark_count; k++)
            told = told || strstr(mesh.remarks[k], LEFT_OUT[i][1]);
        if (!told)
            fail_msg("not told: %s (but %s)", LEFT_OUT[i][1],
                     mesh.remark_count ? mesh.remarks[0] : "nothing");
        solid_mesh_free(&mesh);
    }
    /* a table over the temperature, of the body's own material */
    const char *table = file_with(BRICK, "210000., .3\n", "210000., .3, 20.\n190000., .3, 300.\n");
    assert_int_equal(file_read(".inp", table, 0.001, &mesh), PERCUSS_OK);
    near_relative(mesh.part[0].material.young, 210e9, 1e-14);
    assert_non_null(strstr(mesh.remarks[0], "*ELASTIC is a table over the temperature: its rows at "
                                            "20 are taken"));
    solid_mesh_free(&mesh);
    /* properties that are not the solid's leave its own alone */
    static const struct {
        const char *from, *to, *told;
    } OTHERS[] = {
        {"*DENSITY", "*DENSITY, PORE FLUID\n1e-9\n*DENSITY",
         "is of the fluid in the pores: left out"},
        {"*ELASTIC", "*PLASTIC, HARDENING=JOHNSON COOK\n90, 1, 2, 3, 4, 5\n*ELASTIC",
         "*PLASTIC is no table of stresses: left out"},
        {"*ELASTIC", "*PLASTIC, HARDENING=COMBINED, DATA TYPE=PARAMETERS\n90, 1, 2\n*ELASTIC",
         "*PLASTIC is no table of stresses: left out"},
        {"*PLASTIC", "*PLASTIC, SCALE STRESS=2.", "*PLASTIC: SCALESTRESS=2. is left out"}};
    for (size_t i = 0; i < COUNT(OTHERS); i++) {
        assert_int_equal(
            file_read(".inp", file_with(BRICK, OTHERS[i].from, OTHERS[i].to), 0.001, &mesh),
            PERCUSS_OK);
        assert_non_null(strstr(mesh.remarks[0], OTHERS[i].told));
        near_relative(mesh.part[0].material.density, 7800.0, 1e-14);
        near_relative(mesh.part[0].material.yield, 500e6, 1e-14);
        solid_mesh_free(&mesh);
    }
    /* what a deck does not state is NAN, and the card has its name */
    assert_int_equal(file_read(".inp", file_with(BRICK, "*DENSITY\n7.8e-9\n", ""), 0.001, &mesh),
                     PERCUSS_OK);
    assert_false(mesh.part[0].has_material);
    assert_true(isnan(mesh.part[0].material.density));
    near_relative(mesh.part[0].material.young, 210e9, 1e-14);
    assert_string_equal(mesh.part[0].lacks, "*MATERIAL, NAME=Steel has no *DENSITY");
    solid_mesh_free(&mesh);
}

/* every table of the body's material that is cut, each in a line; none of another's */
static void tells_of_every_table(void **state)
{
    (void)state;
    static const char STEEL[] = "*ELASTIC\n210000., .3\n*DENSITY\n7.8e-9\n*PLASTIC\n500., 0.\n";
    static const char TABLES[] =
        "*CREEP\n1, 2\n*ELASTIC, DEPENDENCIES=1\n210000., .3, 20., 1.\n190000., .3, 20., 2.\n"
        "*DENSITY\n7.8e-9, 20.\n7.7e-9, 30.\n*PLASTIC, RATE=0\n500., 0.\n600., .01\n650., .1\n"
        "*PLASTIC, RATE=1\n700., 0.\n"
        "*MATERIAL, NAME=other\n*ELASTIC\n1, 0, 1\n1, 0, 2\n*MATERIAL, NAME=last\n*PLASTIC\n1, 0\n";
    static const char *const TOLD[] = {"*CREEP is left out",
                                       "*ELASTIC is a table over 1 field",
                                       "*ELASTIC: of its rows the first 1 are taken",
                                       "*DENSITY is a table over the temperature: its rows at 20",
                                       "*PLASTIC: of its rows the first 2 are taken",
                                       "*PLASTIC at further rates is left out"};
    struct solid_mesh mesh;
    if (file_read(".inp", file_with(BRICK, STEEL, TABLES), 0.001, &mesh))
        fail_msg("%s", file_fault.text);
    assert_int_equal(mesh.remark_count, COUNT(TOLD));
    for (size_t i = 0; i < COUNT(TOLD); i++)
        if (!strstr(mesh.remarks[i], TOLD[i]))
            fail_msg("\"%s\" has not \"%s\"", mesh.remarks[i], TOLD[i]);
    near_relative(mesh.part[0].material.young, 210e9, 1e-14);
    near_relative(mesh.part[0].material.yield, 500e6, 1e-14);
    near_relative(mesh.part[0].material.tangent, 210e9 / 22.0, 1e-13);
    solid_mesh_free(&mesh);
    /* inches: 30e6 of pounds-force would be 207 GPa */
    static const char INCHES[] = "*ELASTIC\n30e6, .3\n*DENSITY\n7.3e-4\n*PLASTIC\n5e4, 0.\n";
    if (file_read(".inp", file_with(BRICK, STEEL, INCHES), 0.0254, &mesh))
        fail_msg("%s", file_fault.text);
    assert_non_null(strstr(mesh.remarks[0],
                           ":36: Steel is read in newtons: E 4.65e+10 Pa, *DENSITY "
                           "1754 kg/m^3; of a deck in pounds-force give"));
    solid_mesh_free(&mesh);
}

/* what is there twice with other values, whatever of it a solver would take */
static void refuses_a_second_material(void **state)
{
    (void)state;
    char deck[20000];
    static const char SECOND[] =
        "*MATERIAL, NAME=STEEL\n*DENSITY\n7.8e-9\n*ELASTIC\n210000., .3\n"
        "*PLASTIC\n500., 0.\n600., .01\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=steel\n*STEP";
    struct solid_mesh mesh;
    snprintf(deck, sizeof deck, "%s", file_with(BRICK, "*STEP", SECOND));
    assert_int_equal(file_read(".inp", deck, 0.001, &mesh), PERCUSS_OK);
    assert_int_equal(mesh.remark_count, 0);
    solid_mesh_free(&mesh);
    static const char *const OTHERS[][2] = {
        {"*DENSITY\n7.8e-9\n*EL", "*DENSITY\n2.7e-9\n*EL"},
        {"*DENSITY\n7.8e-9\n*EL", "*EL"},
        {"*ELASTIC\n210000., .3\n*PL", "*ELASTIC\n210000., .2\n*PL"},
        {"*ELASTIC\n210000., .3\n*PL", "*HYPERELASTIC\n1, 2\n*PL"},
        {"*PLASTIC\n500., 0.\n600., .01\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=steel",
         "*PLASTIC\n500., 0.\n"}};
    for (size_t i = 0; i < COUNT(OTHERS); i++)
        file_refused(".inp", file_with(deck, OTHERS[i][0], OTHERS[i][1]),
                     ".inp:45: *MATERIAL, NAME=STEEL: is in line 36 of ");
    file_refused(".inp", file_with(BRICK, "*PLASTIC", "*DENSITY\n2.7e-9\n*PLASTIC"),
                 ".inp:41: *DENSITY: is in line 39 before: must be in a material once");
    file_refused(".inp",
                 file_with(BRICK, "*STEP", "*SOLID SECTION, ELSET=block, MATERIAL=Al\n*STEP"),
                 ".inp:45: element 4: is in the solid sections of Block and block: must be in one; "
                 "the other, of STEEL, is in line 44 of ");
}

/* nodes in a file of their own, in the middle of a block */
static void includes_files(void **state)
{
    (void)state;
    char deck[20000], name[64];
    const char *cut = strstr(TETRAHEDRON, "6, 1,1,0");
    snprintf(name, sizeof name, "/tmp/percuss-test-%d.more", (int)getpid());
    FILE *stream = fopen(name, "w");
    assert_non_null(stream);
    fprintf(stream, "6, 1,1,0\n");
    fclose(stream);
    snprintf(deck, sizeof deck, "%.*s* Include, INPUT=\"%s\"\n%s", (int)(cut - TETRAHEDRON),
             TETRAHEDRON, strrchr(name, '/') + 1, cut + strlen("6, 1,1,0\n"));
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
    file_refused(".inp", deck, ".more: No such file or directory: must be in the deck's folder");
    assert_non_null(strstr(file_fault.text, ".inp:7: *INCLUDE: INPUT=percuss-test-"));

    /* its lines of data in a file; what that names is beside the deck, not in the file's folder */
    char inner[80], folder[64];
    snprintf(folder, sizeof folder, "/tmp/percuss-test-%d.parts", (int)getpid());
    snprintf(inner, sizeof inner, "%s/nodes", folder);
    assert_int_equal(mkdir(folder, 0700), 0);
    stream = fopen(inner, "w");
    fprintf(stream, "1, 0,0,0\n2, 2,0,0\n3, 0,2,0\n4, 0,0,2\n*INCLUDE, INPUT=%s\n",
            strrchr(name, '/') + 1);
    fclose(stream);
    stream = fopen(name, "w");
    fprintf(stream, "5, 1,0,0\n6, 1,1,0\n7, 0,1,0\n8, 0,0,1\n9, 1,0,1\n10, 0,1,1\n");
    fclose(stream);
    snprintf(deck, sizeof deck, "*NODE, INPUT=%s\n%s", strrchr(folder, '/') + 1,
             strstr(TETRAHEDRON, "*ELEMENT"));
    snprintf(deck, sizeof deck, "%s", file_with(deck, ".parts", ".parts/nodes"));
    if (file_read(".inp", deck, 1.0, &mesh))
        fail_msg("%s", file_fault.text);
    assert_int_equal(mesh.node_count, 10);
    solid_mesh_free(&mesh);
    unlink(name);
    unlink(inner);
    rmdir(folder);
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
                 "*ELEMENT: TYPE=C3D8: must be of second order (C3D10, C3D15, C3D20), as");
    file_refused(".inp", file_with(BRICK, "C3D20R", "C3D27"), "must be C3D10, C3D15 or C3D20");
    file_refused(".inp", file_with(BRICK, "2, 2,0,0", "2, two,0,0"),
                 ".inp:6: *NODE: two: must be a number");
    file_refused(".inp", file_with(BRICK, "2, 2,0,0", "2, 1e999,0,0"),
                 ".inp:6: node 2: inf: coordinates must be finite numbers");
    file_refused(".inp", file_with(BRICK, "16,17,18,19,20", "16,17,18,19"),
                 "*ELEMENT: 4: has 19 nodes: must have more");
    file_refused(".inp", file_with(BRICK, "16,17,18,19,20", "16,17,18,19,20,99"),
                 "*ELEMENT: 4: must have 20 nodes");
    file_refused(".inp", file_with(BRICK, "LOW, 17", "HIGH, 17"),
                 "set HELD: HIGH: must be the name of a set of nodes");
    file_refused(".inp", file_with(BRICK, "1, 4, 1", "1, 400000000, 1"),
                 "GENERATE: 1 to 400000000: must be at most");
    file_refused(".inp", file_with(BRICK, "block, S2", "block, S7"), "must be: element or set, S1");
    file_refused(".inp", file_with(BRICK, "*ELASTIC\n", "*ELASTIC, TYPE=ORTHO\n"),
                 "*ELASTIC: TYPE=ORTHO: must be ISOTROPIC");
    file_refused(
        ".inp", file_with(BRICK, "*DENSITY\n7.8e-9", "*DENSITY\n7800"),
        ".inp:36: Steel: *DENSITY: 7800 is 7.8e+15 kg/m^3 in units of N, s and the file's length");
    file_refused(".inp", file_with(BRICK, "210000., .3", "210000., .5"), ".inp:36: Steel: poisson");
    file_refused(".inp", file_with(BRICK, "*STEP", "*NGEN\n1, 9, 1\n*STEP"),
                 "*NGEN: is not read: nodes and elements must be written out");
    file_refused(".inp", file_with(BRICK, "*NODE, NSET=ALL", "*NODE, SYSTEM=C"), "must be R");
    file_refused(".inp", file_with(BRICK, "LOW, 17", "later\n*NSET, NSET=later\nheld"),
                 "must not name itself, nor be more than 12 deep");
    file_refused(".inp", file_with(BRICK, "99, 5,5,5\n", "9, 5,5,5\n"),
                 "node 9: is there twice, at 1, 0, 0 and at 5, 5, 5");
    file_refused(".inp", file_with(BRICK, "ELSET=BLOCK,", "ELSET=BOX,"),
                 ".inp:44: *SOLID SECTION: ELSET=BOX: must be the name of a set of elements");
    file_refused(".inp", file_with(BRICK, "*ELASTIC", "*HYPERELASTIC"),
                 ".inp:37: *HYPERELASTIC: is not read: must be *ELASTIC");
    file_refused(".inp", file_with(BRICK, "1, 4, 1", "1, 4, -1"), "must lead down");
    file_refused(".inp", file_with(BRICK, "NSET=HELD\n", "NSET=HELD, 17\n"),
                 "*NSET: 17: must be a parameter, KEY or KEY=VALUE");
    /* the label that stands for none */
    file_refused(".inp", file_with(BRICK, "16,17,18,19,20", "16,17,18,19,18446744073709551615"),
                 "18446744073709551615: must be a whole number from 1 to 9223372036854775807");
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
        cmocka_unit_test(reads_a_brick),
        cmocka_unit_test(reads_a_tetrahedron),
        cmocka_unit_test(reads_an_assembly),
        cmocka_unit_test(tells_of_a_section_outside),
        cmocka_unit_test(tells_of_an_instance_s_supports),
        cmocka_unit_test(chooses_an_instance),
        cmocka_unit_test(reads_what_solvers_read),
        cmocka_unit_test(reads_collapsed_bricks),
        cmocka_unit_test(reads_wedges),
        cmocka_unit_test(tells_what_is_left_out),
        cmocka_unit_test(tells_of_every_table),
        cmocka_unit_test(refuses_a_second_material),
        cmocka_unit_test(includes_files),
        cmocka_unit_test(reads_text_of_windows),
        cmocka_unit_test(refuses_with_the_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
