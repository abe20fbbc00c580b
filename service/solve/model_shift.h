/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A problem whose models are wrong by what the request says (request->model_shift): for ensembles
 * that take the models' error as one of their inputs. */
#ifndef PERCUSS_SOLVE_MODEL_SHIFT_H
#define PERCUSS_SOLVE_MODEL_SHIFT_H

#include "solve/problem.h"

/* Shifts the laws in use, all by the same deviates, and what is in series with them. To be called
 * again where other laws or compliances were chosen. PERCUSS_OK or PERCUSS_INTERNAL. */
enum percuss_status model_shift_apply(struct problem *problem, struct fault *fault);

#endif
