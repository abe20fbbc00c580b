/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An ensemble from the wire, as the layer below takes it. */
#ifndef PERCUSS_EXCHANGE_DECODE_ENSEMBLE_H
#define PERCUSS_EXCHANGE_DECODE_ENSEMBLE_H

#include "ensemble/spec.h"
#include "percuss_wire.h"

enum { DECODE_MAX_CORRELATIONS = ENSEMBLE_MAX_INPUTS * (ENSEMBLE_MAX_INPUTS - 1) / 2 };

/* The spec points to its neighbours here and, for lists, into the sample. */
struct decoded_ensemble {
    struct ensemble_spec spec; /* the catalogue is the caller's to set */
    struct solve_request request;
    struct ensemble_input inputs[ENSEMBLE_MAX_INPUTS];
    struct copula_pair correlations[DECODE_MAX_CORRELATIONS];
};

/* PERCUSS_OK, or PERCUSS_BAD_REQUEST with the field, its value and what is allowed: what the wire
 * can say wrong. Ranges of the numbers are ensemble_create's to judge. State tokens are refused:
 * they name one instant, not a distribution. */
enum percuss_status decode_ensemble(const percuss_v1_EnsembleRequest *wire,
                                    struct decoded_ensemble *decoded, struct fault *fault);

#endif
