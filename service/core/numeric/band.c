/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/band.h"

#include <lapacke.h>

#include "numeric/linear.h"

static bool factor_from(struct band *band, size_t first)
{
    linear_turn_begin();
    lapack_int result = LAPACKE_dpbtrf_work(LAPACK_COL_MAJOR, 'L', (lapack_int)(band->n - first),
                                            (lapack_int)band->width, band_entry(band, first, first),
                                            (lapack_int)(band->width + 1));
    linear_turn_end();
    return result == 0;
}

bool band_factor(struct band *band)
{
    return factor_from(band, 0);
}

/* the row after the last that a column reaches, not past `end` */
static size_t band_reach(const struct band *band, size_t column, size_t end)
{
    size_t beyond = column + band->width + 1;
    return beyond < end ? beyond : end;
}

bool band_factor_trailing(struct band *band, const struct band *leading, size_t first)
{
    /* A_22 - L_21 L_21^T: only the last `width` columns before `first` reach beyond it */
    for (size_t k = first > band->width ? first - band->width : 0; k < first; k++)
        for (size_t j = first; j < band_reach(band, k, band->n); j++) {
            double factor = *band_entry(leading, j, k);
            for (size_t i = j; i < band_reach(band, k, band->n); i++)
                *band_entry(band, i, j) -= factor * *band_entry(leading, i, k);
        }
    return factor_from(band, first);
}

void band_forward(const struct band *factor, size_t first, size_t end, double *b)
{
    for (size_t j = first; j < end; j++) {
        const double *column = band_entry(factor, j, j);
        double value = b[j] / column[0];
        b[j] = value;
        size_t beyond = band_reach(factor, j, end);
        for (size_t i = j + 1; i < beyond; i++)
            b[i] -= value * column[i - j];
    }
}

void band_backward(const struct band *factor, size_t first, size_t end, double *b)
{
    for (size_t j = end; j-- > first;) {
        const double *column = band_entry(factor, j, j);
        double sum = b[j];
        size_t beyond = band_reach(factor, j, end);
        for (size_t i = j + 1; i < beyond; i++)
            sum -= column[i - j] * b[i];
        b[j] = sum / column[0];
    }
}

void band_carry_forward(const struct band *factor, size_t first, const double *y, double *b)
{
    for (size_t k = first > factor->width ? first - factor->width : 0; k < first; k++)
        for (size_t i = first; i < band_reach(factor, k, factor->n); i++)
            b[i] -= *band_entry(factor, i, k) * y[k];
}

void band_carry_backward(const struct band *factor, size_t first, const double *y, double *b)
{
    for (size_t k = first > factor->width ? first - factor->width : 0; k < first; k++)
        for (size_t i = first; i < band_reach(factor, k, factor->n); i++)
            b[k] -= *band_entry(factor, i, k) * y[i];
}
