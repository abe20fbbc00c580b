/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests from the wire, validated number by number: a single one as the solver takes it, an
 * ensemble as the layer of ensembles takes it. */
#ifndef PERCUSS_EXCHANGE_DECODE_H
#define PERCUSS_EXCHANGE_DECODE_H

#include "ensemble/spec.h"
#include "percuss_wire.h"
#include "solve/request.h"

/* Fills `request` (unused elements of its arrays stay as they were). PERCUSS_OK, or
 * PERCUSS_BAD_REQUEST with a message like "contacts[0].normal: (0, 0, 2): must be a unit vector
 * (norm within 0.0001 of 1)". `request->delassus` points into `wire`. The states of the bodies are
 * NULL: the owner of the stores looks up state tokens and specimens. */
enum percuss_status decode_request(const percuss_v1_Request *wire, struct solve_request *request,
                                   struct fault *fault);

enum { DECODE_MAX_CORRELATIONS = ENSEMBLE_MAX_INPUTS * (ENSEMBLE_MAX_INPUTS - 1) / 2 };

/* The spec points to its neighbours here and, for lists, into the sample. */
struct decoded_ensemble {
    struct ensemble_spec spec; /* the catalogue is the caller's to set */
    struct solve_request request;
    struct ensemble_input inputs[ENSEMBLE_MAX_INPUTS];
    struct copula_pair correlations[DECODE_MAX_CORRELATIONS];
};

/* PERCUSS_OK, or PERCUSS_BAD_REQUEST with the field, its value and the allowed ones, for errors of
 * the wire's form. ensemble_create checks the ranges of the numbers. State tokens are refused: they
 * name one instant, not a distribution. */
enum percuss_status decode_ensemble(const percuss_v1_EnsembleRequest *wire,
                                    struct decoded_ensemble *decoded, struct fault *fault);

#endif
