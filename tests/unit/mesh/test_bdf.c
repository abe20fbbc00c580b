/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/mesh/bdf.c with bdf_card.c: one tetrahedron of a sixth of a cubic unit, in
 * all ways that Nastran writes cards. */
#include "unit/mesh/files.h"

/* its nodes in Nastran's order: 8, 9 and 10 lead from the corners 1, 2 and 3 to the corner 4 */
static const char GRIDS[] =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"
    "GRID,5,,.5,0.,0.\nGRID,6,,.5,.5,0.\nGRID,7,,0.,.5,0.\n"
    "GRID,8,,0.,0.,.5\nGRID,9,,.5,0.,.5\nGRID,10,,0.,.5,.5\n";
static const char TET[] = "CTETRA,7,3,1,2,3,4,5,6,+\n+,7,8,9,10\n";

static char text[8192];

static const char *deck(const char *grids, const char *rest)
{
    snprintf(text, sizeof text,
             "SOL 103\nCEND\nTITLE = it's $ 1\nBEGIN BULK\n%s%sENDDATA\nno card\n", grids, rest);
    return text;
}

static void read_deck(const char *written, struct solid_mesh *mesh)
{
    if (file_read(".bdf", written, 0.001, mesh) != PERCUSS_OK)
        fail_msg("%s in\n%s", file_fault.text, written);
}

/* the tetrahedron, whatever its file: a wrong order of nodes bends it */
static void is_the_tetrahedron(const char *written)
{
    struct solid_mesh mesh;
    struct bulk bulk;
    read_deck(written, &mesh);
    assert_int_equal(mesh.element_count, 1);
    assert_int_equal(mesh.node_count, 10);
    bulk_of(&mesh, &bulk);
    near_relative(bulk.volume, 1e-9 / 6.0, 1e-12);
    near(bulk.smallest_det, 1.0, 1e-9);
    for (int k = 0; k < 3; k++)
        near(mesh.points[0][k], 0.0, 1e-18);
    solid_mesh_free(&mesh);
}

static void reads_every_form_of_a_card(void **state)
{
    (void)state;
    static const char *const ELEMENTS[] = {
        /* columns: continued by a blank, a sign, a mark, a mark and no other, in capitals or not */
        "CTETRA         7       3       1       2       3       4       5       6\n"
        "               7       8       9      10\n",
        "CTETRA         7       3       1       2       3       4       5       6+\n"
        "+              7       8       9      10\n",
        "ctetra         7       3       1       2       3       4       5       6+a\n"
        "$ in between\n\n+A             7       8       9      10\n",
        "CTETRA         7       3       1       2       3       4       5       6\n"
        "+              7       8       9      10\n",
        "CTETRA\t7\t3\t1\t2\t3\t4\t5\t6\n\t7\t8\t9\t10\n",
        /* 16 columns, and one line of each */
        "CTETRA*                7               3               1               2*\n"
        "*                      3               4               5               6*\n"
        "*                      7               8               9              10\n",
        "CTETRA         7       3       1       2       3       4       5       6+\n"
        "*                      7               8               9              10\n",
        /* commas */
        "CTETRA,7,3,1,2,3,4,5,6,+x\n+x,7,8,9,10\n", "CTETRA, 7, 3, 1, 2, 3, 4, 5, 6\n,7,8,9,10,\n",
        "CTETRA*,7,3,1,2,*\n*,3,4,5,6,*\n*,7,8,9,10\n",
        "CTETRA,7,3,1,2,3,4,5,6 $ first\n,7,8,9,10\n"};
    for (size_t i = 0; i < COUNT(ELEMENTS); i++)
        is_the_tetrahedron(deck(GRIDS, ELEMENTS[i]));
    /* meshio's name, and a comment that is not Gmsh's $NOD */
    is_the_tetrahedron(file_with(deck(GRIDS, TET), "CTETRA", "CTETRA_"));
    is_the_tetrahedron(file_with(deck(GRIDS, TET), "SOL", "$NODES of the part\nSOL"));
    /* a mesh alone, and lines of Windows */
    snprintf(text, sizeof text, "$ mesh\n%s%s", GRIDS, TET);
    is_the_tetrahedron(text);
    is_the_tetrahedron(file_with(deck(GRIDS, TET), "GRID,2,,1.,0.,0.\n", "GRID,2,,1.,0.,0.\r\n"));
}

static void reads_every_form_of_a_number(void **state)
{
    (void)state;
    static const char *const ONES[] = {"1",     "1.",   "+1.",    "1.0+0", ".1+1",   "10.-1",
                                       "1.E+0", "1.e0", "1.0D+0", "1.d0",  "100.-2", "+.001+3"};
    for (size_t i = 0; i < COUNT(ONES); i++) {
        char grid[64];
        snprintf(grid, sizeof grid, "GRID    2               %-8s0.      0.\n", ONES[i]);
        is_the_tetrahedron(file_with(deck(GRIDS, TET), "GRID,2,,1.,0.,0.\n", grid));
    }
    is_the_tetrahedron(file_with(
        deck(GRIDS, TET), "GRID,2,,1.,0.,0.\n",
        "GRID*                  2                1.000000000D+00               0.*\n*\t\t0.0\n"));
    file_refused(".bdf", file_with(deck(GRIDS, TET), "2,,1.", "2,,1.x"),
                 ".bdf:6: GRID: field 4: 1.x: must be a number");
    file_refused(".bdf", file_with(deck(GRIDS, TET), "2,,1.", "2,,nan"), "nan: must be a number");
    file_refused(".bdf", file_with(deck(GRIDS, TET), "2,,1.", "2,,1.-"), "1.-: must be a number");
    file_refused(".bdf", file_with(deck(GRIDS, TET), "GRID,2", "GRID,2.0"),
                 "GRID: field 2: 2.0: must be a whole number");
}

/* the same places in four systems that stand in each other */
static void places_nodes_in_their_systems(void **state)
{
    (void)state;
    /* 11: 10 up, turned by 90 degrees about z (its x is y). 12: in 11, its origin is (2, 90
     * degrees, 3) of the cylinder 13 about 11's axes. 14: a sphere about the origin. 15: by nodes
     * 1, 4, 2 */
    static const char FRAMES[] = "CORD2R,11,,0.,0.,10.,0.,0.,11.\n,0.,1.,10.\n"
                                 "CORD2C,13,11,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
                                 "CORD2R,12,13,2.,90.,3.,2.,90.,4.\n,4.,90.,3.\n"
                                 "CORD2S,14,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
                                 "CORD1R,15,1,4,2,16,1,4,3\n";
    struct solid_mesh mesh;
    char grids[2048];
    /* 12's origin is at 11's (0, 2, 3), that is (-2, 0, 13); its x points along 11's y, that is -x
     */
    snprintf(grids, sizeof grids, "%s%s", FRAMES,
             "GRID,1,12,-2.,0.,-13.\nGRID,2,14,1.,90.,0.\nGRID,3,13,1.,0.,-10.\n"
             "GRID,4,14,1.,0.,33.\nGRID,5,11,0.,-.5,-10.\nGRID,6,15,.5,.5,0.,3\n"
             "GRID,7,16,.5,0.,0.\nGRID,8,0,0.,0.,.5\n"
             "GRID,9,14,.7071068,45.,0.\nGRID,10,14,.7071068,45.,90.\n");
    read_deck(deck(grids, TET), &mesh);
    /* by label, in Gmsh's order of the first element: node 9 and 10 change places */
    static const double AT[10][3] = {{0, 0, 0},   {1, 0, 0},  {0, 1, 0},  {0, 0, 1},   {.5, 0, 0},
                                     {.5, .5, 0}, {0, .5, 0}, {0, 0, .5}, {0, .5, .5}, {.5, 0, .5}};
    for (size_t i = 0; i < 10; i++)
        for (int k = 0; k < 3; k++)
            near(mesh.points[i][k], 1e-3 * AT[i][k], 1e-10);
    solid_mesh_free(&mesh);
    /* GRDSET fills blank fields alone: 0 is the basic system */
    snprintf(grids, sizeof grids, "%s%s", FRAMES, GRIDS);
    read_deck(file_with(deck(grids, TET), "GRID,1,,0.,0.,0.\n", "GRDSET,,11,,,,,123\nGRID,1,0\n"),
              &mesh);
    near(mesh.points[0][2], 0.0, 1e-15);
    near(mesh.points[1][1], 1e-3, 1e-15);
    near(mesh.points[1][2], 10e-3, 1e-15);
    assert_int_equal(mesh.set_count, 1);
    assert_string_equal(mesh.set[0].name, "GRID PS");
    assert_int_equal(mesh.set[0].count, 10);
    assert_string_equal(mesh.remarks[0], "GRID PS is not held here: --fixed 'GRID PS' holds it");
    solid_mesh_free(&mesh);
    /* and what leads nowhere */
    snprintf(grids, sizeof grids, "%s%s%s", FRAMES, GRIDS, "GRID,77,12\nGRID,78,15\n");
    file_refused(".bdf", file_with(deck(GRIDS, TET), "GRID,2,,", "GRID,2,5,"),
                 ".bdf:6: GRID 2: coordinate system 5: must be one of the file's");
    file_refused(".bdf", file_with(deck(grids, TET), "CORD2R,11,,", "CORD2R,11,12,"),
                 ": stands in itself, or in more than");
    file_refused(".bdf", file_with(deck(grids, TET), "CORD1R,15,1,4,2,", "CORD1R,15,1,4,8,"),
                 ".bdf:13: CORD1R 15: its three points must not lie on a line");
    file_refused(".bdf", file_with(deck(grids, TET), "CORD1R,15,1,", "CORD1R,15,99,"),
                 "CORD1R 15: GRID 99: must be one of the file's");
    file_refused(".bdf", file_with(deck(grids, TET), "CORD2S,14", "CORD2S,13"),
                 "coordinate system 13: is there twice");
}

static const char MATERIAL[] = "PSOLID,3,5\nMAT1,5,210.+3,,.3,7.8-9\n";

static struct material material_of(const char *cards)
{
    struct solid_mesh mesh;
    char rest[1024];
    snprintf(rest, sizeof rest, "%s%s", TET, cards);
    read_deck(deck(GRIDS, rest), &mesh);
    assert_int_equal(mesh.part_count, 1);
    assert_string_equal(mesh.part[0].name, "PSOLID 3");
    assert_true(mesh.part[0].has_material);
    struct material material = mesh.part[0].material;
    solid_mesh_free(&mesh);
    near_relative(material.young, 210e9, 1e-12);
    near_relative(material.poisson, 0.3, 1e-12);
    near_relative(material.density, 7800.0, 1e-12);
    return material;
}

static void takes_the_material(void **state)
{
    (void)state;
    char wrong[1024];
    struct solid_mesh refused;
    assert_string_equal(material_of(MATERIAL).name, "MAT1 5");
    /* two of three; a weight with its factor; 210/2.6 as a data sheet rounds it */
    material_of("PSOLID,3,5\nMAT1,5,210.+3,80769.230769230769,,7.8-9\n");
    material_of("PSOLID,3,5\nMAT1*,5,,80769.230769230769,.3,*\n*,7.8-9\n");
    material_of("PSOLID,3,5\nMAT1,5,210.+3,80800.,.3,7.8-9\n");
    material_of("PARAM,WTMASS,1.-4\nPSOLID,3,5\nMAT1,5,210.+3,,.3,7.8-5\n");
    material_of("param,wtmass,1.-4\npsolid,3,5,,,,,smech\nmat1,5,210.+3,,.3,7.8-5\n");
    /* cards that are there again as they were */
    material_of("PSOLID,3,5\nMAT1,5,210.+3,,.3,7.8-9\nMAT1,5,2.1+5,,.30,7.8-9\nPSOLID,3,5\n");
    snprintf(wrong, sizeof wrong, "%s%s", TET, MATERIAL);
    deck(GRIDS, wrong);
    file_refused(".bdf", file_with(text, "210.+3,,.3", "210.+3,,"),
                 ".bdf:18: MAT1: 5: two of E, G and NU must be there");
    file_refused(".bdf", file_with(text, "210.+3,,.3", "210.+3,75.+3,.3"),
                 "MAT1: 5: E 210000, G 75000, NU 0.3: G must be E/2(1 + NU) = 80769.2, or blank");
    file_refused(".bdf", file_with(text, "7.8-9", "7800."),
                 ".bdf:18: MAT1 5: RHO: 7800 is 7.8e+15 kg/m^3 in units of N, s and");
    file_refused(".bdf", file_with(text, "PSOLID,3,5", "PSOLID,3,5,,,,,PFLUID"),
                 "PSOLID: 3: FCTN PFLUID: must be a structure's, SMECH");
    file_refused(".bdf", file_with(text, "MAT1,5", "MAT1,5,70.+3,,.33,2.7-9\nMAT1,5"),
                 ".bdf:19: MAT1 5: differs from that of ");
    assert_non_null(strstr(file_fault.text, ".bdf:18: each must have a number of its own"));
    file_refused(".bdf", file_with(text, "MAT1,5", "PSOLID,3,6\nMAT1,5"),
                 ".bdf:18: PSOLID 3: differs from that of ");
    /* a modulus in pascals beside a density in t/mm^3: each would do alone, in m and in mm */
    assert_int_equal(
        file_read(".bdf", file_with(text, "210.+3,,.3,7.8-9", "2.1+11,,.3,7.8"), 1.0, &refused),
        PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(file_fault.text, "waves of 164083 m/s: must be at most 20000"));
    /* without a density it is the caller's to state */
    struct solid_mesh mesh;
    read_deck(file_with(text, "7.8-9", ""), &mesh);
    assert_false(mesh.part[0].has_material);
    assert_string_equal(mesh.part[0].lacks, "MAT1 5 has no RHO");
    solid_mesh_free(&mesh);
    /* and slow waves are told, as those of steel in GPa are: 164 m/s */
    read_deck(file_with(text, "210.+3", "210."), &mesh);
    assert_int_equal(mesh.remark_count, 1);
    assert_non_null(strstr(mesh.remarks[0], "waves of 164 m/s, as in rubber and foam"));
    solid_mesh_free(&mesh);
    read_deck(file_with(text, "7.8-9", "7.8-9"), &mesh);
    assert_int_equal(mesh.remark_count, 0);
    solid_mesh_free(&mesh);
    /* masses of the whole deck have their factor above BEGIN BULK, too, beside indented lines */
    read_deck(file_with(text, "TITLE =", "  PARAM,WTMASS,1.5\n        LABEL = A\nTITLE ="), &mesh);
    near_relative(mesh.part[0].material.density, 1.5 * 7800.0, 1e-12);
    solid_mesh_free(&mesh);
    /* inches: their decks are in pounds, most of them */
    assert_int_equal(file_read(".bdf", file_with(text, "7.8-9", "2.59-4"), 0.0254, &mesh), 0);
    assert_non_null(strstr(mesh.remarks[0], "is read in newtons: E 3.255e+08 Pa"));
    solid_mesh_free(&mesh);
}

static const struct mesh_set *set_named(const struct solid_mesh *mesh, const char *name)
{
    for (size_t i = 0; i < mesh->set_count; i++)
        if (strcmp(mesh->set[i].name, name) == 0)
            return &mesh->set[i];
    return NULL;
}

static void names_what_holds(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    char rest[1024];
    snprintf(rest, sizeof rest, "%s%s", TET,
             "SPC1,1,123456,1,2,3,5,THRU,7\n"
             "SPC,2,4,123,0.,8,12,0.\nSPC,2,,,,8,3,0.\nSPCADD,9,1,2\n"
             "SPC1,4,3,1,2\nRBE2,20,99,123456,1,2,3,6.5-6\n"
             "CTRIA6,30,8,1,2,3,5,6,7\nCONM2,40,1,,5.\n");
    read_deck(deck(GRIDS, rest), &mesh);
    assert_int_equal(set_named(&mesh, "SPC 1")->count, 6);
    assert_int_equal(set_named(&mesh, "SPC 2")->count, 2);
    assert_int_equal(set_named(&mesh, "SPC 9")->count, 8);
    assert_int_equal(set_named(&mesh, "RBE2 20")->count, 3);
    assert_int_equal(set_named(&mesh, "PSHELL 8")->count, 6);
    /* one direction alone is not what --fixed holds */
    assert_null(set_named(&mesh, "SPC 4"));
    assert_int_equal(mesh.remark_count, 6);
    assert_string_equal(mesh.remarks[0], "SPC 1 is not held here: --fixed 'SPC 1' holds it");
    assert_string_equal(mesh.remarks[2],
                        "SPC 4 holds node 1 in some directions alone, which --fixed "
                        "cannot: this set is not taken");
    assert_string_equal(mesh.remarks[4],
                        "cards that are not read, and no part of the body: RBE2 (line 22)");
    assert_non_null(strstr(mesh.remarks[5], "masses on nodes (1, of 5"));
    assert_int_equal(mesh.mass_count, 1);
    assert_int_equal(mesh.labels[mesh.masses[0].node], 1);
    solid_mesh_free(&mesh);
}

/* corners alone, and with one mid node of its own off the middle */
static void raises_what_is_asked_for(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    struct bulk bulk;
    static const char *const TETS[] = {"CTETRA,7,3,1,2,3,4\nSPC1,1,123,1,2,3\n",
                                       "CTETRA,7,3,1,2,3,4,,6\nSPC1,1,123,1,2,3\n"};
    file_refused(
        ".bdf", deck(GRIDS, TETS[0]),
        ".bdf:15: CTETRA: 7: has 4 nodes: must be of second order, 10 nodes, as linear ones "
        "are too stiff (first frequency 4 to 15 % high): mesh with mid-side nodes (Tet10)");
    file_refused(".bdf", deck(GRIDS, TETS[1]), "CTETRA: 7: has 1 of 6 mid nodes: must have all");
    for (size_t i = 0; i < COUNT(TETS); i++) {
        const char *written = deck(GRIDS, TETS[i]);
        file_write(".bdf", written, strlen(written));
        struct mesh_options options = {.unit = 1.0, .raise = true};
        assert_int_equal(mesh_read(file_path, &options, &mesh, &file_fault), PERCUSS_OK);
        unlink(file_path);
        bulk_of(&mesh, &bulk);
        near_relative(bulk.volume, 1.0 / 6.0, 1e-12);
        near(bulk.smallest_det, 1.0, 1e-12);
        /* the face that is held has its mid nodes, but for the one of the file that is not named */
        assert_int_equal(mesh.set[0].count, i == 0 ? 6 : 5);
        assert_non_null(strstr(mesh.remarks[1], "linear elements were raised to second order"));
        solid_mesh_free(&mesh);
    }
}

static void reads_included_files(void **state)
{
    (void)state;
    struct solid_mesh mesh;
    char name[96], main_deck[256];
    struct sha256 hash;
    char before[SHA256_TEXT], after[SHA256_TEXT];
    struct fault fault;
    snprintf(name, sizeof name, "/tmp/percuss-grids-%d.inc", (int)getpid());
    snprintf(main_deck, sizeof main_deck,
             "CEND\nBEGIN BULK\nINCLUDE '/tmp/\npercuss-grids-%d.inc'\n%s", (int)getpid(), TET);
    for (int i = 0; i < 2; i++) {
        FILE *stream = fopen(name, "w");
        assert_non_null(stream);
        fputs(i == 0 ? GRIDS : file_with(GRIDS, "1.,0.,0.", "1.5,0.,0."), stream);
        assert_int_equal(fclose(stream), 0);
        file_write(".bdf", main_deck, strlen(main_deck));
        hash = sha256_begin();
        assert_int_equal(mesh_digest(file_path, &hash, &fault), PERCUSS_OK);
        sha256_end(&hash, i == 0 ? before : after);
    }
    assert_string_not_equal(before, after);
    read_deck(main_deck, &mesh);
    assert_int_equal(mesh.node_count, 10);
    solid_mesh_free(&mesh);
    /* faults have the included file's name; one that includes itself ends */
    FILE *stream = fopen(name, "w");
    fprintf(stream, "GRID,1,,x\n");
    fclose(stream);
    file_refused(".bdf", main_deck, ".inc:1: GRID: field 4: x: must be a number");
    stream = fopen(name, "w");
    fprintf(stream, "include %s\n", name);
    fclose(stream);
    file_refused(".bdf", main_deck, ".inc:1: INCLUDE: must not be more than 8 deep");
    /* above BEGIN BULK its statements are no cards */
    stream = fopen(name, "w");
    fprintf(stream, "COMPILE SEMODES, NOLIST, NOREF, WHATEVER, MORE, AND, STILL, MORE, OF, IT\n");
    fclose(stream);
    snprintf(main_deck, sizeof main_deck, "INCLUDE '%s'\nBEGIN BULK\nGRID,1,,x\n", name);
    file_refused(".bdf", main_deck, ".bdf:3: GRID: field 4: x: must be a number");
    /* a head has control and BEGIN BULK, for a file alone or one that has control too */
    stream = fopen(name, "w");
    fprintf(stream, "SOL 103\nCEND\nPARAM,WTMASS,2.\nBEGIN BULK\n%s%s", MATERIAL, GRIDS);
    fclose(stream);
    for (int i = 0; i < 2; i++) {
        snprintf(main_deck, sizeof main_deck, "%sINCLUDE '%s'\n%s",
                 i ? "SOL 103\nCEND\nSPC = 3\n" : "", name, TET);
        read_deck(main_deck, &mesh);
        near_relative(mesh.part[0].material.density, 15600.0, 1e-12);
        assert_int_equal(mesh.remark_count, 0);
        solid_mesh_free(&mesh);
    }
    file_refused(".bdf", "SOL 103\nCEND\nSPC = 3\n",
                 ": no cards of bulk data: must have BEGIN BULK");
    snprintf(main_deck, sizeof main_deck, "BEGIN BULK\nINCLUDE '%s'\n", name);
    unlink(name);
    file_refused(".bdf", main_deck, ".bdf:2: INCLUDE: ");
    file_refused(".bdf", main_deck, ".inc: No such file");
}

static void refuses_with_the_line(void **state)
{
    (void)state;
    file_refused(".bdf", deck(GRIDS, "CTETRA,7,3,1,2,3,4,5,6,+A\n+B,7,8,9,10\n"),
                 ".bdf:16: the continuation +B must follow the line that ends with this mark");
    file_refused(".bdf", deck("+,1\n", TET), ".bdf:5: a continuation: must follow the line");
    file_refused(".bdf", deck(GRIDS, "CTETRA,7,3,1,2,3,4,5,6,7,8,9,10\n"),
                 ".bdf:15: 7,8,9,10: a line has 8 fields behind its name");
    file_refused(".bdf", deck(GRIDS, "CTETRA,7,3,1,2,3,4,5,6\n,7,8,9,10,11\n"),
                 "CTETRA: 7: has more than 10 nodes (11)");
    file_refused(".bdf", deck(GRIDS, "CPENTA,7,3,1,2,3,4,5,6\n"),
                 ".bdf:15: CPENTA: 7: has 6 nodes: must be of second order, 15 nodes");
    file_refused(".bdf", deck(GRIDS, "CPYRAM,7,3,1,2,3,4,5\n"), ".bdf:15: CPYRAM: is not read");
    file_refused(".bdf", deck(GRIDS, "=,*(1),==\n"), "=: is not read");
    file_refused(".bdf", deck(GRIDS, "BEGIN SUPER=2\n"), ".bdf:15: BEGIN: is not read");
    file_refused(".bdf", deck(GRIDS, "CQUAD4,7,3,1,2,3,4\n"),
                 ": has 1 shells (CQUAD4, CTRIA3, ...) and no solid: mesh the volume with");
    file_refused(".bdf", deck(GRIDS, "SPC1,1,129,1\n"), "SPC1: field 3: 129: must be directions");
    file_refused(".bdf", deck(GRIDS, "SPC1,1,123,9,THRU,2\n"),
                 "SPC1: 9 THRU 2: must be two numbers");
    file_refused(".bdf", deck(GRIDS, "CTETRA,7,3,1,2,3,4,5,6\n,7,8,9,11\n"),
                 ": element 7: node 11: must be one of the file's nodes");
    file_refused(".bdf", deck(GRIDS, "CBAR,7,3,1,2\n"),
                 ": no solid elements: must have CTETRA of 10, CPENTA of 15 or CHEXA of 20 nodes; "
                 "cards that are "
                 "not read: CBAR (line 15)");
    deck(GRIDS, TET);
    file_refused(".bdf", file_with(text, "GRID,3", "GRID,2,,1.,0.,.1\nGRID,3"),
                 ":7: GRID 2: is at 1, 0, 0.1 and by ");
    file_refused(".bdf", file_with(text, "ENDDATA", "CTETRA,7,3,1,2,3,4,5,6\n,7,8,9,10\nENDDATA"),
                 ".bdf:17: element 7: is also at ");
    file_survives(".bdf", text, strlen(text), 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_every_form_of_a_card),
        cmocka_unit_test(reads_every_form_of_a_number),
        cmocka_unit_test(places_nodes_in_their_systems),
        cmocka_unit_test(takes_the_material),
        cmocka_unit_test(names_what_holds),
        cmocka_unit_test(raises_what_is_asked_for),
        cmocka_unit_test(reads_included_files),
        cmocka_unit_test(refuses_with_the_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
