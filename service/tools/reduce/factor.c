/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/factor.h"

#include <dmumps_c.h>
#include <limits.h>
#include <stdlib.h>

/* Numbers of MUMPS's controls, counted from one as in its manual. */
enum { ERRORS = 1, DIAGNOSTICS = 2, GLOBAL = 3, LEVEL = 4 };
enum { PERMUTATION = 6, ORDERING = 7, PIVOTS = 12, RELAXATION = 14, SOLVED_TOGETHER = 27 };
enum { INITIALISE = -1, FINISH = -2, ANALYSE = 1, FACTOR = 2, SOLVE = 3 };
enum { GIVEN = 1, SCOTCH = 3 };
enum { ANY_PROCESS = -987654, OFF = -1 };

struct factor {
    const struct matrices *matrices;
    enum factor_kind kind;
    DMUMPS_STRUC_C mumps;
    MUMPS_INT *row, *column; /* of K, then of M: entries of one place add up */
    double *value;
};

static MUMPS_INT *control(struct factor *factor, int number)
{
    return &factor->mumps.icntl[number - 1];
}

static enum percuss_status no_memory(struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL, "out of memory for the factor of a mesh");
}

/* Status of MUMPS's last job; -13 and the like stand for memory. */
static enum percuss_status outcome(const struct factor *factor, struct fault *fault)
{
    int code = factor->mumps.infog[0];
    if (code >= 0)
        return PERCUSS_OK;
    if (code == -10)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "stiffness: is singular: nodes must be joined to the body and every part "
                         "have a stiffness");
    if (code == -7 || code == -9 || code == -13 || code == -19 || code == -20)
        return no_memory(fault);
    return fault_set(fault, PERCUSS_INTERNAL, "MUMPS: error %d (%d)", code, factor->mumps.infog[1]);
}

static void run(struct factor *factor, int job)
{
    factor->mumps.job = job;
    dmumps_c(&factor->mumps);
}

/* Places of the entries, counted from one; returns how many. */
static size_t list_places(const struct sparse *matrix, MUMPS_INT *row, MUMPS_INT *column)
{
    for (size_t i = 0; i < matrix->n; i++)
        for (size_t p = matrix->start[i]; p < matrix->start[i + 1]; p++) {
            row[p] = (MUMPS_INT)i + 1;
            column[p] = (MUMPS_INT)matrix->column[p] + 1;
        }
    return matrix->start[matrix->n];
}

static bool place_entries(struct factor *factor)
{
    const struct sparse *k = &factor->matrices->stiffness, *m = &factor->matrices->mass;
    size_t count = k->start[k->n] + m->start[m->n];
    factor->row = malloc((count + 1) * sizeof *factor->row);
    factor->column = malloc((count + 1) * sizeof *factor->column);
    factor->value = malloc((count + 1) * sizeof *factor->value);
    if (!factor->row || !factor->column || !factor->value)
        return false;
    size_t first = list_places(k, factor->row, factor->column);
    list_places(m, factor->row + first, factor->column + first);
    factor->mumps.n = (MUMPS_INT)k->n;
    factor->mumps.nnz = (MUMPS_INT8)count;
    factor->mumps.irn = factor->row;
    factor->mumps.jcn = factor->column;
    factor->mumps.a = factor->value;
    return true;
}

enum percuss_status factor_analyse(const struct matrices *matrices, enum factor_kind kind,
                                   const struct factor *like, struct factor **factor,
                                   struct fault *fault)
{
    *factor = NULL;
    if (matrices->stiffness.n == 0 || matrices->stiffness.n > INT_MAX)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%zu degrees of freedom: must be 1 to %d",
                         matrices->stiffness.n, INT_MAX);
    struct factor *made = calloc(1, sizeof *made);
    if (!made)
        return no_memory(fault);
    made->matrices = matrices;
    made->kind = kind;
    made->mumps.sym = kind == FACTOR_POSITIVE ? 1 : 2;
    made->mumps.par = 1;
    made->mumps.comm_fortran = ANY_PROCESS;
    run(made, INITIALISE);
    enum percuss_status status = outcome(made, fault);
    /* silent; the order of unknowns follows from the places alone, and serves any shift */
    *control(made, ERRORS) = *control(made, DIAGNOSTICS) = *control(made, GLOBAL) = OFF;
    *control(made, LEVEL) = 0;
    *control(made, PERMUTATION) = 0;
    *control(made, ORDERING) = like ? GIVEN : SCOTCH;
    made->mumps.perm_in = like ? like->mumps.sym_perm : NULL;
    *control(made, PIVOTS) = 1;
    if (!status && !place_entries(made))
        status = no_memory(fault);
    if (!status) {
        run(made, ANALYSE);
        made->mumps.perm_in = NULL;
        status = outcome(made, fault);
    }
    if (status)
        factor_free(made);
    else
        *factor = made;
    return status;
}

struct factor_cost factor_cost(const struct factor *factor)
{
    const DMUMPS_STRUC_C *mumps = &factor->mumps;
    /* counts above 2^31 come as millions with a minus sign */
    double entries = mumps->infog[2] < 0 ? -1e6 * mumps->infog[2] : mumps->infog[2];
    double places = (double)mumps->nnz * (2.0 * sizeof(MUMPS_INT) + sizeof(double));
    return (struct factor_cost){1e6 * mumps->infog[15] + places, mumps->rinfog[0], entries};
}

enum percuss_status factor_compute(struct factor *factor, double shift, struct fault *fault)
{
    const struct sparse *k = &factor->matrices->stiffness, *m = &factor->matrices->mass;
    size_t first = k->start[k->n];
    for (size_t p = 0; p < first; p++)
        factor->value[p] = k->value[p];
    for (size_t p = 0; p < m->start[m->n]; p++)
        factor->value[first + p] = shift * m->value[p];
    /* pivots may need more room than was foreseen (errors -8, -9): twice as much each time */
    static const MUMPS_INT usual = 25, most = 800;
    for (MUMPS_INT room = usual; room <= most; room *= 2) {
        *control(factor, RELAXATION) = room;
        run(factor, FACTOR);
        if (factor->mumps.infog[0] != -8 && factor->mumps.infog[0] != -9)
            break;
    }
    enum percuss_status status = outcome(factor, fault);
    if (!status && factor->kind == FACTOR_POSITIVE && factor_negatives(factor) > 0)
        status = fault_set(fault, PERCUSS_BAD_REQUEST,
                           "stiffness: has %zu negative eigenvalues: elements must not be folded "
                           "and materials must be stable",
                           factor_negatives(factor));
    return status;
}

enum percuss_status factor_solve(struct factor *factor, size_t count, double *b,
                                 struct fault *fault)
{
    size_t n = factor->matrices->stiffness.n;
    const bool *held = factor->matrices->held;
    for (size_t i = 0; held && i < count * n; i++)
        if (held[i % n])
            b[i] = 0.0;
    *control(factor, SOLVED_TOGETHER) = (MUMPS_INT)count;
    factor->mumps.rhs = b;
    factor->mumps.nrhs = (MUMPS_INT)count;
    factor->mumps.lrhs = factor->mumps.n;
    run(factor, SOLVE);
    return outcome(factor, fault);
}

bool factor_forks(void)
{
    return true;
}

size_t factor_negatives(const struct factor *factor)
{
    return (size_t)factor->mumps.infog[11];
}

void factor_free(struct factor *factor)
{
    if (!factor)
        return;
    run(factor, FINISH);
    free(factor->row);
    free(factor->column);
    free(factor->value);
    free(factor);
}
