/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/copula.h"

#include <math.h>
#include <stdlib.h>

#include "ensemble/sampling.h"
#include "numeric/special.h"

/* In place, lower triangle. False: not positive definite. */
static bool factorise(double *a, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++) {
            double sum = a[i * n + j];
            for (size_t k = 0; k < j; k++)
                sum -= a[i * n + k] * a[j * n + k];
            if (i == j && !(sum > 1e-12))
                return false;
            a[i * n + j] = i == j ? sqrt(sum) : sum / a[j * n + j];
        }
    }
    return true;
}

static enum percuss_status fill(double *matrix, size_t n, const struct copula_pair *pairs,
                                size_t count, struct fault *fault)
{
    for (size_t i = 0; i < n; i++)
        matrix[i * n + i] = 1.0;
    for (size_t p = 0; p < count; p++) {
        const struct copula_pair *pair = &pairs[p];
        if (!(fabs(pair->coefficient) < 1.0))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "correlations[%zu].coefficient: %g: must be between -1 and 1", p,
                             pair->coefficient);
        matrix[pair->first * n + pair->second] = pair->coefficient;
        matrix[pair->second * n + pair->first] = pair->coefficient;
    }
    return PERCUSS_OK;
}

enum percuss_status copula_create(struct copula *copula, size_t dimensions,
                                  const struct copula_pair *pairs, size_t pair_count,
                                  struct fault *fault)
{
    *copula = (struct copula){.dimensions = dimensions};
    if (pair_count == 0)
        return PERCUSS_OK;
    copula->factor = calloc(dimensions * dimensions, sizeof *copula->factor);
    if (!copula->factor)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = fill(copula->factor, dimensions, pairs, pair_count, fault);
    if (!status && !factorise(copula->factor, dimensions))
        status = fault_set(fault, PERCUSS_BAD_REQUEST,
                           "correlations: no distribution has these coefficients: the matrix must "
                           "be positive definite");
    if (status)
        copula_release(copula);
    return status;
}

void copula_release(struct copula *copula)
{
    free(copula->factor);
    copula->factor = NULL;
}

void copula_apply(const struct copula *copula, double *point)
{
    size_t n = copula->dimensions;
    double z[SAMPLING_MAX_DIMENSIONS];
    if (!copula->factor)
        return;
    for (size_t i = 0; i < n; i++)
        z[i] = special_normal_quantile(point[i]);
    for (size_t i = 0; i < n; i++) {
        double sum = 0.0;
        for (size_t j = 0; j <= i; j++)
            sum += copula->factor[i * n + j] * z[j];
        point[i] = fmax(0x1p-54, fmin(special_normal_cdf(sum), 1.0 - 0x1p-53));
    }
}
