/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Boxes get their vibration where a scene needs it (model/ritz.h). */
#ifndef PERCUSS_SOLVE_VIBRATION_H
#define PERCUSS_SOLVE_VIBRATION_H

#include "base/fault.h"
#include "base/watch.h"
#include "solve/problem.h"

struct ritz_store;

/* Of the bodies that can vibrate once that is computed, those that vibrate already, are held, have
 * a stated number of modes, or would keep more of a blow than a tenth of the tolerance and 2e-5, by
 * the fastest approach of all; the others stay rigid, and their error holds it. They come from a
 * store of boxes (NULL: the worker's own). PERCUSS_OK, PERCUSS_INTERNAL, or PERCUSS_TIMEOUT where
 * the pace was stopped. */
enum percuss_status vibration_lend(struct problem *problem, struct ritz_store *boxes,
                                   struct pace *pace, struct fault *fault);

#endif
