/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The impact with its uncertain numbers replaced. */
#ifndef PERCUSS_ENSEMBLE_VARIATION_H
#define PERCUSS_ENSEMBLE_VARIATION_H

#include "ensemble/spec.h"

/* One worker's. */
struct variation {
    const struct ensemble_spec *spec;
    struct solve_request request;
    struct body_set set; /* the bodies of the impact, changed ones included */
    double gap_rate;     /* of the contact as stated, m/s */
};

/* PERCUSS_OK, INTERNAL without memory, or BAD_REQUEST for an input that this impact cannot have. */
enum percuss_status variation_create(struct variation *variation, const struct ensemble_spec *spec,
                                     struct fault *fault);
void variation_release(struct variation *variation);

/* Puts one value an input in place: variation->request and ->set. BAD_REQUEST: such a body cannot
 * exist. */
enum percuss_status variation_apply(struct variation *variation, const double *values,
                                    struct fault *fault);

/* Whether the inputs change a body of the set, but for its yield stress, so that nothing prepared
 * of it (modes, compliance) holds for other values. */
bool variation_changes_body(const struct variation *variation, const struct body *body);

#endif
