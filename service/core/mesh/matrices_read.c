/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/matrices_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "mesh/grow.h"
#include "mesh/scan.h"

enum { LINE_SIZE = 256 };
/* largest relative difference of a symmetric matrix: more digits than any file has */
static const double ASYMMETRY = 1e-8;
/* a body has the same mass in all directions; files have at least 6 digits */
static const double SAME_MASS = 1e-4;
static const uint32_t NO_ROW = UINT32_MAX;

/* a node's label and its number in the mesh */
struct label {
    size_t label, node;
};

/* the mesh's degree of freedom of each row */
struct freedoms {
    size_t count, room;
    uint32_t *of_row;
};

struct entries {
    size_t count, room;
    struct sparse_entry *list;
    bool both; /* both triangles */
};

static int matrices_compare_labels(const void *left, const void *right)
{
    const struct label *a = left, *b = right;
    return a->label < b->label ? -1 : a->label > b->label;
}

static struct label *sort_labels(const struct solid_mesh *mesh)
{
    struct label *labels = malloc((mesh->node_count + 1) * sizeof *labels);
    for (size_t i = 0; labels && i < mesh->node_count; i++)
        labels[i] = (struct label){mesh->labels[i], i};
    if (labels)
        qsort(labels, mesh->node_count, sizeof *labels, matrices_compare_labels);
    return labels;
}

static enum percuss_status matrices_out_of_memory(const char *file, struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", file);
}

static bool add_freedom(struct freedoms *freedoms, size_t node, size_t direction)
{
    if (!GROW(freedoms->of_row, freedoms->count, freedoms->room))
        return false;
    freedoms->of_row[freedoms->count++] = (uint32_t)(3 * node + direction);
    return true;
}

/* a line "node.direction" */
static enum percuss_status read_freedom(const struct scan *scan, const char *line,
                                        const struct solid_mesh *mesh, const struct label *labels,
                                        struct freedoms *freedoms)
{
    unsigned long long node;
    unsigned direction;
    if (sscanf(line, " %llu . %u", &node, &direction) != 2 &&
        sscanf(line, " %llu.%u", &node, &direction) != 2)
        return scan_refuse(scan, "%.40s: must be node.direction", line);
    if (direction < 1 || direction > 3)
        return scan_refuse(scan, "%.40s: direction must be 1, 2 or 3", line);
    struct label key = {node, 0};
    const struct label *found =
        bsearch(&key, labels, mesh->node_count, sizeof *labels, matrices_compare_labels);
    if (!found)
        return scan_refuse(scan, "%.40s: must be a node of the mesh", line);
    return add_freedom(freedoms, found->node, direction - 1)
               ? PERCUSS_OK
               : matrices_out_of_memory(scan->file, scan->fault);
}

static enum percuss_status read_freedoms(const char *path, const struct solid_mesh *mesh,
                                         const struct label *labels, struct freedoms *freedoms,
                                         struct fault *fault)
{
    struct scan scan;
    char line[LINE_SIZE];
    if (!path) {
        for (size_t i = 0; i < mesh->node_count; i++)
            for (size_t k = 0; k < 3; k++)
                if (!add_freedom(freedoms, labels[i].node, k))
                    return matrices_out_of_memory("degrees of freedom", fault);
        return PERCUSS_OK;
    }
    enum percuss_status status = scan_open(path, &scan, fault);
    while (status == PERCUSS_OK && scan_line(&scan, line, sizeof line))
        if (line[strspn(line, " \t")] != '\0')
            status = read_freedom(&scan, line, mesh, labels, freedoms);
    scan_close(&scan);
    return status;
}

/* "%%MatrixMarket matrix coordinate real symmetric", comments, then rows, columns, entries */
static enum percuss_status read_market_header(struct scan *scan, size_t n, bool *both)
{
    char line[LINE_SIZE], symmetry[LINE_SIZE] = "";
    size_t rows, columns, entries;
    if (!scan_line(scan, line, sizeof line) ||
        sscanf(line, "%%%%MatrixMarket matrix coordinate real %s", symmetry) != 1 ||
        (strcasecmp(symmetry, "symmetric") != 0 && strcasecmp(symmetry, "general") != 0))
        return scan_refuse(scan, "must begin with %%%%MatrixMarket matrix coordinate real "
                                 "symmetric (or general)");
    *both = strcasecmp(symmetry, "general") == 0;
    while (scan->at < scan->size && (scan->text[scan->at] == '%' || scan->text[scan->at] == '\n'))
        scan_line(scan, line, sizeof line);
    if (!scan_size(scan, "rows", &rows) || !scan_size(scan, "columns", &columns) ||
        !scan_count(scan, "entries", &entries))
        return PERCUSS_BAD_REQUEST;
    if (rows != n || columns != n)
        return scan_refuse(scan,
                           "%zu rows, %zu columns: must be %zu, as many as there are degrees "
                           "of freedom",
                           rows, columns, n);
    return PERCUSS_OK;
}

static bool at_end(const struct scan *scan)
{
    return scan->text[scan->at + strspn(scan->text + scan->at, " \t\r\n")] == '\0';
}

/* entries by the mesh's degrees of freedom, values times `factor` */
static enum percuss_status read_entries(struct scan *scan, const struct freedoms *freedoms,
                                        double factor, struct entries *entries)
{
    while (!at_end(scan)) {
        size_t row, column;
        double value;
        if (!scan_size(scan, "row", &row) || !scan_size(scan, "column", &column) ||
            !scan_real(scan, "value", &value))
            return PERCUSS_BAD_REQUEST;
        if (row < 1 || row > freedoms->count || column < 1 || column > freedoms->count)
            return scan_refuse(scan, "row %zu, column %zu: must be 1 to %zu", row, column,
                               freedoms->count);
        if (!isfinite(value))
            return scan_refuse(scan, "row %zu, column %zu: %g: must be a finite number", row,
                               column, value);
        if (!GROW(entries->list, entries->count, entries->room))
            return matrices_out_of_memory(scan->file, scan->fault);
        entries->list[entries->count++] = (struct sparse_entry){
            freedoms->of_row[row - 1], freedoms->of_row[column - 1], factor * value};
    }
    return PERCUSS_OK;
}

/* a number of either sign, the same for each call with that row */
static double pseudo_random(uint32_t row, double step)
{
    double x = row * step;
    return x - floor(x) - 0.5;
}

/* x^T A y and y^T A x with pseudo-random x, y differ where A is not symmetric */
static enum percuss_status check_symmetry(const struct scan *scan, const struct entries *entries)
{
    double difference = 0.0, sum = 0.0;
    for (size_t i = 0; i < entries->count; i++) {
        const struct sparse_entry *entry = &entries->list[i];
        double there =
            pseudo_random(entry->row, 0.6180339887) * pseudo_random(entry->column, 0.7548776662);
        double back =
            pseudo_random(entry->column, 0.6180339887) * pseudo_random(entry->row, 0.7548776662);
        difference += entry->value * (there - back);
        sum += fabs(entry->value * there);
    }
    if (fabs(difference) <= ASYMMETRY * sum)
        return PERCUSS_OK;
    return fault_set(scan->fault, PERCUSS_BAD_REQUEST, "%s: must be a symmetric matrix",
                     scan->file);
}

/* held degrees of freedom get a diagonal stiffness, as large as others */
static bool add_held(const struct solid_mesh *mesh, const bool *held, struct entries *entries)
{
    double largest = 1.0;
    for (size_t i = 0; i < entries->count; i++)
        largest = fmax(largest, entries->list[i].value);
    for (uint32_t i = 0; i < 3 * mesh->node_count; i++) {
        if (!held[i])
            continue;
        if (!GROW(entries->list, entries->count, entries->room))
            return false;
        entries->list[entries->count++] = (struct sparse_entry){i, i, largest};
    }
    return true;
}

/* `held`: degrees of freedom that get a diagonal, or NULL */
static enum percuss_status read_matrix(const char *path, const struct freedoms *freedoms,
                                       const struct solid_mesh *mesh, const bool *held,
                                       struct sparse *matrix, struct fault *fault)
{
    struct scan scan;
    struct entries entries = {0};
    const char *dot = strrchr(path, '.');
    enum percuss_status status = scan_open(path, &scan, fault);
    if (status == PERCUSS_OK && dot && strcasecmp(dot, ".mtx") == 0)
        status = read_market_header(&scan, freedoms->count, &entries.both);
    /* stiffness in N/unit, mass in N s^2/unit: both times 1/unit */
    if (status == PERCUSS_OK)
        status = read_entries(&scan, freedoms, 1.0 / mesh->unit, &entries);
    if (status == PERCUSS_OK && entries.both)
        status = check_symmetry(&scan, &entries);
    if (status == PERCUSS_OK && held && !add_held(mesh, held, &entries))
        status = matrices_out_of_memory(path, fault);
    if (status == PERCUSS_OK && !sparse_from_entries(matrix, 3 * mesh->node_count, entries.count,
                                                     entries.list, entries.both))
        status = matrices_out_of_memory(path, fault);
    free(entries.list);
    scan_close(&scan);
    return status;
}

/* marks degrees of freedom without a row as held; refuses those of two rows */
static enum percuss_status find_held(const struct freedoms *freedoms, const char *file,
                                     const struct solid_mesh *mesh, struct matrices *matrices,
                                     struct fault *fault)
{
    size_t n = 3 * mesh->node_count;
    bool *held = malloc(n * sizeof *held);
    if (!held)
        return matrices_out_of_memory(file, fault);
    memset(held, true, n * sizeof *held);
    matrices->held = held;
    for (size_t i = 0; i < freedoms->count; i++) {
        uint32_t at = freedoms->of_row[i];
        if (!held[at])
            return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %zu.%u: is there twice", file,
                             mesh->labels[at / 3], at % 3 + 1);
        held[at] = false;
    }
    if (freedoms->count == n) {
        free(held);
        matrices->held = NULL;
    }
    return PERCUSS_OK;
}

/* a free body has one mass in all directions: otherwise rows and degrees of freedom do not match */
static enum percuss_status check_mass(const struct matrices *matrices, const char *file,
                                      struct fault *fault)
{
    size_t n = matrices->mass.n;
    double mass[3] = {0.0, 0.0, 0.0}, *way = calloc(n + 1, sizeof *way);
    if (!way)
        return matrices_out_of_memory(file, fault);
    for (size_t k = 0; k < 3; k++) {
        for (size_t i = 0; i < n; i++)
            way[i] = i % 3 == k;
        mass[k] = sparse_product(&matrices->mass, way, way);
    }
    free(way);
    bool one = fabs(mass[1] - mass[0]) <= SAME_MASS * fabs(mass[0]) &&
               fabs(mass[2] - mass[0]) <= SAME_MASS * fabs(mass[0]);
    if (mass[0] > 0.0 && (one || matrices->held))
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "%s: moves with %g, %g and %g kg along x, y and z: must be one mass; are the "
                     "rows those of the degrees of freedom?",
                     file, mass[0], mass[1], mass[2]);
}

/* a row without a diagonal has no stiffness, or no mass */
static enum percuss_status check_diagonal(const struct sparse *matrix,
                                          const struct freedoms *freedoms, const char *file,
                                          const struct solid_mesh *mesh, struct fault *fault)
{
    for (size_t row = 0; row < freedoms->count; row++) {
        uint32_t at = freedoms->of_row[row];
        /* the diagonal comes first in its row */
        size_t first = matrix->start[at];
        bool there = first < matrix->start[at + 1] && matrix->column[first] == at;
        if (!there || !(matrix->value[first] > 0.0))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "%s: row %zu (node %zu, direction %u): %g on the diagonal: must be "
                             "> 0; is the file whole?",
                             file, row + 1, mesh->labels[at / 3], at % 3 + 1,
                             there ? matrix->value[first] : 0.0);
    }
    return PERCUSS_OK;
}

enum percuss_status matrices_read(const struct matrices_files *files, const struct solid_mesh *mesh,
                                  struct matrices *matrices, struct fault *fault)
{
    memset(matrices, 0, sizeof *matrices);
    /* row numbers have 32 bits */
    if (mesh->node_count >= NO_ROW / 3)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "nodes: %zu: must be fewer than %u",
                         mesh->node_count, NO_ROW / 3);
    /* degrees of freedom of the rows, by the labels of the nodes */
    const char *map = files->freedoms ? files->freedoms : files->mass;
    struct freedoms freedoms = {0};
    struct label *labels = sort_labels(mesh);
    enum percuss_status status =
        labels ? read_freedoms(files->freedoms, mesh, labels, &freedoms, fault)
               : matrices_out_of_memory(map, fault);
    /* freedoms without a row are held */
    if (status == PERCUSS_OK)
        status = find_held(&freedoms, map, mesh, matrices, fault);
    /* held freedoms get a stiffness and no mass */
    if (status == PERCUSS_OK)
        status = read_matrix(files->stiffness, &freedoms, mesh, matrices->held,
                             &matrices->stiffness, fault);
    if (status == PERCUSS_OK)
        status = read_matrix(files->mass, &freedoms, mesh, NULL, &matrices->mass, fault);
    /* check that each row is there, and that the body has one mass */
    if (status == PERCUSS_OK)
        status = check_diagonal(&matrices->stiffness, &freedoms, files->stiffness, mesh, fault);
    if (status == PERCUSS_OK)
        status = check_diagonal(&matrices->mass, &freedoms, files->mass, mesh, fault);
    if (status == PERCUSS_OK)
        status = check_mass(matrices, files->mass, fault);
    free(labels);
    free(freedoms.of_row);
    if (status != PERCUSS_OK)
        matrices_free(matrices);
    return status;
}
