/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/body_file.h"

#include <errno.h>
#include <hdf5.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/atomic_file.h"
#include "mesh/body_layout.h"
#include "mesh/silence.h"

static const char FORMAT[] = "percuss body";
static const unsigned VERSION = 1;
/* Numbers of one piece of a packed dataset: about a megabyte, which a processor's cache holds. */
static const size_t PIECE = 262144;
/* The fastest level: what is gained comes from the shuffle of the bytes. */
static const unsigned DEFLATE = 1;
/* Deflate makes a thousandth of numbers at best; the file's may be half as wide as ours. */
static const size_t MOST_PACKED = 2200;
/* Larger extents are no body's: products of them stay far from overflow. */
static const size_t MOST = 100000000;

struct file {
    const char *path;
    hid_t id;
    struct fault *fault;
};

static enum percuss_status refuse(const struct file *file, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static enum percuss_status refuse(const struct file *file, const char *format, ...)
{
    char text[400];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return fault_set(file->fault, PERCUSS_BAD_REQUEST, "%.200s: %s", file->path, text);
}

static enum percuss_status out_of_memory(const struct file *file)
{
    return fault_set(file->fault, PERCUSS_INTERNAL, "%.200s: out of memory", file->path);
}

/* The type of numbers in memory; to be closed by type_close. */
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

static size_t numbers_of(const struct layout *layout)
{
    size_t numbers = 1;
    for (int d = 0; d < layout->rank; d++)
        numbers *= *layout->extent[d];
    return numbers;
}

/* ---- writing ---- */

static bool write_text(hid_t at, const char *name, const char *text)
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

/* Pieces of whole rows: a row is what stands at one first index. */
static void pack(hid_t properties, const struct layout *layout, const hsize_t *extents)
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

static enum percuss_status write_dataset(const struct file *file, const struct layout *layout)
{
    const void *data = layout->value ? layout->value : *layout->array;
    hsize_t extents[LAYOUT_RANK] = {0};
    if (layout->optional && (!data || numbers_of(layout) == 0))
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
    if (layout->packed && numbers_of(layout) > 0)
        pack(creation, layout, extents);
    /* the numbers with their unit */
    hid_t set = H5Dcreate2(file->id, layout->name, type, space, links, creation, H5P_DEFAULT);
    bool good =
        set >= 0 && write_text(set, "unit", layout->unit) &&
        (numbers_of(layout) == 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
    good = H5Dclose(set) >= 0 && good;
    H5Pclose(links);
    H5Pclose(creation);
    H5Sclose(space);
    H5Tclose(type);
    return good ? PERCUSS_OK
                : refuse(file, "%s: cannot be written: is the disk full?", layout->name);
}

static enum percuss_status write_all(const struct file *file, const struct mesh_body *body)
{
    struct layout list[LAYOUT_MOST];
    struct layout_flat flat = {0};
    struct mesh_body shadow = *body; /* the list points into it */
    enum percuss_status status = PERCUSS_OK;
    if (!layout_flat_allocate(&flat, &shadow)) {
        layout_flat_free(&flat);
        return out_of_memory(file);
    }
    layout_flatten(&shadow, &flat);
    size_t count = layout_list(&shadow, &flat, list);
    for (size_t i = 0; !status && i < count; i++)
        status = write_dataset(file, &list[i]);
    if (!status && !(write_text(file->id, "format", FORMAT) && write_version(file->id) &&
                     write_text(file->id, "hash", body->hash) &&
                     write_text(file->id, "source", body->source) &&
                     write_text(file->id, "supports", body->supports)))
        status = refuse(file, "cannot be written: is the disk full?");
    layout_flat_free(&flat);
    return status;
}

/* Writes the file and gives it its name. */
static enum percuss_status write_aside(struct file *file, const struct atomic_file *place,
                                       const struct mesh_body *body)
{
    struct fault reason;
    enum percuss_status status;
    file->id = H5Fcreate(place->aside, H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT);
    status = file->id >= 0 ? write_all(file, body)
                           : refuse(file, "cannot be created: %s", strerror(errno));
    if (file->id >= 0 && H5Fclose(file->id) < 0 && !status)
        status = refuse(file, "cannot be written: is the disk full?");
    if (status)
        atomic_file_abandon(place);
    else if (atomic_file_finish(place, true, &reason))
        status = refuse(file, "%s", reason.text);
    return status;
}

enum percuss_status body_file_write(const char *path, const struct mesh_body *body,
                                    struct fault *fault)
{
    struct atomic_file place;
    struct fault reason;
    /* its end of the process falls over a file whose closing has failed; nothing is left to write
     */
    H5dont_atexit();
    struct silence kept = silence_begin();
    struct file file = {path, -1, fault};
    enum percuss_status status = atomic_file_begin(&place, path, &reason);
    if (status)
        refuse(&file, "cannot be created: %s", reason.text);
    else
        status = write_aside(&file, &place, body);
    silence_end(&kept);
    return status;
}

/* ---- reading ---- */

/* A text of at most size - 1 bytes; false: there is none of that kind. */
static bool read_text(const struct file *file, const char *name, char *text, size_t size)
{
    memset(text, 0, size);
    hid_t attribute = H5Aopen(file->id, name, H5P_DEFAULT);
    hid_t stored = H5Aget_type(attribute);
    hid_t space = H5Aget_space(attribute);
    /* of one fixed length, and only one */
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

static enum percuss_status check_format(const struct file *file)
{
    char format[32];
    unsigned version = 0;
    if (!read_text(file, "format", format, sizeof format) || strcmp(format, FORMAT) != 0)
        return refuse(file, "is no body file: made by percuss-reduce, it says format \"%s\"",
                      FORMAT);
    hid_t attribute = H5Aopen(file->id, "version", H5P_DEFAULT);
    bool good = attribute >= 0 && H5Aread(attribute, H5T_NATIVE_UINT, &version) >= 0;
    H5Aclose(attribute);
    if (!good || version == 0 || version > VERSION)
        return refuse(file,
                      "version: %u: must be 1 to %u: reduce the mesh again with the "
                      "percuss-reduce of this percuss",
                      version, VERSION);
    return PERCUSS_OK;
}

/* Takes the extents of a dataset, or compares them with what others have said. */
static enum percuss_status check_extents(const struct file *file, const struct layout *layout,
                                         hid_t set)
{
    hsize_t extents[LAYOUT_RANK] = {0};
    hid_t space = H5Dget_space(set);
    int rank = H5Sget_simple_extent_ndims(space);
    if (rank == layout->rank && rank > 0)
        H5Sget_simple_extent_dims(space, extents, NULL);
    H5Sclose(space);
    if (rank != layout->rank)
        return refuse(file, "%s: has %d dimensions: must have %d", layout->name, rank,
                      layout->rank);
    for (int d = 0; d < rank; d++) {
        /* the body's own counts, which a reader fills */
        size_t *count = (size_t *)layout->extent[d];
        if (d == 0 && layout->counts && extents[0] <= MOST)
            *count = (size_t)extents[0];
        if (extents[d] != *count)
            return refuse(file, "%s: is %llu long in dimension %d: must be %zu", layout->name,
                          (unsigned long long)extents[d], d + 1, *count);
    }
    return PERCUSS_OK;
}

static enum percuss_status check_class(const struct file *file, const struct layout *layout,
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
               : refuse(file, "%s: holds other things than expected: must be %s", layout->name,
                        wanted == H5T_STRING  ? "names of a fixed length"
                        : wanted == H5T_FLOAT ? "floating-point numbers"
                                              : "whole numbers");
}

/* Where damaged extents claim more than the file can hold, reading would fill all memory. */
static bool can_hold(const struct file *file, const struct layout *layout, hid_t set)
{
    hsize_t stored = H5Dget_storage_size(set), whole = 0;
    return H5Fget_filesize(file->id, &whole) >= 0 && stored <= whole &&
           numbers_of(layout) <= MOST_PACKED * (size_t)stored / layout_size(layout->type);
}

static enum percuss_status read_numbers(const struct file *file, const struct layout *layout,
                                        hid_t set)
{
    size_t numbers = numbers_of(layout), at = 0;
    if (!can_hold(file, layout, set))
        return refuse(file, "%s: claims more than the file holds: it is damaged", layout->name);
    /* an array gets a place, never of 0 bytes and far from overflow */
    void *data = layout->value;
    if (!data)
        data = *layout->array = calloc(numbers + 1, layout_size(layout->type));
    if (!data)
        return out_of_memory(file);
    /* read as this machine's type */
    hid_t type = type_open(layout->type);
    bool good = numbers == 0 || H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
    H5Tclose(type);
    if (!good)
        return refuse(file, "%s: cannot be read: the file is damaged or cut short", layout->name);
    /* numbers that the layout does not allow are refused */
    if (!layout_holds(layout, data, numbers, &at))
        return refuse(file, "%s: number %zu is none that is allowed: must be %s", layout->name,
                      at + 1, layout_allowed(layout->range));
    return PERCUSS_OK;
}

static enum percuss_status read_dataset(const struct file *file, const struct layout *layout)
{
    if (layout->optional && (H5Lexists(file->id, "sites", H5P_DEFAULT) <= 0 ||
                             H5Lexists(file->id, layout->name, H5P_DEFAULT) <= 0))
        return PERCUSS_OK;
    hid_t set = H5Dopen2(file->id, layout->name, H5P_DEFAULT);
    if (set < 0)
        return refuse(file, "%s: is missing: the file is damaged or no body's", layout->name);
    enum percuss_status status = check_class(file, layout, set);
    if (!status)
        status = check_extents(file, layout, set);
    if (!status)
        status = read_numbers(file, layout, set);
    H5Dclose(set);
    return status;
}

static enum percuss_status read_all(const struct file *file, struct mesh_body *body)
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
            status = out_of_memory(file);
    }
    layout_flat_free(&flat);
    /* where it comes from */
    if (!status && !(read_text(file, "hash", body->hash, sizeof body->hash) &&
                     read_text(file, "source", body->source, sizeof body->source) &&
                     read_text(file, "supports", body->supports, sizeof body->supports)))
        status = refuse(file, "hash, source or supports: is missing: the file is no body's");
    return status;
}

enum percuss_status body_file_read(const char *path, struct mesh_body **body, struct fault *fault)
{
    struct silence kept = silence_begin();
    struct file file = {path, -1, fault};
    enum percuss_status status = PERCUSS_OK;
    struct mesh_body *made = calloc(1, sizeof *made);
    *body = NULL;
    /* closed with all that is open in it: a damaged file's parts may not close by themselves */
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    errno = 0;
    if (!made)
        status = out_of_memory(&file);
    else if ((file.id = H5Fopen(path, H5F_ACC_RDONLY, access)) < 0)
        status = refuse(&file, "cannot be opened: %s",
                        errno ? strerror(errno) : "it is no HDF5 file, or damaged");
    else {
        status = read_all(&file, made);
        H5Fclose(file.id);
    }
    H5Pclose(access);
    /* and makes sense as a whole */
    struct fault inner = {{0}};
    if (!status && mesh_body_check(made, &inner))
        status = refuse(&file, "%s", inner.text);
    silence_end(&kept);
    if (status)
        mesh_body_free(made);
    else
        *body = made;
    return status;
}
