/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* From a request to an ensemble that is ready to be solved. */
#ifndef PERCUSS_ENSEMBLE_CREATE_H
#define PERCUSS_ENSEMBLE_CREATE_H

#include "ensemble/ensemble.h"

/* Checks the request and chooses the model, which takes some ten milliseconds, or seconds where
 * single impacts take long. PERCUSS_OK, or the refusal: of the ensemble, or of the impact as it is
 * stated; TIMEOUT where the watch (NULL: none) stopped it. */
enum percuss_status ensemble_create(struct ensemble *ensemble, const struct ensemble_spec *spec,
                                    const struct watch *watch, struct fault *fault);

#endif
