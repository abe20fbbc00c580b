/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How well the one model of all samples answers. */
#ifndef PERCUSS_ENSEMBLE_VERIFICATION_H
#define PERCUSS_ENSEMBLE_VERIFICATION_H

#include "ensemble/report.h"

/* Fills report->verification from the samples that were solved again by the accuracy search.
 * False: out of memory. */
bool verification_fill(struct ensemble_report *report, const struct ensemble *ensemble,
                       const struct report_material *material);

#endif
