/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One model for all samples. */
#ifndef PERCUSS_ENSEMBLE_CHOICE_H
#define PERCUSS_ENSEMBLE_CHOICE_H

#include "ensemble/ensemble.h"

/* Fills ensemble->model: the coarsest one that answers some pilot samples as the accuracy search
 * does. PERCUSS_OK; a refusal of all pilots; TIMEOUT where the watch (NULL: nobody) stopped it;
 * INTERNAL: out of memory. */
enum percuss_status choice_of_model(struct ensemble *ensemble, const struct watch *watch,
                                    struct fault *fault);

#endif
