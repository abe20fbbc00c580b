/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The report on samples that were solved. */
#ifndef PERCUSS_ENSEMBLE_REPORT_MAKE_H
#define PERCUSS_ENSEMBLE_REPORT_MAKE_H

#include "ensemble/report.h"

/* The report on the material. What its warnings quote is solved again, watched by `watch` (NULL:
 * nobody), see remarks.h. False: out of memory. Release it all the same. */
bool report_create(struct ensemble_report *report, const struct ensemble *ensemble,
                   const struct report_material *material, const struct watch *watch);

#endif
