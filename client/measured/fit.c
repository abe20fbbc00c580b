/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fit.h"

#include <cminpack.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "distance.h"

/* Relative change of the sum of squares, and of the parameters, at which to stop: the parameters
 * are known to some 1e-3 at best. */
static const double CLOSE_ENOUGH = 1e-6;
/* A combination of parameters that moves the residuals less than this share of the strongest one is
 * not determined at all. */
static const double RANK_TOLERANCE = 1e-6;
enum { MOST_EVALUATIONS = 200 };

static int evaluate(void *context, int residuals, int parameters, const double *x, double *values,
                    int flag)
{
    const struct fit_problem *problem = context;
    (void)residuals, (void)parameters, (void)flag;
    return problem->evaluate(problem->context, x, values) ? 0 : -1;
}

/* Memory of MINPACK, one block. */
struct memory {
    double *residuals, *jacobian, *qtf, *work[3], *work_long;
    int *pivot;
    double *block;
};

static bool take(struct memory *memory, size_t m, size_t n)
{
    memory->block = calloc(2 * m + m * n + 4 * n, sizeof(double));
    memory->pivot = calloc(n, sizeof *memory->pivot);
    double *at = memory->block;
    if (!at || !memory->pivot)
        return false;
    memory->residuals = at;
    memory->work_long = at + m;
    memory->jacobian = at + 2 * m;
    memory->qtf = memory->jacobian + m * n;
    for (size_t i = 0; i < 3; ++i)
        memory->work[i] = memory->qtf + (i + 1) * n;
    return true;
}

/* Covariances from the triangular factor of the Jacobian; a parameter in the part that has no rank
 * gets none. */
static void find_intervals(struct memory *memory, size_t m, size_t n, struct fit *fit)
{
    double *r = memory->jacobian;
    double scale = fit->sum / fit->freedom, quantile = student_quantile(0.975, fit->freedom);
    bool lost[FIT_PARAMETERS] = {false};
    for (size_t k = 0; k < n; ++k)
        lost[memory->pivot[k] - 1] = fabs(r[k * m + k]) <= RANK_TOLERANCE * fabs(r[0]);
    covar((int)n, r, (int)m, memory->pivot, RANK_TOLERANCE, memory->work[0]);
    for (size_t i = 0; i < n; ++i) {
        double variance = scale * r[i * m + i];
        fit->deviation[i] = lost[i] ? INFINITY : sqrt(variance);
        fit->half_width[i] = quantile * fit->deviation[i];
        for (size_t j = 0; j < n; ++j)
            fit->correlation[i][j] =
                lost[i] || lost[j] ? NAN : r[i * m + j] / sqrt(r[i * m + i] * r[j * m + j]);
    }
}

bool fit_solve(const struct fit_problem *problem, struct fit *fit)
{
    size_t m = problem->residuals, n = problem->parameters;
    struct memory memory = {0};
    double scale[FIT_PARAMETERS];
    int evaluations = 0;
    if (n < 1 || n > FIT_PARAMETERS || m <= n || !take(&memory, m, n)) {
        free(memory.block);
        free(memory.pivot);
        return false;
    }
    for (size_t i = 0; i < n; ++i)
        scale[i] = 1.0;
    int info =
        lmdif(evaluate, (void *)problem, (int)m, (int)n, fit->x, memory.residuals, CLOSE_ENOUGH,
              CLOSE_ENOUGH, 0.0, MOST_EVALUATIONS, problem->difference * problem->difference, scale,
              2, 1.0, 0, &evaluations, memory.jacobian, (int)m, memory.pivot, memory.qtf,
              memory.work[0], memory.work[1], memory.work[2], memory.work_long);
    if (info > 0) {
        fit->evaluations = (unsigned)evaluations;
        fit->freedom = (double)(m - n);
        fit->sum = 0.0;
        for (size_t i = 0; i < m; ++i)
            fit->sum += memory.residuals[i] * memory.residuals[i];
        find_intervals(&memory, m, n, fit);
    }
    free(memory.block);
    free(memory.pivot);
    return info > 0;
}
