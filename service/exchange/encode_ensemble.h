/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The report of an ensemble, as a reply on the wire. */
#ifndef PERCUSS_EXCHANGE_ENCODE_ENSEMBLE_H
#define PERCUSS_EXCHANGE_ENCODE_ENSEMBLE_H

#include "ensemble/report.h"
#include "exchange/answer.h"

/* How the ensemble ended: PERCUSS_OK, or PERCUSS_TRUNCATED with the reason. */
struct ensemble_ending {
    enum percuss_status status;
    const char *message;
};

/* The reply; `timing` is zero. NULL: out of memory. */
struct answer *encode_ensemble(const struct envelope *envelope, const struct ensemble *ensemble,
                               const struct ensemble_report *report,
                               const struct ensemble_ending *ending);

/* Number of columns of a listed sample. */
size_t encode_sample_columns(const struct ensemble *ensemble);

/* One listed sample: that many numbers. */
void encode_sample(const struct ensemble *ensemble, uint64_t index,
                   const struct ensemble_sample *sample, double *row);

#endif
