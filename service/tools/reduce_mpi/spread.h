/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Matrices of a mesh and a factor, spread over all processes by rows: PETSc with MUMPS. All calls
 * are made by all processes together; long vectors stand on the first one alone. An error of
 * PETSc ends them all with its own message. */
#ifndef PERCUSS_REDUCE_MPI_SPREAD_H
#define PERCUSS_REDUCE_MPI_SPREAD_H

#include <petscmat.h>

#include "mesh/matrices.h"

/* A call of PETSc's or SLEPc's. */
#define SPREAD_CALL(call) PetscCallAbort(PETSC_COMM_WORLD, call)

/* Rows of vectors that each process has. */
struct spread_rows {
    int rank, size;
    int *counts, *starts; /* [size] */
};

/* Every process' share of a mesh's elements, which it assembles. Owns its arrays. */
struct share {
    size_t node_count;        /* of the whole mesh */
    bool *held;               /* [3 node_count]; NULL: none */
    size_t *nodes;            /* the whole mesh's number of each node of the share */
    struct matrices matrices; /* of the share's elements, nothing held ... */
    bool borrowed;            /* ... or all there are, of no mesh, at the first process */
};

struct spread {
    struct share share;
    struct spread_rows rows;
    Mat mass, shifted, factor; /* M, K + shift M, its factor */
    int neighbours;            /* processes on the first one's machine */
    double *values;            /* of `shifted`, as its places were listed */
};

/* Status of MUMPS's last job: INFOG(1) and (2). */
struct spread_outcome {
    int code, detail;
};

/* Assembles and orders the unknowns. `whole` on the first process alone. */
void spread_make(struct spread *spread, const struct matrices *whole, bool positive,
                 struct spread_outcome *outcome);
void spread_free(struct spread *spread);

/* Factors K + shift M. */
void spread_compute(struct spread *spread, double shift, struct spread_outcome *outcome);

/* Solves in place for `count` right-hand sides of the first process. */
void spread_solve(struct spread *spread, size_t count, double *b, struct spread_outcome *outcome);

/* A vector of the first process to all, and back. */
void spread_scatter(const struct spread_rows *rows, const double *whole, double *own);
void spread_gather(const struct spread_rows *rows, const double *own, double *whole);

/* MUMPS's INFOG(number). */
int spread_info(const struct spread *spread, int number);

#endif
