/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The file of a reduced body. The input is a list of changes to the datasets of a good file: their
 * numbers, their extents, their types, or that they are not there; so all of it is HDF5, whose own
 * reading of damaged files is that library's matter. What is still read is a body that can be hit.
 */
#include "mesh/body_file.h"

#include <hdf5.h>
#include <math.h>
#include <unistd.h>

#include "bodies/made_mesh.h"
#include "fuzz.h"
#include "model/mesh_surface.h"

enum { MOST_RANK = 3, MOST_CHANGES = 24 };

struct set {
    const char *name;
    int rank;
};

/* The datasets of a body file; inputs count them in this order. */
static const struct set SETS[] = {{"unit", 0},
                                  {"centre", 1},
                                  {"volume", 0},
                                  {"mass", 0},
                                  {"inertia", 1},
                                  {"supported", 0},
                                  {"element_size", 0},
                                  {"cut", 0},
                                  {"near", 0},
                                  {"materials/name", 1},
                                  {"materials/young", 1},
                                  {"materials/poisson", 1},
                                  {"materials/density", 1},
                                  {"materials/yield", 1},
                                  {"materials/tangent", 1},
                                  {"modes/omega", 1},
                                  {"modes/removed", 0},
                                  {"surface/points", 2},
                                  {"surface/shapes", 3},
                                  {"faces/count", 1},
                                  {"faces/material", 1},
                                  {"faces/patch", 1},
                                  {"faces/nodes", 2},
                                  {"faces/normal", 3},
                                  {"faces/curvature", 3},
                                  {"faces/doubt", 2},
                                  {"faces/flexibility", 2},
                                  {"faces/flexibility_slope", 2},
                                  {"sites/face", 1},
                                  {"sites/point", 2},
                                  {"sites/normal", 2},
                                  {"sites/between", 2}};

/* The bytes of a good file. */
static struct {
    size_t size;
    uint8_t *bytes;
} good;

static herr_t count_set(hid_t file, const char *name, const H5L_info_t *link, void *count)
{
    (void)link;
    hid_t object = H5Oopen(file, name, H5P_DEFAULT);
    *(size_t *)count += H5Iget_type(object) == H5I_DATASET;
    H5Oclose(object);
    return 0;
}

/* The good file has each dataset of the list with its rank, and no other. */
static void check_sets(const char *path)
{
    size_t count = 0;
    hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    FUZZ_REQUIRE(H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, count_set, &count) >= 0, "%s", path);
    FUZZ_REQUIRE(count == sizeof SETS / sizeof *SETS, "%zu datasets", count);
    for (size_t i = 0; i < count; i++) {
        hid_t set = H5Dopen2(file, SETS[i].name, H5P_DEFAULT), space = H5Dget_space(set);
        FUZZ_REQUIRE(set >= 0 && H5Sget_simple_extent_ndims(space) == SETS[i].rank, "%s",
                     SETS[i].name);
        H5Sclose(space);
        H5Dclose(set);
    }
    H5Fclose(file);
}

static void add_sites(struct mesh_body *body)
{
    body->site_count = 2;
    body->site_face = calloc(2, sizeof *body->site_face);
    body->site_point = calloc(2, sizeof *body->site_point);
    body->site_normal = calloc(2, sizeof *body->site_normal);
    body->between = calloc(4, sizeof *body->between);
    body->site_normal[0][0] = body->site_normal[1][2] = 1.0;
    body->site_point[1][2] = 0.01;
    body->between[1] = body->between[2] = 3e-9f;
}

static void read_bytes(const char *path)
{
    FILE *file = fopen(path, "rb");
    FUZZ_REQUIRE(file && fseek(file, 0, SEEK_END) == 0, "%s", path);
    good.size = (size_t)ftell(file);
    rewind(file);
    good.bytes = malloc(good.size);
    FUZZ_REQUIRE(good.bytes && fread(good.bytes, 1, good.size, file) == good.size, "%s", path);
    fclose(file);
}

static void make_good(void)
{
    struct body rod = {.id = "rod",
                       .kind = &rod_kind,
                       .radius = 0.01,
                       .length = 0.3,
                       .tip_radius = INFINITY,
                       .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0}};
    struct fault fault = {""};
    char path[64] = "/tmp/fuzz-body-XXXXXX";
    FUZZ_REQUIRE(!body_complete(&rod, &fault), "%s", fault.text);
    struct mesh_body *body = made_mesh_bar(
        &(struct made_mesh){.bar = &rod, .modes = 2, .removed = 1, .around = 8, .along = 2});
    int descriptor = mkstemp(path);
    FUZZ_REQUIRE(body && descriptor >= 0, "no body to begin with");
    add_sites(body);
    FUZZ_REQUIRE(!body_file_write(path, body, &fault), "%s", fault.text);
    check_sets(path);
    read_bytes(path);
    remove(path);
    mesh_body_free(body);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

static const char *kept;

static void forget(void)
{
    remove(kept);
}

/* The good file again; HDF5 wants one that has a name. */
static const char *write_good(void)
{
    static char path[] = "/tmp/fuzz-body-XXXXXX";
    static int descriptor = -1;
    if (descriptor < 0) {
        descriptor = mkstemp(path);
        atexit(forget);
        kept = path;
    }
    bool whole = ftruncate(descriptor, 0) == 0 &&
                 pwrite(descriptor, good.bytes, good.size, 0) == (ssize_t)good.size;
    FUZZ_REQUIRE(whole, "%s: cannot be written", path);
    return path;
}

/* ---- changes ---- */

/* One number anywhere becomes another. */
static void change_number(hid_t file, const struct set *set, struct fuzz_bytes *bytes)
{
    hsize_t extents[MOST_RANK] = {1, 1, 1}, at[MOST_RANK], one[MOST_RANK] = {1, 1, 1};
    uint32_t where;
    double value;
    fuzz_take(bytes, &where, sizeof where);
    fuzz_take(bytes, &value, sizeof value);
    hid_t data = H5Dopen2(file, set->name, H5P_DEFAULT);
    hid_t space = H5Dget_space(data), point = H5Screate_simple(1, one, NULL);
    if (data >= 0 && set->rank > 0) {
        H5Sget_simple_extent_dims(space, extents, NULL);
        for (int d = set->rank - 1; d >= 0; d--) {
            at[d] = where % (extents[d] + !extents[d]);
            where /= (uint32_t)(extents[d] + !extents[d]);
        }
        H5Sselect_hyperslab(space, H5S_SELECT_SET, at, NULL, one, NULL);
    }
    if (data >= 0)
        H5Dwrite(data, H5T_NATIVE_DOUBLE, point, space, H5P_DEFAULT, &value);
    H5Sclose(point);
    H5Sclose(space);
    H5Dclose(data);
}

/* The dataset again, of other extents, rank and type. */
static void change_shape(hid_t file, const struct set *set, struct fuzz_bytes *bytes)
{
    const hid_t types[] = {H5T_NATIVE_DOUBLE, H5T_NATIVE_FLOAT, H5T_NATIVE_UINT, H5T_NATIVE_UCHAR,
                           H5T_C_S1};
    uint8_t rank, type, extent[MOST_RANK];
    hsize_t extents[MOST_RANK];
    fuzz_take(bytes, &rank, 1);
    fuzz_take(bytes, &type, 1);
    fuzz_take(bytes, extent, sizeof extent);
    for (int d = 0; d < MOST_RANK; d++)
        extents[d] = extent[d];
    H5Ldelete(file, set->name, H5P_DEFAULT);
    hid_t space = rank % 4 ? H5Screate_simple(rank % 4, extents, NULL) : H5Screate(H5S_SCALAR);
    hid_t data =
        H5Dcreate2(file, set->name, types[type % 5], space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dclose(data);
    H5Sclose(space);
}

static void change(hid_t file, struct fuzz_bytes *bytes)
{
    uint8_t kind, which;
    fuzz_take(bytes, &kind, 1);
    fuzz_take(bytes, &which, 1);
    const struct set *set = &SETS[which % (sizeof SETS / sizeof *SETS)];
    if (kind % 16 == 0)
        H5Ldelete(file, set->name, H5P_DEFAULT);
    else if (kind % 16 == 1)
        H5Adelete(file, which % 2 ? "hash" : "format");
    else if (kind % 16 < 5)
        change_shape(file, set, bytes);
    else
        change_number(file, set, bytes);
}

/* Looks for places on the surface that it has. */
static void hit(struct mesh_body *body)
{
    struct fault fault = {""};
    enum percuss_status status = mesh_surface_prepare(body) ? PERCUSS_OK : PERCUSS_INTERNAL;
    FUZZ_REQUIRE(!status, "no memory for the surface");
    struct body mesh = {.id = "mesh", .kind = &mesh_kind, .mesh = body, .scale = 1.0};
    for (size_t f = 0; f < body->face_count; f++)
        FUZZ_REQUIRE(body->faces[f].material < body->material_count, "face %zu of material %d", f,
                     body->faces[f].material);
    mesh.material = body->materials[0];
    status = body_complete(&mesh, &fault);
    if (status)
        fuzz_refused(status, fault.text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct fuzz_bytes bytes = {data, size};
    struct mesh_body *body;
    struct fault fault = {""};
    if (!good.bytes)
        make_good();
    const char *path = write_good();
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    FUZZ_REQUIRE(file >= 0, "the good file cannot be opened");
    for (int i = 0; i < MOST_CHANGES && bytes.left; i++)
        change(file, &bytes);
    H5Fclose(file);
    enum percuss_status status = body_file_read(path, &body, &fault);
    if (status) {
        fuzz_refused(status, fault.text);
        return 0;
    }
    hit(body);
    mesh_body_free(body);
    return 0;
}
