/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/vtk.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* VTK's order of nodes in Gmsh's numbers, and its names of the cells. */
static const unsigned char TET[] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
static const unsigned char HEX[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                    19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26};
static const unsigned char WEDGE[] = {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11};
static const unsigned char *const ORDERS[] = {TET, HEX, HEX, WEDGE};
static const unsigned char CELLS[] = {24, 25, 29, 26};

/* Arrays follow each other after the header, each behind its size. */
struct writer {
    FILE *file;
    uint64_t offset;
};

static void announce(struct writer *writer, const char *type, const char *name, int components,
                     uint64_t bytes)
{
    fprintf(writer->file,
            "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" "
            "offset=\"%" PRIu64 "\"/>\n",
            type, name, components, writer->offset);
    writer->offset += bytes + sizeof bytes;
}

static void write_header(struct writer *writer, const struct solid_mesh *mesh,
                         const struct modes *modes, size_t shown)
{
    uint64_t nodes = mesh->node_count, cells = mesh->element_count;
    uint64_t entries = mesh->first[mesh->element_count];
    /* sizes first; the data follow in this order */
    fprintf(writer->file,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
            "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
            "<Piece NumberOfPoints=\"%" PRIu64 "\" NumberOfCells=\"%" PRIu64 "\">\n<PointData>\n",
            nodes, cells);
    /* a field a mode */
    for (size_t m = 0; m < shown; m++) {
        char name[64];
        snprintf(name, sizeof name, "mode %zu: %.6g Hz", m + 1, modes->omega[m] / (2.0 * M_PI));
        announce(writer, "Float32", name, 3, 12 * nodes);
    }
    /* the mesh */
    fprintf(writer->file, "</PointData>\n<CellData>\n");
    announce(writer, "Int32", "part", 1, 4 * cells);
    fprintf(writer->file, "</CellData>\n<Points>\n");
    announce(writer, "Float64", "Points", 3, 24 * nodes);
    fprintf(writer->file, "</Points>\n<Cells>\n");
    announce(writer, "Int64", "connectivity", 1, 8 * entries);
    announce(writer, "Int64", "offsets", 1, 8 * cells);
    announce(writer, "UInt8", "types", 1, cells);
    fprintf(writer->file, "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData "
                          "encoding=\"raw\">\n_");
}

static void write_size(const struct writer *writer, uint64_t bytes)
{
    fwrite(&bytes, sizeof bytes, 1, writer->file);
}

static void write_mode(const struct writer *writer, const double *shape, size_t n)
{
    write_size(writer, 4 * n);
    for (size_t i = 0; i < n; i++) {
        float value = (float)shape[i];
        fwrite(&value, sizeof value, 1, writer->file);
    }
}

static void write_cells(const struct writer *writer, const struct solid_mesh *mesh)
{
    size_t cells = mesh->element_count;
    write_size(writer, 8 * mesh->first[cells]);
    for (size_t e = 0; e < cells; e++) {
        const unsigned char *order = ORDERS[mesh->types[e]];
        for (size_t i = 0; i < mesh->first[e + 1] - mesh->first[e]; i++) {
            int64_t node = (int64_t)mesh->nodes[mesh->first[e] + order[i]];
            fwrite(&node, sizeof node, 1, writer->file);
        }
    }
    write_size(writer, 8 * cells);
    for (size_t e = 0; e < cells; e++) {
        int64_t end = (int64_t)mesh->first[e + 1];
        fwrite(&end, sizeof end, 1, writer->file);
    }
    write_size(writer, cells);
    for (size_t e = 0; e < cells; e++)
        fputc(CELLS[mesh->types[e]], writer->file);
}

static void write_arrays(const struct writer *writer, const struct solid_mesh *mesh,
                         const struct modes *modes, size_t shown)
{
    for (size_t m = 0; m < shown; m++)
        write_mode(writer, modes->shapes + m * modes->n, modes->n);
    write_size(writer, 4 * mesh->element_count);
    for (size_t e = 0; e < mesh->element_count; e++) {
        int32_t part = (int32_t)mesh->parts[e];
        fwrite(&part, sizeof part, 1, writer->file);
    }
    write_size(writer, 24 * mesh->node_count);
    fwrite(mesh->points, sizeof *mesh->points, mesh->node_count, writer->file);
    write_cells(writer, mesh);
    fprintf(writer->file, "\n</AppendedData>\n</VTKFile>\n");
}

enum percuss_status vtk_write(const char *path, const struct solid_mesh *mesh,
                              const struct modes *modes, struct fault *fault)
{
    struct writer writer = {fopen(path, "wb"), 0};
    size_t shown = modes->count < VTK_MODES ? modes->count : VTK_MODES;
    if (!writer.file)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s", path, strerror(errno));
    write_header(&writer, mesh, modes, shown);
    write_arrays(&writer, mesh, modes, shown);
    bool fine = !ferror(writer.file);
    fine = fclose(writer.file) == 0 && fine;
    if (fine)
        return PERCUSS_OK;
    remove(path);
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: could not be written whole", path);
}
