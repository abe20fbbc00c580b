/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* mesh/body_file, mesh/sites_file: a body as it was written, and files that are none; sites that
 * are added to it. */
#include "mesh/body_file.h"

#include <hdf5.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bodies/made_mesh.h"
#include "check.h"
#include "mesh/sites_file.h"
#include "model/facet.h"
#include "model/mesh_surface.h"
#include "model/vector.h"

static struct body make_rod(void)
{
    struct body rod = {.id = "rod",
                       .kind = &rod_kind,
                       .radius = 0.01,
                       .length = 0.3,
                       .tip_radius = INFINITY,
                       .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0}};
    struct fault fault;
    assert_int_equal(body_complete(&rod, &fault), PERCUSS_OK);
    return rod;
}

static struct mesh_body *make_body(void)
{
    struct body rod = make_rod();
    struct mesh_body *body = made_mesh_bar(
        &(struct made_mesh){.bar = &rod, .modes = 12, .removed = 4, .around = 8, .along = 6});
    assert_non_null(body);
    return body;
}

static void name_file(char path[64])
{
    snprintf(path, 64, "/tmp/test_body_file_%d.h5", (int)getpid());
}

static struct mesh_body *read_back(const char *path)
{
    struct mesh_body *body;
    struct fault fault = {""};
    if (body_file_read(path, &body, &fault))
        fail_msg("%s", fault.text);
    return body;
}

/* Every array of it, bit for bit. */
static void expect_same(const struct mesh_body *a, const struct mesh_body *b)
{
    size_t shapes = a->node_count * 3 * a->mode_count;
    assert_string_equal(a->hash, b->hash);
    assert_string_equal(a->source, b->source);
    assert_true(a->mass == b->mass && a->unit == b->unit && a->volume == b->volume);
    assert_true(a->removed == b->removed && a->supported == b->supported);
    assert_memory_equal(a->inertia, b->inertia, sizeof a->inertia);
    assert_int_equal(a->mode_count, b->mode_count);
    assert_int_equal(a->node_count, b->node_count);
    assert_int_equal(a->face_count, b->face_count);
    assert_int_equal(a->material_count, b->material_count);
    assert_int_equal(a->site_count, b->site_count);
    assert_int_equal(a->all_ways, b->all_ways);
    assert_memory_equal(a->omega, b->omega, a->mode_count * sizeof *a->omega);
    assert_memory_equal(a->points, b->points, a->node_count * sizeof *a->points);
    assert_memory_equal(a->shapes, b->shapes, shapes * sizeof *a->shapes);
    for (size_t f = 0; f < a->face_count; f++) {
        const struct mesh_body_face *x = &a->faces[f], *y = &b->faces[f];
        assert_true(x->count == y->count && x->patch == y->patch && x->material == y->material);
        assert_memory_equal(x->nodes, y->nodes, sizeof x->nodes);
        assert_memory_equal(x->normal, y->normal, sizeof x->normal);
        assert_memory_equal(x->curvature, y->curvature, sizeof x->curvature);
        assert_memory_equal(x->flexibility, y->flexibility, sizeof x->flexibility);
        if (a->all_ways)
            assert_memory_equal(x->tensor, y->tensor, sizeof x->tensor);
    }
    assert_string_equal(a->materials[0].name, b->materials[0].name);
    assert_true(a->materials[0].yield == b->materials[0].yield);
}

/* Tensors that go with the flexibilities. */
static void add_tensors(struct mesh_body *body)
{
    body->all_ways = true;
    for (size_t f = 0; f < body->face_count; f++)
        for (int i = 0; i < body->faces[f].count; i++) {
            struct mesh_body_face *face = &body->faces[f];
            const double n[3] = {face->normal[i][0], face->normal[i][1], face->normal[i][2]};
            double tensor[6] = {1e-9, -2e-10, 3e-10, 1e-10 * (double)i, 2e-10, -1e-10};
            mesh_body_set_normal(n, face->flexibility[i], tensor);
            for (int k = 0; k < 6; k++)
                face->tensor[i][k] = (float)tensor[k];
        }
}

static void comes_back_as_written(void **state)
{
    (void)state;
    struct mesh_body *body = make_body(), *other;
    struct fault fault = {""};
    char path[64];
    name_file(path);
    /* with an unknown flexibility, and sites */
    body->faces[3].flexibility[2] = NAN;
    body->site_count = 2;
    body->site_face = calloc(2, sizeof *body->site_face);
    body->site_point = calloc(2, sizeof *body->site_point);
    body->site_normal = calloc(2, sizeof *body->site_normal);
    body->between = calloc(4, sizeof *body->between);
    body->site_point[1][2] = 0.5;
    body->between[2] = 3e-9f;
    assert_int_equal(body_file_write(path, body, &fault), PERCUSS_OK);
    other = read_back(path);
    expect_same(body, other);
    assert_memory_equal(body->site_point, other->site_point, 2 * sizeof *body->site_point);
    assert_memory_equal(body->between, other->between, 4 * sizeof *body->between);
    mesh_body_free(other);
    /* and without sites, in its place, but with tensors, one of which is not known either */
    body->site_count = 0;
    add_tensors(body);
    assert_true(isnan(body->faces[3].tensor[2][0]));
    assert_int_equal(body_file_write(path, body, &fault), PERCUSS_OK);
    other = read_back(path);
    expect_same(body, other);
    assert_true(other->site_count == 0 && !other->between);
    mesh_body_free(other);
    mesh_body_free(body);
    remove(path);
}

static void expect_refused(const char *path, const char *words)
{
    struct mesh_body *body;
    struct fault fault = {""};
    assert_int_equal(body_file_read(path, &body, &fault), PERCUSS_BAD_REQUEST);
    assert_null(body);
    if (!strstr(fault.text, words) || !strstr(fault.text, path))
        fail_msg("'%s' does not say '%s'", fault.text, words);
}

/* Writes the body with one thing wrong. */
static void write_wrong(const char *path, const struct mesh_body *body)
{
    struct fault fault;
    assert_int_equal(body_file_write(path, body, &fault), PERCUSS_OK);
}

static void refuses_wrong_numbers(void **state)
{
    (void)state;
    struct mesh_body *body = make_body();
    char path[64];
    name_file(path);
    /* one after the other, each put right again */
    float shape = body->shapes[100];
    body->shapes[100] = NAN;
    write_wrong(path, body);
    expect_refused(path, "surface/shapes: number 101");
    body->shapes[100] = shape;
    body->mass = -1.0;
    write_wrong(path, body);
    expect_refused(path, "mass: number 1 is none that is allowed: must be finite and > 0");
    body->mass = 1.0;
    body->faces[5].nodes[3] = 4000000000u;
    write_wrong(path, body);
    expect_refused(path, "faces/nodes: 4000000000 at face 5");
    body->faces[5].nodes[3] = 0;
    body->faces[2].count = 7;
    write_wrong(path, body);
    expect_refused(path, "faces/count: 7 at face 2: must be 6, 8 or 9");
    body->faces[2].count = 9;
    body->faces[2].normal[0][1] += 0.1f;
    write_wrong(path, body);
    expect_refused(path, "faces/normal");
    body->faces[2].normal[0][1] -= 0.1f;
    body->omega[5] = 2.0 * body->omega[6];
    write_wrong(path, body);
    expect_refused(path, "modes/omega: number 7 is below");
    body->omega[5] = body->omega[6];
    body->inertia[1] = 1.0;
    write_wrong(path, body);
    expect_refused(path, "inertia: must be symmetric");
    body->inertia[1] = 0.0;
    add_tensors(body);
    body->faces[4].tensor[6][0] += 1e-9f;
    body->faces[4].tensor[6][1] += 1e-9f;
    body->faces[4].tensor[6][2] += 1e-9f;
    write_wrong(path, body);
    expect_refused(path, "faces/tensor: at node 6 of face 4: along the normal it must be");
    add_tensors(body);
    body->faces[4].tensor[6][3] = INFINITY;
    write_wrong(path, body);
    expect_refused(path, "faces/tensor: number ");
    /* stiffer in itself than a contact is compliant */
    add_tensors(body);
    body->cut = 1.0;
    write_wrong(path, body);
    expect_refused(path, "it must be positive definite");
    body->all_ways = false;
    body->materials[0].poisson = 0.7;
    write_wrong(path, body);
    expect_refused(path, "materials[0].poisson");
    mesh_body_free(body);
    remove(path);
}

static void refuses_files_that_are_none(void **state)
{
    (void)state;
    char path[64];
    name_file(path);
    remove(path);
    expect_refused(path, "cannot be opened: No such file");
    FILE *file = fopen(path, "w");
    fputs("$MeshFormat\n4.1 0 8\n", file);
    fclose(file);
    expect_refused(path, "cannot be opened");
    /* another program's */
    hid_t id = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(id);
    expect_refused(path, "is no body file");
    /* cut short, dataset after dataset taken away, and one of another length */
    struct mesh_body *body = make_body();
    write_wrong(path, body);
    assert_int_equal(truncate(path, 30000), 0);
    expect_refused(path, "");
    const char *names[] = {"mass", "inertia", "modes/omega", "surface/shapes", "faces/doubt"};
    for (size_t i = 0; i < COUNT(names); i++) {
        write_wrong(path, body);
        id = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
        H5Ldelete(id, names[i], H5P_DEFAULT);
        if (i == 1) {
            const hsize_t eight = 8;
            hid_t space = H5Screate_simple(1, &eight, NULL);
            H5Dclose(H5Dcreate2(id, names[i], H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT,
                                H5P_DEFAULT));
            H5Sclose(space);
        }
        H5Fclose(id);
        char words[64];
        snprintf(words, sizeof words, i == 1 ? "%s: is 8 long" : "%s: is missing", names[i]);
        expect_refused(path, words);
    }
    mesh_body_free(body);
    remove(path);
}

/* A damaged extent: reading what was never written would fill 1.6 GB with zeros. */
static void refuses_more_than_it_can_hold(void **state)
{
    (void)state;
    struct mesh_body *body = make_body();
    const hsize_t many = 99999999, piece = 1000;
    char path[64];
    name_file(path);
    write_wrong(path, body);
    hid_t id = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    hid_t space = H5Screate_simple(1, &many, NULL), pieces = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(pieces, 1, &piece);
    H5Ldelete(id, "modes/omega", H5P_DEFAULT);
    H5Dclose(
        H5Dcreate2(id, "modes/omega", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, pieces, H5P_DEFAULT));
    H5Pclose(pieces);
    H5Sclose(space);
    H5Fclose(id);
    expect_refused(path, "modes/omega: claims more than the file holds");
    mesh_body_free(body);
    remove(path);
}

/* No byte of a file may do worse than make a message. */
static void bears_any_damage(void **state)
{
    (void)state;
    struct mesh_body *body = make_body();
    char path[64];
    name_file(path);
    write_wrong(path, body);
    mesh_body_free(body);
    for (unsigned i = 0; i < 400; i++) {
        FILE *file = fopen(path, "r+b");
        fseek(file, 0, SEEK_END);
        long at = (long)((i * 2654435761u) % (unsigned long)ftell(file));
        fseek(file, at, SEEK_SET);
        int octet = fgetc(file);
        fseek(file, at, SEEK_SET);
        fputc(octet ^ (1 << i % 8), file);
        fclose(file);
        struct fault fault = {""};
        if (!body_file_read(path, &body, &fault)) {
            assert_true(mesh_surface_prepare(body));
            mesh_body_free(body);
        }
        file = fopen(path, "r+b");
        fseek(file, at, SEEK_SET);
        fputc(octet, file);
        fclose(file);
    }
    remove(path);
}

static void says_where_it_cannot_write(void **state)
{
    (void)state;
    struct mesh_body *body = make_body();
    struct fault fault = {""};
    assert_int_equal(body_file_write("/nowhere/body.h5", body, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "/nowhere/body.h5: cannot be created: /nowhere/: "));
    mesh_body_free(body);
}

/* A link at either of its names leads to no other file. */
static void follows_no_link(void **state)
{
    (void)state;
    char path[64], part[72], victim[72], text[16] = "";
    struct mesh_body *body = make_body(), *read;
    struct fault fault = {""};
    name_file(path);
    snprintf(part, sizeof part, "%s.part", path);
    snprintf(victim, sizeof victim, "%s.victim", path);
    FILE *file = fopen(victim, "w");
    fputs("precious", file);
    fclose(file);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(symlink(victim, i ? part : path), 0);
        assert_int_equal(body_file_write(path, body, &fault), PERCUSS_OK);
        file = fopen(victim, "r");
        assert_int_equal(fread(text, 1, sizeof text, file), 8);
        fclose(file);
        assert_memory_equal(text, "precious", 8);
        read = read_back(path);
        expect_same(body, read);
        mesh_body_free(read);
    }
    remove(path);
    remove(victim);
    mesh_body_free(body);
}

/* ---- sites that are added beside it ---- */

/* Writes a body whose sites are solved for later. */
static struct mesh_body *write_later(const char *path)
{
    struct mesh_body *body = make_body();
    struct fault fault = {""};
    char sites[80];
    snprintf(sites, sizeof sites, "%s.sites", path);
    remove(sites);
    body->origin.mesh = strdup("/somewhere/rod.inp");
    body->origin.options = strdup("unit=0.001\nfixed=foot\n");
    strcpy(body->origin.hash, "abc");
    for (size_t f = 0; f < body->face_count; f++)
        for (int i = 0; i < MESH_BODY_FACE_NODES; i++)
            body->faces[f].flexibility[i] = NAN;
    assert_int_equal(body_file_write(path, body, &fault), PERCUSS_OK);
    mesh_body_free(body);
    body = read_back(path);
    assert_true(mesh_surface_prepare(body));
    return body;
}

/* A site in the middle of a face, with numbers that need all digits. */
static struct mesh_body_site site_on(const struct mesh_body *body, unsigned face, double value)
{
    struct mesh_body_site site = {.face = face, .flexibility = value};
    const struct mesh_body_face *at = &body->faces[face];
    double shape[FACET_MOST_NODES];
    facet_shape(at->count, at->count == 6 ? 1.0 / 3.0 : 0.0, at->count == 6 ? 1.0 / 3.0 : 0.0,
                shape, NULL, NULL);
    for (int i = 0; i < at->count; i++)
        add_scaled3(shape[i], body->points[at->nodes[i]], site.point);
    for (int k = 0; k < 6; k++)
        site.tensor[k] = isnan(value) ? NAN : value / (3.0 + k);
    return site;
}

static void add_site(struct mesh_body *body, unsigned face, double value, size_t expected)
{
    struct fault fault = {""};
    struct mesh_body_site site = site_on(body, face, value);
    size_t added;
    if (sites_file_add(body, 1, &site, &added, &fault))
        fail_msg("%s", fault.text);
    assert_int_equal(added, expected);
}

static struct mesh_spot spot_on(const struct mesh_body *body, unsigned face)
{
    bool three = body->faces[face].count == 6;
    return mesh_surface_at(body, face, three ? 1.0 / 3.0 : 0.0, three ? 1.0 / 3.0 : 0.0);
}

static void remove_later(struct mesh_body *body, const char *path)
{
    char sites[80];
    snprintf(sites, sizeof sites, "%s.sites", path);
    remove(sites);
    remove(path);
    mesh_body_free(body);
}

static void sites_are_added_beside_it(void **state)
{
    (void)state;
    char path[64];
    name_file(path);
    struct mesh_body *body = write_later(path);
    assert_string_equal(body->origin.mesh, "/somewhere/rod.inp");
    assert_string_equal(body->origin.options, "unit=0.001\nfixed=foot\n");
    assert_string_equal(body->origin.hash, "abc");
    assert_true(spot_on(body, 5).unsolved);
    /* one of them is known not to be known; an earlier one stays */
    add_site(body, 5, 1e-9 / 3.0, 1);
    add_site(body, 9, NAN, 1);
    add_site(body, 5, 2e-9, 0);
    struct mesh_body *other = read_back(path);
    assert_true(mesh_surface_prepare(other));
    assert_int_equal(other->added_count, 2);
    assert_memory_equal(other->added, body->added, 2 * sizeof *body->added);
    struct mesh_spot spot = spot_on(other, 5);
    assert_true(!spot.unsolved && spot.flexibility == 1e-9 / 3.0);
    spot = spot_on(other, 9);
    assert_true(!spot.unsolved && isnan(spot.flexibility));
    assert_true(spot_on(other, 6).unsolved);
    /* what is not known there is known beside it */
    struct mesh_body_site beside = site_on(other, 9, 3e-9);
    struct fault fault = {""};
    size_t added;
    double asked[3] = {beside.point[0], beside.point[1], beside.point[2]};
    beside.point[0] += 0.03 * other->volume / other->area;
    assert_int_equal(sites_file_add(other, 1, &beside, &added, &fault), PERCUSS_OK);
    assert_int_equal(added, 1);
    assert_true(mesh_body_added_at(other, 9, beside.point)->flexibility == 3e-9);
    asked[0] += 0.06 * other->volume / other->area;
    assert_true(mesh_body_added_at(other, 9, asked)->flexibility == 3e-9);
    mesh_body_free(other);
    /* those of another body of that name count no more, nor where it takes out other modes, and go
     * with the next that is added */
    body->removed--;
    assert_int_equal(body_file_write(path, body, &fault), PERCUSS_OK);
    other = read_back(path);
    assert_int_equal(other->added_count, 0);
    mesh_body_free(other);
    body->removed++;
    strcpy(body->hash, "other");
    assert_int_equal(body_file_write(path, body, &fault), PERCUSS_OK);
    other = read_back(path);
    assert_int_equal(other->added_count, 0);
    assert_true(mesh_surface_prepare(other));
    add_site(other, 7, 1e-9, 1);
    assert_int_equal(other->added_count, 1);
    mesh_body_free(other);
    remove_later(body, path);
}

/* Two processes add at once, one of them is killed: all that was added stays, and whoever reads
 * meanwhile reads a whole file. */
static void processes_add_sites_at_once(void **state)
{
    (void)state;
    enum { EACH = 12, READ = 60 };
    char path[64];
    name_file(path);
    struct mesh_body *body = write_later(path);
    pid_t adds[2], killed;
    for (unsigned p = 0; p < 2; p++) {
        adds[p] = fork();
        if (adds[p] == 0) {
            for (unsigned i = 0; i < EACH; i++)
                add_site(body, 2 * i + p, 1e-9, 1);
            _exit(0);
        }
    }
    /* and one that adds for ever */
    killed = fork();
    if (killed == 0)
        for (unsigned face = 2 * EACH;; face = face + 1 < body->face_count ? face + 1 : 2 * EACH) {
            struct fault fault;
            struct mesh_body_site site = site_on(body, face, 1e-9);
            size_t added;
            sites_file_add(body, 1, &site, &added, &fault);
        }
    for (int i = 0; i < READ; i++)
        mesh_body_free(read_back(path));
    kill(killed, SIGKILL);
    int status;
    assert_int_equal(waitpid(killed, &status, 0), killed);
    for (int p = 0; p < 2; p++) {
        assert_int_equal(waitpid(adds[p], &status, 0), adds[p]);
        assert_int_equal(status, 0);
    }
    struct mesh_body *other = read_back(path);
    assert_true(mesh_surface_prepare(other));
    for (unsigned face = 0; face < 2 * EACH; face++)
        assert_false(spot_on(other, face).unsolved);
    mesh_body_free(other);
    remove_later(body, path);
}

static void damaged_sites_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *words;
    } cases[] = {
        {"percuss sites 2\n", ".sites:1: must be"},
        {"percuss sites 1\n", ".sites:2: must be"},
        {"", ".sites:3: must be \"end COUNT\""},
        {"site 5 0 0 0 1e-9 0 0 0 0 0 0\nend 2\n", ".sites:4: must be"},
        {"site 5 0 0 0 1e-9 0 0 0 0 0\nend 1\n", ".sites:3: must be"},
        {"site 99999 0 0 0 1e-9 0 0 0 0 0 0\nend 1\n", ".sites:3: must"},
        {"site 5 0 nan 0 1e-9 0 0 0 0 0 0\nend 1\n", ".sites:3: must"},
    };
    char path[64], sites[80];
    name_file(path);
    snprintf(sites, sizeof sites, "%s.sites", path);
    struct mesh_body *body = write_later(path), *other;
    struct fault fault = {""};
    size_t added;
    strcpy(body->hash, "made");
    assert_int_equal(body_file_write(path, body, &fault), PERCUSS_OK);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        FILE *file = fopen(sites, "w");
        assert_non_null(file);
        /* those after the body's line */
        if (cases[i].text[0] != 'p')
            fprintf(file, "percuss sites 1\nbody made %zu %.17g 1\n", body->removed, body->cut);
        fputs(cases[i].text, file);
        fclose(file);
        assert_int_equal(body_file_read(path, &other, &fault), PERCUSS_BAD_REQUEST);
        if (!strstr(fault.text, cases[i].words))
            fail_msg("case %zu: %s", i, fault.text);
    }
    /* where it cannot be written: a folder has its name */
    remove(sites);
    assert_int_equal(mkdir(sites, 0700), 0);
    struct mesh_body_site site = site_on(body, 5, 1e-9);
    assert_int_equal(sites_file_add(body, 1, &site, &added, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, ".sites: cannot be written: "));
    rmdir(sites);
    remove_later(body, path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(comes_back_as_written),
        cmocka_unit_test(refuses_wrong_numbers),
        cmocka_unit_test(refuses_files_that_are_none),
        cmocka_unit_test(bears_any_damage),
        cmocka_unit_test(says_where_it_cannot_write),
        cmocka_unit_test(follows_no_link),
        cmocka_unit_test(refuses_more_than_it_can_hold),
        cmocka_unit_test(sites_are_added_beside_it),
        cmocka_unit_test(processes_add_sites_at_once),
        cmocka_unit_test(damaged_sites_are_refused),
    };
    /* damaged files leave what the library complains of at its end */
    H5dont_atexit();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
