/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the models themselves may be wrong by, beside modes and steps: their deviations
 * (model_deviation.h), as far as the answer is sensitive to them. Of a single contact by the energy
 * that it leaves as vibration; a sequence of sub-impacts, which may amplify them, is followed by
 * first and second order, or solved again with a softer contact and a stiffer one where these do
 * not tell.
 */
#ifndef PERCUSS_SOLVE_MODEL_ERROR_H
#define PERCUSS_SOLVE_MODEL_ERROR_H

#include "solve/model_deviation.h"
#include "solve/solution.h"

struct model_error {
    double restitution;                   /* of the contact where it is largest */
    double yield;                         /* what metals whose yield is not stated add to it */
    double impulse[PERCUSS_MAX_CONTACTS]; /* of each contact, N s; INFINITY: nobody knows */
};

/* PERCUSS_OK, PERCUSS_INTERNAL or PERCUSS_TIMEOUT. */
enum percuss_status model_error_find(const struct problem *problem, const struct solution *solution,
                                     struct pace *pace, struct model_error *error);

/* The same of complete finite elements, which have neither modes nor a law: strains that are not
 * small, a block that is taken as round. */
double model_error_complete(const struct problem *problem, const struct model_blow *blow);

#endif
