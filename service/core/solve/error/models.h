/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Errors of the models themselves, beside modes and steps: their deviations (deviation.h), as far
 * as the answer is sensitive to them. Of a single contact by the energy that it leaves as
 * vibration; a sequence of sub-impacts, which may amplify them, is followed by first and second
 * order, or solved again with a softer contact and a stiffer one where these do not tell. */
#ifndef PERCUSS_SOLVE_ERROR_MODELS_H
#define PERCUSS_SOLVE_ERROR_MODELS_H

#include "solve/error/deviation.h"
#include "solve/solution.h"

/* PERCUSS_OK, PERCUSS_INTERNAL or PERCUSS_TIMEOUT. */
enum percuss_status models_find_error(const struct problem *problem,
                                      const struct solution *solution, struct pace *pace,
                                      struct model_error *error);

/* The error of complete finite elements, which have neither modes nor a law: strains that are not
 * small, a block that is taken as round. */
double models_complete_error(const struct problem *problem, const struct model_impact *impact);

#endif
