/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/vtk_legacy.h"

#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "mesh/builder.h"
#include "mesh/element.h"
#include "mesh/scan.h"

enum { VTK_LINE = 256, VTK_WORD = 64 };

/* ---- numbers ---- */

/* Types of numbers; `size` bytes each in binary files, the most significant one first. */
static const struct vtk_type {
    const char *name;
    unsigned char size;
    char kind; /* i, u: whole numbers; f: others */
} TYPES[] = {{"unsigned_char", 1, 'u'}, {"char", 1, 'i'},          {"unsigned_short", 2, 'u'},
             {"short", 2, 'i'},         {"unsigned_int", 4, 'u'},  {"int", 4, 'i'},
             {"unsigned_long", 8, 'u'}, {"long", 8, 'i'},          {"float", 4, 'f'},
             {"double", 8, 'f'},        {"vtktypeint64", 8, 'i'},  {"vtktypeuint64", 8, 'u'},
             {"vtktypeint32", 4, 'i'},  {"vtktypeuint32", 4, 'u'}, {"vtkIdType", 4, 'i'},
             {"vtktypeint16", 2, 'i'},  {"vtktypeuint16", 2, 'u'}, {"vtktypeint8", 1, 'i'},
             {"vtktypeuint8", 1, 'u'},  {"signed_char", 1, 'i'},   {"unsigned_long_long", 8, 'u'},
             {"long_long", 8, 'i'}};

/* A list of numbers; NULL: not read. */
struct numbers {
    size_t count;
    double *values;
};

struct vtk {
    struct scan scan;
    struct builder builder;
    bool binary;
    double version;
    struct numbers points, offsets, nodes, types, groups;
    char group_name[VTK_WORD / 2];
    int group_rank;    /* of the array that names the groups: see rank_groups */
    size_t data_count; /* tuples of the data under way */
    bool of_cells;     /* they are of cells */
};

static enum percuss_status vtk_out_of_memory(const struct vtk *vtk)
{
    return fault_set(vtk->scan.fault, PERCUSS_INTERNAL, "%s: out of memory", vtk->scan.file);
}

static const struct vtk_type *find_type(const char *name)
{
    for (size_t i = 0; i < sizeof TYPES / sizeof *TYPES; i++)
        if (strcasecmp(name, TYPES[i].name) == 0)
            return &TYPES[i];
    return NULL;
}

static double from_bytes(const unsigned char *bytes, const struct vtk_type *type)
{
    uint64_t word = 0;
    for (size_t i = 0; i < type->size; i++)
        word = word << 8 | bytes[i];
    if (type->kind == 'f' && type->size == 4) {
        uint32_t half = (uint32_t)word;
        float number;
        memcpy(&number, &half, sizeof number);
        return (double)number;
    }
    if (type->kind == 'f') {
        double number;
        memcpy(&number, &word, sizeof number);
        return number;
    }
    /* the sign bit counts negative */
    uint64_t sign = (uint64_t)1 << (8 * type->size - 1);
    if (type->kind == 'i' && (word & sign))
        return -(double)((sign << 1) - word);
    return (double)word;
}

/* Takes `count` numbers behind a line; `subject` begins the message. Whole numbers are exact up to
 * 2^53. */
static enum percuss_status take_numbers(struct vtk *vtk, const char *subject,
                                        const struct vtk_type *type, size_t count,
                                        struct numbers *numbers)
{
    struct scan *scan = &vtk->scan;
    size_t left = scan->size - scan->at, least = vtk->binary ? type->size : 1;
    if (count > left / least)
        return scan_refuse(scan, "%s: %zu numbers: the file ends before: it must be whole", subject,
                           count);
    numbers->count = count;
    numbers->values = malloc((count + 1) * sizeof *numbers->values);
    if (!numbers->values)
        return vtk_out_of_memory(vtk);
    const unsigned char *bytes = (const unsigned char *)scan->text + scan->at;
    for (size_t i = 0; i < count; i++) {
        if (vtk->binary)
            numbers->values[i] = from_bytes(bytes + i * type->size, type);
        else if (!scan_real(scan, subject, &numbers->values[i]))
            return PERCUSS_BAD_REQUEST;
    }
    if (vtk->binary)
        scan->at += count * type->size;
    return PERCUSS_OK;
}

static void drop_numbers(struct numbers *numbers)
{
    free(numbers->values);
    *numbers = (struct numbers){0};
}

/* ---- sections ---- */

/* The next line that is not empty; false: the file ends. */
static bool next_line(struct vtk *vtk, char line[VTK_LINE])
{
    while (scan_line(&vtk->scan, line, VTK_LINE)) {
        size_t blank = strspn(line, " \t\r");
        if (line[blank]) {
            memmove(line, line + blank, strlen(line + blank) + 1);
            return true;
        }
    }
    return false;
}

static enum percuss_status refuse_vtk_line(const struct vtk *vtk, const char *line,
                                           const char *allowed)
{
    return scan_refuse(&vtk->scan, "%.60s: must be %s", line, allowed);
}

/* a line KEYWORD [COUNT] TYPE, and so many numbers behind it, times `each` */
static enum percuss_status read_array(struct vtk *vtk, const char *line, size_t count, size_t each,
                                      const char *type_name, struct numbers *numbers)
{
    char word[VTK_WORD];
    const struct vtk_type *type = find_type(type_name);
    if (!type)
        return refuse_vtk_line(vtk, line, "of a type such as float, double, int, vtktypeint64");
    sscanf(line, "%63s", word);
    if (each == 0 || count > SIZE_MAX / each)
        return refuse_vtk_line(vtk, line, "of fewer numbers");
    drop_numbers(numbers);
    return take_numbers(vtk, word, type, count * each, numbers);
}

static enum percuss_status read_points(struct vtk *vtk, const char *line)
{
    char type[VTK_WORD];
    size_t count;
    if (sscanf(line, "%*s %zu %63s", &count, type) != 2)
        return refuse_vtk_line(vtk, line, "POINTS, a number and a type");
    return read_array(vtk, line, count, 3, type, &vtk->points);
}

/* version 5: where each cell begins, then the nodes of all */
static enum percuss_status read_split_cells(struct vtk *vtk, size_t offsets, size_t nodes)
{
    static const char *const NAMES[] = {"OFFSETS", "CONNECTIVITY"};
    for (int i = 0; i < 2; i++) {
        char line[VTK_LINE], name[VTK_WORD] = "", type[VTK_WORD] = "";
        if (!next_line(vtk, line) || sscanf(line, "%63s %63s", name, type) != 2 ||
            strcasecmp(name, NAMES[i]) != 0)
            return scan_refuse(&vtk->scan, "CELLS: must be followed by %s and a type", NAMES[i]);
        enum percuss_status status = read_array(vtk, line, i == 0 ? offsets : nodes, 1, type,
                                                i == 0 ? &vtk->offsets : &vtk->nodes);
        if (status != PERCUSS_OK)
            return status;
    }
    return PERCUSS_OK;
}

/* before version 5: each cell's count, then its nodes; made into the other form */
static enum percuss_status read_joined_cells(struct vtk *vtk, const char *line, size_t cells,
                                             size_t total)
{
    enum percuss_status status = read_array(vtk, line, total, 1, "int", &vtk->nodes);
    if (status != PERCUSS_OK)
        return status;
    drop_numbers(&vtk->offsets);
    if (cells > total)
        return refuse_vtk_line(vtk, line, "CELLS, a number of cells and one of numbers");
    vtk->offsets.values = malloc((cells + 1) * sizeof *vtk->offsets.values);
    if (!vtk->offsets.values)
        return vtk_out_of_memory(vtk);
    size_t at = 0, to = 0;
    for (size_t cell = 0; cell < cells; cell++) {
        double count = at < total ? vtk->nodes.values[at++] : -1.0;
        vtk->offsets.values[cell] = (double)to;
        if (!(count >= 0.0 && count <= (double)(total - at)))
            return scan_refuse(&vtk->scan, "CELLS: cell %zu: must have as many nodes as it says",
                               cell);
        for (size_t i = 0; i < (size_t)count; i++)
            vtk->nodes.values[to++] = vtk->nodes.values[at++];
    }
    vtk->offsets.values[cells] = (double)to;
    vtk->offsets.count = cells + 1;
    vtk->nodes.count = to;
    return PERCUSS_OK;
}

static enum percuss_status read_cells(struct vtk *vtk, const char *line)
{
    size_t first, second;
    if (sscanf(line, "%*s %zu %zu", &first, &second) != 2)
        return refuse_vtk_line(vtk, line, "CELLS and two numbers");
    return vtk->version >= 5.0 ? read_split_cells(vtk, first, second)
                               : read_joined_cells(vtk, line, first, second);
}

static enum percuss_status read_cell_types(struct vtk *vtk, const char *line)
{
    size_t count;
    if (sscanf(line, "%*s %zu", &count) != 1)
        return refuse_vtk_line(vtk, line, "CELL_TYPES and a number");
    return read_array(vtk, line, count, 1, "int", &vtk->types);
}

static enum percuss_status read_data_count(struct vtk *vtk, const char *line)
{
    vtk->of_cells = toupper((unsigned char)line[0]) == 'C';
    if (sscanf(line, "%*s %zu", &vtk->data_count) != 1)
        return refuse_vtk_line(vtk, line, "CELL_DATA or POINT_DATA and a number");
    if (vtk->of_cells && vtk->types.values && vtk->data_count != vtk->types.count)
        return scan_refuse(&vtk->scan, "%.60s: must be of all %zu cells", line, vtk->types.count);
    return PERCUSS_OK;
}

/* ---- data of points and cells ---- */

static int compare_numbers(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

/* whether more than half as many values as cells differ, one cell aside; false with *whole false:
 * out of memory */
static bool numbers_cells(const struct numbers *numbers, bool *whole)
{
    size_t size = numbers->count * sizeof(double), differ = numbers->count > 0;
    double *sorted = malloc(size + 1);
    *whole = sorted != NULL;
    if (!sorted)
        return false;
    memcpy(sorted, numbers->values, size);
    if (numbers->count)
        qsort(sorted, numbers->count, sizeof *sorted, compare_numbers);
    for (size_t i = 1; i < numbers->count; i++)
        differ += sorted[i] != sorted[i - 1];
    free(sorted);
    return differ > 1 + numbers->count / 2;
}

/* How well the whole numbers of cells name groups: 2: their name says that they do; 1: others; 0:
 * each cell has a number of its own, or VTK keeps its books by them, as in vtkGhostType; -1: out of
 * memory. */
static int rank_groups(const char *name, const struct numbers *numbers)
{
    static const char *const NAMES[] = {"material", "CellEntityIds", "physical"};
    bool whole;
    for (size_t i = 0; i < sizeof NAMES / sizeof *NAMES; i++)
        if (strcasestr(name, NAMES[i]))
            return 2;
    bool each = numbers_cells(numbers, &whole);
    return !whole ? -1 : !each && strncmp(name, "vtk", 3) != 0;
}

/* whole numbers of cells: the first array of the best rank names the groups; takes *numbers */
static enum percuss_status offer_groups(struct vtk *vtk, const char *line, const char *name,
                                        struct numbers *numbers)
{
    int rank = rank_groups(name, numbers);
    if (rank < 0)
        return vtk_out_of_memory(vtk);
    if (numbers->count != vtk->data_count)
        return scan_refuse(&vtk->scan, "%.60s: must be of all %zu cells", line, vtk->data_count);
    if (rank <= vtk->group_rank)
        return PERCUSS_OK;
    drop_numbers(&vtk->groups);
    vtk->groups = *numbers;
    *numbers = (struct numbers){0};
    vtk->group_rank = rank;
    snprintf(vtk->group_name, sizeof vtk->group_name, "%s", name);
    return PERCUSS_OK;
}

/* The length of a string of binary files: its first byte's upper two bits say whether 1, 2, 4 or 8
 * bytes have it. False: the file ends before. */
static bool binary_length(const struct vtk *vtk, size_t *bytes, size_t *length)
{
    const unsigned char *at = (const unsigned char *)vtk->scan.text + vtk->scan.at;
    size_t left = vtk->scan.size - vtk->scan.at;
    if (left == 0)
        return false;
    *bytes = (size_t)1 << (3 - (at[0] >> 6));
    *length = at[0] & 63u;
    for (size_t i = 1; i < *bytes && i < left; i++)
        *length = *length << 8 | at[i];
    return *bytes <= left && *length <= left - *bytes;
}

/* passes over texts: lines, or lengths and letters */
static enum percuss_status skip_strings(struct vtk *vtk, const char *line, size_t count)
{
    char text[VTK_LINE];
    for (size_t i = 0; i < count; i++) {
        size_t bytes = 0, length = 0;
        if (vtk->binary ? !binary_length(vtk, &bytes, &length)
                        : !scan_line(&vtk->scan, text, sizeof text))
            return refuse_vtk_line(vtk, line, "followed by as many texts as it says");
        vtk->scan.at += bytes + length;
    }
    return PERCUSS_OK;
}

/* one array; whole numbers of cells may be their groups */
static enum percuss_status read_data(struct vtk *vtk, const char *line, const char *name,
                                     size_t tuples, size_t components, const char *type)
{
    struct numbers numbers = {0};
    if (components == 0 || tuples > SIZE_MAX / components)
        return refuse_vtk_line(vtk, line, "of fewer numbers");
    if (strcasecmp(type, "string") == 0)
        return skip_strings(vtk, line, tuples * components);
    /* binary files have eight of them in a byte */
    bool bits = strcasecmp(type, "bit") == 0;
    if (bits && vtk->binary) {
        tuples = tuples * components / 8 + (tuples * components % 8 > 0);
        components = 1;
    }
    enum percuss_status status =
        read_array(vtk, line, tuples, components, bits ? "unsigned_char" : type, &numbers);
    if (status == PERCUSS_OK && vtk->of_cells && components == 1 && !bits &&
        find_type(type)->kind != 'f')
        status = offer_groups(vtk, line, name, &numbers);
    drop_numbers(&numbers);
    return status;
}

/* SCALARS name type [components], then a line LOOKUP_TABLE */
static enum percuss_status read_scalars(struct vtk *vtk, const char *line)
{
    char name[VTK_WORD], type[VTK_WORD], table[VTK_LINE];
    size_t components = 1;
    if (sscanf(line, "%*s %63s %63s %zu", name, type, &components) < 2)
        return refuse_vtk_line(vtk, line, "SCALARS, a name and a type");
    struct scan before = vtk->scan;
    if (next_line(vtk, table) && strncasecmp(table, "LOOKUP_TABLE", 12) != 0)
        vtk->scan = before;
    return read_data(vtk, line, name, vtk->data_count, components, type);
}

/* KEYWORD name type, with components by the keyword */
static enum percuss_status read_fixed_data(struct vtk *vtk, const char *line)
{
    static const struct {
        const char *name;
        size_t components;
    } KINDS[] = {{"VECTORS", 3},          {"NORMALS", 3},
                 {"TENSORS", 9},          {"TENSORS6", 6},
                 {"GLOBAL_IDS", 1},       {"PEDIGREE_IDS", 1},
                 {"RATIONAL_WEIGHTS", 1}, {"HIGHER_ORDER_DEGREES", 3}};
    char kind[VTK_WORD], name[VTK_WORD], type[VTK_WORD];
    size_t components = 0;
    if (sscanf(line, "%63s %63s %63s", kind, name, type) != 3)
        return refuse_vtk_line(vtk, line, "followed by a name and a type");
    for (size_t i = 0; i < sizeof KINDS / sizeof *KINDS; i++)
        if (strcasecmp(kind, KINDS[i].name) == 0)
            components = KINDS[i].components;
    /* numbers of cells, not groups */
    struct numbers numbers = {0};
    enum percuss_status status = read_array(vtk, line, vtk->data_count, components, type, &numbers);
    drop_numbers(&numbers);
    return status;
}

/* LOOKUP_TABLE name n: colours of four parts; COLOR_SCALARS name parts: a colour of each tuple.
 * Text has them as numbers, binary files as bytes */
static enum percuss_status skip_colours(struct vtk *vtk, const char *line)
{
    struct numbers numbers = {0};
    size_t count;
    bool table = toupper((unsigned char)line[0]) == 'L';
    if (sscanf(line, "%*s %*s %zu", &count) != 1)
        return refuse_vtk_line(vtk, line, "followed by a name and a number");
    enum percuss_status status = read_array(vtk, line, table ? count : vtk->data_count,
                                            table ? 4 : count, "unsigned_char", &numbers);
    drop_numbers(&numbers);
    return status;
}

/* TEXTURE_COORDINATES name components type */
static enum percuss_status skip_coordinates(struct vtk *vtk, const char *line)
{
    struct numbers numbers = {0};
    size_t components;
    char type[VTK_WORD];
    if (sscanf(line, "%*s %*s %zu %63s", &components, type) != 2)
        return refuse_vtk_line(vtk, line, "followed by a name, a number and a type");
    enum percuss_status status = read_array(vtk, line, vtk->data_count, components, type, &numbers);
    drop_numbers(&numbers);
    return status;
}

/* up to an empty line */
static enum percuss_status skip_metadata(struct vtk *vtk, const char *line)
{
    char rest[VTK_LINE];
    (void)line;
    while (scan_line(&vtk->scan, rest, sizeof rest) && rest[strspn(rest, " \t")])
        ;
    return PERCUSS_OK;
}

/* FIELD name n, then n arrays: name components tuples type, with METADATA behind each */
static enum percuss_status read_field(struct vtk *vtk, const char *line)
{
    size_t count, components, tuples;
    char array[VTK_LINE], name[VTK_WORD], type[VTK_WORD];
    if (sscanf(line, "%*s %*s %zu", &count) != 1)
        return refuse_vtk_line(vtk, line, "FIELD, a name and a number");
    for (size_t i = 0; i < count;) {
        if (!next_line(vtk, array))
            return scan_refuse(&vtk->scan, "FIELD: the file ends before: it must be whole");
        enum percuss_status status;
        if (strncasecmp(array, "METADATA", 8) == 0) {
            status = skip_metadata(vtk, array);
        } else {
            if (sscanf(array, "%63s %zu %zu %63s", name, &components, &tuples, type) != 4)
                return refuse_vtk_line(vtk, array, "a name, two numbers and a type");
            status = read_data(vtk, array, name, tuples, components, type);
            i++;
        }
        if (status != PERCUSS_OK)
            return status;
    }
    return PERCUSS_OK;
}

static enum percuss_status check_dataset(struct vtk *vtk, const char *line)
{
    char kind[VTK_WORD] = "";
    sscanf(line, "%*s %63s", kind);
    return strcasecmp(kind, "UNSTRUCTURED_GRID") == 0
               ? PERCUSS_OK
               : refuse_vtk_line(
                     vtk, line,
                     "DATASET UNSTRUCTURED_GRID, with tetrahedra or hexahedra of second "
                     "order (a POLYDATA is a surface alone)");
}

typedef enum percuss_status vtk_reader(struct vtk *vtk, const char *line);

static const struct {
    const char *name;
    vtk_reader *read;
} SECTIONS[] = {{"DATASET", check_dataset},
                {"POINTS", read_points},
                {"CELLS", read_cells},
                {"CELL_TYPES", read_cell_types},
                {"CELL_DATA", read_data_count},
                {"POINT_DATA", read_data_count},
                {"SCALARS", read_scalars},
                {"FIELD", read_field},
                {"VECTORS", read_fixed_data},
                {"NORMALS", read_fixed_data},
                {"TENSORS", read_fixed_data},
                {"TENSORS6", read_fixed_data},
                {"GLOBAL_IDS", read_fixed_data},
                {"PEDIGREE_IDS", read_fixed_data},
                {"RATIONAL_WEIGHTS", read_fixed_data},
                {"HIGHER_ORDER_DEGREES", read_fixed_data},
                {"LOOKUP_TABLE", skip_colours},
                {"COLOR_SCALARS", skip_colours},
                {"TEXTURE_COORDINATES", skip_coordinates},
                {"METADATA", skip_metadata}};

/* the mesh and its groups; a section that is not known ends them once the mesh is there */
static enum percuss_status read_vtk_sections(struct vtk *vtk)
{
    char line[VTK_LINE], word[VTK_WORD];
    while (next_line(vtk, line)) {
        size_t i = 0, count = sizeof SECTIONS / sizeof *SECTIONS;
        sscanf(line, "%63s", word);
        while (i < count && strcasecmp(word, SECTIONS[i].name) != 0)
            i++;
        if (i == count && vtk->points.values && vtk->types.values)
            return builder_remark(&vtk->builder,
                                  "%.60s: is not read, nor the data behind it, such as groups",
                                  word)
                       ? PERCUSS_OK
                       : vtk_out_of_memory(vtk);
        if (i == count)
            return refuse_vtk_line(vtk, line, "POINTS, CELLS, CELL_TYPES or their data");
        enum percuss_status status = SECTIONS[i].read(vtk, line);
        if (status != PERCUSS_OK)
            return status;
    }
    return PERCUSS_OK;
}

static enum percuss_status read_head(struct vtk *vtk)
{
    char line[VTK_LINE];
    if (!scan_line(&vtk->scan, line, sizeof line) ||
        sscanf(line, "# vtk DataFile Version %lf", &vtk->version) != 1 || vtk->version >= 6.0)
        return scan_refuse(&vtk->scan, "must begin with # vtk DataFile Version, 1.0 to 5.1");
    scan_line(&vtk->scan, line, sizeof line);
    if (!next_line(vtk, line) ||
        (strncasecmp(line, "ASCII", 5) != 0 && strncasecmp(line, "BINARY", 6) != 0))
        return scan_refuse(&vtk->scan, "the third line must be ASCII or BINARY");
    vtk->binary = vtk->scan.binary = toupper((unsigned char)line[0]) == 'B';
    return PERCUSS_OK;
}

/* ---- cells ---- */

/* Cells that are taken, with VTK's node of each node in Gmsh's order. A linear one has its corners
 * alone. */
static const struct vtk_cell {
    const char *name;
    int type;
    enum element_type element;
    size_t nodes;
    unsigned char order[ELEMENT_MOST_NODES];
} CELLS[] = {
    {"tetrahedron", 10, ELEMENT_TET10, 4, {0, 1, 2, 3}},
    {"hexahedron", 12, ELEMENT_HEX20, 8, {0, 1, 2, 3, 4, 5, 6, 7}},
    {"wedge", 13, ELEMENT_WEDGE15, 6, {0, 1, 2, 3, 4, 5}},
    {"quadratic tetrahedron", 24, ELEMENT_TET10, 10, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
    {"Lagrange tetrahedron", 71, ELEMENT_TET10, 10, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
    {"quadratic wedge",
     26,
     ELEMENT_WEDGE15,
     15,
     {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10}},
    {"quadratic hexahedron", 25, ELEMENT_HEX20, 20, {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                                     16, 9, 17, 10, 18, 19, 12, 15, 13, 14}},
    {"triquadratic hexahedron", 29, ELEMENT_HEX27, 27, {0,  1,  2,  3,  4,  5,  6,  7,  8,
                                                        11, 16, 9,  17, 10, 18, 19, 12, 15,
                                                        13, 14, 24, 22, 20, 21, 23, 25, 26}}};

/* points, lines and faces: vertices to polygons, and those of second order */
static bool is_flat(int type)
{
    static const unsigned char FLAT[] = {1,  2,  3,  4,  5,  6,  7,  8,  9, 21,
                                         22, 23, 28, 30, 34, 35, 68, 69, 70};
    return memchr(FLAT, type, sizeof FLAT) != NULL;
}

static enum percuss_status refuse_cell(const struct vtk *vtk, size_t cell, const char *message)
{
    return fault_set(vtk->scan.fault, PERCUSS_BAD_REQUEST, "%s: cell %zu: %s", vtk->scan.file, cell,
                     message);
}

/* the name of a cell's group */
static void group_of(const struct vtk *vtk, size_t cell, char name[MESH_NAME_SIZE])
{
    if (cell < vtk->groups.count)
        snprintf(name, MESH_NAME_SIZE, "%s %.0f", vtk->group_name, vtk->groups.values[cell]);
    else
        snprintf(name, MESH_NAME_SIZE, "body");
}

static enum percuss_status add_flat(struct vtk *vtk, size_t cell, const size_t *nodes, size_t count)
{
    char name[MESH_NAME_SIZE];
    if (cell >= vtk->groups.count)
        return PERCUSS_OK;
    group_of(vtk, cell, name);
    size_t set = builder_set(&vtk->builder, name);
    for (size_t i = 0; i < count && set != SIZE_MAX; i++)
        if (!builder_append(&vtk->builder.sets[set].labels, nodes[i]))
            set = SIZE_MAX;
    return set != SIZE_MAX ? PERCUSS_OK : vtk_out_of_memory(vtk);
}

static enum percuss_status add_solid(struct vtk *vtk, size_t cell, const struct vtk_cell *kind,
                                     const size_t *nodes)
{
    char name[MESH_NAME_SIZE], message[256];
    size_t ordered[ELEMENT_MOST_NODES];
    if (kind->nodes <= 8 && !vtk->builder.raise) {
        snprintf(message, sizeof message,
                 "%s of %zu nodes (type %d): must be of second order, as linear ones are too stiff "
                 "(first frequency 4 to 15 %% high): write VTK_QUADRATIC_TETRA (24), _HEXAHEDRON "
                 "(25) or _WEDGE (26), or raise them by --raise",
                 kind->name, kind->nodes, kind->type);
        return refuse_cell(vtk, cell, message);
    }
    for (size_t i = 0; i < element_node_count(kind->element); i++)
        ordered[i] = i < kind->nodes ? nodes[kind->order[i]] : BUILDER_MIDDLE;
    group_of(vtk, cell, name);
    size_t part = builder_part(&vtk->builder, name);
    return part != SIZE_MAX &&
                   builder_add_element(&vtk->builder, kind->element, cell, part, ordered)
               ? PERCUSS_OK
               : vtk_out_of_memory(vtk);
}

/* one cell with its nodes from `first` to `end` */
static enum percuss_status add_cell(struct vtk *vtk, size_t cell, size_t first, size_t end)
{
    size_t nodes[ELEMENT_MOST_NODES] = {0}, count = end - first;
    double stated = vtk->types.values[cell];
    int type = stated >= 0.0 && stated < 256.0 ? (int)stated : -1;
    const struct vtk_cell *kind = NULL;
    char message[160];
    for (size_t i = 0; i < sizeof CELLS / sizeof *CELLS; i++)
        if (CELLS[i].type == type)
            kind = &CELLS[i];
    if (!kind && !is_flat(type)) {
        snprintf(message, sizeof message,
                 "type %d: must be a tetrahedron of 10 nodes (24), a hexahedron of 20 or 27 (25, "
                 "29) or a wedge of 15 (26)",
                 type);
        return refuse_cell(vtk, cell, message);
    }
    if (kind && count != kind->nodes) {
        snprintf(message, sizeof message, "%s: has %zu nodes: must have %zu", kind->name, count,
                 kind->nodes);
        return refuse_cell(vtk, cell, message);
    }
    if (count > ELEMENT_MOST_NODES)
        return PERCUSS_OK;
    for (size_t i = 0; i < count; i++) {
        double node = vtk->nodes.values[first + i];
        if (!(node >= 0.0 && node < (double)(vtk->points.count / 3)))
            return refuse_cell(vtk, cell, "its nodes must be numbers of points, from 0");
        nodes[i] = (size_t)node;
    }
    return kind ? add_solid(vtk, cell, kind, nodes) : add_flat(vtk, cell, nodes, count);
}

static enum percuss_status add_cells(struct vtk *vtk)
{
    size_t cells = vtk->types.count, points = vtk->points.count / 3;
    if (vtk->offsets.count != cells + 1)
        return scan_refuse(&vtk->scan, "CELLS and CELL_TYPES must be of one number: %zu and %zu",
                           vtk->offsets.count ? vtk->offsets.count - 1 : 0, cells);
    if (vtk->groups.values && vtk->groups.count != cells)
        return scan_refuse(&vtk->scan,
                           "CELL_DATA: %s: has %zu numbers: must have one of each of "
                           "the %zu cells",
                           vtk->group_name, vtk->groups.count, cells);
    for (size_t i = 0; i < points; i++)
        if (!builder_add_node(&vtk->builder, i, vtk->points.values + 3 * i))
            return vtk_out_of_memory(vtk);
    for (size_t cell = 0; cell < cells; cell++) {
        double first = vtk->offsets.values[cell], end = vtk->offsets.values[cell + 1];
        if (!(first >= 0.0 && first <= end && end <= (double)vtk->nodes.count))
            return refuse_cell(vtk, cell, "its OFFSETS must ascend within CONNECTIVITY");
        enum percuss_status status = add_cell(vtk, cell, (size_t)first, (size_t)end);
        if (status != PERCUSS_OK)
            return status;
    }
    return PERCUSS_OK;
}

enum percuss_status vtk_legacy_read(const char *path, double unit, bool raise,
                                    struct solid_mesh *mesh, struct fault *fault)
{
    struct vtk vtk = {0};
    memset(mesh, 0, sizeof *mesh);
    vtk.builder.raise = raise;
    vtk.builder.wedges_either_way = true;
    enum percuss_status status = scan_open(path, &vtk.scan, fault);
    if (status == PERCUSS_OK)
        status = read_head(&vtk);
    if (status == PERCUSS_OK)
        status = read_vtk_sections(&vtk);
    if (status == PERCUSS_OK)
        status = add_cells(&vtk);
    if (status == PERCUSS_OK)
        status = builder_finish(&vtk.builder, path, unit, mesh, fault);
    scan_close(&vtk.scan);
    builder_free(&vtk.builder);
    drop_numbers(&vtk.points);
    drop_numbers(&vtk.offsets);
    drop_numbers(&vtk.nodes);
    drop_numbers(&vtk.types);
    drop_numbers(&vtk.groups);
    return status;
}
