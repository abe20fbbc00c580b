/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Of mesh/mesh_read.c: parts that Gmsh meshes, in each format that goes through it, held against
 * their volumes, numbers of sides, normals and curvatures in closed form. Skipped without Gmsh. */
#include "mesh/mesh_check.h"
#include "model/vector.h"
#include "unit/mesh/files.h"

static const char HEAD[] = "SetFactory(\"OpenCASCADE\");\n";
static char folder[64], path[512];
static struct fault fault;

static int prepare(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "/tmp/percuss-gmsh-%d", (int)getpid());
    char command[128];
    snprintf(command, sizeof command, "mkdir -p %s", folder);
    return system(command);
}

static int clean(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static void need_gmsh(void)
{
    if (system("command -v gmsh >/dev/null") != 0)
        skip();
}

/* part.geo in the folder, and how gmsh turns it into another file */
static void write_part(const char *geometry)
{
    snprintf(path, sizeof path, "%s/part.geo", folder);
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fprintf(stream, "%s%s", HEAD, geometry);
    fclose(stream);
}

static void convert(const char *options, const char *suffix)
{
    char command[1024];
    snprintf(command, sizeof command, "timeout 60 gmsh %s %s -o %s/out%s >%s/said 2>&1", path,
             options, folder, suffix, folder);
    assert_int_equal(system(command), 0);
    snprintf(path, sizeof path, "%s/out%s", folder, suffix);
}

/* what comes of reading `path`: mesh, surface, findings */
struct body {
    struct solid_mesh mesh;
    struct surface surface;
    struct mesh_findings findings;
};

static void read_body(struct body *body, double unit, double size)
{
    fault.text[0] = '\0';
    struct mesh_options options = {.unit = unit, .size = size};
    if (mesh_read(path, &options, &body->mesh, &fault) != PERCUSS_OK ||
        surface_make(&body->mesh, &body->surface, &fault) != PERCUSS_OK ||
        surface_fit(&body->mesh, &body->surface, &fault) != PERCUSS_OK ||
        mesh_check(&body->mesh, &body->surface, &body->findings, &fault) != PERCUSS_OK)
        fail_msg("%s: %s", path, fault.text);
}

static void free_body(struct body *body)
{
    surface_free(&body->surface);
    solid_mesh_free(&body->mesh);
}

/* a part with its volume (mm^3) and its number of smooth sides; curved elements of a tenth of a
 * turn miss the volume by the fourth power of the angle: 1e-3 of the round parts, which are a part
 * of the whole */
static void meshes(const char *geometry, double volume, size_t sides)
{
    struct body body;
    write_part(geometry);
    read_body(&body, 0.001, 0.0);
    near_relative(body.findings.volume, 1e-9 * volume, 1e-3);
    assert_int_equal(body.surface.patch_count, sides);
    assert_int_equal(body.findings.remark_count, 0);
    free_body(&body);
}

static void meshes_parts(void **state)
{
    (void)state;
    need_gmsh();
    meshes("Box(1) = {0,0,0, 60,40,6};\n", 14400.0, 6);
    meshes("Box(1) = {0,0,0, 40,20,5};\nBox(2) = {0,0,0, 5,20,30};\n"
           "BooleanUnion(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};\n"
           "Cylinder(4) = {25,10,-1, 0,0,10, 4};\n"
           "BooleanDifference(5) = {Volume{3}; Delete;}{Volume{4}; Delete;};\n",
           4000.0 + 2500.0 - 80.0 * M_PI, 9);
    meshes("Cylinder(1) = {0,0,0, 0,0,8, 20};\nCylinder(2) = {0,0,0, 0,0,8, 14};\n"
           "BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};\n",
           8.0 * M_PI * (400.0 - 196.0), 4);
    meshes("Torus(1) = {0,0,0, 20,6};\n", 2.0 * M_PI * M_PI * 20.0 * 36.0, 1);
    meshes("Box(1) = {0,0,0, 30,30,20};\nCylinder(2) = {15,15,-1, 0,0,30, 6};\n"
           "BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};\n",
           18000.0 - 720.0 * M_PI, 7);
}

/* groups name; they do not choose what is a part of the body */
static void takes_all_solids(void **state)
{
    (void)state;
    need_gmsh();
    struct body body;
    write_part("Box(1) = {0,0,0, 30,20,10};\nPhysical Surface(\"foot\") = {-1};\n");
    read_body(&body, 0.001, 0.01);
    near_relative(body.findings.volume, 6e-6, 1e-9);
    assert_string_equal(body.mesh.set[0].name, "foot");
    free_body(&body);
    write_part("Box(1) = {0,0,0, 30,20,10};\nBox(2) = {30,0,0, 30,20,10};\n"
               "BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n"
               "Physical Volume(\"left\") = {1};\n");
    read_body(&body, 0.001, 0.01);
    near_relative(body.findings.volume, 12e-6, 1e-9);
    assert_string_equal(body.mesh.remarks[0],
                        "in no physical group, and part of the body: volume 2");
    free_body(&body);
}

/* client/examples/mesh: foot, wall and fillet less the holes; its fillet makes one patch of foot
 * and wall inside */
static void meshes_the_example(void **state)
{
    (void)state;
    need_gmsh();
    struct body body;
    snprintf(path, sizeof path, "%s/client/examples/mesh/bracket.geo", PERCUSS_SOURCE_DIR);
    read_body(&body, 0.001, 0.0);
    double fillet = (16.0 - 4.0 * M_PI) * 40.0, holes = 2.0 * 80.0 * M_PI;
    near_relative(body.findings.volume, 1e-9 * (12000.0 + 9000.0 + fillet - holes), 1e-4);
    assert_int_equal(body.surface.patch_count, 9);
    assert_int_equal(body.findings.remark_count, 0);
    assert_string_equal(body.mesh.part[0].name, "bracket");
    assert_int_equal(body.mesh.set_count, 1);
    assert_string_equal(body.mesh.set[0].name, "foot");
    for (size_t i = 0; i < body.mesh.set[0].count; i++)
        near(body.mesh.points[body.mesh.set[0].nodes[i]][2], 0.0, 1e-9);
    free_body(&body);
}

static const char CYLINDER[] = "Cylinder(1) = {0,0,0, 0,0,60, 10};\n";
static const double CYLINDER_VOLUME = 6000e-9 * M_PI;

static void check_cylinder(double unit, double size, double relative)
{
    struct body body;
    read_body(&body, unit, size);
    near_relative(body.findings.volume, CYLINDER_VOLUME, relative);
    assert_int_equal(body.surface.patch_count, 3);
    free_body(&body);
}

/* edges of 5 mm on a radius of 10: straight-sided ones miss (1 - sin a/a) of the volume, 4 % */
static void reads_every_format(void **state)
{
    (void)state;
    need_gmsh();
    static const char *const GEOMETRIES[] = {".step", ".brep"};
    static const char *const MESHES[] = {".unv", ".bdf", ".vtk", ".inp"};
    for (size_t i = 0; i < COUNT(GEOMETRIES); i++) {
        write_part(CYLINDER);
        convert("-0", GEOMETRIES[i]);
        check_cylinder(0.001, 0.006, 2e-3);
    }
    /* a STEP file knows its unit */
    write_part(CYLINDER);
    convert("-0", ".step");
    check_cylinder(1.0, 0.006, 2e-3);
    for (size_t i = 0; i < COUNT(MESHES); i++) {
        write_part(CYLINDER);
        convert("-3 -order 2 -clmax 6", MESHES[i]);
        check_cylinder(0.001, 0.0, 2e-3);
    }
    write_part(CYLINDER);
    convert("-3 -order 2 -clmax 6 -format msh22", ".msh");
    check_cylinder(0.001, 0.0, 2e-3);
    write_part(CYLINDER);
    convert("-3 -order 2 -clmax 6 -format msh41 -bin", ".msh");
    check_cylinder(0.001, 0.0, 2e-3);
    write_part(CYLINDER);
    convert("-2 -clmax 3", ".stl");
    check_cylinder(0.001, 0.004, 0.04);
}

/* 6 mm elements on 10 mm, more than 15 mm from the ends: .013 degrees were measured,
 * 1.9 % in curvature; near the ends all neighbours are on one side */
static void fits_the_side_of_a_cylinder(void **state)
{
    (void)state;
    need_gmsh();
    struct body body;
    double angle = 0.0, off = 0.0;
    size_t count = 0;
    write_part(CYLINDER);
    convert("-3 -order 2 -clmax 6", ".msh");
    read_body(&body, 0.001, 0.0);
    for (size_t f = 0; f < body.surface.face_count; f++)
        for (int i = 0; i < 6; i++) {
            const double *x = body.mesh.points[body.surface.faces[f].nodes[i]];
            const struct surface_point *point = &body.surface.points[f][i];
            double r = hypot(x[0], x[1]), normal[3] = {x[0] / r, x[1] / r, 0.0}, cross[3];
            if (fabs(r - 0.01) > 1e-8 || fabs(x[2] - 0.03) > 0.015)
                continue;
            cross3(normal, point->normal, cross);
            angle = fmax(angle, asin(norm3(cross)));
            for (int k = 0; k < 9; k++) {
                double t[3] = {-normal[1], normal[0], 0.0};
                off = fmax(off, fabs(0.01 * point->curvature[k] - t[k / 3] * t[k % 3]));
            }
            count++;
        }
    assert_true(count > 100);
    measured("normal, degrees", angle * 180.0 / M_PI, 0.0, 0.1);
    measured("curvature", off, 0.0, 0.03);
    free_body(&body);
}

static void says_why_not(void **state)
{
    (void)state;
    need_gmsh();
    struct solid_mesh mesh;
    struct mesh_options options = {.unit = 0.001};
    write_part("Box(1) = {0,0,0, 1,1};\n");
    assert_int_equal(mesh_read(path, &options, &mesh, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "gmsh could not make a mesh of it: Error"));

    /* no triangles: what it says of them, without the summary that it ends with */
    file_refused(".stl", "solid nothing\nendsolid nothing\n",
                 "gmsh could not make a mesh of it: Warning : No triangles");
    assert_null(strstr(file_fault.text, "-----"));

    /* linear elements of another program */
    write_part(CYLINDER);
    convert("-3 -clmax 6", ".bdf");
    assert_int_equal(mesh_read(path, &options, &mesh, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "has 4 nodes: must be of second order, 10 nodes"));

    /* two boxes side by side that share nothing */
    write_part("Box(1) = {0,0,0, 10,10,10};\nBox(2) = {20,0,0, 10,10,10};\n");
    struct surface surface;
    struct mesh_findings findings;
    assert_int_equal(mesh_read(path, &options, &mesh, &fault), PERCUSS_OK);
    assert_int_equal(mesh.part_count, 2);
    assert_int_equal(surface_make(&mesh, &surface, &fault), PERCUSS_OK);
    assert_int_equal(mesh_check(&mesh, &surface, &findings, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "2 pieces that do not hang together"));
    surface_free(&surface);
    solid_mesh_free(&mesh);

    /* without the program */
    char *old = strdup(getenv("PATH"));
    setenv("PATH", "/nowhere", 1);
    assert_int_equal(mesh_read(path, &options, &mesh, &fault), PERCUSS_BAD_REQUEST);
    setenv("PATH", old, 1);
    free(old);
    assert_non_null(strstr(fault.text, "there is no program gmsh: install it (Debian: gmsh)"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_parts),
        cmocka_unit_test(meshes_the_example),
        cmocka_unit_test(takes_all_solids),
        cmocka_unit_test(reads_every_format),
        cmocka_unit_test(fits_the_side_of_a_cylinder),
        cmocka_unit_test(says_why_not),
    };
    return cmocka_run_group_tests(tests, prepare, clean);
}
