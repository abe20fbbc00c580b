/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An ensemble that is being answered: its parts so far. */
#ifndef PERCUSS_LIB_ENSEMBLE_EXCHANGE_H
#define PERCUSS_LIB_ENSEMBLE_EXCHANGE_H

#include <percuss/percuss.h>

#include "percuss_wire.h"

struct ensemble_exchange {
    struct percuss_ensemble_progress progress;
    unsigned heard; /* progress samples and parts so far */
    unsigned told;  /* progress samples so far */
    struct percuss_ensemble_reply reply;
    double *rows; /* of the listed samples */
    size_t columns, room, numbers;
    uint32_t parts, arrived;
};

/* Files a progress sample. */
void ensemble_exchange_note(struct ensemble_exchange *exchange,
                            const percuss_v1_EnsembleProgress *wire);

/* Files a part of the listed samples. Without memory it is dropped, and the list never complete. */
void ensemble_exchange_add(struct ensemble_exchange *exchange,
                           const percuss_v1_EnsembleSamples *wire);

/* Whether all listed samples of the reply are there. */
bool ensemble_exchange_is_complete(const struct ensemble_exchange *exchange);

#endif
