/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* catalogue/mesh_entry: bodies from files, with places that have names. */
#include "catalogue/mesh_entry.h"

#include "model/damping.h"
#include "unit/catalogue/parse.h"
#include "unit/catalogue/rod_file.h"

/* The catalogue with these lines of one body, as if it stood in the folder. */
static enum percuss_status parse(struct body_set **set, struct fault *fault, const char *lines)
{
    char text[2000], name[96];
    snprintf(name, sizeof name, "%s/catalogue.yaml", rod_folder);
    snprintf(text, sizeof text,
             "materials:\n"
             "  alloy: {young: 75e9, poisson: 0.33, density: 2800, yield: 300e6}\n"
             "  other: {young: 75e9, poisson: 0.30, density: 2800}\n"
             "  plastic: {young: 3e9, poisson: 0.33, density: 1140, loss_factor: 0.06}\n"
             "bodies:\n"
             "  part: %s\n",
             lines);
    return catalogue_parse(text, strlen(text), name, set, fault);
}

static struct body_set *good(const char *lines)
{
    struct body_set *set;
    struct fault fault = {""};
    if (parse(&set, &fault, lines))
        fail_msg("%s", fault.text);
    return set;
}

static void bad(const char *lines, const char *words)
{
    struct body_set *set;
    struct fault fault = {""};
    assert_int_equal(parse(&set, &fault, lines), PERCUSS_BAD_REQUEST);
    assert_null(set);
    if (!strstr(fault.text, words))
        fail_msg("'%s' does not say '%s'", fault.text, words);
}

static void a_file_is_a_body(void **state)
{
    (void)state;
    struct body_set *set = good("{shape: mesh, file: rod.h5, damping: 0.002}");
    const struct body *part = body_set_find(set, "part");
    assert_ptr_equal(part->kind, &mesh_kind);
    assert_int_equal(set->mesh_count, 1);
    assert_string_equal(part->material.name, "aluminium");
    near_relative(part->mass, 2700.0 * M_PI * 1e-4 * 0.3, 1e-14);
    assert_true(part->damping == 0.002 && part->scale == 1.0 && body_is_flexible(part));
    body_set_free(set);
    /* of another material and size, and rigid */
    set = good("{shape: mesh, file: rod.h5, material: alloy, scale: 2, rigid: true}");
    part = body_set_find(set, "part");
    near_relative(part->mass, 2800.0 * M_PI * 1e-4 * 0.3 * 8.0, 1e-14);
    assert_true(part->material.yield == 300e6 && !body_is_flexible(part));
    assert_string_equal(body_theory(part), "rigid");
    body_set_free(set);
    /* one file for several bodies is read once */
    set = good("{shape: mesh, file: rod.h5}\n  twin: {shape: mesh, file: rod.h5, modes: 4}");
    assert_int_equal(set->mesh_count, 1);
    assert_ptr_equal(body_set_find(set, "part")->mesh, body_set_find(set, "twin")->mesh);
    body_set_free(set);
}

/* One ratio of each mode, the last one's of all others. */
static void modes_have_damping_of_their_own(void **state)
{
    (void)state;
    static const double wanted[] = {0.01, 0.04, 0.002, 0.002};
    struct body_set *set = good("{shape: mesh, file: rod.h5, damping: [0.01, 0.04, 0.002]}");
    const struct body *part = body_set_find(set, "part");
    assert_true(part->damping == 0.04);
    for (size_t k = 0; k < 4; k++)
        near_relative(damping_of(part, k, 1.0), wanted[k], 2e-16); /* kept over the largest */
    struct body_description description = {.text = ""};
    part->kind->describe(part, &description);
    assert_non_null(strstr(description.text,
                           "ratios 0.002 to 0.04 of the lowest 3 modes, 0.002 of the others"));
    char revision[PERCUSS_ID_SIZE];
    memcpy(revision, set->revision, sizeof revision);
    body_set_free(set);
    set = good("{shape: mesh, file: rod.h5, damping: [0.01, 0.04, 0.003]}");
    assert_string_not_equal(set->revision, revision);
    body_set_free(set);
    set = good("{shape: mesh, file: rod.h5, damping: [0, 0]}");
    assert_true(damping_of(body_set_find(set, "part"), 0, 1.0) == 0.0);
    body_set_free(set);
    /* what is none */
    bad("{shape: mesh, file: rod.h5, damping: []}",
        "must be a ratio >= 0 and < 1, or a list of such, of the modes from the lowest up, the "
        "last one of all others");
    bad("{shape: mesh, file: rod.h5, damping: [0.1, 1]}",
        "bodies.part.damping[1]: 1: must be a ratio >= 0 and < 1");
    bad("{shape: mesh, file: rod.h5, damping: [0.1, no]}", "damping[1]: no: must be a ratio");
    bad("{shape: mesh, file: rod.h5, damping: [0, 0, 0, 0, 0, 0, 0, 0, 0.1]}",
        "damping: 9 ratios: must be at most 8, one of each mode in its file");
}

static void sites_stand_in_the_mesh_s_frame(void **state)
{
    (void)state;
    struct body_set *set =
        good("{shape: mesh, file: rod.h5, sites: {tip: {point: [300, 0, 0]}, side: {point: [150, "
             "0, 10], normal: [0, 0, 2], curvatures: [0, 100], directions: [1, 0, 0]}}}");
    const struct body *part = body_set_find(set, "part");
    const struct body_site *tip = body_find_site(part, "tip"), *side = body_find_site(part, "side");
    double point[3];
    assert_true(part->site_count == 2 && tip && side && !body_find_site(part, "none"));
    body_site_point(part, tip, point);
    near(point[0], 0.15, 1e-15);
    near(tip->normal[0], 1.0, 1e-6);
    body_site_point(part, side, point);
    near(point[2], 0.010, 1e-15);
    near(side->normal[2], 1.0, 0.0);
    /* 1/r about y, none along x */
    near(side->curvature[4], 100.0, 1e-12);
    near(side->curvature[0], 0.0, 1e-12);
    assert_string_equal(side->remark, "");
    body_set_free(set);
    /* what differs from the surface is remarked */
    set = good("{shape: mesh, file: rod.h5, sites: {side: {point: [150, 0, 10], normal: [0, 0.1, "
               "1]}}}");
    part = body_set_find(set, "part");
    assert_non_null(strstr(part->sites[0].remark, "5.7 degrees"));
    body_set_free(set);
    set = good("{shape: mesh, file: rod.h5, sites: {side: {point: [150, 0, 10], normal: [0, 0, 1], "
               "curvatures: [50, 50]}}}");
    part = body_set_find(set, "part");
    assert_non_null(strstr(part->sites[0].remark, "curvature"));
    body_set_free(set);
}

/* Half of half a thickness is 2.42 mm here, half an element of the side 12.5 mm. */
static void sites_beside_the_surface_are_moved(void **state)
{
    (void)state;
    struct body_set *set =
        good("{shape: mesh, file: rod.h5, scale: 2, sites: {near: {point: [150, 0, 10.4]}, out: "
             "{point: [150, 0, 12]}, in: {point: [150, -8.5, 0]}}}");
    const struct body *part = body_set_find(set, "part");
    const struct body_site *out = body_find_site(part, "out"), *in = body_find_site(part, "in");
    struct body_description description = {.text = ""};
    double point[3];
    /* as they are, or by how much, at the mesh's own size; faces of nine nodes lie within
     * (turn/2)^4/8 radii of the circle */
    const double off = 2e-6;
    assert_true(body_find_site(part, "near")->moved == 0.0);
    near(out->moved, 0.002, off);
    near(in->moved, 0.0015, off);
    body_site_point(part, out, point);
    near(point[2], 0.020, off);
    near(out->normal[2], 1.0, 1e-6);
    body_site_point(part, in, point);
    near(point[1], -0.020, off);
    part->kind->describe(part, &description);
    assert_non_null(strstr(description.text, "2 sites moved onto the surface by up to 0.004 m"));
    body_set_free(set);
}

static void revisions_follow_what_is_said(void **state)
{
    (void)state;
    const char *const texts[] = {
        "{shape: mesh, file: rod.h5}",
        "{shape: mesh, file: rod.h5, scale: 1.5}",
        "{shape: mesh, file: rod.h5, rigid: true}",
        "{shape: mesh, file: rod.h5, sites: {tip: {point: [300, 0, 0]}}}",
        "{shape: mesh, file: rod.h5, sites: {end: {point: [300, 0, 0]}}}",
    };
    char revisions[COUNT(texts)][PERCUSS_ID_SIZE];
    for (size_t i = 0; i < COUNT(texts); i++) {
        struct body_set *set = good(texts[i]);
        memcpy(revisions[i], set->revision, sizeof revisions[i]);
        body_set_free(set);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(revisions[i], revisions[j]);
    }
    struct body_set *set = good(texts[1]);
    assert_string_equal(set->revision, revisions[1]);
    body_set_free(set);
}

/* Files hold none: the catalogue states it, and the modes are damped by it. */
static void a_material_that_loses_energy(void **state)
{
    (void)state;
    static const struct {
        const char *lines;
        double loss_factor, damping;
    } cases[] = {
        {"{shape: mesh, file: rod.h5}", NAN, 0.0},
        {"{shape: mesh, file: rod.h5, material: alloy}", NAN, 0.0},
        {"{shape: mesh, file: rod.h5, material: plastic}", 0.06, 0.03},
        {"{shape: mesh, file: rod.h5, material: plastic, damping: 0.01}", 0.06, 0.01},
        {"{shape: mesh, file: rod.h5, material: plastic, damping: [0.02, 0.01]}", 0.06, 0.02},
        {"{shape: mesh, file: rod.h5, material: plastic, rigid: true}", 0.06, 0.0},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct body_set *set = good(cases[i].lines);
        const struct body *part = body_set_find(set, "part");
        assert_true(isnan(cases[i].loss_factor) ? isnan(part->loss_factor)
                                                : part->loss_factor == cases[i].loss_factor);
        near(part->damping, cases[i].damping, 1e-15);
        body_set_free(set);
    }
}

static void a_material_is_found_by_its_name(void **state)
{
    (void)state;
    struct material material;
    struct fault fault = {""};
    char path[96];
    snprintf(path, sizeof path, "%s/materials.yaml", rod_folder);
    FILE *file = fopen(path, "w");
    /* nothing but materials need be good */
    fputs("materials: {alloy: {young: 75e9, poisson: 0.33, density: 2800}}\nbodies: none\n", file);
    fclose(file);
    assert_int_equal(catalogue_material(path, "alloy", &material, &fault), PERCUSS_OK);
    assert_true(material.young == 75e9 && isinf(material.yield));
    assert_int_equal(catalogue_material(path, "other", &material, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "other: unknown material; must be one of alloy"));
    remove(path);
    assert_int_equal(catalogue_material(path, "alloy", &material, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "cannot be read"));
}

static void says_what_is_wrong(void **state)
{
    (void)state;
    bad("{shape: mesh}", "bodies.part.file: missing");
    bad("{shape: mesh, file: none.h5}", "none.h5: cannot be opened: No such file");
    bad("{shape: mesh, file: rod.h5, radius: 1}", "radius: unknown key; the keys of mesh are");
    bad("{shape: mesh, file: rod.h5, material: none}", "none: unknown material");
    bad("{shape: mesh, file: rod.h5, material: other}",
        "poisson: 0.3: must be 0.33, with which the mesh was reduced");
    bad("{shape: mesh, file: massive.h5, material: alloy}",
        "material: must be absent: the file has masses on nodes, 0.1 kg of 0.354469 kg, which no "
        "material scales");
    bad("{shape: mesh, file: rod.h5, scale: 0}", "scale: 0: must be a number > 0");
    bad("{shape: mesh, file: rod.h5, sites: {tip: {}}}", "sites.tip.point: missing");
    bad("{shape: mesh, file: rod.h5, sites: {tip: {point: [150, 0, 0]}}}",
        "bodies.part.sites.tip.point: lies");
    bad("{shape: mesh, file: rod.h5, sites: {tip: {point: [150, 0, 12.6]}}}",
        "lies 0.0026 m off the surface: at most 0.00242 m is allowed");
    /* beyond an edge */
    bad("{shape: mesh, file: rod.h5, sites: {tip: {point: [301, 0, 10]}}}",
        "lies 0.001 m off the surface: at most 0.000");
    bad("{shape: mesh, file: rod.h5, sites: {a: {point: [300, 0, 0], normal: [0, 0, 0]}}}",
        "normal: must not be zero");
    bad("{shape: mesh, file: rod.h5, sites: {a: {point: [300, 0, 0], curvatures: [1, 2]}}}",
        "curvatures: must stand beside normal");
    bad("{shape: mesh, file: rod.h5, sites: {a: {point: [300, 0, 0], normal: [1, 0, 0], curvatures:"
        " [1, 2]}}}",
        "directions: missing");
    bad("{shape: mesh, file: rod.h5, sites: {a: {point: [300, 0, 0], normal: [1, 0, 0], curvatures:"
        " [1, 2], directions: [1, 0, 0]}}}",
        "directions: must be one direction");
    bad("{shape: mesh, file: rod.msh, unit: mm}", "rod.msh: must be a body file");
    bad("{shape: mesh, file: rod.h5, unit: mm}", "unit: must be absent");
    bad("{shape: rod, file: rod.h5}", "file: unknown key");
    bad("{shape: sphere, radius: 1}", "bodies.part.material: missing");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_is_a_body),
        cmocka_unit_test(modes_have_damping_of_their_own),
        cmocka_unit_test(sites_stand_in_the_mesh_s_frame),
        cmocka_unit_test(sites_beside_the_surface_are_moved),
        cmocka_unit_test(revisions_follow_what_is_said),
        cmocka_unit_test(a_material_that_loses_energy),
        cmocka_unit_test(a_material_is_found_by_its_name),
        cmocka_unit_test(says_what_is_wrong),
    };
    return cmocka_run_group_tests(tests, rod_file_make, rod_file_remove);
}
