/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The energy audit: it computes each term, none as a remainder. */
#ifndef PERCUSS_IMPACT_ENERGY_H
#define PERCUSS_IMPACT_ENERGY_H

#include "impact/impact.h"

/* The end of a march. */
struct energy_end {
    const double
        *indentation;    /* [contact], local, of those that are still closed; 0 of the others */
    const double *force; /* [contact] of lossy laws, N; NULL: there is none */
    const double *tangential; /* [2 frictions]: forces of the tangents, N; NULL: without friction */
    double damping;           /* lost so far, J */
};

/* Fills outcome->energy and ->vibration from the scene, the final motion and laws, and the
 * dissipated energy. False: out of memory. */
bool energy_audit(const struct scene *scene, const struct energy_end *last, struct arena *arena,
                  struct impact_outcome *outcome);

#endif
