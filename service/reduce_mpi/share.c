/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce_mpi/share.h"

#include <limits.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What one message may hold, bytes: its length is an int. */
enum { MESSAGE = 1 << 30 };

/* Ends all processes. */
static void give_up(const char *reason)
{
    fprintf(stderr, "percuss-reduce-mpi: %s\n", reason);
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    abort();
}

static void *take(size_t bytes)
{
    void *memory = malloc(bytes + 1);
    if (!memory)
        give_up("out of memory");
    return memory;
}

/* The first process' bytes to all. */
static void broadcast(void *bytes, size_t count)
{
    for (size_t sent = 0; sent < count; sent += MESSAGE) {
        size_t part = count - sent < MESSAGE ? count - sent : MESSAGE;
        MPI_Bcast((char *)bytes + sent, (int)part, MPI_BYTE, 0, MPI_COMM_WORLD);
    }
}

/* The first process' array, or a copy elsewhere. */
static void *receive(const void *array, size_t bytes, int rank)
{
    void *copy = rank == 0 ? (void *)(uintptr_t)array : take(bytes);
    broadcast(copy, bytes);
    return copy;
}

/* What of a mesh makes its matrices. The first process' own mesh keeps its arrays. */
static void receive_mesh(const struct solid_mesh *own, int rank, struct solid_mesh *mesh)
{
    if (rank == 0)
        *mesh = *own;
    else
        memset(mesh, 0, sizeof *mesh);
    size_t counts[3] = {mesh->node_count, mesh->element_count, mesh->part_count};
    broadcast(counts, sizeof counts);
    mesh->node_count = counts[0];
    mesh->element_count = counts[1];
    mesh->part_count = counts[2];
    mesh->points = receive(mesh->points, counts[0] * sizeof *mesh->points, rank);
    mesh->types = receive(mesh->types, counts[1] * sizeof *mesh->types, rank);
    mesh->first = receive(mesh->first, (counts[1] + 1) * sizeof *mesh->first, rank);
    mesh->nodes =
        receive(mesh->nodes, mesh->first[mesh->element_count] * sizeof *mesh->nodes, rank);
    mesh->parts = receive(mesh->parts, counts[1] * sizeof *mesh->parts, rank);
    mesh->part = receive(mesh->part, counts[2] * sizeof *mesh->part, rank);
}

/* Elements `from` ... `to` with the nodes that they have. */
static void cut(const struct solid_mesh *mesh, size_t from, size_t to, struct share *share,
                struct solid_mesh *piece)
{
    size_t start = mesh->first[from], total = mesh->first[to] - start;
    size_t *number = take(mesh->node_count * sizeof *number);
    *piece = (struct solid_mesh){.element_count = to - from,
                                 .part_count = mesh->part_count,
                                 .part = mesh->part,
                                 .types = mesh->types + from,
                                 .parts = mesh->parts + from,
                                 .first = take((to - from + 1) * sizeof *piece->first),
                                 .nodes = take(total * sizeof *piece->nodes)};
    for (size_t e = 0; e <= piece->element_count; e++)
        piece->first[e] = mesh->first[from + e] - start;

    /* nodes in the order of the whole, so that rows above the diagonal stay so */
    memset(number, 0, mesh->node_count * sizeof *number);
    for (size_t i = 0; i < total; i++)
        number[mesh->nodes[start + i]] = 1;
    for (size_t i = 0; i < mesh->node_count; i++)
        if (number[i])
            number[i] = ++piece->node_count;
    piece->points = take(piece->node_count * sizeof *piece->points);
    share->nodes = take(piece->node_count * sizeof *share->nodes);
    for (size_t i = 0; i < mesh->node_count; i++) {
        if (!number[i])
            continue;
        share->nodes[number[i] - 1] = i;
        memcpy(piece->points[number[i] - 1], mesh->points[i], sizeof *piece->points);
    }
    for (size_t i = 0; i < total; i++)
        piece->nodes[i] = number[mesh->nodes[start + i]] - 1;
    free(number);
}

/* A share of the mesh's elements, which follow one another in the file: most are neighbours. */
static void take_elements(const struct solid_mesh *own, int rank, int size, struct share *share)
{
    size_t part = (size_t)rank, parts = (size_t)size;
    struct solid_mesh mesh, piece;
    struct fault fault;
    receive_mesh(own, rank, &mesh);
    cut(&mesh, mesh.element_count * part / parts, mesh.element_count * (part + 1) / parts, share,
        &piece);
    if (matrices_make(&piece, &share->matrices, &fault))
        give_up(fault.text);
    share->matrices.mesh = NULL;
    free(piece.first);
    free(piece.nodes);
    free(piece.points);
    if (rank != 0)
        solid_mesh_free(&mesh);
}

/* Matrices that were read: the first process has them all. */
static void take_matrices(const struct matrices *whole, struct share *share)
{
    size_t count = whole ? share->node_count : 0;
    share->borrowed = true;
    share->nodes = take(count * sizeof *share->nodes);
    for (size_t i = 0; i < count; i++)
        share->nodes[i] = i;
    if (whole)
        share->matrices = *whole;
    else
        share->matrices = (struct matrices){.stiffness = {.start = take(sizeof(size_t))},
                                            .mass = {.start = take(sizeof(size_t))}};
    if (!whole)
        share->matrices.stiffness.start[0] = share->matrices.mass.start[0] = 0;
}

void share_make(const struct matrices *whole, struct share *share)
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
    broadcast(about, sizeof about);
    *share = (struct share){.node_count = about[0]};

    /* supports */
    if (about[1]) {
        size_t bytes = 3 * share->node_count * sizeof *share->held;
        share->held = take(bytes);
        if (whole)
            memcpy(share->held, whole->held, bytes);
        broadcast(share->held, bytes);
    }
    if (about[2])
        take_elements(whole ? whole->mesh : NULL, rank, size, share);
    else
        take_matrices(whole, share);
}

void share_free(struct share *share)
{
    free(share->held);
    free(share->nodes);
    if (share->borrowed && share->matrices.stiffness.n > 0)
        return;
    matrices_free(&share->matrices);
}
