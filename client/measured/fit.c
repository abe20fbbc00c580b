/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fit.h"

#include <cminpack.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "distance.h"

/* Relative change of the sum of squares at which to stop: a tenth of a standard deviation of the
 * parameters for a hundred residuals; and of the parameters. */
static const double FLAT_ENOUGH = 1e-4, CLOSE_ENOUGH = 1e-5;
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
    for (size_t i = 0; i < 3; i++)
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
    for (size_t k = 0; k < n; k++)
        lost[memory->pivot[k] - 1] = fabs(r[k * m + k]) <= RANK_TOLERANCE * fabs(r[0]);
    covar((int)n, r, (int)m, memory->pivot, RANK_TOLERANCE, memory->work[0]);
    for (size_t i = 0; i < n; i++) {
        double variance = scale * r[i * m + i];
        fit->deviation[i] = lost[i] ? INFINITY : sqrt(variance);
        fit->half_width[i] = quantile * fit->deviation[i];
        for (size_t j = 0; j < n; j++)
            fit->correlation[i][j] =
                lost[i] || lost[j] ? NAN : r[i * m + j] / sqrt(r[i * m + i] * r[j * m + j]);
    }
}

/* Inverts a symmetric positive definite matrix of n rows in place (Gauss and Jordan). */
static void invert(double a[FIT_PARAMETERS][FIT_PARAMETERS], size_t n)
{
    for (size_t k = 0; k < n; k++) {
        double pivot = 1.0 / a[k][k];
        a[k][k] = 1.0;
        for (size_t j = 0; j < n; j++)
            a[k][j] *= pivot;
        for (size_t i = 0; i < n; i++) {
            double factor = a[i][k];
            if (i == k)
                continue;
            a[i][k] = 0.0;
            for (size_t j = 0; j < n; j++)
                a[i][j] -= factor * a[k][j];
        }
    }
}

/* Derivatives by central differences at the solution, column by column. */
static bool differentiate(const struct fit_problem *problem, const struct fit *fit,
                          double *jacobian)
{
    size_t m = problem->residuals;
    double *other = calloc(m, sizeof *other);
    bool good = other != NULL;
    for (size_t k = 0; good && k < problem->parameters; k++) {
        double x[FIT_PARAMETERS], h = problem->difference * fmax(fabs(fit->x[k]), 0.1);
        memcpy(x, fit->x, sizeof x);
        x[k] = fit->x[k] + h;
        good = problem->evaluate(problem->context, x, jacobian + k * m);
        x[k] = fit->x[k] - h;
        good = good && problem->evaluate(problem->context, x, other);
        for (size_t i = 0; i < m; i++)
            jacobian[k * m + i] = (jacobian[k * m + i] - other[i]) / (2.0 * h);
    }
    free(other);
    return good;
}

/* The sum over groups of the outer product of their gradients, J_g^T r_g. */
static bool scatter_of_groups(const struct fit_problem *problem, const double *jacobian,
                              const double *residuals, double sum[FIT_PARAMETERS][FIT_PARAMETERS])
{
    size_t n = problem->parameters;
    double(*gradient)[FIT_PARAMETERS] = calloc(problem->groups, sizeof *gradient);
    if (!gradient)
        return false;
    for (size_t i = 0; i < problem->residuals; i++)
        for (size_t k = 0; k < n; k++)
            gradient[problem->group[i]][k] += jacobian[k * problem->residuals + i] * residuals[i];
    for (size_t g = 0; g < problem->groups; g++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                sum[i][j] += gradient[g][i] * gradient[g][j];
    free(gradient);
    return true;
}

/* Replaces the intervals by those of the sandwich (J^T J)^-1 B (J^T J)^-1, where B is the scatter
 * of the groups (Huber 1967, Liang and Zeger 1986). Parameters without rank stay as they are. */
static bool find_grouped_intervals(const struct fit_problem *problem, struct memory *memory,
                                   struct fit *fit)
{
    size_t n = problem->parameters, m = problem->residuals, map[FIT_PARAMETERS], count = 0;
    double a[FIT_PARAMETERS][FIT_PARAMETERS] = {{0.0}}, b[FIT_PARAMETERS][FIT_PARAMETERS] = {{0.0}};
    double variance[FIT_PARAMETERS][FIT_PARAMETERS] = {{0.0}};
    fit->freedom = (double)problem->groups - (double)n;
    if (!(fit->freedom >= 1.0) || !differentiate(problem, fit, memory->jacobian) ||
        !scatter_of_groups(problem, memory->jacobian, memory->residuals, b))
        return false;
    for (size_t k = 0; k < n; k++)
        if (isfinite(fit->deviation[k]))
            map[count++] = k;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++)
            for (size_t r = 0; r < m; r++)
                a[i][j] += memory->jacobian[map[i] * m + r] * memory->jacobian[map[j] * m + r];
    invert(a, count);
    /* the sandwich, widened for few groups */
    double scale = (double)problem->groups / fit->freedom;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++)
            for (size_t k = 0; k < count; k++)
                for (size_t l = 0; l < count; l++)
                    variance[i][j] += scale * a[i][k] * b[map[k]][map[l]] * a[l][j];
    for (size_t i = 0; i < count; i++) {
        fit->deviation[map[i]] = sqrt(variance[i][i]);
        fit->half_width[map[i]] = student_quantile(0.975, fit->freedom) * sqrt(variance[i][i]);
        for (size_t j = 0; j < count; j++)
            fit->correlation[map[i]][map[j]] =
                variance[i][j] / sqrt(variance[i][i] * variance[j][j]);
    }
    return true;
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
    for (size_t i = 0; i < n; i++)
        scale[i] = 1.0;
    int info =
        lmdif(evaluate, (void *)problem, (int)m, (int)n, fit->x, memory.residuals, FLAT_ENOUGH,
              CLOSE_ENOUGH, 0.0, MOST_EVALUATIONS, problem->difference * problem->difference, scale,
              2, 1.0, 0, &evaluations, memory.jacobian, (int)m, memory.pivot, memory.qtf,
              memory.work[0], memory.work[1], memory.work[2], memory.work_long);
    /* the residuals, and the intervals of the parameters by them */
    if (info > 0) {
        fit->evaluations = (unsigned)evaluations;
        fit->freedom = (double)(m - n);
        fit->sum = 0.0;
        for (size_t i = 0; i < m; i++)
            fit->sum += memory.residuals[i] * memory.residuals[i];
        find_intervals(&memory, m, n, fit);
    }
    bool good = info > 0 && (!problem->group || find_grouped_intervals(problem, &memory, fit));
    free(memory.block);
    free(memory.pivot);
    return good;
}
