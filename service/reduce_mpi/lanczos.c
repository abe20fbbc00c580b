/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What reduce/lanczos.h promises, by SLEPc on all processes: in place of reduce/lanczos.c. */
#include "reduce/lanczos.h"

#include <math.h>
#include <stdlib.h>

#include "reduce_mpi/factor.h"
#include "reduce_mpi/spread_modes.h"
#include "reduce_mpi/team.h"

/* Unknowns that can move elastically. */
static size_t free_count(const struct lanczos_input *input)
{
    size_t n = input->matrices->stiffness.n, moving = n;
    for (size_t i = 0; input->matrices->held && i < n; i++)
        moving -= input->matrices->held[i];
    return moving - input->rigid.count;
}

static enum percuss_status run(const struct lanczos_input *input, double *omega, double *shapes,
                               struct fault *fault)
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
    enum percuss_status status = spread_modes(factor_spread(input->factor), &task, omega, shapes);
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
        status = run(input, *omega, *shapes, fault);
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
