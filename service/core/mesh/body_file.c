/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/body_file.h"

#include <dlfcn.h>
#include <errno.h>
#include <hdf5.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/atomic_file.h"
#include "mesh/sites_file.h"

static const char FORMAT[] = "percuss body";
static const unsigned VERSION = 1;
/* Numbers in one chunk of a packed dataset: about a megabyte, which fits a processor's cache. */
static const size_t PIECE = 262144;
/* The fastest level: the shuffle of the bytes brings the gain. */
static const unsigned DEFLATE = 1;
/* The largest compression: Deflate reaches 1000 at best, and the file's numbers may be half as wide
 * as ours. */
static const size_t MOST_PACKED = 2200;
/* No body has larger extents: products of them stay far from overflow. */
static const size_t MOST = 100000000;

/* ---- layout: the list of datasets, which writing, reading and checks follow ---- */

enum { LAYOUT_MOST = 40, LAYOUT_RANK = 3 };

enum layout_type { LAYOUT_REAL64, LAYOUT_REAL32, LAYOUT_WHOLE32, LAYOUT_WHOLE8, LAYOUT_NAME };

/* Allowed numbers. */
enum layout_range {
    LAYOUT_FINITE,
    LAYOUT_POSITIVE,
    LAYOUT_NOT_NEGATIVE,
    LAYOUT_OR_UNKNOWN /* NAN too */,
    LAYOUT_OR_INFINITE
};

struct layout {
    const char *name;
    const char *unit;
    enum layout_type type;
    enum layout_range range;
    int rank;
    const size_t *extent[LAYOUT_RANK]; /* members of the body */
    bool counts;                       /* reading sets the first extent from this dataset */
    bool optional;
    bool packed; /* large: in compressed chunks */
    void *value; /* member of the body; NULL: reading allocates *array */
    void **array;
};

/* Faces and materials as arrays of their members, one dataset each. */
struct layout_flat {
    unsigned char *face_count, *face_material;
    unsigned *face_patch, *face_nodes;
    float *normal, *curvature, *doubt, *tensor;
    double *flexibility, *slope;
    char (*names)[PERCUSS_ID_SIZE];
    double *young, *poisson, *density, *yield, *tangent;
    unsigned supported, removed;
};

static const size_t ONE = 1;
static const size_t THREE = 3;
static const size_t SIX = 6;
static const size_t TENSOR = 9;
static const size_t CORNERS = MESH_BODY_FACE_NODES;

static struct layout layout_number(const char *name, const char *unit, enum layout_range range,
                                   double *value)
{
    return (struct layout){.name = name, .unit = unit, .range = range, .value = value};
}

static struct layout layout_vector(const char *name, const char *unit, const size_t *length,
                                   double *value)
{
    return (struct layout){
        .name = name, .unit = unit, .rank = 1, .extent = {length}, .value = value};
}

static struct layout layout_whole(const char *name, unsigned *value)
{
    return (struct layout){.name = name, .unit = "1", .type = LAYOUT_WHOLE32, .value = value};
}

/* A list of `count` numbers. */
static struct layout layout_list_of(const char *name, const char *unit, enum layout_range range,
                                    const size_t *count, double **array)
{
    return (struct layout){.name = name,
                           .unit = unit,
                           .range = range,
                           .rank = 1,
                           .extent = {count},
                           .array = (void **)array};
}

static struct layout layout_table_of(const char *name, const char *unit, const size_t *count,
                                     const size_t *width, void *array)
{
    return (struct layout){
        .name = name, .unit = unit, .rank = 2, .extent = {count, width}, .array = array};
}

static struct layout *list_body(struct layout *next, struct mesh_body *body,
                                struct layout_flat *flat)
{
    *next++ = layout_number("unit", "m", LAYOUT_POSITIVE, &body->unit);
    *next++ = layout_vector("centre", "m", &THREE, body->centre);
    *next++ = layout_number("volume", "m^3", LAYOUT_POSITIVE, &body->volume);
    *next++ = layout_number("mass", "kg", LAYOUT_POSITIVE, &body->mass);
    *next++ = layout_vector("inertia", "kg m^2", &TENSOR, body->inertia);
    *next++ = layout_whole("supported", &flat->supported);
    *next++ = layout_number("element_size", "m", LAYOUT_POSITIVE, &body->element_size);
    *next++ = layout_number("cut", "m", LAYOUT_NOT_NEGATIVE, &body->cut);
    *next++ = layout_number("near", "m", LAYOUT_NOT_NEGATIVE, &body->near);
    return next;
}

static struct layout *list_materials(struct layout *next, struct mesh_body *body,
                                     struct layout_flat *flat)
{
    const size_t *count = &body->material_count;
    *next++ = (struct layout){.name = "materials/name",
                              .type = LAYOUT_NAME,
                              .unit = "1",
                              .rank = 1,
                              .extent = {count},
                              .counts = true,
                              .array = (void **)&flat->names};
    *next++ = layout_list_of("materials/young", "Pa", LAYOUT_POSITIVE, count, &flat->young);
    *next++ = layout_list_of("materials/poisson", "1", LAYOUT_FINITE, count, &flat->poisson);
    *next++ = layout_list_of("materials/density", "kg/m^3", LAYOUT_POSITIVE, count, &flat->density);
    *next++ = layout_list_of("materials/yield", "Pa", LAYOUT_OR_INFINITE, count, &flat->yield);
    *next++ = layout_list_of("materials/tangent", "Pa", LAYOUT_NOT_NEGATIVE, count, &flat->tangent);
    return next;
}

static struct layout *list_vibration(struct layout *next, struct mesh_body *body,
                                     struct layout_flat *flat)
{
    *next =
        layout_list_of("modes/omega", "rad/s", LAYOUT_POSITIVE, &body->mode_count, &body->omega);
    next++->counts = true;
    *next++ = layout_whole("modes/removed", &flat->removed);
    *next = layout_table_of("surface/points", "m", &body->node_count, &THREE, &body->points);
    next++->counts = true;
    *next++ = (struct layout){.name = "surface/shapes",
                              .unit = "1/sqrt(kg)",
                              .type = LAYOUT_REAL32,
                              .rank = 3,
                              .extent = {&body->node_count, &THREE, &body->mode_count},
                              .packed = true,
                              .array = (void **)&body->shapes};
    return next;
}

static struct layout *list_faces(struct layout *next, struct mesh_body *body,
                                 struct layout_flat *flat)
{
    const size_t *count = &body->face_count;
    const struct layout small = {.type = LAYOUT_WHOLE8, .unit = "1", .rank = 1, .extent = {count}};
    /* element faces */
    *next = small;
    next->name = "faces/count";
    next->counts = true;
    next++->array = (void **)&flat->face_count;
    *next = small;
    next->name = "faces/material";
    next++->array = (void **)&flat->face_material;
    *next = small;
    next->name = "faces/patch";
    next->type = LAYOUT_WHOLE32;
    next++->array = (void **)&flat->face_patch;
    *next = layout_table_of("faces/nodes", "1", count, &CORNERS, &flat->face_nodes);
    next++->type = LAYOUT_WHOLE32;
    /* normal, curvature, flexibility at their nodes */
    const size_t *widths[] = {&THREE, &SIX, &ONE};
    const char *names[] = {"faces/normal", "faces/curvature", "faces/doubt"};
    const char *units[] = {"1", "1/m", "rad"};
    float **arrays[] = {&flat->normal, &flat->curvature, &flat->doubt};
    for (int i = 0; i < 3; i++)
        *next++ = (struct layout){.name = names[i],
                                  .unit = units[i],
                                  .type = LAYOUT_REAL32,
                                  .rank = widths[i] == &ONE ? 2 : 3,
                                  .extent = {count, &CORNERS, widths[i]},
                                  .packed = true,
                                  .array = (void **)arrays[i]};
    *next = layout_table_of("faces/flexibility", "m/N", count, &CORNERS, &flat->flexibility);
    next++->range = LAYOUT_OR_UNKNOWN;
    *next = layout_table_of("faces/flexibility_slope", "m/N", count, &CORNERS, &flat->slope);
    next++->range = LAYOUT_OR_UNKNOWN;
    *next++ = (struct layout){.name = "faces/tensor",
                              .unit = "m/N",
                              .type = LAYOUT_REAL32,
                              .range = LAYOUT_OR_UNKNOWN,
                              .rank = 3,
                              .extent = {count, &CORNERS, &SIX},
                              .optional = true,
                              .packed = true,
                              .array = (void **)&flat->tensor};
    return next;
}

static struct layout *list_sites(struct layout *next, struct mesh_body *body)
{
    const size_t *count = &body->site_count;
    *next++ = (struct layout){.name = "sites/face",
                              .unit = "1",
                              .type = LAYOUT_WHOLE32,
                              .rank = 1,
                              .extent = {count},
                              .counts = true,
                              .optional = true,
                              .array = (void **)&body->site_face};
    *next = layout_table_of("sites/point", "m", count, &THREE, &body->site_point);
    next++->optional = true;
    *next = layout_table_of("sites/normal", "1", count, &THREE, &body->site_normal);
    next++->optional = true;
    *next = layout_table_of("sites/between", "m/N", count, count, &body->between);
    next->type = LAYOUT_REAL32;
    next->packed = true;
    next++->optional = true;
    return next;
}

/* Fills the list for a body and the flat arrays beside it; returns the number of datasets. */
static size_t layout_list(struct mesh_body *body, struct layout_flat *flat,
                          struct layout list[LAYOUT_MOST])
{
    struct layout *next = list_body(list, body, flat);
    next = list_materials(next, body, flat);
    next = list_vibration(next, body, flat);
    next = list_faces(next, body, flat);
    return (size_t)(list_sites(next, body) - list);
}

/* Bytes of one number. */
static size_t layout_size(enum layout_type type)
{
    static const size_t sizes[] = {[LAYOUT_REAL64] = sizeof(double),
                                   [LAYOUT_REAL32] = sizeof(float),
                                   [LAYOUT_WHOLE32] = sizeof(unsigned),
                                   [LAYOUT_WHOLE8] = 1,
                                   [LAYOUT_NAME] = PERCUSS_ID_SIZE};
    return sizes[type];
}

/* Room for the flat arrays of the body's faces and materials. False: out of memory. */
static bool layout_flat_allocate(struct layout_flat *flat, const struct mesh_body *body)
{
    struct layout list[LAYOUT_MOST];
    struct mesh_body shadow = *body;
    size_t count = layout_list(&shadow, flat, list);
    bool good = true;
    for (size_t i = 0; i < count; i++) {
        bool faces = list[i].extent[0] == &shadow.face_count;
        if (!list[i].array || !(faces || list[i].extent[0] == &shadow.material_count))
            continue;
        size_t numbers = 1;
        for (int d = 0; d < list[i].rank; d++)
            numbers *= *list[i].extent[d];
        *list[i].array = calloc(numbers + 1, layout_size(list[i].type));
        good = good && *list[i].array;
    }
    return good;
}

static void layout_flat_free(struct layout_flat *flat)
{
    void *arrays[] = {flat->face_count, flat->face_material, flat->face_patch, flat->face_nodes,
                      flat->normal,     flat->curvature,     flat->doubt,      flat->flexibility,
                      flat->slope,      flat->tensor,        flat->names,      flat->young,
                      flat->poisson,    flat->density,       flat->yield,      flat->tangent};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        free(arrays[i]);
}

/* Copies to the member (`back`) or from it. */
static void layout_pass(void *flat, void *member, size_t size, bool back)
{
    if (back)
        memcpy(member, flat, size);
    else
        memcpy(flat, member, size);
}

/* Tensors that are not there are left. */
static void pass_face(const struct layout_flat *flat, struct mesh_body_face *face, size_t f,
                      bool back)
{
    enum { NODES = MESH_BODY_FACE_NODES };
    layout_pass(flat->face_count + f, &face->count, sizeof face->count, back);
    layout_pass(flat->face_material + f, &face->material, sizeof face->material, back);
    layout_pass(flat->face_patch + f, &face->patch, sizeof face->patch, back);
    layout_pass(flat->face_nodes + f * NODES, face->nodes, sizeof face->nodes, back);
    layout_pass(flat->normal + f * NODES * 3, face->normal, sizeof face->normal, back);
    layout_pass(flat->curvature + f * NODES * 6, face->curvature, sizeof face->curvature, back);
    layout_pass(flat->doubt + f * NODES, face->doubt, sizeof face->doubt, back);
    layout_pass(flat->flexibility + f * NODES, face->flexibility, sizeof face->flexibility, back);
    layout_pass(flat->slope + f * NODES, face->flexibility_slope, sizeof face->flexibility_slope,
                back);
    if (flat->tensor)
        layout_pass(flat->tensor + f * NODES * 6, face->tensor, sizeof face->tensor, back);
}

static void pass_material(const struct layout_flat *flat, struct material *material, size_t i,
                          bool back)
{
    layout_pass(flat->names[i], material->name, sizeof material->name, back);
    layout_pass(flat->young + i, &material->young, sizeof material->young, back);
    layout_pass(flat->poisson + i, &material->poisson, sizeof material->poisson, back);
    layout_pass(flat->density + i, &material->density, sizeof material->density, back);
    layout_pass(flat->yield + i, &material->yield, sizeof material->yield, back);
    layout_pass(flat->tangent + i, &material->tangent, sizeof material->tangent, back);
    material->name[sizeof material->name - 1] = '\0';
}

/* From the body to the flat arrays. */
static void layout_flatten(const struct mesh_body *body, struct layout_flat *flat)
{
    flat->supported = body->supported;
    flat->removed = (unsigned)body->removed;
    for (size_t f = 0; f < body->face_count; f++)
        pass_face(flat, &body->faces[f], f, false);
    for (size_t i = 0; i < body->material_count; i++)
        pass_material(flat, &body->materials[i], i, false);
}

/* From the flat arrays to a body with allocated faces and materials. */
static void layout_unflatten(const struct layout_flat *flat, struct mesh_body *body)
{
    body->supported = flat->supported != 0;
    body->all_ways = flat->tensor != NULL;
    body->removed = flat->removed;
    for (size_t f = 0; f < body->face_count; f++)
        pass_face(flat, &body->faces[f], f, true);
    for (size_t i = 0; i < body->material_count; i++)
        pass_material(flat, &body->materials[i], i, true);
}

static bool layout_is_allowed(enum layout_range range, double value)
{
    switch (range) {
    case LAYOUT_POSITIVE:
        return value > 0.0 && isfinite(value);
    case LAYOUT_NOT_NEGATIVE:
        return value >= 0.0 && isfinite(value);
    case LAYOUT_OR_UNKNOWN:
        return !isinf(value);
    case LAYOUT_OR_INFINITE:
        return value > 0.0;
    default:
        return isfinite(value);
    }
}

/* Whether the range allows all `count` numbers; *at is the first that it forbids. */
static bool layout_holds(const struct layout *layout, const void *data, size_t count, size_t *at)
{
    const double *wide = data;
    const float *narrow = data;
    bool real = layout->type == LAYOUT_REAL64 || layout->type == LAYOUT_REAL32;
    for (size_t i = 0; real && i < count; i++) {
        double value = layout->type == LAYOUT_REAL64 ? wide[i] : (double)narrow[i];
        *at = i;
        if (!layout_is_allowed(layout->range, value))
            return false;
    }
    return true;
}

/* The range in words that follow "must be". */
static const char *layout_allowed(enum layout_range range)
{
    static const char *const texts[] = {
        [LAYOUT_FINITE] = "finite numbers",
        [LAYOUT_POSITIVE] = "finite and > 0",
        [LAYOUT_NOT_NEGATIVE] = "finite and >= 0",
        [LAYOUT_OR_UNKNOWN] = "finite numbers, or nan where it is not known",
        [LAYOUT_OR_INFINITE] = "> 0",
    };
    return texts[range];
}

/* ---- HDF5 error guard: between begin and end HDF5 prints no errors to standard error. It also
 * keeps the library loaded, even after this code is unloaded: HDF5 allocates data for each thread
 * that calls it, and its code releases them when the thread ends. ---- */

/* The handler outside the guard. */
struct hdf5_guard {
    H5E_auto2_t function;
    void *data;
};

/* Keeps the loaded library file; a statically linked program has none. */
static void hold_library(void)
{
    Dl_info place;
    void *held = dladdr((void *)H5open, &place)
                     ? dlopen(place.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE)
                     : NULL;
    if (held)
        dlclose(held);
}

static struct hdf5_guard hdf5_guard_begin(void)
{
    struct hdf5_guard outer = {NULL, NULL};
    hold_library();
    H5Eget_auto2(H5E_DEFAULT, &outer.function, &outer.data);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    return outer;
}

static void hdf5_guard_end(const struct hdf5_guard *outer)
{
    H5Eset_auto2(H5E_DEFAULT, outer->function, outer->data);
}

/* ---- the file ---- */

struct body_file {
    const char *path;
    hid_t id;
    struct fault *fault;
};

static enum percuss_status body_file_refuse(const struct body_file *file, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static enum percuss_status body_file_refuse(const struct body_file *file, const char *format, ...)
{
    char text[400];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return fault_set(file->fault, PERCUSS_BAD_REQUEST, "%.200s: %s", file->path, text);
}

static enum percuss_status body_file_out_of_memory(const struct body_file *file)
{
    return fault_set(file->fault, PERCUSS_INTERNAL, "%.200s: out of memory", file->path);
}

/* The type of numbers in memory; close it with H5Tclose. */
static hid_t type_open(enum layout_type type)
{
    if (type == LAYOUT_NAME) {
        hid_t name = H5Tcopy(H5T_C_S1);
        H5Tset_size(name, PERCUSS_ID_SIZE);
        return name;
    }
    return H5Tcopy(type == LAYOUT_REAL64   ? H5T_NATIVE_DOUBLE
                   : type == LAYOUT_REAL32 ? H5T_NATIVE_FLOAT
                   : type == LAYOUT_WHOLE8 ? H5T_NATIVE_UCHAR
                                           : H5T_NATIVE_UINT);
}

static size_t layout_numbers(const struct layout *layout)
{
    size_t numbers = 1;
    for (int d = 0; d < layout->rank; d++)
        numbers *= *layout->extent[d];
    return numbers;
}

/* ---- writing ---- */

static bool write_attribute(hid_t at, const char *name, const char *text)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, strlen(text) + 1);
    hid_t space = H5Screate(H5S_SCALAR);
    hid_t attribute = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    bool good = attribute >= 0 && H5Awrite(attribute, type, text) >= 0;
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    return good;
}

static bool write_version(hid_t at)
{
    hid_t space = H5Screate(H5S_SCALAR);
    hid_t attribute = H5Acreate2(at, "version", H5T_NATIVE_UINT, space, H5P_DEFAULT, H5P_DEFAULT);
    bool good = attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_UINT, &VERSION) >= 0;
    H5Aclose(attribute);
    H5Sclose(space);
    return good;
}

/* Chunks of whole rows; a row has all numbers of one first index. */
static void pack_dataset(hid_t properties, const struct layout *layout, const hsize_t *extents)
{
    hsize_t piece[LAYOUT_RANK] = {1, 1, 1};
    size_t row = 1;
    for (int d = 1; d < layout->rank; d++)
        row *= (size_t)(piece[d] = extents[d]);
    size_t rows = row < PIECE ? PIECE / row : 1;
    piece[0] = rows < extents[0] ? rows : extents[0];
    H5Pset_chunk(properties, layout->rank, piece);
    H5Pset_shuffle(properties);
    H5Pset_deflate(properties, DEFLATE);
}

static enum percuss_status write_dataset(const struct body_file *file, const struct layout *layout)
{
    const void *data = layout->value ? layout->value : *layout->array;
    hsize_t extents[LAYOUT_RANK] = {0};
    if (layout->optional && (!data || layout_numbers(layout) == 0))
        return PERCUSS_OK;
    /* shape and packing */
    for (int d = 0; d < layout->rank; d++)
        extents[d] = *layout->extent[d];
    hid_t type = type_open(layout->type);
    hid_t space =
        layout->rank ? H5Screate_simple(layout->rank, extents, NULL) : H5Screate(H5S_SCALAR);
    hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    hid_t links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    if (layout->packed && layout_numbers(layout) > 0)
        pack_dataset(creation, layout, extents);
    /* the numbers with their unit */
    hid_t set = H5Dcreate2(file->id, layout->name, type, space, links, creation, H5P_DEFAULT);
    bool good = set >= 0 && write_attribute(set, "unit", layout->unit) &&
                (layout_numbers(layout) == 0 ||
                 H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
    good = H5Dclose(set) >= 0 && good;
    H5Pclose(links);
    H5Pclose(creation);
    H5Sclose(space);
    H5Tclose(type);
    return good ? PERCUSS_OK
                : body_file_refuse(file, "%s: cannot be written: is the disk full?", layout->name);
}

/* Where a body comes from whose sites are solved for later. */
static bool write_origin(const struct body_file *file, const struct mesh_body_origin *origin)
{
    return !origin->mesh || (write_attribute(file->id, "mesh", origin->mesh) &&
                             write_attribute(file->id, "mesh_options", origin->options) &&
                             write_attribute(file->id, "mesh_hash", origin->hash));
}

static enum percuss_status write_layout(const struct body_file *file, const struct mesh_body *body)
{
    struct layout list[LAYOUT_MOST];
    struct layout_flat flat = {0};
    struct mesh_body shadow = *body; /* the list points into it */
    enum percuss_status status = PERCUSS_OK;
    if (!layout_flat_allocate(&flat, &shadow)) {
        layout_flat_free(&flat);
        return body_file_out_of_memory(file);
    }
    layout_flatten(&shadow, &flat);
    size_t count = layout_list(&shadow, &flat, list);
    for (size_t i = 0; !status && i < count; i++)
        if (list[i].array != (void **)&flat.tensor || shadow.all_ways)
            status = write_dataset(file, &list[i]);
    if (!status && !(write_attribute(file->id, "format", FORMAT) && write_version(file->id) &&
                     write_attribute(file->id, "hash", body->hash) &&
                     write_attribute(file->id, "source", body->source) &&
                     write_attribute(file->id, "supports", body->supports) &&
                     write_origin(file, &body->origin)))
        status = body_file_refuse(file, "cannot be written: is the disk full?");
    layout_flat_free(&flat);
    return status;
}

/* Writes a temporary file and renames it. */
static enum percuss_status write_temporary(struct body_file *file, const struct atomic_file *place,
                                           const struct mesh_body *body)
{
    struct fault reason;
    enum percuss_status status;
    file->id = H5Fcreate(place->aside, H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT);
    status = file->id >= 0 ? write_layout(file, body)
                           : body_file_refuse(file, "cannot be created: %s", strerror(errno));
    if (file->id >= 0 && H5Fclose(file->id) < 0 && !status)
        status = body_file_refuse(file, "cannot be written: is the disk full?");
    if (status)
        atomic_file_abandon(place);
    else if (atomic_file_finish(place, true, &reason))
        status = body_file_refuse(file, "%s", reason.text);
    return status;
}

enum percuss_status body_file_write(const char *path, const struct mesh_body *body,
                                    struct fault *fault)
{
    struct atomic_file place;
    struct fault reason;
    /* HDF5's exit handler crashes on a file that failed to close; there is nothing left to write */
    H5dont_atexit();
    struct hdf5_guard guard = hdf5_guard_begin();
    struct body_file file = {path, -1, fault};
    enum percuss_status status = atomic_file_begin(&place, path, &reason);
    if (status)
        body_file_refuse(&file, "cannot be created: %s", reason.text);
    else
        status = write_temporary(&file, &place, body);
    hdf5_guard_end(&guard);
    return status;
}

/* ---- reading ---- */

/* Reads a text of at most size - 1 bytes; false: there is no such attribute. */
static bool read_attribute(const struct body_file *file, const char *name, char *text, size_t size)
{
    memset(text, 0, size);
    hid_t attribute = H5Aopen(file->id, name, H5P_DEFAULT);
    hid_t stored = H5Aget_type(attribute);
    hid_t space = H5Aget_space(attribute);
    /* one string of fixed length */
    bool good = attribute >= 0 && H5Tget_class(stored) == H5T_STRING &&
                H5Tis_variable_str(stored) == 0 && H5Sget_simple_extent_npoints(space) == 1;
    if (good) {
        hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, size);
        good = H5Aread(attribute, type, text) >= 0;
        text[size - 1] = '\0';
        H5Tclose(type);
    }
    H5Sclose(space);
    H5Tclose(stored);
    H5Aclose(attribute);
    return good;
}

/* The attribute as a text for free(); false: it is longer than MOST_TEXT, or there is no memory. */
static bool read_text(const struct body_file *file, const char *name, char **text)
{
    enum { MOST_TEXT = 65536 };
    *text = malloc(MOST_TEXT);
    return *text && read_attribute(file, name, *text, MOST_TEXT) && strlen(*text) + 1 < MOST_TEXT;
}

/* Nothing where all flexibility stands in the faces. */
static enum percuss_status read_origin(const struct body_file *file,
                                       struct mesh_body_origin *origin)
{
    if (H5Aexists(file->id, "mesh") <= 0)
        return PERCUSS_OK;
    return read_text(file, "mesh", &origin->mesh) &&
                   read_text(file, "mesh_options", &origin->options) &&
                   read_attribute(file, "mesh_hash", origin->hash, sizeof origin->hash)
               ? PERCUSS_OK
               : body_file_refuse(file, "mesh, mesh_options or mesh_hash: is missing: the file is "
                                        "damaged");
}

static enum percuss_status check_format(const struct body_file *file)
{
    char format[32];
    unsigned version = 0;
    if (!read_attribute(file, "format", format, sizeof format) || strcmp(format, FORMAT) != 0)
        return body_file_refuse(
            file, "is no body file: made by percuss-reduce, it says format \"%s\"", FORMAT);
    hid_t attribute = H5Aopen(file->id, "version", H5P_DEFAULT);
    bool good = attribute >= 0 && H5Aread(attribute, H5T_NATIVE_UINT, &version) >= 0;
    H5Aclose(attribute);
    if (!good || version == 0 || version > VERSION)
        return body_file_refuse(file,
                                "version: %u: must be 1 to %u: reduce the mesh again with the "
                                "percuss-reduce of this percuss",
                                version, VERSION);
    return PERCUSS_OK;
}

/* Takes the extents of a dataset, or compares them with those of earlier datasets. */
static enum percuss_status check_extents(const struct body_file *file, const struct layout *layout,
                                         hid_t set)
{
    hsize_t extents[LAYOUT_RANK] = {0};
    hid_t space = H5Dget_space(set);
    int rank = H5Sget_simple_extent_ndims(space);
    if (rank == layout->rank && rank > 0)
        H5Sget_simple_extent_dims(space, extents, NULL);
    H5Sclose(space);
    if (rank != layout->rank)
        return body_file_refuse(file, "%s: has %d dimensions: must have %d", layout->name, rank,
                                layout->rank);
    for (int d = 0; d < rank; d++) {
        /* the body's own counts, which reading fills */
        size_t *count = (size_t *)layout->extent[d];
        if (d == 0 && layout->counts && extents[0] <= MOST)
            *count = (size_t)extents[0];
        if (extents[d] != *count)
            return body_file_refuse(file, "%s: is %llu long in dimension %d: must be %zu",
                                    layout->name, (unsigned long long)extents[d], d + 1, *count);
    }
    return PERCUSS_OK;
}

static enum percuss_status check_class(const struct body_file *file, const struct layout *layout,
                                       hid_t set)
{
    hid_t stored = H5Dget_type(set);
    H5T_class_t found = H5Tget_class(stored);
    bool variable = found == H5T_STRING && H5Tis_variable_str(stored) != 0;
    H5Tclose(stored);
    H5T_class_t wanted = layout->type == LAYOUT_NAME ? H5T_STRING
                         : layout->type == LAYOUT_REAL64 || layout->type == LAYOUT_REAL32
                             ? H5T_FLOAT
                             : H5T_INTEGER;
    return found == wanted && !variable
               ? PERCUSS_OK
               : body_file_refuse(file, "%s: holds other things than expected: must be %s",
                                  layout->name,
                                  wanted == H5T_STRING  ? "names of a fixed length"
                                  : wanted == H5T_FLOAT ? "floating-point numbers"
                                                        : "whole numbers");
}

/* False: damaged extents claim more than the file can hold, and reading would fill all memory. */
static bool can_hold(const struct body_file *file, const struct layout *layout, hid_t set)
{
    hsize_t stored = H5Dget_storage_size(set), whole = 0;
    return H5Fget_filesize(file->id, &whole) >= 0 && stored <= whole &&
           layout_numbers(layout) <= MOST_PACKED * (size_t)stored / layout_size(layout->type);
}

static enum percuss_status read_dataset_numbers(const struct body_file *file,
                                                const struct layout *layout, hid_t set)
{
    size_t numbers = layout_numbers(layout), at = 0;
    if (!can_hold(file, layout, set))
        return body_file_refuse(file, "%s: claims more than the file holds: it is damaged",
                                layout->name);
    /* an array, never of 0 bytes and far from overflow */
    void *data = layout->value;
    if (!data)
        data = *layout->array = calloc(numbers + 1, layout_size(layout->type));
    if (!data)
        return body_file_out_of_memory(file);
    /* HDF5 converts to this machine's type */
    hid_t type = type_open(layout->type);
    bool good = numbers == 0 || H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
    H5Tclose(type);
    if (!good)
        return body_file_refuse(file, "%s: cannot be read: the file is damaged or cut short",
                                layout->name);
    /* refuse numbers outside the layout's range */
    if (!layout_holds(layout, data, numbers, &at))
        return body_file_refuse(file, "%s: number %zu is none that is allowed: must be %s",
                                layout->name, at + 1, layout_allowed(layout->range));
    return PERCUSS_OK;
}

/* Whether the file has a dataset; asking for one in a group that is missing is an error of HDF5's.
 */
static bool is_there(const struct body_file *file, const char *name)
{
    char group[32];
    snprintf(group, sizeof group, "%.*s", (int)strcspn(name, "/"), name);
    return H5Lexists(file->id, group, H5P_DEFAULT) > 0 &&
           H5Lexists(file->id, name, H5P_DEFAULT) > 0;
}

static enum percuss_status read_dataset(const struct body_file *file, const struct layout *layout)
{
    if (layout->optional && !is_there(file, layout->name))
        return PERCUSS_OK;
    hid_t set = H5Dopen2(file->id, layout->name, H5P_DEFAULT);
    if (set < 0)
        return body_file_refuse(file, "%s: is missing: the file is damaged or no body's",
                                layout->name);
    enum percuss_status status = check_class(file, layout, set);
    if (!status)
        status = check_extents(file, layout, set);
    if (!status)
        status = read_dataset_numbers(file, layout, set);
    H5Dclose(set);
    return status;
}

static enum percuss_status read_layout(const struct body_file *file, struct mesh_body *body)
{
    struct layout list[LAYOUT_MOST];
    struct layout_flat flat = {0};
    size_t count = layout_list(body, &flat, list);
    enum percuss_status status = check_format(file);
    for (size_t i = 0; !status && i < count; i++)
        status = read_dataset(file, &list[i]);
    /* faces and materials as structs */
    if (!status) {
        body->faces = calloc(body->face_count + 1, sizeof *body->faces);
        body->materials = calloc(body->material_count + 1, sizeof *body->materials);
        if (body->faces && body->materials)
            layout_unflatten(&flat, body);
        else
            status = body_file_out_of_memory(file);
    }
    layout_flat_free(&flat);
    /* its origin */
    if (!status && !(read_attribute(file, "hash", body->hash, sizeof body->hash) &&
                     read_attribute(file, "source", body->source, sizeof body->source) &&
                     read_attribute(file, "supports", body->supports, sizeof body->supports)))
        status =
            body_file_refuse(file, "hash, source or supports: is missing: the file is no body's");
    return status ? status : read_origin(file, &body->origin);
}

/* Its path, and the sites that were added to it. */
static enum percuss_status complete(const char *path, struct mesh_body *body, struct fault *fault)
{
    body->path = strdup(path);
    if (!body->path)
        return fault_set(fault, PERCUSS_INTERNAL, "%.200s: out of memory", path);
    return mesh_body_is_later(body) ? sites_file_read(body, fault) : PERCUSS_OK;
}

enum percuss_status body_file_read(const char *path, struct mesh_body **body, struct fault *fault)
{
    struct hdf5_guard guard = hdf5_guard_begin();
    struct body_file file = {path, -1, fault};
    enum percuss_status status = PERCUSS_OK;
    struct mesh_body *made = calloc(1, sizeof *made);
    *body = NULL;
    /* closing the file closes its objects, too: those of a damaged file may fail to close singly */
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    errno = 0;
    if (!made)
        status = body_file_out_of_memory(&file);
    else if ((file.id = H5Fopen(path, H5F_ACC_RDONLY, access)) < 0)
        status = body_file_refuse(&file, "cannot be opened: %s",
                                  errno ? strerror(errno) : "it is no HDF5 file, or damaged");
    else {
        status = read_layout(&file, made);
        H5Fclose(file.id);
    }
    H5Pclose(access);
    /* check the body as a whole */
    struct fault inner = {{0}};
    if (!status && mesh_body_check(made, &inner))
        status = body_file_refuse(&file, "%s", inner.text);
    hdf5_guard_end(&guard);
    if (!status)
        status = complete(path, made, fault);
    if (status)
        mesh_body_free(made);
    else
        *body = made;
    return status;
}
