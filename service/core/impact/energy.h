/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The energy audit: it computes each term, none as a remainder. */
#ifndef PERCUSS_IMPACT_ENERGY_H
#define PERCUSS_IMPACT_ENERGY_H

#include "impact/impact.h"

/* Fills outcome->energy and ->vibration from the scene, the final motion and laws, and the
 * dissipated energy. `indentation` holds the local indentation of the contacts that are still
 * closed, 0 of the others. False: out of memory. */
bool energy_audit(const struct scene *scene, const double *indentation, double damping,
                  struct arena *arena, struct impact_outcome *outcome);

#endif
