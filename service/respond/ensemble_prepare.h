/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* From a request to an ensemble whose samples can be solved. */
#ifndef PERCUSS_RESPOND_ENSEMBLE_PREPARE_H
#define PERCUSS_RESPOND_ENSEMBLE_PREPARE_H

#include "base/hash.h"
#include "exchange/decode.h"
#include "respond/ensemble_means.h"

struct ensemble_prepared {
    struct decoded_ensemble *decoded;
    struct ensemble ensemble;
    struct table_maker maker; /* of tables that are asked for; only finds them afterwards */
};

/* Fills what is zeroed; to be released whatever it returns. TIMEOUT: the watch stopped it. */
enum percuss_status ensemble_prepare(struct ensemble_prepared *prepared,
                                     const struct ensemble_means *means,
                                     const struct ensemble_question *question,
                                     const struct watch *watch, struct fault *fault);
void ensemble_prepared_release(struct ensemble_prepared *prepared);

/* The same for all who solve items of this ensemble alike: what is asked, the catalogue, the
 * version, the model that was chosen, and how an item lies in memory. */
struct digest ensemble_prepared_digest(const struct ensemble_prepared *prepared,
                                       const struct ensemble_question *question);

#endif
