/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What reduce/factor.h promises, by all processes together: in place of reduce/factor.c. */
#include "reduce_mpi/factor.h"

#include <limits.h>
#include <stdlib.h>

#include "reduce_mpi/team.h"

/* What MUMPS reports of all processes (INFOG): entries of L, negative pivots, and megabytes of the
 * process that takes most. */
enum { ENTRIES = 3, NEGATIVES = 12, MOST_MEGABYTES = 16 };

struct factor {
    const struct matrices *matrices;
    enum factor_kind kind;
    struct spread spread;
};

static enum percuss_status no_memory(struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL, "out of memory for the factor of a mesh");
}

/* -13 and the like are MUMPS's words for memory. */
static enum percuss_status judge(struct spread_outcome outcome, struct fault *fault)
{
    int code = outcome.code;
    if (code >= 0)
        return PERCUSS_OK;
    if (code == -6 || code == -10)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "stiffness: is singular: nodes must be joined to the body and every part "
                         "have a stiffness");
    if (code == -7 || code == -9 || code == -13 || code == -19 || code == -20)
        return no_memory(fault);
    return fault_set(fault, PERCUSS_INTERNAL, "MUMPS: error %d (%d)", code, outcome.detail);
}

enum percuss_status factor_analyse(const struct matrices *matrices, enum factor_kind kind,
                                   struct factor **factor, struct fault *fault)
{
    *factor = NULL;
    /* rows are numbered in int */
    if (matrices->stiffness.n == 0 || matrices->stiffness.n > INT_MAX)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%zu degrees of freedom: must be 1 to %d",
                         matrices->stiffness.n, INT_MAX);
    struct factor *made = calloc(1, sizeof *made);
    if (!made)
        return no_memory(fault);
    made->matrices = matrices;
    made->kind = kind;
    /* the others are told to begin, and this one does its own share */
    bool positive = kind == FACTOR_POSITIVE;
    struct spread_outcome outcome;
    team_order(
        (struct team_order){.key = factor_key(made), .job = TEAM_MAKE, .positive = positive});
    spread_make(&made->spread, matrices, positive, &outcome);
    enum percuss_status status = judge(outcome, fault);
    if (status)
        factor_free(made);
    else
        *factor = made;
    return status;
}

/* Counts above 2^31 come as millions with a minus sign. */
static double count_of(int info)
{
    return info < 0 ? -1e6 * info : info;
}

struct factor_cost factor_cost(const struct factor *factor)
{
    const struct spread *spread = &factor->spread;
    double operations;
    SPREAD_CALL(MatMumpsGetRinfog(spread->factor, 1, &operations));
    return (struct factor_cost){.memory =
                                    1e6 * spread_info(spread, MOST_MEGABYTES) * spread->neighbours,
                                .operations = operations,
                                .entries = count_of(spread_info(spread, ENTRIES))};
}

enum percuss_status factor_compute(struct factor *factor, double shift, struct fault *fault)
{
    struct spread_outcome outcome;
    team_order((struct team_order){.key = factor_key(factor), .job = TEAM_COMPUTE, .shift = shift});
    spread_compute(&factor->spread, shift, &outcome);
    enum percuss_status status = judge(outcome, fault);
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
    struct spread_outcome outcome;
    for (size_t i = 0; held && i < count * n; i++)
        if (held[i % n])
            b[i] = 0.0;
    team_order((struct team_order){.key = factor_key(factor), .job = TEAM_SOLVE, .count = count});
    spread_solve(&factor->spread, count, b, &outcome);
    return judge(outcome, fault);
}

size_t factor_negatives(const struct factor *factor)
{
    return (size_t)spread_info(&factor->spread, NEGATIVES);
}

struct spread *factor_spread(struct factor *factor)
{
    return &factor->spread;
}

uint64_t factor_key(const struct factor *factor)
{
    return (uint64_t)(uintptr_t)factor;
}

void factor_free(struct factor *factor)
{
    if (!factor)
        return;
    team_order((struct team_order){.key = factor_key(factor), .job = TEAM_FREE});
    spread_free(&factor->spread);
    free(factor);
}
