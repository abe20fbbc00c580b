/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce_mpi/spread.h"

#include <limits.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- a process' share of the elements ---- */

/* Most bytes of one message: its length is an int. */
enum { MESSAGE = 1 << 30 };

/* Ends all processes. */
static void give_up(const char *reason)
{
    fprintf(stderr, "percuss-reduce-mpi: %s\n", reason);
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    abort();
}

static void *take_memory(size_t bytes)
{
    void *memory = malloc(bytes + 1);
    if (!memory)
        give_up("out of memory");
    return memory;
}

/* The first process' bytes to all. */
static void broadcast_bytes(void *bytes, size_t count)
{
    for (size_t sent = 0; sent < count; sent += MESSAGE) {
        size_t part = count - sent < MESSAGE ? count - sent : MESSAGE;
        MPI_Bcast((char *)bytes + sent, (int)part, MPI_BYTE, 0, MPI_COMM_WORLD);
    }
}

/* The first process' array, or a copy elsewhere. */
static void *receive_array(const void *array, size_t bytes, int rank)
{
    void *copy = rank == 0 ? (void *)(uintptr_t)array : take_memory(bytes);
    broadcast_bytes(copy, bytes);
    return copy;
}

/* The parts of a mesh that make its matrices. The first process' own mesh keeps its arrays. */
static void receive_mesh(const struct solid_mesh *own, int rank, struct solid_mesh *mesh)
{
    if (rank == 0)
        *mesh = *own;
    else
        memset(mesh, 0, sizeof *mesh);
    size_t counts[4] = {mesh->node_count, mesh->element_count, mesh->part_count, mesh->mass_count};
    broadcast_bytes(counts, sizeof counts);
    mesh->node_count = counts[0];
    mesh->element_count = counts[1];
    mesh->part_count = counts[2];
    mesh->mass_count = counts[3];
    mesh->points = receive_array(mesh->points, counts[0] * sizeof *mesh->points, rank);
    mesh->types = receive_array(mesh->types, counts[1] * sizeof *mesh->types, rank);
    mesh->first = receive_array(mesh->first, (counts[1] + 1) * sizeof *mesh->first, rank);
    mesh->nodes =
        receive_array(mesh->nodes, mesh->first[mesh->element_count] * sizeof *mesh->nodes, rank);
    mesh->parts = receive_array(mesh->parts, counts[1] * sizeof *mesh->parts, rank);
    mesh->part = receive_array(mesh->part, counts[2] * sizeof *mesh->part, rank);
    mesh->masses = receive_array(mesh->masses, counts[3] * sizeof *mesh->masses, rank);
}

/* Masses on nodes whose first element is one of `from` ... `to`: each in one share. `number`: the
 * piece's nodes, from one. */
static void cut_masses(const struct solid_mesh *mesh, size_t from, size_t to, const size_t *number,
                       struct solid_mesh *piece)
{
    piece->masses = take_memory(mesh->mass_count * sizeof *piece->masses);
    for (size_t i = 0; i < mesh->mass_count; i++) {
        size_t node = mesh->masses[i].node, at = 0;
        while (at < mesh->first[to] && mesh->nodes[at] != node)
            at++;
        if (at >= mesh->first[from] && at < mesh->first[to])
            piece->masses[piece->mass_count++] =
                (struct mesh_mass){number[node] - 1, mesh->masses[i].mass};
    }
}

/* Elements `from` ... `to` with the nodes that they have. */
static void cut_piece(const struct solid_mesh *mesh, size_t from, size_t to, struct share *share,
                      struct solid_mesh *piece)
{
    size_t start = mesh->first[from], total = mesh->first[to] - start;
    size_t *number = take_memory(mesh->node_count * sizeof *number);
    *piece = (struct solid_mesh){.element_count = to - from,
                                 .part_count = mesh->part_count,
                                 .part = mesh->part,
                                 .types = mesh->types + from,
                                 .parts = mesh->parts + from,
                                 .first = take_memory((to - from + 1) * sizeof *piece->first),
                                 .nodes = take_memory(total * sizeof *piece->nodes)};
    for (size_t e = 0; e <= piece->element_count; e++)
        piece->first[e] = mesh->first[from + e] - start;

    /* nodes in the order of the whole, so that rows above the diagonal stay so */
    memset(number, 0, mesh->node_count * sizeof *number);
    for (size_t i = 0; i < total; i++)
        number[mesh->nodes[start + i]] = 1;
    for (size_t i = 0; i < mesh->node_count; i++)
        if (number[i])
            number[i] = ++piece->node_count;
    piece->points = take_memory(piece->node_count * sizeof *piece->points);
    share->nodes = take_memory(piece->node_count * sizeof *share->nodes);
    for (size_t i = 0; i < mesh->node_count; i++) {
        if (!number[i])
            continue;
        share->nodes[number[i] - 1] = i;
        memcpy(piece->points[number[i] - 1], mesh->points[i], sizeof *piece->points);
    }
    for (size_t i = 0; i < total; i++)
        piece->nodes[i] = number[mesh->nodes[start + i]] - 1;
    cut_masses(mesh, from, to, number, piece);
    free(number);
}

/* A share of the mesh's elements, which follow one another in the file: most are neighbours. */
static void take_elements(const struct solid_mesh *own, int rank, int size, struct share *share)
{
    size_t part = (size_t)rank, parts = (size_t)size;
    struct solid_mesh mesh, piece;
    struct fault fault;
    receive_mesh(own, rank, &mesh);
    cut_piece(&mesh, mesh.element_count * part / parts, mesh.element_count * (part + 1) / parts,
              share, &piece);
    if (matrices_make(&piece, &share->matrices, &fault))
        give_up(fault.text);
    share->matrices.mesh = NULL;
    free(piece.first);
    free(piece.nodes);
    free(piece.points);
    free(piece.masses);
    if (rank != 0)
        solid_mesh_free(&mesh);
}

/* Matrices that were read: the first process has them all. */
static void take_matrices(const struct matrices *whole, struct share *share)
{
    size_t count = whole ? share->node_count : 0;
    share->borrowed = true;
    share->nodes = take_memory(count * sizeof *share->nodes);
    for (size_t i = 0; i < count; i++)
        share->nodes[i] = i;
    if (whole)
        share->matrices = *whole;
    else
        share->matrices = (struct matrices){.stiffness = {.start = take_memory(sizeof(size_t))},
                                            .mass = {.start = take_memory(sizeof(size_t))}};
    if (!whole)
        share->matrices.stiffness.start[0] = share->matrices.mass.start[0] = 0;
}

/* By all processes together: `whole` is the first one's, borrowed, NULL elsewhere. A process
 * without memory ends them all. */
static void share_make(const struct matrices *whole, struct share *share)
{
    int rank, size;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    size_t about[3] = {0};
    if (whole) {
        about[0] = whole->stiffness.n / 3;
        about[1] = whole->held != NULL;
        about[2] = whole->mesh != NULL;
    }
    broadcast_bytes(about, sizeof about);
    *share = (struct share){.node_count = about[0]};

    /* supports */
    if (about[1]) {
        size_t bytes = 3 * share->node_count * sizeof *share->held;
        share->held = take_memory(bytes);
        if (whole)
            memcpy(share->held, whole->held, bytes);
        broadcast_bytes(share->held, bytes);
    }
    if (about[2])
        take_elements(whole ? whole->mesh : NULL, rank, size, share);
    else
        take_matrices(whole, share);
}

static void share_free(struct share *share)
{
    free(share->held);
    free(share->nodes);
    if (share->borrowed && share->matrices.stiffness.n > 0)
        return;
    matrices_free(&share->matrices);
}

/* ---- matrices and factor of all processes ---- */

/* Numbers of MUMPS's controls, counted from one as in its manual. */
enum { ORDERING = 7, PLAIN_ROOT = 13, RELAXATION = 14, SCOTCH = 3 };

/* Where entries go, in the order of a share's matrices, both triangles: held degrees of freedom
 * have a stiffness alone, their own. PETSc passes over places below zero. */
struct places {
    const struct share *share;
    PetscInt *row, *column;
    size_t count;
};

static PetscInt whole_number(const struct share *share, size_t unknown)
{
    return (PetscInt)(3 * share->nodes[unknown / 3] + unknown % 3);
}

static size_t entry_count(const struct sparse *matrix)
{
    return matrix->start[matrix->n];
}

/* Each entry of the upper triangle, and its mirror image. */
static void list_places(struct places *places, const struct sparse *matrix, bool keep_diagonal)
{
    const bool *held = places->share->held;
    for (size_t i = 0; i < matrix->n; i++)
        for (size_t p = matrix->start[i]; p < matrix->start[i + 1]; p++) {
            PetscInt row = whole_number(places->share, i);
            PetscInt column = whole_number(places->share, matrix->column[p]);
            bool own = row == column, out = held && (held[row] || held[column]);
            if (out && !(own && keep_diagonal))
                row = column = -1;
            places->row[places->count] = row;
            places->column[places->count++] = column;
            places->row[places->count] = own ? -1 : column;
            places->column[places->count++] = own ? -1 : row;
        }
}

static void list_values(const struct sparse *matrix, double factor, double *values)
{
    for (size_t p = 0; p < entry_count(matrix); p++)
        values[2 * p] = values[2 * p + 1] = factor * matrix->value[p];
}

/* An empty matrix with room for a share's stiffness (if any) and mass. */
static Mat lay_out(const struct spread *spread, const struct sparse *stiffness)
{
    const struct share *share = &spread->share;
    const struct sparse *mass = &share->matrices.mass;
    size_t most = 2 * ((stiffness ? entry_count(stiffness) : 0) + entry_count(mass));
    struct places places = {.share = share};
    PetscInt n = (PetscInt)(3 * share->node_count), own = spread->rows.counts[spread->rows.rank];
    Mat matrix;
    SPREAD_CALL(PetscMalloc2(most, &places.row, most, &places.column));
    if (stiffness)
        list_places(&places, stiffness, true);
    list_places(&places, mass, false);
    SPREAD_CALL(MatCreate(PETSC_COMM_WORLD, &matrix));
    SPREAD_CALL(MatSetSizes(matrix, own, own, n, n));
    SPREAD_CALL(MatSetType(matrix, MATAIJ));
    SPREAD_CALL(
        MatSetPreallocationCOO(matrix, (PetscCount)places.count, places.row, places.column));
    SPREAD_CALL(PetscFree2(places.row, places.column));
    SPREAD_CALL(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
    SPREAD_CALL(MatSetOption(matrix, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
    return matrix;
}

/* Whole nodes to each process, about as many to all. */
static void share_rows(struct spread_rows *rows, size_t node_count)
{
    MPI_Comm_rank(PETSC_COMM_WORLD, &rows->rank);
    MPI_Comm_size(PETSC_COMM_WORLD, &rows->size);
    SPREAD_CALL(PetscMalloc2(rows->size, &rows->counts, rows->size, &rows->starts));
    for (int r = 0; r < rows->size; r++) {
        size_t first = node_count * (size_t)r / (size_t)rows->size;
        size_t next = node_count * ((size_t)r + 1) / (size_t)rows->size;
        rows->starts[r] = (int)(3 * first);
        rows->counts[r] = (int)(3 * (next - first));
    }
}

/* Processes that share the memory of this one's machine. */
static int count_neighbours(void)
{
    MPI_Comm machine;
    int count;
    MPI_Comm_split_type(PETSC_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &count);
    MPI_Comm_free(&machine);
    return count;
}

int spread_info(const struct spread *spread, int number)
{
    PetscInt value;
    SPREAD_CALL(MatMumpsGetInfog(spread->factor, number, &value));
    return (int)value;
}

static struct spread_outcome outcome_of(const struct spread *spread)
{
    return (struct spread_outcome){spread_info(spread, 1), spread_info(spread, 2)};
}

/* K + shift M */
static void assemble(struct spread *spread, double shift)
{
    const struct matrices *matrices = &spread->share.matrices;
    list_values(&matrices->stiffness, 1.0, spread->values);
    list_values(&matrices->mass, shift, spread->values + 2 * entry_count(&matrices->stiffness));
    SPREAD_CALL(MatSetValuesCOO(spread->shifted, spread->values, INSERT_VALUES));
}

void spread_make(struct spread *spread, const struct matrices *whole, bool positive,
                 struct spread_outcome *outcome)
{
    memset(spread, 0, sizeof *spread);
    share_make(whole, &spread->share);
    const struct sparse *k = &spread->share.matrices.stiffness, *m = &spread->share.matrices.mass;
    share_rows(&spread->rows, spread->share.node_count);
    spread->neighbours = count_neighbours();
    SPREAD_CALL(PetscMalloc1(2 * (entry_count(k) + entry_count(m)), &spread->values));
    spread->mass = lay_out(spread, NULL);
    list_values(m, 1.0, spread->values);
    SPREAD_CALL(MatSetValuesCOO(spread->mass, spread->values, INSERT_VALUES));
    spread->shifted = lay_out(spread, k);
    assemble(spread, 0.0);
    if (positive)
        SPREAD_CALL(MatSetOption(spread->shifted, MAT_SPD, PETSC_TRUE));

    /* the order follows from the places alone, and serves any shift */
    MatFactorInfo info;
    SPREAD_CALL(MatFactorInfoInitialize(&info));
    SPREAD_CALL(
        MatGetFactor(spread->shifted, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &spread->factor));
    SPREAD_CALL(MatMumpsSetIcntl(spread->factor, ORDERING, SCOTCH));
    /* negative pivots are not counted in a root that ScaLAPACK factors */
    SPREAD_CALL(MatMumpsSetIcntl(spread->factor, PLAIN_ROOT, 1));
    SPREAD_CALL(MatCholeskyFactorSymbolic(spread->factor, spread->shifted, NULL, &info));
    *outcome = outcome_of(spread);
}

void spread_free(struct spread *spread)
{
    SPREAD_CALL(MatDestroy(&spread->factor));
    SPREAD_CALL(MatDestroy(&spread->shifted));
    SPREAD_CALL(MatDestroy(&spread->mass));
    SPREAD_CALL(PetscFree(spread->values));
    SPREAD_CALL(PetscFree2(spread->rows.counts, spread->rows.starts));
    share_free(&spread->share);
}

void spread_compute(struct spread *spread, double shift, struct spread_outcome *outcome)
{
    MatFactorInfo info;
    assemble(spread, shift);
    SPREAD_CALL(MatFactorInfoInitialize(&info));

    /* pivots may need more room than was foreseen (errors -8, -9): twice as much each time */
    static const int usual = 25, most = 800;
    for (int room = usual; room <= most; room *= 2) {
        SPREAD_CALL(MatMumpsSetIcntl(spread->factor, RELAXATION, room));
        SPREAD_CALL(MatFactorClearError(spread->factor));
        SPREAD_CALL(MatCholeskyFactorNumeric(spread->factor, spread->shifted, &info));
        *outcome = outcome_of(spread);
        if (outcome->code != -8 && outcome->code != -9)
            break;
    }
}

void spread_scatter(const struct spread_rows *rows, const double *whole, double *own)
{
    MPI_Scatterv(whole, rows->counts, rows->starts, MPI_DOUBLE, own, rows->counts[rows->rank],
                 MPI_DOUBLE, 0, PETSC_COMM_WORLD);
}

void spread_gather(const struct spread_rows *rows, const double *own, double *whole)
{
    MPI_Gatherv(own, rows->counts[rows->rank], MPI_DOUBLE, whole, rows->counts, rows->starts,
                MPI_DOUBLE, 0, PETSC_COMM_WORLD);
}

/* Vectors of the first process to columns of a matrix, or back. */
static void move_columns(const struct spread *spread, size_t count, double *b, Mat columns,
                         bool back)
{
    size_t n = 3 * spread->share.node_count;
    size_t own = (size_t)spread->rows.counts[spread->rows.rank];
    bool first = spread->rows.rank == 0;
    double *values;
    SPREAD_CALL(MatDenseGetArray(columns, &values));
    for (size_t c = 0; c < count; c++)
        if (back)
            spread_gather(&spread->rows, values + c * own, first ? b + c * n : NULL);
        else
            spread_scatter(&spread->rows, first ? b + c * n : NULL, values + c * own);
    SPREAD_CALL(MatDenseRestoreArray(columns, &values));
}

void spread_solve(struct spread *spread, size_t count, double *b, struct spread_outcome *outcome)
{
    PetscInt n = (PetscInt)(3 * spread->share.node_count);
    PetscInt own = spread->rows.counts[spread->rows.rank];
    Mat right, left;
    SPREAD_CALL(
        MatCreateDense(PETSC_COMM_WORLD, own, PETSC_DECIDE, n, (PetscInt)count, NULL, &right));
    SPREAD_CALL(MatDuplicate(right, MAT_DO_NOT_COPY_VALUES, &left));
    move_columns(spread, count, b, right, false);
    SPREAD_CALL(MatMatSolve(spread->factor, right, left));
    *outcome = outcome_of(spread);
    move_columns(spread, count, b, left, true);
    SPREAD_CALL(MatDestroy(&right));
    SPREAD_CALL(MatDestroy(&left));
}
