/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce_mpi/spread_modes.h"

#include <slepceps.h>
#include <string.h>

/* |A x - t x| over t in the norm of M, A = (K + shift M)^-1 M and t = 1/(w^2 + shift): see
 * reduce/lanczos.h; the shapes are to be the same. */
static const double RESIDUAL = 1e-10;

/* How often copies of multiple frequencies that a single start has no part of are sought; vectors
 * that such a search has room for, enough to see the next mode behind hundreds. */
enum { MOST_SEARCHES = 6, SEARCH_ROOM = 64, MOST_RESTARTS = 1000 };

struct search {
    struct spread *spread;
    const struct spread_modes_task *task;
    Vec *kept; /* rigid motions, then modes: kept out of the search */
    size_t kept_count;
    double *squares; /* of the kept modes, in any order */
    bool stopped;
};

/* The factor there is, for SLEPc's shift and inversion. */
static PetscErrorCode apply(PC solver, Vec x, Vec y)
{
    struct search *search;
    PetscCall(PCShellGetContext(solver, &search));
    PetscCall(MatSolve(search->spread->factor, x, y));
    return 0;
}

/* SLEPc's own test, and the watch of the first process. */
static PetscErrorCode stop(EPS eps, PetscInt round, PetscInt most, PetscInt converged,
                           PetscInt wanted, EPSConvergedReason *reason, void *context)
{
    struct search *search = context;
    const struct watch *watch = search->task->watch;
    int goes_on = 1;
    PetscCall(EPSStoppingBasic(eps, round, most, converged, wanted, reason, NULL));
    if (search->spread->rows.rank == 0 && watch && watch->proceed) {
        double done = (double)(search->kept_count - search->task->rigid_count) + (double)converged;
        goes_on =
            watch->proceed(watch->context, fmin(0.9 * done / (double)search->task->count, 0.99));
    }
    MPI_Bcast(&goes_on, 1, MPI_INT, 0, PETSC_COMM_WORLD);
    if (!goes_on) {
        search->stopped = true;
        *reason = EPS_CONVERGED_USER;
    }
    return 0;
}

/* (K + shift M) x = (w^2 + shift) M x about zero; its inversion is that factor. */
static void set_problem(struct search *search, EPS eps)
{
    ST st;
    KSP inverse;
    PC solver;
    SPREAD_CALL(EPSSetOperators(eps, search->spread->shifted, search->spread->mass));
    SPREAD_CALL(EPSSetProblemType(eps, EPS_GHEP));
    SPREAD_CALL(EPSSetType(eps, EPSKRYLOVSCHUR));
    SPREAD_CALL(EPSSetTarget(eps, 0.0));
    SPREAD_CALL(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
    SPREAD_CALL(EPSGetST(eps, &st));
    SPREAD_CALL(STSetType(st, STSINVERT));
    SPREAD_CALL(STGetKSP(st, &inverse));
    SPREAD_CALL(KSPSetType(inverse, KSPPREONLY));
    SPREAD_CALL(KSPGetPC(inverse, &solver));
    SPREAD_CALL(PCSetType(solver, PCSHELL));
    SPREAD_CALL(PCShellSetContext(solver, search));
    SPREAD_CALL(PCShellSetApply(solver, apply));
}

static EPS prepare(struct search *search, size_t wanted, uint64_t seed)
{
    EPS eps;
    BV basis;
    PetscRandom random;
    SPREAD_CALL(EPSCreate(PETSC_COMM_WORLD, &eps));
    set_problem(search, eps);
    PetscInt n = (PetscInt)(3 * search->spread->share.node_count);
    PetscInt room = (PetscInt)(2 * wanted + SEARCH_ROOM);
    SPREAD_CALL(EPSSetDimensions(eps, (PetscInt)wanted, room < n ? room : n, PETSC_DEFAULT));
    SPREAD_CALL(EPSSetTolerances(eps, RESIDUAL, MOST_RESTARTS));
    SPREAD_CALL(EPSSetStoppingTestFunction(eps, stop, search, NULL));
    if (search->kept_count > 0)
        SPREAD_CALL(EPSSetDeflationSpace(eps, (PetscInt)search->kept_count, search->kept));
    SPREAD_CALL(EPSGetBV(eps, &basis));
    SPREAD_CALL(BVGetRandomContext(basis, &random));
    SPREAD_CALL(PetscRandomSetSeed(random, (unsigned long)seed));
    SPREAD_CALL(PetscRandomSeed(random));
    return eps;
}

/* Seeks `wanted` modes beside those that are kept, and keeps them too. */
static enum percuss_status seek(struct search *search, size_t wanted, uint64_t seed)
{
    EPS eps = prepare(search, wanted, seed);
    PetscInt converged;
    SPREAD_CALL(EPSSolve(eps));
    SPREAD_CALL(EPSGetConverged(eps, &converged));
    bool fine = !search->stopped && (size_t)converged >= wanted;
    for (size_t i = 0; fine && i < wanted; i++) {
        size_t mode = search->kept_count - search->task->rigid_count;
        Vec *shape = &search->kept[search->kept_count++];
        SPREAD_CALL(MatCreateVecs(search->spread->mass, shape, NULL));
        SPREAD_CALL(EPSGetEigenpair(eps, (PetscInt)i, &search->squares[mode], NULL, *shape, NULL));
        search->squares[mode] -= search->task->shift;
    }
    SPREAD_CALL(EPSDestroy(&eps));
    return fine ? PERCUSS_OK : search->stopped ? PERCUSS_TIMEOUT : PERCUSS_INTERNAL;
}

/* Rigid motions to all processes. */
static void keep_rigid(struct search *search)
{
    const struct spread *spread = search->spread;
    size_t n = 3 * spread->share.node_count;
    for (size_t i = 0; i < search->task->rigid_count; i++) {
        Vec *motion = &search->kept[search->kept_count++];
        double *values;
        SPREAD_CALL(MatCreateVecs(spread->mass, motion, NULL));
        SPREAD_CALL(VecGetArray(*motion, &values));
        spread_scatter(&spread->rows, spread->rows.rank == 0 ? search->task->rigid + i * n : NULL,
                       values);
        SPREAD_CALL(VecRestoreArray(*motion, &values));
    }
}

/* Sorts modes by frequency. */
static void sort(struct search *search)
{
    Vec *modes = search->kept + search->task->rigid_count;
    size_t count = search->kept_count - search->task->rigid_count;
    for (size_t i = 1; i < count; i++)
        for (size_t k = i; k > 0 && search->squares[k] < search->squares[k - 1]; k--) {
            double square = search->squares[k];
            Vec mode = modes[k];
            search->squares[k] = search->squares[k - 1];
            modes[k] = modes[k - 1];
            search->squares[k - 1] = square;
            modes[k - 1] = mode;
        }
}

/* The lowest to the first process. */
static void collect(struct search *search, double *squares, double *shapes)
{
    const struct spread *spread = search->spread;
    size_t n = 3 * spread->share.node_count;
    memcpy(squares, search->squares, search->task->count * sizeof *squares);
    for (size_t i = 0; i < search->task->count; i++) {
        const double *values;
        Vec mode = search->kept[search->task->rigid_count + i];
        SPREAD_CALL(VecGetArrayRead(mode, &values));
        spread_gather(&spread->rows, values, spread->rows.rank == 0 ? shapes + i * n : NULL);
        SPREAD_CALL(VecRestoreArrayRead(mode, &values));
    }
}

enum percuss_status spread_modes(struct spread *spread, const struct spread_modes_task *task,
                                 double *squares, double *shapes)
{
    struct search search = {.spread = spread, .task = task};
    size_t most = task->count + MOST_SEARCHES;
    SPREAD_CALL(PetscCalloc2(task->rigid_count + most, &search.kept, most, &search.squares));
    keep_rigid(&search);
    enum percuss_status status = seek(&search, task->count, task->seed);
    if (!status)
        sort(&search);

    /* until the lowest of all others lies above */
    for (int i = 0; !status && i < MOST_SEARCHES; i++) {
        size_t found = search.kept_count - task->rigid_count;
        double highest = search.squares[task->count - 1];
        status = seek(&search, 1, task->seed + 1 + (uint64_t)i);
        if (status || search.squares[found] >= highest)
            break;
        sort(&search);
    }
    if (!status)
        collect(&search, squares, shapes);
    for (size_t i = 0; i < search.kept_count; i++)
        SPREAD_CALL(VecDestroy(&search.kept[i]));
    SPREAD_CALL(PetscFree2(search.kept, search.squares));
    return status;
}
