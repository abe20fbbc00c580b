/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A computed table as the curves of the contact law. */
#ifndef PERCUSS_STORE_TABLE_CURVES_H
#define PERCUSS_STORE_TABLE_CURVES_H

#include <stddef.h>

#include "contact/family.h"
#include "fe/indentation.h"

/* ---- unloading branches: computed as recovery at fractions of the force, used by laws as shares
 * of the force at equal steps of the recovery ---- */

enum { BRANCH_SHARES_SCRATCH = 5 * INDENTATION_SAMPLES };

/* Fills share[count]. F^(2/3) is nearly linear in the recovery, and a spline interpolates it;
 * `part` blends Hertz's branch (0) with the computed one (1). */
void branch_shares_fill(const double *recovery, double part, size_t count, double *share,
                        double scratch[BRANCH_SHARES_SCRATCH]);

/* ---- tables ---- */

/* Beyond the table's last indentation its curves continue in proportion to those of the family, if
 * there is one (NULL: none). BAD_REQUEST: the table's curves do not rise as they must; INTERNAL:
 * out of memory; *curves is NULL then. Otherwise free it with contact_curves_free. */
enum percuss_status table_curves_make(const struct indentation_table *table,
                                      const struct contact_family *family,
                                      struct contact_curves **curves, struct fault *fault);

#endif
