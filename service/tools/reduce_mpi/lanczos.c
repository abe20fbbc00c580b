/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The functions of reduce/factor.h and reduce/lanczos.h by all processes together, with MUMPS and
 * SLEPc: in place of reduce/factor.c and reduce/lanczos.c. */
#include "reduce/lanczos.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "reduce/factor.h"
#include "reduce_mpi/spread.h"
#include "reduce_mpi/spread_modes.h"
#include "reduce_mpi/team.h"

/* MUMPS's reports of all processes (INFOG): entries of L, negative pivots, and megabytes of the
 * process that takes most. */
enum { ENTRIES = 3, NEGATIVES = 12, MOST_MEGABYTES = 16 };

struct factor {
    const struct matrices *matrices;
    enum factor_kind kind;
    struct spread spread;
};

/* The name that the other processes know it by. */
static uint64_t factor_key(const struct factor *factor)
{
    return (uint64_t)(uintptr_t)factor;
}

static enum percuss_status no_memory(struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL, "out of memory for the factor of a mesh");
}

/* -13 and the like are MUMPS's words for memory. */
static enum percuss_status judge_outcome(struct spread_outcome outcome, struct fault *fault)
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

/* PETSc orders the unknowns of each factor itself. */
enum percuss_status factor_analyse(const struct matrices *matrices, enum factor_kind kind,
                                   const struct factor *like, struct factor **factor,
                                   struct fault *fault)
{
    (void)like;
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
    enum percuss_status status = judge_outcome(outcome, fault);
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
    enum percuss_status status = judge_outcome(outcome, fault);
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
    return judge_outcome(outcome, fault);
}

/* a copy is no member of the team */
bool factor_forks(void)
{
    return false;
}

size_t factor_negatives(const struct factor *factor)
{
    return (size_t)spread_info(&factor->spread, NEGATIVES);
}

void factor_free(struct factor *factor)
{
    if (!factor)
        return;
    team_order((struct team_order){.key = factor_key(factor), .job = TEAM_FREE});
    spread_free(&factor->spread);
    free(factor);
}

/* Unknowns that can move elastically. */
static size_t free_count(const struct lanczos_input *input)
{
    size_t n = input->matrices->stiffness.n, moving = n;
    for (size_t i = 0; input->matrices->held && i < n; i++)
        moving -= input->matrices->held[i];
    return moving - input->rigid.count;
}

static enum percuss_status run_search(const struct lanczos_input *input, double *omega,
                                      double *shapes, struct fault *fault)
{
    struct spread_modes_task task = {.count = input->count,
                                     .rigid_count = input->rigid.count,
                                     .shift = input->shift,
                                     .seed = input->seed,
                                     .rigid = input->rigid.values,
                                     .watch = input->watch};
    team_order((struct team_order){.key = factor_key(input->factor),
                                   .job = TEAM_MODES,
                                   .shift = input->shift,
                                   .count = input->count,
                                   .rigid_count = input->rigid.count,
                                   .seed = input->seed});
    enum percuss_status status = spread_modes(&input->factor->spread, &task, omega, shapes);
    for (size_t i = 0; i < input->count; i++)
        omega[i] = sqrt(fmax(omega[i], 0.0));
    if (status == PERCUSS_TIMEOUT)
        return fault_set(fault, status, "stopped");
    return status ? fault_set(fault, status, "%zu modes: SLEPc does not converge", input->count)
                  : PERCUSS_OK;
}

enum percuss_status lanczos_modes(const struct lanczos_input *input, double **omega,
                                  double **shapes, struct fault *fault)
{
    size_t count = input->count;
    *omega = *shapes = NULL;
    if (count + 1 > free_count(input))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%zu modes: must be less than %zu", count,
                         free_count(input));
    *omega = calloc(count + 1, sizeof **omega);
    *shapes = malloc((count * input->matrices->stiffness.n + 1) * sizeof **shapes);
    enum percuss_status status = PERCUSS_OK;
    if (!*omega || !*shapes)
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory for %zu modes", count);
    else if (count > 0)
        status = run_search(input, *omega, *shapes, fault);
    if (status) {
        free(*omega);
        free(*shapes);
        *omega = *shapes = NULL;
    }
    return status;
}

/* Krylov-Schur works in twice the modes and some more, as spread_modes.c has it. */
size_t lanczos_expected_vectors(size_t count)
{
    return 2 * count + 8 * LANCZOS_BLOCK;
}
